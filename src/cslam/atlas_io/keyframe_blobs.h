// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/vision/frame_features.h"

#include <opencv2/core/mat.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace cslam {

// The blobs of a keyframe's row: arrays without gaps, one element per keypoint
// (docs/formats.md). Each unpacker throws Error unless the blob has num_keypoints elements.
inline constexpr std::size_t kKeypointBytes = 29;

std::string PackKeypoints(const std::vector<Keypoint>& keypoints);
std::vector<Keypoint> UnpackKeypoints(std::string_view bytes);  // tells their number

std::string PackDescriptors(const std::vector<Descriptor>& descriptors);
std::vector<Descriptor> UnpackDescriptors(std::string_view bytes, std::size_t num_keypoints);

std::string PackSemantics(const std::vector<KeypointSemantics>& semantics);
std::vector<KeypointSemantics> UnpackSemantics(std::string_view bytes, std::size_t num_keypoints);

std::string PackPoints(const std::vector<PointId>& points);
std::vector<PointId> UnpackPoints(std::string_view bytes, std::size_t num_keypoints);

// Pixel by pixel, row by row. An empty image has no rows. type: CV_16UC1 or CV_8UC3.
std::string PackImage(const cv::Mat& image);
cv::Mat UnpackImage(std::string_view bytes, std::int64_t width_px, std::int64_t height_px,
                    int type);

}  // namespace cslam
