// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/mapper.h"

#include "cslam/mapping/correction.h"
#include "cslam/mapping/culling.h"
#include "cslam/mapping/fusion.h"
#include "cslam/mapping/local_ba.h"
#include "cslam/mapping/point_creation.h"
#include "cslam/util/check.h"
#include "cslam/util/stopwatch.h"

namespace cslam {
namespace {

#ifdef NDEBUG
constexpr bool kIsDebugBuild = false;
#else
constexpr bool kIsDebugBuild = true;
#endif

// Connects the keyframe to what it saw; ids that were fused since are followed.
void AddMatches(Map& map, KeyframeId id, const std::vector<PointId>& matches) {
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const auto point = matches[i].valid() ? map.Resolve(matches[i]) : std::nullopt;
    if (!point || !map.AddObservation(*point, id, static_cast<int>(i))) continue;
    map.RefreshAppearance(*point);
  }
}

void AddSightings(Map& map, const std::vector<PointSightings>& sightings) {
  for (const PointSightings& s : sightings) {
    if (const auto point = map.Resolve(s.point)) map.AddSightings(*point, s.expected, s.found);
  }
}

}  // namespace

Mapper::Mapper(const Camera& camera, const OrbOptions& orb, const DepthOptions& depth,
               const MapperOptions& options)
    : camera_(camera),
      bounds_(UndistortedBounds(camera)),
      depth_(depth),
      options_(options),
      model_(LevelScales(orb), depth.disparity_sigma_px),
      map_(model_.level_scales()),
      objects_(camera_, depth_, options_, model_) {}

void Mapper::Reset() {
  map_.Clear();
  newest_ = KeyframeId();
  on_probation_.clear();
  objects_.Reset();
}

MapUpdate Mapper::Continue(Map map) {
  if (map.level_scales() != model_.level_scales()) {
    throw Error(
        "the map was made with another image pyramid of {} levels; give tracking.orb the values "
        "of the run that made it",
        map.level_scales().size());
  }
  Reset();
  map_.Replace(std::move(map));
  map_.StartSession();
  MapUpdate update;
  update.step = MapUpdate::Step::kContinued;
  return Publish(std::move(update));
}

MapUpdate Mapper::Insert(const KeyframeProposal& proposal) {
  Stopwatch watch;
  MapUpdate update;
  update.keyframe = proposal.id;
  ++proposals_applied_;

  Keyframe keyframe;
  keyframe.id = proposal.id;
  keyframe.map = proposal.map;
  keyframe.data = proposal.data;
  keyframe.T_world_camera = proposal.T_reference_camera;
  const bool starts_map = !proposal.reference.valid();
  if (!starts_map) {
    const auto anchor = map_.Resolve(proposal.reference);
    if (!anchor) {
      update.step = MapUpdate::Step::kRefused;
      return Publish(std::move(update));
    }
    keyframe.parent = anchor->keyframe;
    keyframe.map = map_.FindKeyframe(anchor->keyframe)->map;  // its own may have been merged away
    keyframe.T_world_camera = map_.FindKeyframe(anchor->keyframe)->T_world_camera *
                              anchor->T_keyframe_self * proposal.T_reference_camera;
  }
  map_.AddKeyframe(std::move(keyframe));
  AddSightings(map_, proposal.sightings);
  AddMatches(map_, proposal.id, proposal.matches);
  if (!starts_map) {
    const auto best = map_.Neighbours(proposal.id, options_.min_shared_points, 1);
    if (!best.empty()) map_.SetParent(proposal.id, best.front().id);
  }
  const auto created =
      CreatePointsFromDepth(map_, proposal.id, camera_, depth_, options_.min_near_points);
  on_probation_.insert(on_probation_.end(), created.begin(), created.end());
  newest_ = proposal.id;

  update.points_created = static_cast<int>(created.size());
  AddLap(update.times, "insert", watch);
  const ObjectLayerReport objects = objects_.Update(map_, proposal);
  update.objects_found = objects.num_new;
  update.objects_changed = objects.num_changed;
  AddLap(update.times, "objects", watch);
  return Publish(std::move(update));
}

MapUpdate Mapper::Refine(const std::function<bool()>& should_stop) {
  CSLAM_CHECK(newest_.valid(), "Refine() without Insert()");
  Stopwatch watch;
  MapUpdate update;
  update.step = MapUpdate::Step::kRefined;
  update.keyframe = newest_;

  PointCulling culling = CullPointsOnProbation(map_, on_probation_, newest_, options_.culling);
  on_probation_ = std::move(culling.still_on_probation);
  update.points_culled = culling.num_erased;

  const auto created = TriangulatePoints(map_, newest_, camera_, model_, options_.min_shared_points,
                                         options_.triangulation);
  on_probation_.insert(on_probation_.end(), created.begin(), created.end());
  objects_.AssignPoints(map_, newest_, created);
  update.points_created = static_cast<int>(created.size());
  AddLap(update.times, "triangulate", watch);

  update.points_fused = FuseWithNeighbours(map_, newest_, camera_, bounds_, depth_, model_,
                                           options_.min_shared_points, options_.fusion);
  AddLap(update.times, "fuse", watch);

  const LocalBaReport ba =
      AdjustLocally(map_, newest_, camera_, depth_, model_, options_.min_shared_points,
                    options_.local_ba, should_stop);
  update.ba_iterations = ba.iterations;
  update.ba_was_stopped = ba.was_stopped;
  AddLap(update.times, "local_ba", watch);

  update.keyframes_culled =
      CullRedundantKeyframes(map_, newest_, depth_, options_.min_shared_points, options_.culling);
  AddLap(update.times, "cull", watch);
  return Publish(std::move(update));
}

MapUpdate Mapper::Apply(const MapCorrection& correction) {
  Stopwatch watch;
  CorrectionReport report = ApplyCorrection(map_, correction);
  if (report.is_applied()) objects_.MergeAllDoubles(map_);
  return Publish(std::move(report), watch);
}

MapUpdate Mapper::Apply(const PoseRefinement& refinement) {
  Stopwatch watch;
  return Publish(ApplyRefinement(map_, refinement), watch);
}

MapUpdate Mapper::Publish(CorrectionReport report, Stopwatch& watch) {
  MapUpdate update;
  update.step = MapUpdate::Step::kCorrected;
  update.points_fused = report.points_fused;
  update.correction = std::move(report);
  AddLap(update.times, "correct", watch);
  return Publish(std::move(update));
}

MapUpdate Mapper::Publish(MapUpdate update) {
  if (kIsDebugBuild || options_.check_invariants) {
    const std::string violation = map_.CheckInvariants();
    CSLAM_CHECK(violation.empty(), "{}", violation);
  }
  Stopwatch watch;
  auto snapshot = std::make_shared<MapSnapshot>();
  snapshot->revision = ++revision_;
  snapshot->proposals_applied = proposals_applied_;
  snapshot->map = map_.Snapshot();
  update.snapshot = std::move(snapshot);
  AddLap(update.times, "publish", watch);
  return update;
}

}  // namespace cslam
