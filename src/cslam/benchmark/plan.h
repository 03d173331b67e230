// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/rendering.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

// What a benchmark renders and runs, and where that lies.

namespace cslam {

// Off: things are the room, and only people and what moves are left out.
enum class ObjectLayer { kOn, kOff };
std::string_view NameOf(ObjectLayer layer);  // "on", "off"

struct BenchmarkRequest {
  std::filesystem::path folder;
  std::vector<std::string> sequences;  // names, or one of "six" and "all"
  bool is_short = false;
  std::uint64_t first_seed = 1;
  int num_seeds = 1;    // renderings of each sequence
  int num_repeats = 1;  // runs of each rendering; of inline runs one is enough
  std::vector<ObjectLayer> layers = {ObjectLayer::kOn, ObjectLayer::kOff};
};

// A rendering of a sequence.
struct PlannedData {
  std::string sequence;
  std::uint64_t seed = 1;
  std::filesystem::path folder;
};

struct PlannedRun {
  std::size_t data = 0;  // index of its rendering
  ObjectLayer layer = ObjectLayer::kOn;
  int repeat = 1;
  std::filesystem::path folder;
};

struct BenchmarkPlan {
  std::vector<PlannedData> data;
  std::vector<PlannedRun> runs;  // those of one rendering one after the other

  std::vector<std::string> Sequences() const;  // in order, each once
};

// The sequences of the paper's table.
std::vector<std::string> SixSequences();

// "six", "all" (but the demo) or names; throws Error for a name there is not, or there twice.
std::vector<std::string> ResolveSequences(const std::vector<std::string>& names);

// request.sequences must be resolved. Renderings lie in <folder>/data, runs in <folder>/runs.
BenchmarkPlan MakePlan(const BenchmarkRequest& request);

// What the folder of a rendering holds.
enum class RenderingState {
  kUnfinished,  // nothing yet, or a beginning that can be gone on with
  kOutdated,    // a beginning by another version of the program, whose pictures may differ
  kComplete,    // by whatever version
};

// request, look ("packages", "procedural", or empty: any): what was asked for. Throws Error if the
// folder holds a rendering of something else.
RenderingState StateOf(const PlannedData& data, const RenderRequest& request, std::string_view look,
                       std::string_view program);

// Whether a run folder is complete and of a run of this program (commit) with these arguments.
bool IsRunDone(const std::filesystem::path& folder, std::string_view commit,
               const std::vector<std::string>& arguments);

}  // namespace cslam
