// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/loop/loop_options.h"

#include <opencv2/core/mat.hpp>

#include <string>
#include <vector>

namespace cslam {

// How the depth readings of one side of a loop fit those of the other.
struct DepthComparison {
  int num_agreeing = 0;       // the same surface, within noise
  int num_contradicting = 0;  // a surface where the other side saw through

  int num_compared() const { return num_agreeing + num_contradicting; }
  double contradicted() const {
    return num_compared() == 0 ? 0.0 : static_cast<double>(num_contradicting) / num_compared();
  }
};

// A keyframe's reduced depth image (KeyframeData::depth_small_mm) at its pose.
struct PlacedDepth {
  cv::Mat depth_small_mm;
  Se3 T_world_camera;
};

// Carries every reading of each view into every view of the other side, both ways. A reading behind
// what the other saw says nothing: the other view's own readings are judged when their turn comes.
DepthComparison CompareDepth(const std::vector<PlacedDepth>& side_a,
                             const std::vector<PlacedDepth>& side_b, const Camera& camera,
                             const DepthCheckOptions& options);

// Why depth says that the two sides are not the same place; empty if it does not.
std::string WhyContradicted(const DepthComparison& depth, const DepthCheckOptions& options);

}  // namespace cslam
