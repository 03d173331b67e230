// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/check_frames.h"
#include "cslam/geometry/trajectory.h"
#include "cslam/io/camera_file.h"
#include "cslam/io/tum_dataset.h"

#include <filesystem>
#include <optional>
#include <string>

namespace cslam {

// The frames of a folder in TUM's layout, with true poses and, if there are any, instance images
// in instances/, named like the colour images. Reads an image when asked for it.
class FolderFrames : public CheckFrames {
 public:
  // Poses come from groundtruth_camera.txt, else groundtruth.txt, interpolated at the stamps of
  // the depth images; without either, or if it cannot be read, no frame has one.
  FolderFrames(TumIndex index, const CameraConfig& camera);

  // The file the poses come from.
  const std::optional<std::filesystem::path>& pose_file() const { return pose_file_; }
  const std::filesystem::path& folder() const { return index_.folder; }

  std::size_t size() const override { return index_.pairs.size(); }
  const Camera& camera() const override { return camera_.camera; }
  Stamp stamp(std::size_t i) const override { return index_.pairs[i].color_stamp; }
  std::optional<Se3> T_world_camera(std::size_t i) const override;
  cv::Mat DepthM(std::size_t i) const override;
  bool has_instances() const override { return has_instances_; }
  cv::Mat Instances(std::size_t i) const override;

 private:
  TumIndex index_;
  CameraConfig camera_;
  std::optional<std::filesystem::path> pose_file_;
  Trajectory poses_;
  bool has_instances_ = false;
};

}  // namespace cslam
