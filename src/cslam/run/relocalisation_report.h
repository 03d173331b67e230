// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/pipeline/frame_localiser.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

// Frames of a sequence that were looked for in a map one by one.
struct RelocalisationReport {
  struct Frame {
    LocalisedFrame result;
    std::optional<PoseDifference> error;  // where it was found and the truth is known
  };
  std::filesystem::path map;
  std::filesystem::path sequence;
  std::vector<Frame> frames;
  std::size_t num_unreadable = 0;
  std::optional<double> keyframe_rmse_m;  // of the map's keyframes, aligned to the truth
};

// Errors of the frames that were found.
struct RelocalisationErrors {
  std::size_t count = 0;
  double median_m = 0.0;
  double max_m = 0.0;
  double median_deg = 0.0;
  double max_deg = 0.0;
};

std::size_t CountFound(const RelocalisationReport& report);
RelocalisationErrors SummariseErrors(const std::vector<RelocalisationReport::Frame>& frames);

// A table for a terminal.
std::string FormatRelocalisation(const RelocalisationReport& report);

// One JSON object with every frame (docs/formats.md).
std::string FormatRelocalisationJson(const RelocalisationReport& report);

}  // namespace cslam
