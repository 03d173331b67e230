// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/truth_lookup.h"

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

constexpr double kSameTimeS = 1e-3;  // JSON and microsecond stamps round
constexpr double kSamePlaceM = 1e-5;
constexpr double kSameAngleRad = 1e-5;

Se3 PoseIn(const TrueInterval& interval, double time_s) {
  const auto& poses = interval.poses;
  if (poses.empty()) return {};
  const auto after = std::lower_bound(
      poses.begin(), poses.end(), time_s,
      [](const TrueInterval::Sample& sample, double wanted) { return sample.time_s < wanted; });
  if (after == poses.begin()) return poses.front().T_world_object;
  if (after == poses.end()) return poses.back().T_world_object;
  const TrueInterval::Sample& before = *std::prev(after);
  const double length_s = after->time_s - before.time_s;
  const double alpha = length_s > 0.0 ? (time_s - before.time_s) / length_s : 1.0;
  return Interpolate(before.T_world_object, after->T_world_object, alpha);
}

}  // namespace

const TrueObject* FindObject(const TrueObjects& objects, int instance) {
  const auto found = std::find_if(objects.objects.begin(), objects.objects.end(),
                                  [&](const TrueObject& o) { return o.instance == instance; });
  return found == objects.objects.end() ? nullptr : &*found;
}

Placement StateAt(const TrueObject& object, double time_s) {
  for (const TrueInterval& interval : object.intervals) {
    if (time_s < interval.from_s || time_s >= interval.to_s) continue;
    return {.presence = interval.is_moving ? Presence::kMoving : Presence::kResting,
            .T_world_object = PoseIn(interval, time_s)};
  }
  return {};
}

bool IsAtBoundary(const TrueObject& object, double time_s) {
  return std::any_of(object.intervals.begin(), object.intervals.end(), [&](const TrueInterval& i) {
    return std::abs(time_s - i.from_s) < kSameTimeS || std::abs(time_s - i.to_s) < kSameTimeS;
  });
}

bool IsSamePlace(const TrueObjects& objects, int instance, double time_a_s, double time_b_s) {
  if (instance == 0) return true;
  const TrueObject* object = FindObject(objects, instance);
  if (object == nullptr || object->is_deformable) return false;
  const Placement a = StateAt(*object, time_a_s);
  const Placement b = StateAt(*object, time_b_s);
  if (a.presence != Presence::kResting || b.presence != Presence::kResting) return false;
  const PoseDifference difference = Difference(a.T_world_object, b.T_world_object);
  return difference.distance_m < kSamePlaceM && difference.angle_rad < kSameAngleRad;
}

double DistanceToBox(const TrueObject& object, const Se3& T_world_object,
                     const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d p = T_world_object.Inverse() * p_world - object.box_center;
  const Eigen::Vector3d outside = (p.cwiseAbs() - 0.5 * object.box_size_m).cwiseMax(0.0);
  return outside.norm();
}

}  // namespace cslam
