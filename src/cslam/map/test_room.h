// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Maps of a room made of points, as a tracker with drift would have built them: for tests of what
// works on whole maps.

#include "cslam/geometry/camera.h"
#include "cslam/map/map.h"
#include "cslam/vision/depth_thumbnail.h"
#include "cslam/vision/test_features.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace cslam::test {

inline const std::vector<double> kRoomScales{1.0, 1.2, 1.44, 1.728, 2.0736};
inline constexpr double kRoomBaselineM = 0.08;

inline Camera RoomCamera() {
  return {.width = 640, .height = 480, .fx = 525.0, .fy = 525.0, .cx = 319.5, .cy = 239.5};
}

// An axis-aligned box: the room seen from inside, or a thing in it seen from outside.
struct TestBox {
  Eigen::Vector3d min;
  Eigen::Vector3d max;
};

struct RoomPoint {
  Eigen::Vector3d p_world;
  Descriptor descriptor;
};

struct TestRoom {
  TestBox walls{{-3.0, -1.3, -3.0}, {3.0, 1.3, 3.0}};
  std::vector<TestBox> things;  // they hide nothing but depth: points are seen through them
  std::vector<RoomPoint> points;
};

// Points on all six sides, of random looks.
inline TestRoom MakeRoom(int num_points, std::uint64_t seed) {
  Rng rng(seed);
  TestRoom room;
  for (int i = 0; i < num_points; ++i) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = rng.Uniform(room.walls.min[axis], room.walls.max[axis]);
    const auto side = rng.Index(20);  // mostly the four walls
    const int axis = side < 8 ? 0 : side < 16 ? 2 : 1;
    p[axis] = side % 2 == 0 ? room.walls.min[axis] : room.walls.max[axis];
    room.points.push_back({p, RandomDescriptor(rng)});
  }
  return room;
}

// Distance along a ray in units of its direction: entering a box from outside, or leaving it from
// inside. Infinite if it misses.
inline double RayToBox(const TestBox& box, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& direction) {
  double enter = -1e9;
  double leave = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = std::abs(direction[axis]) < 1e-12 ? 1e-12 : direction[axis];
    const double a = (box.min[axis] - from[axis]) / d;
    const double b = (box.max[axis] - from[axis]) / d;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (leave < 0.0 || enter > leave) return 1e9;
  return enter > 0.0 ? enter : leave;
}

// A depth image of a quarter of the size, as a keyframe keeps it.
inline cv::Mat RoomDepth(const TestRoom& room, const Camera& camera, const Se3& T_world_camera) {
  const int step = DepthThumbnailStep(camera.width);
  cv::Mat depth_mm(camera.height / step, camera.width / step, CV_16UC1);
  for (int v = 0; v < depth_mm.rows; ++v) {
    for (int u = 0; u < depth_mm.cols; ++u) {
      const Eigen::Vector2d uv(u * step + step / 2, v * step + step / 2);
      const Eigen::Vector3d ray = T_world_camera.rotation * Unproject(camera, uv, 1.0);
      double z = RayToBox(room.walls, T_world_camera.translation, ray);
      for (const TestBox& thing : room.things)
        z = std::min(z, RayToBox(thing, T_world_camera.translation, ray));
      depth_mm.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(std::lround(1000.0 * z));
    }
  }
  return depth_mm;
}

// Looks outwards from a circle about the room's middle: turn 1 is the first place again.
inline Se3 CirclePose(double turn, double radius_m = 0.8) {
  const double angle = 2.0 * std::numbers::pi * turn;
  const Se3 outwards(ExpSo3({0.0, angle, 0.0}), Eigen::Vector3d::Zero());
  return {outwards.rotation, outwards * Eigen::Vector3d(0.0, 0.0, radius_m)};
}

// What a keyframe sees of a room; points[i] is the index of the room's point at keypoint i.
struct RoomView {
  std::shared_ptr<KeyframeData> data;
  std::vector<int> points;
};

