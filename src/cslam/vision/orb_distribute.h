// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/vision/orb_kernels.h"

#include <opencv2/core/types.hpp>

#include <vector>

namespace cslam::orb {

// In each cell of about 30 px keeps the strongest candidates above `score` (16 of them, more where
// `count` corners need them), or the strongest of all if none is above it. In any order.
std::vector<Candidate> ThinOut(const std::vector<Candidate>& candidates, cv::Rect area, int score,
                               int count);

// The `count` candidates (or all, if there are fewer) with the largest suppression radius: the
// distance to the next stronger candidate, stretched the more the closer that one is in strength.
// Even cover without cell borders, yet strong corners side by side stay (after Brown, Szeliski,
// Winder: Multi-Image Matching using Multi-Scale Oriented Patches, 2005). In any order.
std::vector<Candidate> SelectEvenly(const std::vector<Candidate>& candidates, cv::Rect area,
                                    int count, Simd simd);

// Splits `total` over levels by `shares`; a level gets no more than it has available, and what it
// cannot use goes to the others.
std::vector<int> SplitCount(int total, const std::vector<double>& shares,
                            const std::vector<int>& available);

}  // namespace cslam::orb
