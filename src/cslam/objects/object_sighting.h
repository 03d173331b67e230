// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/colour_histogram.h"
#include "cslam/objects/depth_region.h"
#include "cslam/objects/object_classes.h"
#include "cslam/util/id.h"
#include "cslam/util/stamp.h"
#include "cslam/vision/box.h"

#include <opencv2/core/mat.hpp>

#include <span>

namespace cslam {

// A resting, named thing as one frame shows it: what the map learns of objects.
struct ObjectSighting {
  TrackId track;
  int class_id = -1;  // COCO
  double score = 0.0;
  Box box;             // undistorted px
  DepthRegion region;  // in the frame's depth view; never empty
  Stamp first_detected;
  Stamp detected;  // the newest frame a detector saw it in; carried on since
  ColourHistogram colours{};
};

// What things of other kinds cover (CV_8UC1 of the view's size); empty if nothing.
cv::Mat CoveredByOthers(std::span<const ObjectSighting> sightings, int class_id,
                        const ObjectClasses& classes);

}  // namespace cslam
