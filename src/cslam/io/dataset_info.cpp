// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/dataset_info.h"

#include "cslam/io/association.h"
#include "cslam/io/image_codec.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/util/check.h"
#include "cslam/util/quantile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <utility>

namespace cslam {
namespace {

constexpr std::int64_t kGroundTruthWindowNs = 20'000'000;

std::vector<double> IntervalsOf(const std::vector<TumPair>& pairs) {
  std::vector<double> intervals_s;
  for (std::size_t i = 1; i < pairs.size(); ++i)
    intervals_s.push_back(SecondsBetween(pairs[i].color_stamp, pairs[i - 1].color_stamp));
  return intervals_s;
}

void FillTimes(DatasetInfo& info, const std::vector<TumPair>& pairs) {
  info.first_stamp = pairs.front().color_stamp;
  info.duration_s = SecondsBetween(pairs.back().color_stamp, info.first_stamp);
  const std::vector<double> intervals_s = IntervalsOf(pairs);
  const double interval_s = intervals_s.empty() ? 0.0 : MedianOf(intervals_s);
  info.rate_hz = interval_s > 0.0 ? 1.0 / interval_s : 0.0;
  info.gaps = FindGaps(pairs);
  double sum_s = 0.0;
  for (const TumPair& pair : pairs) {
    const double difference_s = std::abs(SecondsBetween(pair.color_stamp, pair.depth_stamp));
    sum_s += difference_s;
    info.max_pair_difference_s = std::max(info.max_pair_difference_s, difference_s);
  }
  info.mean_pair_difference_s = sum_s / static_cast<double>(pairs.size());
}

void FillFromSample(DatasetInfo& info, const std::vector<TumPair>& pairs,
                    const CameraConfig& camera, std::size_t num_samples) {
  DepthStatistics depth;
  for (const std::size_t i : EvenSample(pairs.size(), num_samples)) {
    const LoadResult result = LoadTumPair(pairs[i], FrameId(static_cast<std::uint32_t>(i)), camera);
    ++info.num_sampled;
    if (result.frame) {
      depth.Add(result.frame->depth_m);
      continue;
    }
    ++info.num_unreadable;
    if (info.first_problem.empty()) info.first_problem = result.problem;
  }
  info.depth_valid_share = depth.valid_share();
  info.median_depth_m = depth.median_m();
}

// Of the first colour image that can be read, among a few: a whole folder of broken ones shall not
// take long.
cv::Size FindImageSize(const std::vector<TumPair>& pairs) {
  constexpr std::size_t kMaxTries = 10;
  for (const std::size_t i : EvenSample(pairs.size(), kMaxTries)) {
    try {
      return ReadColorImage(pairs[i].color).size();
    } catch (const Error&) {
      continue;  // told with its reason when the frame itself is loaded
    }
  }
  return {};
}

// Null if the nearest one is outside the window.
const StampedPose* NearestPose(const Trajectory& trajectory, Stamp stamp) {
  const auto distance_ns = [&](const StampedPose& pose) {
    return std::abs(pose.stamp.ns - stamp.ns);
  };
  const auto after =
      std::lower_bound(trajectory.begin(), trajectory.end(), stamp,
                       [](const StampedPose& pose, Stamp wanted) { return pose.stamp < wanted; });
  const StampedPose* nearest = after == trajectory.end() ? nullptr : &*after;
  if (after != trajectory.begin()) {
    const StampedPose& before = *std::prev(after);
    if (nearest == nullptr || distance_ns(before) < distance_ns(*nearest)) nearest = &before;
  }
  return nearest != nullptr && distance_ns(*nearest) <= kGroundTruthWindowNs ? nearest : nullptr;
}

}  // namespace

std::vector<FrameGap> FindGaps(const std::vector<TumPair>& pairs, double longer_than_s) {
  std::vector<FrameGap> gaps;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const double length_s = SecondsBetween(pairs[i].color_stamp, pairs[i - 1].color_stamp);
    if (length_s > longer_than_s) gaps.push_back({.frame = i - 1, .length_s = length_s});
  }
  return gaps;
}

