// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_association.h"

#include "cslam/mapping/object_geometry.h"
#include "cslam/util/quantile.h"

#include <algorithm>
#include <utility>

namespace cslam {
namespace {

constexpr std::size_t kMaxPoints = 300;    // of a sighting
constexpr std::size_t kMaxSightings = 64;  // of a keyframe: bounds what false detections cost

// Those that may become objects of the map; of too many the surest.
std::vector<const ObjectSighting*> Candidates(std::span<const ObjectSighting> sightings,
                                              const ObjectClasses& classes) {
  std::vector<const ObjectSighting*> candidates;
  for (const ObjectSighting& sighting : sightings) {
    if (classes.IsMapped(sighting.class_id)) candidates.push_back(&sighting);
  }
  if (candidates.size() <= kMaxSightings) return candidates;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto* a, const auto* b) { return a->score > b->score; });
  candidates.resize(kMaxSightings);
  return candidates;
}

double ReachM(const ObjectSurface& surface) {
  return std::max(0.04, 1.5 * surface.voxel_m);
}

std::vector<Eigen::Vector3f> Transformed(std::span<const Eigen::Vector3f> points, const Se3& T) {
  std::vector<Eigen::Vector3f> moved;
  moved.reserve(points.size());
  for (const Eigen::Vector3f& p : points)
    moved.push_back((T * p.cast<double>()).cast<float>());
  return moved;
}

// Where the values lie, the outermost 5 % at each end left out.
ValueRange<double> MostOf(std::vector<double> values) {
  const std::size_t num_out = values.size() / 20;
  return InnerRange(std::move(values), num_out);
}

// Largest side of the object's box once it holds the points as well (object frame).
double UnionSizeM(const OrientedBox& box, std::span<const Eigen::Vector3f> points) {
  const Eigen::Matrix3d R = box.rotation.toRotationMatrix().transpose();
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const Eigen::Vector3f& p : points)
      values.push_back(R.row(axis).dot(p.cast<double>() - box.center));
    const auto ends = MostOf(std::move(values));
    const double half = 0.5 * box.size_m[axis];
    largest = std::max(largest, std::max(half, ends.max) - std::min(-half, ends.min));
  }
  return largest;
}

// It is in the picture, but elsewhere than the sighting.
bool IsElsewhere(const StandingSurface& surface) {
  constexpr double kMinVisible = 0.3;
  constexpr double kMaxCovered = 0.2;
  return surface.num_standing >= kMinVisible * surface.num_samples &&
         surface.num_covered < kMaxCovered * surface.num_standing;
}

// The larger of width and height.
double ExtentAcross(std::span<const Eigen::Vector3f> points_camera) {
  double extent_m = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> values;
    values.reserve(points_camera.size());
    for (const Eigen::Vector3f& p : points_camera)
      values.push_back(static_cast<double>(p[axis]));
    const auto ends = MostOf(std::move(values));
    extent_m = std::max(extent_m, ends.length());
  }
  return extent_m;
}

bool AreOfOneSize(const OrientedBox& a, const OrientedBox& b, double min_ratio) {
  const double a_m = a.size_m.maxCoeff();
  const double b_m = b.size_m.maxCoeff();
  return std::min(a_m, b_m) >= min_ratio * std::max(a_m, b_m);
}

struct Likeness {
  double score = 0.0;  // 0: another thing
  bool is_on_surface = false;
};

// An object that sightings are held against. What several of them ask for is computed once.
class ViewedObject {
 public:
  ViewedObject(const MapView& map, const MapObject& object, const Se3& T_world_camera)
      : object_(object),
        T_world_object_(map.T_world_object(object)),
        T_camera_object_(T_world_camera.Inverse() * T_world_object_) {}

  Likeness Compare(const PlacedSighting& sighting, const DepthView& view,
                   const ObjectClasses& classes, const MapObjectOptions& options);

 private:
  const MapObject& object_;
  const Se3 T_world_object_;
  const Se3 T_camera_object_;
  std::optional<std::vector<cv::Point>> standing_;
  std::optional<SurfaceCells> cells_;
};

