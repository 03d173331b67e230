// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/vision/features.h"

#include <opencv2/core/mat.hpp>

#include <memory>
#include <vector>

namespace cslam {

class OptionList;

struct OrbOptions {
  int num_features = 1000;     // per image, over all levels
  int num_levels = 8;          // pyramid levels
  double scale_factor = 1.2;   // between neighbouring levels
  int fast_threshold = 20;     // grey levels
  int fast_threshold_min = 7;  // tried where a cell has no corner at fast_threshold
  bool subpixel = true;        // refine positions to fractions of a level's pixel
};
void Describe(OptionList& list, OrbOptions& o);

// Scale of each level relative to full resolution: scale_factor^level.
std::vector<double> LevelScales(const OrbOptions& options);

// Extracts ORB features. Keeps its buffers between calls, so one instance per thread.
// The result depends on the image and the options alone.
class OrbExtractor {
 public:
  explicit OrbExtractor(const OrbOptions& options);
  ~OrbExtractor();

  // gray: H x W, CV_8UC1. mask: empty, or H x W CV_8UC1, features only where it is non-zero.
  OrbFeatures Extract(const cv::Mat& gray, const cv::Mat& mask = cv::Mat());

 private:
  struct Workspace;
  OrbOptions options_;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace cslam