std::vector<std::size_t> EvenSample(std::size_t total, std::size_t count) {
  count = std::min(count, total);
  std::vector<std::size_t> indices(count);
  for (std::size_t i = 0; i < count; ++i)
    indices[i] = count == 1 ? 0 : i * (total - 1) / (count - 1);
  return indices;
}

void DepthStatistics::Add(const cv::Mat& depth_m) {
  constexpr int kStep = 16;  // px between sampled readings
  std::size_t num_valid = 0;
  for (int y = 0; y < depth_m.rows; ++y) {
    const auto* row = depth_m.ptr<float>(y);
    for (int x = 0; x < depth_m.cols; ++x) {
      if (!(row[x] > 0.0F)) continue;
      ++num_valid;
      if (y % kStep == 0 && x % kStep == 0) sample_m_.push_back(row[x]);
    }
  }
  shares_.push_back(static_cast<double>(num_valid) / static_cast<double>(depth_m.total()));
}

double DepthStatistics::valid_share() const {
  if (shares_.empty()) return 0.0;
  return std::accumulate(shares_.begin(), shares_.end(), 0.0) / static_cast<double>(shares_.size());
}

double DepthStatistics::median_m() const {
  return sample_m_.empty() ? 0.0 : static_cast<double>(MedianOf(sample_m_));
}

GroundTruthInfo InspectGroundTruth(const std::filesystem::path& path,
                                   const std::vector<TumPair>& pairs) {
  GroundTruthInfo info;
  info.path = path;
  Trajectory trajectory;
  try {
    trajectory = ReadTrajectory(path);
  } catch (const Error& error) {
    info.problem = error.what();
    return info;
  }
  if (trajectory.empty()) info.problem = fmt::format("'{}' has no pose", path.string());
  info.num_poses = trajectory.size();
  Trajectory at_frames;
  for (const TumPair& pair : pairs) {
    const StampedPose* pose = NearestPose(trajectory, pair.color_stamp);
    if (pose != nullptr) at_frames.push_back(*pose);
  }
  info.num_covered_frames = at_frames.size();
  info.path_length_m = PathLength(at_frames);
  return info;
}

InspectionCamera FindInspectionCamera(const TumIndex& index, const CameraChoice& choice) {
  const std::optional<CameraConfig> known = FindCamera(index.folder, choice);
  if (known) return {.config = *known, .is_known = true, .problem = {}};
  const cv::Size size = FindImageSize(index.pairs);
  InspectionCamera result;
  result.problem = MissingCameraMessage(index.folder);
  result.config.name = "unknown; its size is that of the first image";
  result.config.depth_units_per_m = choice.depth_units_per_m.value_or(5000.0);
  result.config.camera.width = size.width;
  result.config.camera.height = size.height;
  return result;
}

DatasetInfo InspectDataset(const std::filesystem::path& folder, const CameraChoice& choice,
                           std::size_t num_samples) {
  CheckIsDataset(folder);
  const TumIndex index = ReadTumIndex(folder);
  DatasetInfo info;
  info.folder = folder;
  info.pair_source = index.source;
  info.num_frames = index.pairs.size();
  info.num_unmatched_color = index.num_unmatched_color;
  info.num_unmatched_depth = index.num_unmatched_depth;
  FillTimes(info, index.pairs);
  const cv::Size size = FindImageSize(index.pairs);
  info.width_px = size.width;
  info.height_px = size.height;
  info.color_format = index.pairs[0].color.extension().string();
  const InspectionCamera camera = FindInspectionCamera(index, choice);
  if (camera.is_known) info.camera = camera.config;
  info.camera_problem = camera.problem;
  if (const auto truth = index.ground_truth ? index.ground_truth : index.ground_truth_camera) {
    info.ground_truth = InspectGroundTruth(*truth, index.pairs);
  }
  FillFromSample(info, index.pairs, camera.config, num_samples);
  return info;
}

}  // namespace cslam