Likeness ViewedObject::Compare(const PlacedSighting& sighting, const DepthView& view,
                               const ObjectClasses& classes, const MapObjectOptions& options) {
  const double distance_m = (sighting.centroid_world - T_world_object_ * object_.centroid).norm();
  const double limit_m =
      std::max(classes.DistanceM(object_.class_id), classes.DistanceM(sighting.sighting->class_id));
  if (distance_m > 2.0 * limit_m) return {};
  const std::vector<Eigen::Vector3f>& samples = object_.surface->samples;
  if (!standing_) standing_ = PixelsOfStanding(samples, T_camera_object_, view, options.view);
  const StandingSurface standing = CoveredBy(sighting.region.mask, *standing_, samples.size());
  const bool is_alike = classes.AreAlike(object_.class_id, sighting.sighting->class_id);
  // One thing that the detector takes now for this, now for that: the very same surface.
  const bool may_be_same =
      standing.num_standing > 0 && standing.covered_share() >= options.same_surface;
  if (!is_alike && !may_be_same) return {};
  const auto points = Transformed(sighting.points_camera, T_camera_object_.Inverse());
  if (!cells_) cells_.emplace(*object_.surface, ReachM(*object_.surface));
  const double overlap = cells_->ShareOf(points);
  if (!is_alike) return {overlap >= options.same_surface ? 0.5 * overlap : 0.0, true};
  const double nearness = std::max(0.0, 1.0 - distance_m / limit_m);
  const bool is_on_surface = overlap >= options.min_overlap;
  const bool is_gone = object_.state == ObjectState::kAbsent;
  if (is_on_surface && !is_gone) return {overlap + 0.3 * nearness, true};
  if (!is_on_surface && (is_gone || distance_m > limit_m)) return {};
  const DepthSampler sampler{&view.depth_mm, view.step, &view.camera, false};
  const ExpectedView expected = LookAtPlace(samples, T_camera_object_, sampler, 0.0, options.view);
  if (expected.verdict == PlaceVerdict::kLookedThrough) return {};
  if (is_on_surface) return {overlap + 0.3 * nearness, true};
  if (IsElsewhere(standing)) return {};
  if (UnionSizeM(object_.box, points) > options.max_union * limit_m) return {};
  return {overlap + 0.3 * nearness + 1e-3, false};
}

// Whether the object was in sight just before, or has the colours of the sighting.
bool IsRecognised(const MapObject& object, const ObjectSighting& sighting,
                  const SeenBefore& seen_before, const MapObjectOptions& options) {
  const auto seen = seen_before.find(object.id);
  if (seen == seen_before.end() ||
      SecondsBetween(sighting.detected, seen->second) < options.recognise_after_s) {
    return true;
  }
  return ColourLikeness(object.colours, sighting.colours) >= options.min_likeness;
}

// Whether one thing may have been taken for the two. What is too large for its name is no such
// thing, of which what has the right size could be a piece.
bool MayBeOne(const MapObject& a, const MapObject& b, const ObjectClasses& classes,
              const MapObjectOptions& options) {
  const auto is_too_large = [&](const MapObject& object) {
    return classes.IsTooLarge(object.class_id, object.box.size_m.maxCoeff());
  };
  if (classes.AreAlike(a.class_id, b.class_id) && is_too_large(a) != is_too_large(b)) return false;
  const bool were_seen_apart =
      a.last_keyframe < b.first_keyframe || b.last_keyframe < a.first_keyframe;
  return !were_seen_apart || ColourLikeness(a.colours, b.colours) >= options.min_likeness;
}

}  // namespace

SeenBefore WhenSeen(const MapView& map, MapId map_id) {
  SeenBefore seen;
  for (const ObjectId id : map.Objects()) {
    const MapObject& object = *map.FindObject(id);
    if (object.map == map_id) seen[id] = object.last_seen;
  }
  return seen;
}

PlacedSighting Place(const ObjectSighting& sighting, const DepthRegion& region,
                     const DepthView& view, const Se3& T_world_camera) {
  PlacedSighting placed;
  placed.sighting = &sighting;
  placed.region = region;
  placed.points_camera = PointsOfRegion(view, region, kMaxPoints);
  if (placed.points_camera.empty()) return placed;
  placed.extent_m = ExtentAcross(placed.points_camera);
  placed.centroid_world = T_world_camera * MeanOf(placed.points_camera);
  return placed;
}

