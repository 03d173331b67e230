// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/random.h"

#include <opencv2/core/mat.hpp>

namespace cslam {

// Procedural things with a front: each fills its whole image (size in texels, CV_8UC3, BGR), and
// no two generators give the same one.

cv::Mat PaintPoster(cv::Size size, Rng rng);  // a picture with headline and small print
cv::Mat PaintPhoto(cv::Size size, Rng rng);   // hills, houses, sky
cv::Mat PaintPage(cv::Size size, Rng rng);    // a printed sheet
cv::Mat PaintScreen(cv::Size size, Rng rng);  // windows with code and a diagram
cv::Mat PaintKeyboard(cv::Size size, Rng rng);
cv::Mat PaintBookSpine(cv::Size size, Rng rng);   // title across the width
cv::Mat PaintNotesBoard(cv::Size size, Rng rng);  // cork with pinned sheets
cv::Mat PaintWhiteboard(cv::Size size, Rng rng);  // scribbles and boxes
cv::Mat PaintDoor(cv::Size size, double texels_per_m, Rng rng);
cv::Mat PaintDrawers(cv::Size size, int rows, double texels_per_m, Rng rng);
cv::Mat PaintPackage(cv::Size size, Rng rng);  // a printed product box

}  // namespace cslam
