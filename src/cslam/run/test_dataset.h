// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/dataset.h"
#include "cslam/io/trajectory_file.h"

#include <opencv2/core.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace cslam {

// For tests: frames that are played from memory.
class MemoryDataset : public DatasetReader {
 public:
  // truth: the pose of each frame.
  MemoryDataset(CameraConfig camera, std::vector<RgbdFrame> frames, Trajectory truth)
      : camera_(std::move(camera)), frames_(std::move(frames)), truth_(std::move(truth)) {}

  std::size_t size() const override { return frames_.size(); }
  Stamp stamp(std::size_t index) const override { return frames_[index].stamp; }
  const CameraConfig& camera() const override { return camera_; }
  std::optional<std::filesystem::path> ground_truth() const override { return ground_truth_; }

  LoadResult Load(std::size_t index) const override {
    if (unreadable_.contains(index)) {
      return {.frame = std::nullopt, .fault = FrameFault::kUnreadable, .problem = "no such luck"};
    }
    LoadResult result{.frame = frames_[index], .fault = FrameFault::kNone, .problem = {}};
    // A new matrix: assigning an expression would write into the shared one.
    if (!has_depth_) result.frame->depth_m = cv::Mat(frames_[index].gray.size(), CV_32FC1, 0.0);
    return result;
  }

  void MakeUnreadable(std::size_t index) { unreadable_.insert(index); }
  void RemoveDepth() { has_depth_ = false; }
  void WriteGroundTruth(const std::filesystem::path& path) {
    WriteTrajectory(path, truth_);
    ground_truth_ = path;
  }

 private:
  CameraConfig camera_;
  std::vector<RgbdFrame> frames_;
  Trajectory truth_;
  std::set<std::size_t> unreadable_;
  bool has_depth_ = true;
  std::optional<std::filesystem::path> ground_truth_;
};

// The first 20 frames of the demo sequence at 320 x 240, rendered once for the whole program.
// Copies share pixels.
const MemoryDataset& RenderedDataset();

}  // namespace cslam
