// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/local_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cslam {
namespace {

// A set of ids that remembers its members in order of insertion.
template <typename Id>
class OrderedIdSet {
 public:
  explicit OrderedIdSet(std::size_t num_ids) : is_member_(num_ids, 0) {}

  bool Insert(Id id) {
    if (id.index() >= is_member_.size() || is_member_[id.index()] != 0) return false;
    is_member_[id.index()] = 1;
    members_.push_back(id);
    return true;
  }
  void Block(Id id) {
    if (id.index() < is_member_.size()) is_member_[id.index()] = 1;
  }
  std::size_t size() const { return members_.size(); }
  const std::vector<Id>& members() const { return members_; }

 private:
  std::vector<std::uint8_t> is_member_;
  std::vector<Id> members_;
};

// Keyframes by the number of matched points they see, most first (ties: smaller id).
std::vector<CovisibleKeyframe> CountSharedPoints(const MapView& map,
                                                 std::span<const PointId> matched) {
  std::vector<std::int32_t> votes(map.num_keyframe_ids(), 0);
  for (const PointId id : matched) {
    const MapPoint* point = map.FindPoint(id);
    if (point == nullptr) continue;
    for (const PointObservation& o : point->observations)
      ++votes[o.keyframe.index()];
  }
  std::vector<CovisibleKeyframe> voted;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (votes[i] > 0) voted.push_back({KeyframeId(static_cast<std::uint32_t>(i)), votes[i]});
  }
  std::stable_sort(voted.begin(), voted.end(),
                   [](const auto& a, const auto& b) { return a.shared_points > b.shared_points; });
  return voted;
}

// Adds the best neighbour that is not a member yet, and the parent.
void AddRelatives(const MapView& map, KeyframeId id, const LocalMapOptions& options,
                  OrderedIdSet<KeyframeId>& members) {
  const auto neighbours = map.Neighbours(id, options.min_shared_points,
                                         static_cast<std::size_t>(options.neighbours_per_keyframe));
  for (const CovisibleKeyframe& neighbour : neighbours) {
    if (members.Insert(neighbour.id)) break;
  }
  const KeyframeId parent = map.FindKeyframe(id)->parent;
  if (parent.valid()) members.Insert(parent);
}

}  // namespace

LocalMap SelectLocalMap(const MapView& map, std::span<const PointId> matched, KeyframeId fallback,
                        const LocalMapOptions& options) {
  LocalMap local;
  const auto max_keyframes = static_cast<std::size_t>(options.max_keyframes);
  OrderedIdSet<KeyframeId> keyframes(map.num_keyframe_ids());
  for (const CovisibleKeyframe& voted : CountSharedPoints(map, matched)) {
    if (keyframes.size() >= max_keyframes) break;
    keyframes.Insert(voted.id);
  }
  if (keyframes.size() == 0 && map.FindKeyframe(fallback) != nullptr) keyframes.Insert(fallback);
  if (keyframes.size() == 0) return local;
  local.reference = keyframes.members().front();

  const std::vector<KeyframeId> seeds = keyframes.members();
  for (const KeyframeId seed : seeds) {
    if (keyframes.size() >= max_keyframes) break;
    AddRelatives(map, seed, options, keyframes);
  }
  local.keyframes = keyframes.members();

  OrderedIdSet<PointId> points(map.num_point_ids());
  for (const PointId id : matched) {
    if (id.valid()) points.Block(id);
  }
  for (const KeyframeId id : local.keyframes) {
    for (const PointId point : map.FindKeyframe(id)->points) {
      if (point.valid()) points.Insert(point);
    }
  }
  local.points = points.members();
  return local;
}

std::vector<ExpectedPoint> ExpectPoints(const MapView& map, std::span<const PointId> points,
                                        const Se3& T_world_camera, const Camera& camera,
                                        const ImageBounds& bounds, double baseline_m,
                                        const MeasurementModel& model,
                                        const LocalMapOptions& options, HeldBack held_back) {
  constexpr double kDistanceSlack = 0.2;  // the scale limits are estimates from one view
  constexpr double kFrontalCosine = 0.998;
  const double min_cosine = std::cos(options.max_view_angle_deg * std::numbers::pi / 180.0);
  const Eigen::Matrix3d R_camera_world = T_world_camera.R().transpose();
  const Eigen::Vector3d center = T_world_camera.translation;
  std::vector<ExpectedPoint> expected;
  for (const PointId id : points) {
    const MapPoint* point = map.FindPoint(id);
    if (point == nullptr) continue;
    if (held_back == HeldBack::kLeaveOut && !IsUsable(*point)) continue;
    const Eigen::Vector3d offset = point->p_world - center;
    const Eigen::Vector3d p_camera = R_camera_world * offset;
    if (p_camera.z() <= 0.05) continue;
    const Eigen::Vector2d uv = Project(camera, p_camera);
    if (!bounds.Contains(uv)) continue;
    const double distance = offset.norm();
    if (distance < (1.0 - kDistanceSlack) * static_cast<double>(point->min_distance_m) ||
        distance > (1.0 + kDistanceSlack) * static_cast<double>(point->max_distance_m)) {
      continue;
    }
    const double cosine = offset.dot(point->normal.cast<double>()) / distance;
    if (cosine < min_cosine) continue;

    const int octave = model.PredictOctave(static_cast<double>(point->max_distance_m) / distance);
    const double radius =
        cosine > kFrontalCosine ? options.radius_frontal_px : options.radius_oblique_px;
    ExpectedPoint e;
    e.point = id;
    e.is_held_back = !IsUsable(*point);
    e.query.uv_px = uv.cast<float>();
    e.query.disparity_px = static_cast<float>(camera.fx * baseline_m / p_camera.z());
    e.query.radius_px = static_cast<float>(options.radius_factor * radius * model.scale(octave));
    e.query.min_octave = octave - 1;
    e.query.max_octave = octave;
    e.query.descriptor = point->descriptor;
    e.query.angle_rad = point->angle_rad;
    expected.push_back(e);
  }
  return expected;
}

}  // namespace cslam