std::vector<PlacedSighting> PlaceSightings(std::span<const ObjectSighting> sightings,
                                           const DepthView& view, const Se3& T_world_camera,
                                           const ObjectClasses& classes,
                                           const MapObjectOptions& options) {
  std::vector<PlacedSighting> placed;
  for (const ObjectSighting* sighting : Candidates(sightings, classes)) {
    PlacedSighting one = Place(*sighting, sighting->region, view, T_world_camera);
    if (static_cast<int>(one.points_camera.size()) < options.min_voxels) continue;
    if (!classes.IsTooLarge(sighting->class_id, one.extent_m)) placed.push_back(std::move(one));
  }
  return placed;
}

std::vector<std::optional<ObjectId>> AssociateSightings(
    const MapView& map, MapId map_id, std::span<const PlacedSighting> sightings,
    const DepthView& view, const Se3& T_world_camera, const SeenBefore& seen_before,
    const ObjectClasses& classes, const MapObjectOptions& options) {
  struct Pair {
    Likeness likeness;
    std::size_t sighting = 0;
    ObjectId object;
  };
  std::vector<Pair> pairs;
  for (const ObjectId id : map.Objects()) {
    const MapObject& object = *map.FindObject(id);
    if (object.map != map_id || !object.surface) continue;
    ViewedObject viewed(map, object, T_world_camera);
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      if (!IsRecognised(object, *sightings[i].sighting, seen_before, options)) continue;
      const Likeness likeness = viewed.Compare(sightings[i], view, classes, options);
      if (likeness.score > 0.0) pairs.push_back({likeness, i, id});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return a.likeness.score > b.likeness.score;
  });
  std::vector<std::optional<ObjectId>> found(sightings.size());
  std::vector<ObjectId> taken;
  for (const Pair& pair : pairs) {
    if (found[pair.sighting]) continue;
    const bool is_taken = std::find(taken.begin(), taken.end(), pair.object) != taken.end();
    if (is_taken && !pair.likeness.is_on_surface) continue;
    found[pair.sighting] = pair.object;
    taken.push_back(pair.object);
  }
  return found;
}

std::optional<ObjectId> FindDouble(const MapView& map, const MapObject& object,
                                   const ObjectClasses& classes, const MapObjectOptions& options) {
  constexpr double kSameSurfaceReach = 0.35;  // one surface has one middle, more or less
  if (!object.surface || object.state == ObjectState::kAbsent) return std::nullopt;
  const Se3 T_object_world = map.T_world_object(object).Inverse();
  for (const ObjectId id : map.Objects()) {
    const MapObject& other = *map.FindObject(id);
    if (id == object.id || other.map != object.map || !other.surface ||
        other.state == ObjectState::kAbsent || !MayBeOne(object, other, classes, options)) {
      continue;
    }
    const Se3 T_object_other = T_object_world * map.T_world_object(other);
    const double limit_m =
        std::max(classes.DistanceM(object.class_id), classes.DistanceM(other.class_id));
    const bool is_alike = classes.AreAlike(other.class_id, object.class_id);
    const double reach_m = is_alike ? limit_m : kSameSurfaceReach * limit_m;
    if ((T_object_other * other.centroid - object.centroid).norm() > reach_m) continue;
    const double of_other =
        Overlap(*object.surface, Transformed(other.surface->samples, T_object_other),
                ReachM(*object.surface));
    const double of_object =
        Overlap(*other.surface, Transformed(object.surface->samples, T_object_other.Inverse()),
                ReachM(*other.surface));
    // One surface is one thing, whatever it is called; but a bear is no part of its chair.
    const bool is_double = is_alike ? std::max(of_other, of_object) >= options.merge_overlap
                                    : std::min(of_other, of_object) >= options.same_surface &&
                                          AreOfOneSize(object.box, other.box, options.same_size);
    if (is_double) return id;
  }
  return std::nullopt;
}

}  // namespace cslam
