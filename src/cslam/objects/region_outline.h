// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/depth_region.h"

namespace cslam {

// Whether the picture's border cuts the region off, so that its centre is not the thing's.
bool IsClipped(const DepthRegion& region);

// Whether something clearly nearer stands right beside the region and may hide a part of the
// thing. view: the region's own.
bool IsCovered(const DepthRegion& region, const DepthView& view);

// Share of the region's pixels that other covers, too; both of one view. 0 if one is empty.
double ShareInside(const DepthRegion& region, const DepthRegion& other);

}  // namespace cslam
