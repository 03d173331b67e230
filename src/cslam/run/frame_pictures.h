// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/dataset.h"
#include "cslam/pipeline/sink.h"

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <filesystem>

namespace cslam {

// A frame as SLAM saw it: keypoints by label (background green, movable yellow, dynamic red, as in
// the paper), objects with class, track and speed. bgr: H x W, CV_8UC3; result must have been made
// with tracking.report_keypoints.
cv::Mat DrawFrame(const cv::Mat& bgr, const TrackingResult& result);

// Writes such a picture of every stride-th frame into folder as <frame>.png. Reads the frames
// again from the data set, which must outlive the sink; first_frame is the id of its frame 0.
class FramePictures : public OutputSink {
 public:
  FramePictures(const DatasetReader& dataset, std::filesystem::path folder, std::size_t first_frame,
                std::size_t stride);

  void OnFrame(const TrackingResult& result) override;

 private:
  const DatasetReader& dataset_;
  std::filesystem::path folder_;
  std::size_t first_frame_;
  std::size_t stride_;
};

}  // namespace cslam
