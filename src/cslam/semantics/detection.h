// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/id.h"
#include "cslam/util/stamp.h"
#include "cslam/vision/box.h"

#include <opencv2/core/mat.hpp>

#include <vector>

namespace cslam {

constexpr int kBackgroundClass = -1;
constexpr int kPersonClass = 0;

// One thing that a detector found in an image.
struct Detection {
  int class_id = kBackgroundClass;  // COCO
  double score = 0.0;               // 0 to 1
  Box box;                          // in the image as recorded, within it
  cv::Mat mask;  // of the box's pixels (CV_8UC1, non-zero inside), or empty: not known
};

// All that was found in one frame, best score first.
struct Detections {
  FrameId frame;
  Stamp stamp;
  std::vector<Detection> objects;
};

}  // namespace cslam
