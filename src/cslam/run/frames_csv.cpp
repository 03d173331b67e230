// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/frames_csv.h"

#include "cslam/run/stage_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace cslam {
namespace {

std::string Quote(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

template <typename Tag>
std::string IdOrEmpty(Id<Tag> id) {
  return id.valid() ? fmt::format("{}", id.value()) : "";
}

// In the order in which they first ran.
std::vector<std::string_view> FindStages(const std::vector<TrackingResult>& frames) {
  std::vector<std::string_view> stages;
  for (const TrackingResult& frame : frames) {
    for (const StageTime& time : frame.times) {
      if (std::find(stages.begin(), stages.end(), time.stage) == stages.end()) {
        stages.emplace_back(time.stage);
      }
    }
  }
  return stages;
}

std::string StageField(const TrackingResult& frame, std::string_view stage) {
  double ms = 0.0;
  bool did_run = false;
  for (const StageTime& time : frame.times) {
    if (time.stage != stage) continue;
    ms += time.ms;
    did_run = true;
  }
  return did_run ? fmt::format("{:.3f}", ms) : "";
}

}  // namespace

std::string FormatFramesCsv(const std::vector<TrackingResult>& frames) {
  const std::vector<std::string_view> stages = FindStages(frames);
  std::string csv =
      "frame,timestamp_s,state,reason,map,keypoints,matches,inliers,keyframe,reference_keyframe,"
      "map_revision,total_ms";
  const auto out = std::back_inserter(csv);
  for (const std::string_view stage : stages)
    fmt::format_to(out, ",{}_ms", stage);
  csv += '\n';
  for (const TrackingResult& frame : frames) {
    fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{},{},{:.3f}", frame.frame.value(),
                   FormatStamp(frame.stamp), ToString(frame.state), Quote(frame.reason),
                   IdOrEmpty(frame.map), frame.num_keypoints, frame.num_map_matches,
                   frame.num_inliers, ToString(frame.keyframe_reason), IdOrEmpty(frame.reference),
                   frame.map_revision, TotalOf(frame.times).wall_ms);
    for (const std::string_view stage : stages)
      fmt::format_to(out, ",{}", StageField(frame, stage));
    csv += '\n';
  }
  return csv;
}

}  // namespace cslam
