// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/semantics/detection.h"

#include <vector>

namespace cslam {

// Detectors call one thing by two names at once, in boxes that are all but equal. The better score
// stays: as two things each would get the pixels that the other one left over, floor and wall.
// Boxes that overlap (Iou) by max_iou or more count as equal. People keep theirs: they may well be
// in front of what fills the same box. The order is kept.
std::vector<Detection> WithoutSecondNames(std::vector<Detection> detections, double max_iou);

}  // namespace cslam
