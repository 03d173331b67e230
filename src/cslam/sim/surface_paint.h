// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/random.h"

#include <opencv2/core/mat.hpp>

namespace cslam {

// Procedural materials: size in texels, scale in texels per metre, a generator that alone decides
// how they differ. All return CV_8UC3, BGR.

cv::Mat PaintPlaster(cv::Size size, double texels_per_m, const cv::Scalar& color, Rng rng);
cv::Mat PaintWallpaper(cv::Size size, double texels_per_m, const cv::Scalar& color, Rng rng);
cv::Mat PaintBricks(cv::Size size, double texels_per_m, Rng rng);
cv::Mat PaintPlanks(cv::Size size, double texels_per_m, Rng rng);
cv::Mat PaintWood(cv::Size size, double texels_per_m, const cv::Scalar& color, Rng rng);
cv::Mat PaintFabric(cv::Size size, double texels_per_m, const cv::Scalar& color, Rng rng);
cv::Mat PaintRug(cv::Size size, double texels_per_m, Rng rng);
cv::Mat PaintCeiling(cv::Size size, double texels_per_m, Rng rng);
cv::Mat PaintCardboard(cv::Size size, double texels_per_m, Rng rng);
cv::Mat PaintPlain(cv::Size size, const cv::Scalar& color, Rng rng);

}  // namespace cslam
