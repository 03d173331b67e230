// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"
#include "cslam/sim/renderer.h"

#include <opencv2/core/mat.hpp>

namespace cslam {

// How the camera moved while the shutter was open.
struct ShutterMotion {
  Se3 T_world_first;  // the camera as it opens
  Se3 T_world_last;   // and as it closes
  double open_s = 0.0;
};

// H x W, CV_32FC2: how far (px) what each pixel shows moves through the picture meanwhile.
cv::Mat FlowOf(const RenderedView& view, const Camera& camera, const ShutterMotion& motion);

// The view's colours smeared along their flow, half of it to either side. A pixel that moves less
// than a third of a pixel stays as it is.
cv::Mat BlurMotion(const cv::Mat& bgr, const cv::Mat& flow_px);

}  // namespace cslam
