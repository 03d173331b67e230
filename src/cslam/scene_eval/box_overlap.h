// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/visibility.h"

namespace cslam {

// Volume that two boxes share over the volume of both, 0 to 1, to about 0.01: counted on
// points that fill the smaller one. 0 if a box has no volume.
double IntersectionOverUnion(const PlacedBox& a, const PlacedBox& b);

}  // namespace cslam
