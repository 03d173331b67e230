// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/report_files.h"
#include "cslam/scene_eval/scene_run.h"
#include "cslam/scene_eval/scene_truth.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// For tests: a small world of boxes in front of a wall, its truth files and its depth images, all
// from one list of stays. World axes are those of the camera: z forward.

namespace cslam::test {

constexpr int kChair = 56;
constexpr int kTv = 62;
constexpr int kUmbrella = 25;
constexpr double kFrameS = 0.1;
constexpr std::int64_t kFrameNs = 100'000'000;
constexpr double kWallM = 4.5;  // away from the camera's start, across its axis

// Places that the camera sees as it starts, m.
inline const Eigen::Vector3d kLeft(-0.8, 0.0, 3.0);
inline const Eigen::Vector3d kMiddle(0.0, 0.0, 3.0);
inline const Eigen::Vector3d kRight(0.8, 0.0, 3.0);

struct TestStay {
  int instance = 0;
  int class_id = kChair;
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
  Eigen::Vector3d center = {0.0, 0.0, 3.0};
};

// Where the camera looks: 0 straight on, pi back.
using TestYaw = std::function<double(double time_s)>;

inline double LookStraight(double /*time_s*/) {
  return 0.0;
}

inline Stamp StampAt(double time_s) {
  return Stamp{1'000'000'000 + static_cast<std::int64_t>(std::llround(time_s * 1e9))};
}

struct TestWorld {
  double duration_s = 10.0;
  std::vector<TestStay> stays;
  std::vector<TrueChange> changes;
  TestYaw yaw_rad = LookStraight;
  Eigen::Vector3d size_m = {0.4, 0.4, 0.4};  // of every box

  bool IsThere(const TestStay& stay, double time_s) const {
    return time_s >= stay.from_s - 1e-9 && time_s < stay.to_s - 1e-9;
  }
  // The camera drifts a little, so that trajectories can be aligned.
  Se3 CameraAt(double time_s) const {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(yaw_rad(time_s), Eigen::Vector3d::UnitY()));
    return {q, {0.1 * std::sin(time_s), 0.05 * std::cos(1.7 * time_s), 0.02 * time_s}};
  }
};

inline Se3 At(const Eigen::Vector3d& center) {
  return {Eigen::Quaterniond::Identity(), center};
}

class TestFrames : public CheckFrames {
 public:
  explicit TestFrames(TestWorld world) : world_(std::move(world)) {
    camera_.width = 64;
    camera_.height = 48;
    camera_.fx = camera_.fy = 50.0;
    camera_.cx = 31.5;
    camera_.cy = 23.5;
  }

  std::size_t size() const override {
    return static_cast<std::size_t>(std::lround(world_.duration_s / kFrameS));
  }
  const Camera& camera() const override { return camera_; }
  Stamp stamp(std::size_t i) const override { return StampAt(TimeAt(i)); }
  std::optional<Se3> T_world_camera(std::size_t i) const override {
    return world_.CameraAt(TimeAt(i));
  }
  cv::Mat DepthM(std::size_t i) const override { return Render(i).first; }
  bool has_instances() const override { return true; }
  cv::Mat Instances(std::size_t i) const override { return Render(i).second; }

  double TimeAt(std::size_t i) const { return kFrameS * static_cast<double>(i); }
  const TestWorld& world() const { return world_; }

  std::pair<cv::Mat, cv::Mat> Render(std::size_t frame) const {
    cv::Mat depth_m(camera_.height, camera_.width, CV_32F, cv::Scalar::all(0.0));
    cv::Mat instances(camera_.height, camera_.width, CV_16U, cv::Scalar::all(0.0));
    const Se3 T_world_camera = world_.CameraAt(TimeAt(frame));
    for (int v = 0; v < camera_.height; ++v) {
      for (int u = 0; u < camera_.width; ++u) {
        const Eigen::Vector3d ray = T_world_camera.R() * Unproject(camera_, {u, v}, 1.0);
        double nearest = ray.z() > 0.0 ? (kWallM - T_world_camera.translation.z()) / ray.z() : 9.0;
        for (const TestStay& stay : world_.stays) {
          if (!world_.IsThere(stay, TimeAt(frame))) continue;
          const std::optional<double> hit = Hit(stay, T_world_camera.translation, ray);
          if (!hit || *hit >= nearest) continue;
          nearest = *hit;
          instances.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(stay.instance);
        }
        depth_m.at<float>(v, u) = static_cast<float>(nearest);
      }
    }
    return {depth_m, instances};
  }

