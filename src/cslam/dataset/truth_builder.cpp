// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/truth_builder.h"

#include "cslam/util/check.h"

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace cslam {
namespace {

constexpr double kPresenceToleranceS = 1e-6;  // of the moments in which bodies come and go

void SetBox(TrueObject& object, const Eigen::AlignedBox3f& box) {
  if (box.isEmpty()) return;
  object.box_center = box.center().cast<double>();
  object.box_size_m = box.sizes().cast<double>();
}

// Poses --------------------------------------------------------------------------------------

std::optional<TrueInterval> RestWithin(const Stay& stay, double duration_s) {
  const double from_s = std::max(stay.from_s, 0.0);
  const double to_s = std::min(stay.to_s, duration_s);
  if (from_s >= to_s) return std::nullopt;
  return TrueInterval{from_s, to_s, false, {{from_s, stay.T_world_object}}};
}

std::optional<TrueInterval> CarryWithin(const Carry& carry, double duration_s) {
  if (carry.empty()) return std::nullopt;
  const double from_s = std::max(carry.front().time_s, 0.0);
  const double to_s = std::min(carry.back().time_s, duration_s);
  if (from_s >= to_s) return std::nullopt;
  const Timeline alone{.stays = {}, .carries = {carry}};
  TrueInterval interval{from_s, to_s, true, {{from_s, StateAt(alone, from_s).T_world_object}}};
  for (const TimedPose& pose : carry) {
    if (pose.time_s > from_s && pose.time_s < to_s)
      interval.poses.push_back({pose.time_s, pose.T_world_object});
  }
  const bool is_whole = to_s == carry.back().time_s;
  interval.poses.push_back(
      {to_s, is_whole ? carry.back().T_world_object : StateAt(alone, to_s).T_world_object});
  return interval;
}

std::vector<TrueInterval> Intervals(const Timeline& timeline, double duration_s) {
  std::vector<TrueInterval> intervals;
  for (const Stay& stay : timeline.stays) {
    if (auto interval = RestWithin(stay, duration_s)) intervals.push_back(std::move(*interval));
  }
  for (const Carry& carry : timeline.carries) {
    if (auto interval = CarryWithin(carry, duration_s)) intervals.push_back(std::move(*interval));
  }
  std::ranges::sort(intervals, {}, &TrueInterval::from_s);
  return intervals;
}

// Bodies -------------------------------------------------------------------------------------

// Follows a body through time and collects where it was and how much room it took.
class BodyTracer {
 public:
  explicit BodyTracer(const Animation& animation) : animation_(animation) {}

  void Trace(double duration_s) {
    double last_s = 0.0;
    bool was_there = Visit(0.0);
    if (was_there) Begin(0.0);
    for (std::int64_t k = 1; last_s < duration_s; ++k) {
      const double time_s = std::min(static_cast<double>(k) / kBodyRateHz, duration_s);
      const bool is_there = animation_(time_s).has_value();
      if (is_there != was_there) Cross(last_s, time_s, was_there);
      if (is_there && time_s > intervals_.back().from_s) Add(time_s);
      if (is_there) intervals_.back().to_s = time_s;
      was_there = is_there;
      last_s = time_s;
    }
    std::erase_if(intervals_, [](const TrueInterval& i) { return i.from_s >= i.to_s; });
  }

  std::vector<TrueInterval> TakeIntervals() { return std::move(intervals_); }
  const Eigen::AlignedBox3f& box() const { return box_; }

 private:
  bool Visit(double time_s) const { return animation_(time_s).has_value(); }

  void Begin(double time_s) {
    intervals_.push_back({time_s, time_s, true, {}});
    Add(time_s);
  }

  // Finds when it comes or goes between two times, and begins or ends its interval there.
  void Cross(double before_s, double after_s, bool was_there) {
    while (after_s - before_s > kPresenceToleranceS) {
      const double middle_s = 0.5 * (before_s + after_s);
      (Visit(middle_s) == was_there ? before_s : after_s) = middle_s;
    }
    if (!was_there) {
      Begin(after_s);
      return;
    }
    if (before_s > intervals_.back().poses.back().time_s) Add(before_s);
    intervals_.back().to_s = after_s;
  }

  void Add(double time_s) {
    const std::optional<BodyShape> shape = animation_(time_s);
    CSLAM_CHECK(shape, "a body is there and is not at {} s", time_s);
    const Eigen::Isometry3f T_body_world(shape->T_world_body.Inverse().Matrix().cast<float>());
    for (const Eigen::Vector3f& p : shape->positions)
      box_.extend(T_body_world * p);
    intervals_.back().poses.push_back({time_s, shape->T_world_body});
  }

  const Animation& animation_;
  std::vector<TrueInterval> intervals_;
  Eigen::AlignedBox3f box_;
};

TrueObject BuildTrueObject(const World& world, int instance, double duration_s) {
  const SceneObject& source = world.scene.objects[static_cast<std::size_t>(instance)];
  TrueObject object;
  object.instance = instance;
  object.name = source.name;
  object.class_id = source.class_id;
  if (const auto animation = world.animations.find(instance); animation != world.animations.end()) {
    object.is_deformable = true;
    BodyTracer tracer(animation->second);
    tracer.Trace(duration_s);
    SetBox(object, tracer.box());
    object.intervals = tracer.TakeIntervals();
    return object;
  }
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : source.mesh.positions)
    box.extend(p);
  SetBox(object, box);
  const auto timeline = world.timelines.find(instance);
  const Timeline always{.stays = {Stay{.T_world_object = source.T_world_object}}, .carries = {}};
  object.intervals =
      Intervals(timeline == world.timelines.end() ? always : timeline->second, duration_s);
  return object;
}

double DurationS(const SimulatedSequence& sequence) {
  return sequence.size() / sequence.options().fps;
}

}  // namespace

