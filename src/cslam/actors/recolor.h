// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/person_look.h"

#include <opencv2/core/mat.hpp>

namespace cslam {

// Photographed textures (CV_8UC3) in another person's colours; light and shade stay. Unused parts
// of such textures are black.
cv::Mat RecolorSkin(const cv::Mat& skin, const PersonLook& look);
cv::Mat RecolorHair(const cv::Mat& hair, const PersonLook& look);
cv::Mat RecolorShoes(const cv::Mat& shoes, const PersonLook& look);
cv::Mat RecolorTrousers(const cv::Mat& jeans, const PersonLook& look);

// The look's own cloth with the photograph's folds; the print goes.
cv::Mat RecolorShirt(const cv::Mat& shirt, const PersonLook& look);

}  // namespace cslam