inline RoomView LookAtRoom(const TestRoom& room, const Camera& camera, const Se3& T_world_camera,
                           std::uint32_t id, double noise_px = 0.3) {
  Rng rng(id, 99);
  std::vector<Feature> features;
  RoomView view;
  for (std::size_t i = 0; i < room.points.size(); ++i) {
    const Eigen::Vector3d p = T_world_camera.Inverse() * room.points[i].p_world;
    if (p.z() < 0.3) continue;
    const Eigen::Vector2d uv = Project(camera, p);
    if (uv.x() < 0 || uv.y() < 0 || uv.x() >= camera.width || uv.y() >= camera.height) continue;
    const double level = std::log(2.8 / p.norm()) / std::log(1.2) + 2.0;
    Descriptor descriptor = room.points[i].descriptor;
    for (int flip = 0; flip < 10; ++flip)
      descriptor.words[rng.Index(4)] ^= std::uint64_t{1} << rng.Index(64);
    features.push_back({.u = static_cast<float>(uv.x() + noise_px * rng.Gaussian()),
                        .v = static_cast<float>(uv.y() + noise_px * rng.Gaussian()),
                        .descriptor = descriptor,
                        .octave = std::clamp(static_cast<int>(std::lround(level)), 0, 4),
                        .disparity_px = static_cast<float>(camera.fx * kRoomBaselineM / p.z()),
                        .depth_m = static_cast<float>(p.z())});
    view.points.push_back(static_cast<int>(i));
  }
  view.data = std::make_shared<KeyframeData>();
  view.data->frame = FrameId(10 * id);
  view.data->stamp = Stamp{1'000'000'000LL * id};
  view.data->features = MakeFeatures(features);
  view.data->depth_small_mm = RoomDepth(room, camera, T_world_camera);
  return view;
}

// Builds a map keyframe by keyframe. A point seen by one of the last two keyframes is the same map
// point; seen again later, it becomes a new one, as after drift.
class RoomMapper {
 public:
  explicit RoomMapper(TestRoom room) : room_(std::move(room)), map_(kRoomScales) {
    last_seen_.assign(room_.points.size(), {});
  }

  // The keyframe is at T_true in the room and at T_estimated in the map. Without a parent it begins
  // a new map.
  KeyframeId Add(const Se3& T_true, const Se3& T_estimated, KeyframeId parent,
                 MapId map = MapId(0)) {
    const auto id = KeyframeId(static_cast<std::uint32_t>(map_.num_keyframe_ids()));
    const RoomView view = LookAtRoom(room_, camera_, T_true, id.value());
    if (!parent.valid()) last_seen_.assign(room_.points.size(), {});
    Keyframe keyframe;
    keyframe.id = id;
    keyframe.map = map;
    keyframe.parent = parent;
    keyframe.T_world_camera = T_estimated;
    keyframe.data = view.data;
    map_.AddKeyframe(std::move(keyframe));
    truth_.resize(id.index() + 1);
    truth_[id.index()] = T_true;
    for (std::size_t k = 0; k < view.points.size(); ++k)
      Observe(id, static_cast<int>(k), static_cast<std::size_t>(view.points[k]), view);
    return id;
  }

  Map& map() { return map_; }
  const Camera& camera() const { return camera_; }
  const TestRoom& room() const { return room_; }
  TestRoom& room() { return room_; }
  const std::vector<Se3>& truth() const { return truth_; }  // by keyframe id

 private:
  struct Sighting {
    PointId point;
    KeyframeId keyframe;
  };

  void Observe(KeyframeId id, int keypoint, std::size_t room_point, const RoomView& view) {
    Sighting& last = last_seen_[room_point];
    const bool is_fresh = last.point.valid() && last.keyframe.value() + 2 >= id.value();
    const auto known = is_fresh ? map_.Resolve(last.point) : std::nullopt;
    PointId point;
    if (known) {
      point = *known;
    } else {
      const Keypoint& k = view.data->features.keypoints[static_cast<std::size_t>(keypoint)];
      point = map_.AddPoint(map_.FindKeyframe(id)->T_world_camera *
                                Unproject(camera_, k.uv_px.cast<double>(), k.depth_m),
                            id);
    }
    map_.AddObservation(point, id, keypoint);
    map_.RefreshAppearance(point);
    last = {point, id};
  }

  TestRoom room_;
  Camera camera_ = RoomCamera();
  Map map_;
  std::vector<Se3> truth_;
  std::vector<Sighting> last_seen_;
};

// A circle of count keyframes and extra ones beyond the full turn, each off by drift against the
// one before.
inline RoomMapper DriftingCircle(TestRoom room, int count, int extra, const Se3& drift) {
  RoomMapper mapper(std::move(room));
  KeyframeId last;
  for (int i = 0; i < count + extra; ++i) {
    const Se3 T_true = CirclePose(static_cast<double>(i) / count);
    Se3 T_estimated = T_true;
    if (last.valid()) {
      T_estimated = mapper.map().FindKeyframe(last)->T_world_camera *
                    (mapper.truth()[last.index()].Inverse() * T_true) * drift;
    }
    last = mapper.Add(T_true, T_estimated, last);
  }
  return mapper;
}

// Root mean square distance (m) of the alive keyframes of a map from where they were in truth; the
// first of them defines where the map lies.
inline double PositionError(const MapView& map, const std::vector<Se3>& truth,
                            MapId id = MapId(0)) {
  double sum = 0.0;
  int count = 0;
  std::optional<Se3> T_world_map;
  for (const KeyframeId keyframe : map.Keyframes()) {
    const Keyframe& k = *map.FindKeyframe(keyframe);
    if (k.map != id) continue;
    if (!T_world_map) T_world_map = truth[keyframe.index()] * k.T_world_camera.Inverse();
    sum += (*T_world_map * k.T_world_camera.translation - truth[keyframe.index()].translation)
               .squaredNorm();
    ++count;
  }
  return count == 0 ? 0.0 : std::sqrt(sum / count);
}

}  // namespace cslam::test
