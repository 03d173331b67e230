// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/story.h"
#include "cslam/sim/simulated_sequence.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cslam {

std::string_view NameOf(SensorNoise noise);  // "off", "kinect", "d435i"

// render.json: what a folder is rendered with. Written before the first frame, so that an
// interrupted rendering can be told from any other folder and be gone on with.
struct RenderRecord {
  std::string sequence;             // name, as `dataset list` gives it
  std::string summary;              // one line for people
  std::string program;              // version and commit
  std::string look = "procedural";  // or "packages"
  std::string command;              // that renders it again; empty: none
  std::uint64_t seed = 1;
  bool is_short = false;
  bool without_people = false;
  std::vector<std::string> without;  // names of other objects left out; empty in older records
  int width_px = 0;
  int height_px = 0;
  double fps = 0.0;
  int num_frames = 0;
  double story_duration_s = 0.0;  // of the whole story, of which fewer frames may be rendered
  SensorNoise noise = SensorNoise::kOff;
  PeopleClaim people;  // what the whole story promises
};

// What the sequence itself knows; its name is up to the caller.
RenderRecord DescribeSequence(const SimulatedSequence& sequence, const std::string& name);

// Throws Error with file and place, like the readers of the truth files. Writing is atomic.
RenderRecord ReadRenderRecord(const std::filesystem::path& file);
void WriteRenderRecord(const std::filesystem::path& file, const RenderRecord& record);

// What tells two renderings apart: "seed is 1 there, 2 was asked for"; empty: nothing.
std::vector<std::string> Differences(const RenderRecord& there, const RenderRecord& wanted);

}  // namespace cslam