std::vector<TrueObject> BuildTrueObjects(const World& world, double duration_s) {
  std::vector<TrueObject> objects;
  for (std::size_t i = 1; i < world.scene.objects.size(); ++i)
    objects.push_back(BuildTrueObject(world, static_cast<int>(i), duration_s));
  return objects;
}

std::vector<RecordedDetection> BuildDetections(const cv::Mat& instances, const Scene& scene) {
  CSLAM_CHECK(instances.type() == CV_16UC1, "type {}", instances.type());
  struct Extent {
    int min_u = std::numeric_limits<int>::max(), min_v = 0, max_u = 0, max_v = 0, num_pixels = 0;
  };
  std::vector<Extent> extents(scene.objects.size());
  for (int v = 0; v < instances.rows; ++v) {
    const auto* const row = instances.ptr<std::uint16_t>(v);
    for (int u = 0; u < instances.cols; ++u) {
      CSLAM_CHECK(row[u] < extents.size(), "instance {} of {}", row[u], extents.size());
      Extent& extent = extents[row[u]];
      if (extent.num_pixels++ == 0) extent.min_v = v;
      extent.min_u = std::min(extent.min_u, u);
      extent.max_u = std::max(extent.max_u, u);
      extent.max_v = v;
    }
  }
  std::vector<RecordedDetection> detections;
  for (std::size_t i = 1; i < extents.size(); ++i) {
    const Extent& extent = extents[i];
    if (extent.num_pixels == 0 || scene.objects[i].class_id < 0) continue;
    detections.push_back(
        {.instance = static_cast<int>(i),
         .class_id = scene.objects[i].class_id,
         .score = 1.0,
         .box = {static_cast<double>(extent.min_u), static_cast<double>(extent.min_v),
                 extent.max_u + 1.0, extent.max_v + 1.0},
         .visible_px = extent.num_pixels});
  }
  return detections;
}

TrueObjects BuildTrueObjects(const SimulatedSequence& sequence, const std::string& name) {
  const double duration_s = DurationS(sequence);
  return {.sequence = name,
          .duration_s = duration_s,
          .start = SimulatedSequence::start(),
          .objects = BuildTrueObjects(sequence.world(), duration_s)};
}

TrueChanges BuildTrueChanges(const SimulatedSequence& sequence, const std::string& name) {
  Observer observer{.camera = sequence.camera(), .views = {}};
  for (int i = 0; i < sequence.size(); ++i)
    observer.views.push_back({sequence.time_s(i), sequence.T_world_camera(i)});
  return {.sequence = name,
          .changes = BuildTrueChanges(sequence.world(), observer, DurationS(sequence))};
}

}  // namespace cslam
