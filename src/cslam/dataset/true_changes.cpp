// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/truth_builder.h"
#include "cslam/util/check.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

namespace cslam {
namespace {

constexpr double kToleranceS = 1e-6;  // times that are meant to be equal

// Whether a carry ends at that time or is under way shortly before it.
bool IsCarriedUntil(const Timeline& timeline, double time_s) {
  return std::ranges::any_of(timeline.carries, [&](const Carry& carry) {
    return !carry.empty() && carry.front().time_s < time_s - kToleranceS &&
           carry.back().time_s > time_s - kToleranceS;
  });
}

// Until when carries hold what ends its rest at from_s, without a moment away.
double CarriedUntil(const Timeline& timeline, double from_s) {
  double until_s = from_s;
  for (const Carry& carry : timeline.carries) {
    if (!carry.empty() && carry.front().time_s <= until_s + kToleranceS)
      until_s = std::max(until_s, carry.back().time_s);
  }
  return until_s;
}

bool IsSamePlace(const Se3& a, const Se3& b) {
  const PoseDifference difference = Difference(a, b);
  return difference.distance_m < kMinMoveM && difference.angle_rad < kMinTurnRad;
}

// What one object does, as if it were alone.
class ObjectChanges {
 public:
  ObjectChanges(int instance, int class_id, const Timeline& timeline)
      : instance_(instance), class_id_(class_id), timeline_(timeline) {}

  std::vector<TrueChange> Find(double duration_s) {
    std::vector<Stay> rests;
    for (const Stay& stay : timeline_.stays) {
      if (stay.to_s > 0.0 && stay.from_s < duration_s) rests.push_back(stay);
    }
    if (rests.empty()) return {};
    if (rests.front().from_s > 0.0) Add(rests.front());
    for (std::size_t i = 1; i < rests.size(); ++i)
      Follow(rests[i - 1], rests[i]);
    if (rests.back().to_s < duration_s) Remove(rests.back());
    std::erase_if(changes_, [&](const TrueChange& c) { return c.time_s >= duration_s; });
    return std::move(changes_);
  }

 private:
  void Follow(const Stay& before, const Stay& after) {
    if (CarriedUntil(timeline_, before.to_s) < after.from_s - kToleranceS) {
      Remove(before);
      Add(after);
    } else if (!IsSamePlace(before.T_world_object, after.T_world_object)) {
      TrueChange& change = New(ChangeKind::kMoved, after.from_s);
      change.from = before.T_world_object;
      change.to = after.T_world_object;
    }
  }

  void Add(const Stay& rest) { New(ChangeKind::kAdded, rest.from_s).to = rest.T_world_object; }

  void Remove(const Stay& rest) {
    const double gone_s = CarriedUntil(timeline_, rest.to_s);
    New(ChangeKind::kRemoved, gone_s).from = rest.T_world_object;
  }

  TrueChange& New(ChangeKind kind, double time_s) {
    TrueChange change{.kind = kind, .time_s = time_s, .instance = instance_, .class_id = class_id_};
    change.is_carried_in_view = IsCarriedUntil(timeline_, time_s);
    return changes_.emplace_back(std::move(change));
  }

  int instance_;
  int class_id_;
  const Timeline& timeline_;
  std::vector<TrueChange> changes_;
};

// The middle of an object's box, where it stands in that pose.
Eigen::Vector3d Middle(const Scene& scene, int instance, const Se3& T_world_object) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : scene.objects[static_cast<std::size_t>(instance)].mesh.positions)
    box.extend(p);
  if (box.isEmpty()) return T_world_object.translation;
  return T_world_object * box.center().cast<double>().eval();
}

bool IsInField(const Camera& camera, const Se3& T_world_camera, const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d p_camera = T_world_camera.Inverse() * p_world;
  if (p_camera.z() <= 0.0) return false;
  const Eigen::Vector2d uv = Project(camera, p_camera);
  return uv.x() > -0.5 && uv.y() > -0.5 && uv.x() < camera.width - 0.5 &&
         uv.y() < camera.height - 0.5;
}

// Joins removals and additions that are replacements.
class Replacements {
 public:
  Replacements(const Scene& scene, const Observer& observer) : scene_(scene), observer_(observer) {}

  std::vector<TrueChange> Join(std::vector<TrueChange> changes) const {
    std::vector<bool> is_used(changes.size(), false);
    std::vector<TrueChange> joined;
    for (const auto& [distance_m, removed, added] : Pairs(changes)) {
      if (is_used[removed] || is_used[added]) continue;
      is_used[removed] = is_used[added] = true;
      joined.push_back(Joined(changes[removed], changes[added]));
    }
    for (std::size_t i = 0; i < changes.size(); ++i) {
      if (!is_used[i]) joined.push_back(std::move(changes[i]));
    }
    return joined;
  }

 private:
  using Pair = std::tuple<double, std::size_t, std::size_t>;  // distance (m), removal, addition

  std::vector<Pair> Pairs(const std::vector<TrueChange>& changes) const {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < changes.size(); ++i) {
      for (std::size_t j = 0; j < changes.size(); ++j) {
        const TrueChange& a = changes[i];
        const TrueChange& b = changes[j];
        if (a.kind != ChangeKind::kRemoved || b.kind != ChangeKind::kAdded) continue;
        const double distance_m = (a.from->translation - b.to->translation).norm();
        if (a.class_id != b.class_id && distance_m <= kReplaceDistanceM && !IsSeenBetween(a, b))
          pairs.emplace_back(distance_m, i, j);
      }
    }
    std::ranges::sort(pairs);
    return pairs;
  }

  bool IsSeenBetween(const TrueChange& removed, const TrueChange& added) const {
    const auto [first_s, last_s] = std::minmax(removed.time_s, added.time_s);
    const Eigen::Vector3d before = Middle(scene_, removed.instance, *removed.from);
    const Eigen::Vector3d after = Middle(scene_, added.instance, *added.to);
    const auto view_from = std::ranges::lower_bound(observer_.views, first_s, {}, &View::time_s);
    const auto view_to = std::ranges::lower_bound(observer_.views, last_s, {}, &View::time_s);
    return std::any_of(view_from, std::max(view_from, view_to), [&](const View& view) {
      return IsInField(observer_.camera, view.T_world_camera, before) ||
             IsInField(observer_.camera, view.T_world_camera, after);
    });
  }

  static TrueChange Joined(const TrueChange& removed, const TrueChange& added) {
    TrueChange change = removed;
    change.kind = ChangeKind::kReplaced;
    change.time_s = std::max(removed.time_s, added.time_s);
    change.new_instance = added.instance;
    change.new_class_id = added.class_id;
    change.to = added.to;
    change.is_carried_in_view = removed.is_carried_in_view || added.is_carried_in_view;
    return change;
  }

  const Scene& scene_;
  const Observer& observer_;
};

}  // namespace

std::vector<TrueChange> BuildTrueChanges(const World& world, const Observer& observer,
                                         double duration_s) {
  std::vector<TrueChange> changes;
  for (const auto& [instance, timeline] : world.timelines) {
    if (world.animations.contains(instance)) continue;
    const SceneObject& object = world.scene.objects[static_cast<std::size_t>(instance)];
    const auto found = ObjectChanges(instance, object.class_id, timeline).Find(duration_s);
    changes.insert(changes.end(), found.begin(), found.end());
  }
  changes = Replacements(world.scene, observer).Join(std::move(changes));
  std::ranges::sort(changes, {},
                    [](const TrueChange& c) { return std::tuple(c.time_s, c.instance); });
  return changes;
}

}  // namespace cslam
