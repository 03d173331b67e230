// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/semantics/detection.h"

#include <cstddef>
#include <vector>

namespace cslam {

// Non-maximum suppression, for each class by itself: of two boxes that overlap by more than
// max_iou only the one with the better score stays. Boxes that are empty or not finite and scores
// that are NaN go first. At most max_detections are kept, best score first; equal scores keep the
// order they came in.
std::vector<Detection> SuppressNonMaxima(std::vector<Detection> candidates, double max_iou,
                                         std::size_t max_detections);

}  // namespace cslam
