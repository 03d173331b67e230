// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/check_frames.h"
#include "cslam/dataset/truth_check.h"
#include "cslam/geometry/se3.h"
#include "cslam/io/truth_files.h"

#include <cstddef>
#include <vector>

namespace cslam {

struct StoryCheckOptions;

// Which frames see what. Opens as few images as it can: detections tell of objects with a class,
// poses tell where something can be in view at all. All arguments must outlive it.
class StoryViews {
 public:
  StoryViews(const CheckFrames& frames, const SequenceTruth& truth,
             const StoryCheckOptions& options);

  std::size_t size() const { return frames_.size(); }
  double time_s(std::size_t frame) const;  // since the sequence's start

  // The first frame at or after the time; size() if there is none.
  std::size_t FirstFrameAt(double time_s) const;

  // Pixels of the instance in a frame.
  int VisiblePx(std::size_t frame, int instance) const;

  // Frames begin to end - 1, in order, that show enough of the instance.
  std::vector<std::size_t> Showing(int instance, std::size_t begin, std::size_t end) const;

  // Frames, in order, that prove that the instance is not at the pose: depth reaches through the
  // place where its box would be, or something else is seen there.
  std::vector<std::size_t> SeeingEmpty(int instance, const Se3& T_world_object, std::size_t begin,
                                       std::size_t end) const;

 private:
  bool IsRecorded(int instance) const;
  // Points inside the instance's box at the pose, in the world.
  std::vector<Eigen::Vector3d> PointsIn(int instance, const Se3& T_world_object) const;
  bool MaySee(std::size_t frame, const std::vector<Eigen::Vector3d>& points) const;
  bool SeesEmpty(std::size_t frame, int instance, const Se3& T_world_object,
                 const std::vector<Eigen::Vector3d>& points) const;

  const CheckFrames& frames_;
  const SequenceTruth& truth_;
  const StoryCheckOptions& options_;
};

}  // namespace cslam
