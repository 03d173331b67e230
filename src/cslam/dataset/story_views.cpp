// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/story_views.h"

#include "cslam/dataset/story_check.h"
#include "cslam/dataset/truth_lookup.h"
#include "cslam/io/dataset_info.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cslam {
namespace {

constexpr int kGrid = 5;                  // points along each side of a box
constexpr double kInnerShare = 0.8;       // of the box that they fill: depth bleeds at its faces
constexpr double kMinThroughShare = 0.6;  // of the points, all in the picture and proven empty
constexpr double kMinBehindM = 0.03;      // depth beyond a point by less may still be the object
constexpr double kMinDepthM = 0.1;        // nearer points are not projected

// Raw pixel of a point of the camera frame; nothing outside the picture.
std::optional<cv::Point> PixelOf(const Camera& camera, const Eigen::Vector3d& p_camera) {
  if (p_camera.z() < kMinDepthM) return std::nullopt;
  Eigen::Vector2d uv = Project(camera, p_camera);
  const bool is_near =
      std::abs(uv.x() - camera.cx) < camera.width && std::abs(uv.y() - camera.cy) < camera.height;
  if (!is_near) return std::nullopt;
  if (camera.HasDistortion()) uv = Distort(camera, uv);
  const cv::Point pixel(static_cast<int>(std::lround(uv.x())),
                        static_cast<int>(std::lround(uv.y())));
  if (!cv::Rect(0, 0, camera.width, camera.height).contains(pixel)) return std::nullopt;
  return pixel;
}

std::vector<std::size_t> Pick(const std::vector<std::size_t>& frames, std::size_t count) {
  std::vector<std::size_t> picked;
  for (const std::size_t k : EvenSample(frames.size(), count))
    picked.push_back(frames[k]);
  return picked;
}

}  // namespace

StoryViews::StoryViews(const CheckFrames& frames, const SequenceTruth& truth,
                       const StoryCheckOptions& options)
    : frames_(frames), truth_(truth), options_(options) {}

double StoryViews::time_s(std::size_t frame) const {
  return TimeOf(*truth_.objects, frames_.stamp(frame));
}