 private:
  std::optional<double> Hit(const TestStay& stay, const Eigen::Vector3d& from,
                            const Eigen::Vector3d& ray) const {
    double enter = 0.0;
    double leave = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const double a = (stay.center[i] - 0.5 * world_.size_m[i] - from[i]) / ray[i];
      const double b = (stay.center[i] + 0.5 * world_.size_m[i] - from[i]) / ray[i];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter > 0.0 && enter < leave ? std::optional(enter) : std::nullopt;
  }

  TestWorld world_;
  Camera camera_;
};

inline TrueObjects ObjectsOf(const TestWorld& world) {
  std::map<int, TrueObject> objects;
  for (const TestStay& stay : world.stays) {
    TrueObject& object = objects[stay.instance];
    object.instance = stay.instance;
    object.name = "thing" + std::to_string(stay.instance);
    object.class_id = stay.class_id;
    object.box_size_m = world.size_m;
    object.intervals.push_back({.from_s = stay.from_s,
                                .to_s = std::min(stay.to_s, world.duration_s),
                                .is_moving = false,
                                .poses = {{stay.from_s, At(stay.center)}}});
  }
  TrueObjects truth{
      .sequence = "test", .duration_s = world.duration_s, .start = StampAt(0.0), .objects = {}};
  for (const auto& [instance, object] : objects)
    truth.objects.push_back(object);
  // What stays to the end is there at the last frame.
  for (TrueObject& object : truth.objects) {
    if (object.intervals.back().to_s >= world.duration_s)
      object.intervals.back().to_s = world.duration_s + 1.0;
  }
  return truth;
}

inline DetectionRecord DetectionsOf(const TestFrames& frames) {
  DetectionRecord record{.sequence = "test", .width_px = 64, .height_px = 48, .frames = {}};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const cv::Mat instances = frames.Instances(i);
    RecordedFrame frame{.stamp = frames.stamp(i), .detections = {}};
    for (const TrueObject& object : ObjectsOf(frames.world()).objects) {
      const int count = cv::countNonZero(instances == object.instance);
      if (count == 0) continue;
      frame.detections.push_back({.instance = object.instance,
                                  .class_id = object.class_id,
                                  .score = 1.0,
                                  .box = {0, 0, 1, 1},
                                  .visible_px = count});
    }
    record.frames.push_back(std::move(frame));
  }
  return record;
}

inline SceneTruth TruthOf(const TestWorld& world) {
  auto frames = std::make_unique<TestFrames>(world);
  SceneTruth truth;
  truth.folder = "truth";
  truth.objects = ObjectsOf(world);
  truth.changes = {.sequence = "test", .changes = world.changes};
  truth.detections = DetectionsOf(*frames);
  for (std::size_t i = 0; i < frames->size(); ++i)
    truth.trajectory.push_back({frames->stamp(i), *frames->T_world_camera(i)});
  truth.frames = std::move(frames);
  return truth;
}

// An object just as big as those of the world.
inline FoundObject Found(int id, int class_id, const Eigen::Vector3d& center) {
  ReportedObject object{.id = id, .class_id = class_id, .state = "present", .belief = 0.9};
  object.centroid = object.box_center = center;
  object.box_size_m = {0.4, 0.4, 0.4};
  object.extent_min = center - 0.5 * object.box_size_m;
  object.extent_max = center + 0.5 * object.box_size_m;
  object.num_points = object.num_active_points = 10;
  object.first_seen = StampAt(0.0);
  return MoveToTruth(object, Se3());
}

// A run that followed the whole truth without error and says nothing yet.
inline SceneRun RunOf(const SceneTruth& truth) {
  SceneRun run;
  run.folder = "run";
  run.trajectory = truth.trajectory;
  run.objects.emplace();
  run.changes.emplace();
  run.map_points.emplace();
  return run;
}

// A world and such a run in it, which a test spoils.
struct TestScene {
  explicit TestScene(const TestWorld& world) : truth(TruthOf(world)), run(RunOf(truth)) {}

  SceneTruth truth;
  SceneRun run;
};

}  // namespace cslam::test
