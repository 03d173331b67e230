// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/dataset.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/sim/simulated_sequence.h"

#include <opencv2/core.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <vector>

namespace cslam {

// For tests: a few frames of the demo sequence at 320 x 240, rendered once, played from memory.
class SimulatedDataset : public DatasetReader {
 public:
  explicit SimulatedDataset(int num_frames)
      : sequence_(MakeDemoSequence({.width = 320, .height = 240})) {
    camera_.camera = sequence_.camera();
    camera_.name = "simulated";
    for (int i = 0; i < num_frames; ++i)
      frames_.push_back(sequence_.Frame(i));
  }

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
    Trajectory truth;
    for (int i = 0; i < static_cast<int>(size()); ++i)
      truth.push_back({sequence_.stamp(i), sequence_.T_world_camera(i)});
    WriteTrajectory(path, truth);
    ground_truth_ = path;
  }

 private:
  SimulatedSequence sequence_;
  CameraConfig camera_;
  std::vector<RgbdFrame> frames_;
  std::set<std::size_t> unreadable_;
  bool has_depth_ = true;
  std::optional<std::filesystem::path> ground_truth_;
};

// 20 frames, rendered once for the whole program. Copies share pixels.
inline const SimulatedDataset& RenderedDataset() {
  static const SimulatedDataset kDataset(20);
  return kDataset;
}

}  // namespace cslam
