// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/check_folder.h"

#include "cslam/io/image_codec.h"
#include "cslam/io/instance_image.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/util/check.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace cslam {
namespace {

constexpr double kMaxPoseGapS = 0.1;  // longer gaps of the ground truth are not bridged
constexpr char kInstanceFolder[] = "instances";

}  // namespace

FolderFrames::FolderFrames(TumIndex index, const CameraConfig& camera)
    : index_(std::move(index)), camera_(camera) {
  std::error_code ignored;
  has_instances_ = std::filesystem::is_directory(index_.folder / kInstanceFolder, ignored);
  pose_file_ = index_.ground_truth_camera ? index_.ground_truth_camera : index_.ground_truth;
  if (!pose_file_) return;
  try {
    poses_ = ReadTrajectory(*pose_file_);
  } catch (const Error&) {
    poses_.clear();  // CheckDataset() tells why
  }
}

std::optional<Se3> FolderFrames::T_world_camera(std::size_t i) const {
  const Stamp stamp = index_.pairs[i].depth_stamp;
  const auto after =
      std::lower_bound(poses_.begin(), poses_.end(), stamp,
                       [](const StampedPose& pose, Stamp wanted) { return pose.stamp < wanted; });
  if (after == poses_.end()) return std::nullopt;
  if (after->stamp == stamp) return after->T_world_camera;
  if (after == poses_.begin()) return std::nullopt;
  const StampedPose& before = *std::prev(after);
  const double gap_s = SecondsBetween(after->stamp, before.stamp);
  if (gap_s > kMaxPoseGapS) return std::nullopt;
  return Interpolate(before.T_world_camera, after->T_world_camera,
                     SecondsBetween(stamp, before.stamp) / gap_s);
}

cv::Mat FolderFrames::DepthM(std::size_t i) const {
  try {
    cv::Mat depth_m;
    ReadDepthImage(index_.pairs[i].depth)
        .convertTo(depth_m, CV_32F, 1.0 / camera_.depth_units_per_m);
    const bool has_size = depth_m.cols == camera().width && depth_m.rows == camera().height;
    return has_size ? depth_m : cv::Mat();
  } catch (const Error&) {
    return {};
  }
}

cv::Mat FolderFrames::Instances(std::size_t i) const {
  const std::filesystem::path file =
      index_.folder / kInstanceFolder / index_.pairs[i].color.filename();
  try {
    return ReadInstanceImage(file);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace cslam