std::size_t StoryViews::FirstFrameAt(double time_s) const {
  constexpr double kRoundingS = 1e-6;
  std::size_t low = 0;
  std::size_t high = frames_.size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (this->time_s(middle) < time_s - kRoundingS) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

bool StoryViews::IsRecorded(int instance) const {
  const TrueObject* object = FindObject(*truth_.objects, instance);
  return truth_.detections && truth_.detections->frames.size() == frames_.size() &&
         object != nullptr && object->class_id >= 0;
}

int StoryViews::VisiblePx(std::size_t frame, int instance) const {
  if (IsRecorded(instance)) {
    for (const RecordedDetection& d : truth_.detections->frames[frame].detections) {
      if (d.instance == instance) return d.visible_px;
    }
    return 0;
  }
  const cv::Mat instances = frames_.Instances(frame);
  return instances.empty() ? 0 : cv::countNonZero(instances == instance);
}

std::vector<std::size_t> StoryViews::Showing(int instance, std::size_t begin,
                                             std::size_t end) const {
  const Camera& camera = frames_.camera();
  const int min_px = std::max(
      1, static_cast<int>(std::lround(options_.min_visible_share * camera.width * camera.height)));
  std::vector<std::size_t> candidates;
  const TrueObject* object = FindObject(*truth_.objects, instance);
  if (object == nullptr) return {};
  const bool is_recorded = IsRecorded(instance);
  for (std::size_t i = begin; i < end; ++i) {
    const Placement state = StateAt(*object, time_s(i));
    if (state.presence == Presence::kAway) continue;
    if (is_recorded || MaySee(i, PointsIn(instance, state.T_world_object))) candidates.push_back(i);
  }
  if (!is_recorded) candidates = Pick(candidates, options_.max_images);
  std::erase_if(candidates, [&](std::size_t i) { return VisiblePx(i, instance) < min_px; });
  return candidates;
}

std::vector<std::size_t> StoryViews::SeeingEmpty(int instance, const Se3& T_world_object,
                                                 std::size_t begin, std::size_t end) const {
  const std::vector<Eigen::Vector3d> points = PointsIn(instance, T_world_object);
  if (points.empty()) return {};
  std::vector<std::size_t> candidates;
  for (std::size_t i = begin; i < end; ++i) {
    if (MaySee(i, points)) candidates.push_back(i);
  }
  candidates = Pick(candidates, options_.max_images);
  std::erase_if(candidates,
                [&](std::size_t i) { return !SeesEmpty(i, instance, T_world_object, points); });
  return candidates;
}

std::vector<Eigen::Vector3d> StoryViews::PointsIn(int instance, const Se3& T_world_object) const {
  const TrueObject* object = FindObject(*truth_.objects, instance);
  if (object == nullptr) return {};
  const auto offset = [](int k) { return kInnerShare * (k / (kGrid - 1.0) - 0.5); };
  std::vector<Eigen::Vector3d> points;
  for (int x = 0; x < kGrid; ++x) {
    for (int y = 0; y < kGrid; ++y) {
      for (int z = 0; z < kGrid; ++z) {
        const Eigen::Vector3d share(offset(x), offset(y), offset(z));
        points.push_back(T_world_object *
                         (object->box_center + share.cwiseProduct(object->box_size_m)));
      }
    }
  }
  return points;
}

bool StoryViews::MaySee(std::size_t frame, const std::vector<Eigen::Vector3d>& points) const {
  const std::optional<Se3> T_world_camera = frames_.T_world_camera(frame);
  if (!T_world_camera) return false;
  const Se3 T_camera_world = T_world_camera->Inverse();
  const auto count = std::count_if(points.begin(), points.end(), [&](const Eigen::Vector3d& p) {
    return PixelOf(frames_.camera(), T_camera_world * p).has_value();
  });
  return static_cast<double>(count) >= kMinThroughShare * static_cast<double>(points.size());
}

bool StoryViews::SeesEmpty(std::size_t frame, int instance, const Se3& T_world_object,
                           const std::vector<Eigen::Vector3d>& points) const {
  const std::optional<Se3> T_world_camera = frames_.T_world_camera(frame);
  const cv::Mat depth_m = frames_.DepthM(frame);
  const TrueObject* object = FindObject(*truth_.objects, instance);
  if (!T_world_camera || depth_m.empty() || object == nullptr) return false;
  cv::Mat instances = frames_.has_instances() ? frames_.Instances(frame) : cv::Mat();
  if (instances.size() != depth_m.size()) instances.release();
  const Se3 T_camera_world = T_world_camera->Inverse();
  // Something else that now stands in the place is as good a proof as a look through it.
  const auto is_taken = [&](const Eigen::Vector3d& p, const cv::Point& pixel, double z_m) {
    if (instances.empty() || instances.at<std::uint16_t>(pixel) == instance) return false;
    const Eigen::Vector3d p_seen = *T_world_camera * Eigen::Vector3d(p * (z_m / p.z()));
    return z_m > 0.0 && DistanceToBox(*object, T_world_object, p_seen) <= kMinBehindM;
  };
  std::size_t num_empty = 0;
  for (const Eigen::Vector3d& p_world : points) {
    const Eigen::Vector3d p = T_camera_world * p_world;
    const std::optional<cv::Point> pixel = PixelOf(frames_.camera(), p);
    if (!pixel) continue;
    const auto z_m = static_cast<double>(depth_m.at<float>(*pixel));
    const double margin_m = std::max(kMinBehindM, 2.0 * options_.tolerance.At(p.z()));
    if (z_m > p.z() + margin_m || is_taken(p, *pixel, z_m)) ++num_empty;
  }
  return static_cast<double>(num_empty) >= kMinThroughShare * static_cast<double>(points.size());
}

}  // namespace cslam
