// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/id.h"
#include "cslam/util/stamp.h"

#include <opencv2/core/mat.hpp>

namespace cslam {

// One input: the only owner of full-size pixels. Fill it, then share it as
// shared_ptr<const RgbdFrame>; nobody writes to it or keeps one of its matrices afterwards.
struct RgbdFrame {
  FrameId id;
  Stamp stamp;      // of the colour image
  cv::Mat gray;     // H x W, CV_8UC1
  cv::Mat bgr;      // H x W, CV_8UC3; may be empty
  cv::Mat depth_m;  // H x W, CV_32FC1, metres along z, registered to colour; 0 = no reading
};

}  // namespace cslam
