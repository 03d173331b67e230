// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/id.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace cslam {

// A detection that may be of a tracked object, for their boxes overlap.
struct BoxOverlap {
  double iou = 0.0;
  std::size_t detection = 0;
  TrackId track;
};

// One to one, best overlaps first, ties by track (Algorithm 2 of the paper). For each of the
// detections its track or nothing.
std::vector<std::optional<TrackId>> MatchBestFirst(std::vector<BoxOverlap> overlaps,
                                                   std::size_t num_detections);

}  // namespace cslam
