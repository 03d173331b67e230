// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/benchmark/plan.h"

#include "cslam/dataset/render_record.h"
#include "cslam/dataset/sequence_folder.h"
#include "cslam/io/json_reader.h"
#include "cslam/util/check.h"
#include "cslam/util/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace cslam {
namespace {

constexpr std::string_view kSix = "six";
constexpr std::string_view kAll = "all";

std::vector<std::string> AllNames() {
  std::vector<std::string> names;
  for (const SequenceEntry& entry : AllSequences())
    names.emplace_back(entry.name);
  return names;
}

// As it is there, but with the parameters that were asked for.
RenderRecord Wanted(RenderRecord record, const PlannedData& data, const RenderRequest& request,
                    std::string_view look) {
  const auto entries = AllSequences();
  const auto entry = std::find_if(entries.begin(), entries.end(), [&](const SequenceEntry& one) {
    return one.name == data.sequence;
  });
  CSLAM_CHECK(entry != entries.end());
  if (!look.empty()) record.look = look;
  record.sequence = data.sequence;
  record.seed = data.seed;
  record.width_px = request.width;
  record.height_px = request.height;
  record.fps = request.fps;
  record.num_frames = CountFrames(*entry, request);
  record.noise = NoiseOf(*entry, request);
  record.is_short = request.is_short;
  record.without_people = request.without_people;
  record.without = request.without;
  return record;
}

}  // namespace

std::string_view NameOf(ObjectLayer layer) {
  return layer == ObjectLayer::kOn ? "on" : "off";
}

std::vector<std::string> BenchmarkPlan::Sequences() const {
  std::vector<std::string> names;
  for (const PlannedData& one : data) {
    if (names.empty() || names.back() != one.sequence) names.push_back(one.sequence);
  }
  return names;
}

std::vector<std::string> SixSequences() {
  return {"static", "onechair", "vanishing", "changing", "shift", "replacing"};
}

std::vector<std::string> ResolveSequences(const std::vector<std::string>& names) {
  if (names.size() == 1 && names[0] == kSix) return SixSequences();
  const std::vector<std::string> all = AllNames();
  if (names.size() == 1 && names[0] == kAll) return all;
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(all.begin(), all.end(), *name) == all.end()) {
      throw Error("unknown sequence '{}'; did you mean '{}'? (see 'changing-slam dataset list')",
                  *name, NearestName(*name, all));
    }
    if (std::find(names.begin(), name, *name) != name) throw Error("'{}' is named twice", *name);
  }
  return names;
}

BenchmarkPlan MakePlan(const BenchmarkRequest& request) {
  BenchmarkPlan plan;
  const char* const form = request.is_short ? "short" : "long";
  for (const std::string& sequence : request.sequences) {
    for (int i = 0; i < request.num_seeds; ++i) {
      const std::uint64_t seed = request.first_seed + static_cast<std::uint64_t>(i);
      const std::string name = fmt::format("{}-{}-{}", sequence, form, seed);
      for (int repeat = 1; repeat <= request.num_repeats; ++repeat) {
        for (const ObjectLayer layer : request.layers) {
          const std::string run = fmt::format("{}-objects_{}-{}", name, NameOf(layer), repeat);
          plan.runs.push_back({plan.data.size(), layer, repeat, request.folder / "runs" / run});
        }
      }
      plan.data.push_back({sequence, seed, request.folder / "data" / name});
    }
  }
  return plan;
}

RenderingState StateOf(const PlannedData& data, const RenderRequest& request, std::string_view look,
                       std::string_view program) {
  const bool is_complete = std::filesystem::exists(data.folder / kCameraFile);
  const std::filesystem::path file = data.folder / kRenderFile;
  if (!std::filesystem::exists(file))
    return is_complete ? RenderingState::kComplete : RenderingState::kUnfinished;
  const RenderRecord there = ReadRenderRecord(file);
  const auto differences = Differences(there, Wanted(there, data, request, look));
  if (!differences.empty()) {
    throw Error("'{}' holds another rendering: {}; choose another folder, or delete it",
                data.folder.string(), fmt::join(differences, ", "));
  }
  if (is_complete) return RenderingState::kComplete;
  return there.program == program ? RenderingState::kUnfinished : RenderingState::kOutdated;
}

bool IsRunDone(const std::filesystem::path& folder, std::string_view commit,
               const std::vector<std::string>& arguments) {
  if (!std::filesystem::exists(folder / "run.json")) return false;
  const JsonFile json(folder / "run.json");
  const JsonValue root = json.root();
  if (root.At("was_interrupted").Bool() || root.At("commit").Text() != commit) return false;
  std::vector<std::string> there;
  for (const JsonValue& argument : root.At("arguments").Items())
    there.push_back(argument.Text());
  return there == arguments;
}

}  // namespace cslam
