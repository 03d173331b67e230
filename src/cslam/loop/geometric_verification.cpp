// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/geometric_verification.h"

#include "cslam/loop/place_index.h"
#include "cslam/optim/residuals.h"
#include "cslam/util/check.h"
#include "cslam/util/options.h"
#include "cslam/util/quantile.h"
#include "cslam/vision/matching.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace cslam {
namespace {

constexpr int kMinSharedPoints = 15;  // with fewer, keyframes hardly see the same

// Labels say what a point lies on, as the keyframe it was measured best in saw it.
bool IsOnBackground(const MapView& map, const MapPoint& point) {
  for (const PointObservation& o : point.observations) {
    const Keyframe* keyframe = map.FindKeyframe(o.keyframe);
    if (keyframe == nullptr) continue;
    return keyframe->data->features.semantics[static_cast<std::size_t>(o.keypoint)].label ==
           KeypointLabel::kStatic;
  }
  return false;
}

class Verifier {
 public:
  Verifier(const FrameFeatures& features, const MapView& map, const PlaceSensor& sensor,
           const VerificationOptions& options, const PointFilter& may_use)
      : features_(features), map_(map), sensor_(sensor), options_(options), may_use_(may_use) {
    keypoints_ = PlaceKeypoints(features);
    is_taken_.assign(features.size(), 1);
    for (const int i : keypoints_)
      is_taken_[static_cast<std::size_t>(i)] = 0;
  }

  PlaceVerification Run(KeyframeId candidate) {
    result_.candidate = candidate;
    result_.points.assign(features_.size(), PointId());
    const std::vector<KeyframeId> group = GroupOf(candidate);
    if (!MatchByLooks(PointsOf(group)) || !FindFirstPose()) return result_;
    SearchAround(PointsOf(group), options_.first_radius_px);
    SearchAround(PointsOf(LocalKeyframes(group)), options_.second_radius_px);
    Judge();
    return result_;
  }

 private:
  std::vector<KeyframeId> GroupOf(KeyframeId candidate) const {
    std::vector<KeyframeId> group{candidate};
    for (const CovisibleKeyframe& neighbour : map_.Neighbours(
             candidate, kMinSharedPoints, static_cast<std::size_t>(options_.neighbours))) {
      group.push_back(neighbour.id);
    }
    return group;
  }

  // The group, then the keyframes that see most of what was found, then their neighbours.
  std::vector<KeyframeId> LocalKeyframes(const std::vector<KeyframeId>& group) const {
    std::vector<std::int32_t> votes(map_.num_keyframe_ids(), 0);
    for (const PointId id : result_.points) {
      if (!id.valid()) continue;
      for (const PointObservation& o : map_.FindPoint(id)->observations)
        ++votes[o.keyframe.index()];
    }
    for (const KeyframeId id : group)
      votes[id.index()] = 0;
    std::vector<std::uint32_t> order(votes.size());
    std::iota(order.begin(), order.end(), 0U);
    std::erase_if(order, [&](std::uint32_t i) { return votes[i] == 0; });
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return votes[a] > votes[b]; });
    const auto max_keyframes = static_cast<std::size_t>(options_.max_local_keyframes);
    std::vector<KeyframeId> local = group;
    for (const std::uint32_t i : order) {
      if (local.size() < max_keyframes) local.push_back(KeyframeId(i));
    }
    const std::vector<KeyframeId> seeds = local;
    for (const KeyframeId seed : seeds) {
      for (const CovisibleKeyframe& n : map_.Neighbours(seed, kMinSharedPoints, 3)) {
        if (local.size() >= max_keyframes) return local;
        if (std::find(local.begin(), local.end(), n.id) == local.end()) local.push_back(n.id);
      }
    }
    return local;
  }

  std::vector<const MapPoint*> PointsOf(const std::vector<KeyframeId>& keyframes) const {
    std::vector<std::uint8_t> is_in(map_.num_point_ids(), 0);
    std::vector<const MapPoint*> points;
    for (const KeyframeId id : keyframes) {
      for (const PointId point_id : map_.FindKeyframe(id)->points) {
        if (!point_id.valid() || is_in[point_id.index()] != 0) continue;
        is_in[point_id.index()] = 1;
        const MapPoint* point = map_.FindPoint(point_id);
        if (point == nullptr || !IsUsable(*point) || !IsOnBackground(map_, *point)) continue;
        if (!may_use_ || may_use_(*point)) points.push_back(point);
      }
    }
    return points;
  }

  bool MatchByLooks(const std::vector<const MapPoint*>& points) {
    FrameFeatures looks;
    std::vector<int> all(points.size());
    std::iota(all.begin(), all.end(), 0);
    for (const MapPoint* point : points) {
      Keypoint keypoint;
      keypoint.uv_px = keypoint.raw_px = Eigen::Vector2f::Zero();
      keypoint.angle_rad = point->angle_rad;
      looks.keypoints.push_back(keypoint);
      looks.descriptors.push_back(point->descriptor);
    }
    const MatchOptions match{.max_distance = options_.match_distance,
                             .max_ratio = options_.match_ratio,
                             .check_rotation = true};
    matches_.assign(features_.size(), nullptr);
    for (const Match& m : MatchByDescriptor(features_, keypoints_, looks, all, match)) {
      matches_[static_cast<std::size_t>(m.query)] = points[static_cast<std::size_t>(m.keypoint)];
      ++result_.num_matches;
    }
    if (result_.num_matches >= options_.min_matches) return true;
    Conclude(VerificationOutcome::kFewMatches,
             fmt::format("{} matches < {}", result_.num_matches, options_.min_matches));
    return false;
  }

  bool FindFirstPose() {
    const Observations o = Observe();
    const PoseRansacResult found = FindPose(sensor_.camera, sensor_.baseline_m, o.observations,
                                            options_.ransac, result_.candidate.value());
    result_.num_ransac_inliers = found.num_inliers;
    result_.ransac_iterations = found.iterations;
    result_.T_world_camera = found.T_world_camera;
    if (found.num_inliers >= options_.min_ransac_inliers) return true;
    Conclude(VerificationOutcome::kNoPose,
             fmt::format("{} of {} matches agree < {}", found.num_inliers, result_.num_matches,
                         options_.min_ransac_inliers));
    return false;
  }

  struct Observations {
    std::vector<std::size_t> keypoints;
    std::vector<PoseObservation> observations;  // one for each
  };

  Observations Observe() const {
    Observations result;
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      if (matches_[i] == nullptr) continue;
      const Keypoint& k = features_.keypoints[i];
      result.keypoints.push_back(i);
      result.observations.push_back(
          {.p_world = matches_[i]->p_world,
           .uv_px = k.uv_px.cast<double>(),
           .disparity_px = static_cast<double>(k.disparity_px),
           .information_px = sensor_.model.information_px(k.octave),
           .information_disparity = sensor_.model.information_disparity(k.octave)});
    }
    return result;
  }

  struct Expected {
    std::vector<const MapPoint*> points;
    std::vector<ProjectionQuery> queries;  // one for each
  };

  // The points that should be in view, at a distance and an angle from which they can be told.
  Expected Expect(const std::vector<const MapPoint*>& points, double radius_px) const {
    constexpr double kDistanceSlack = 0.2;  // the scale limits are estimates
    constexpr double kMinDepth = 0.05;      // m
    const double min_cosine = std::cos(options_.max_view_angle_deg * std::numbers::pi / 180.0);
    const Se3 T_camera_world = result_.T_world_camera.Inverse();
    Expected expected;
    for (const MapPoint* point : points) {
      const Eigen::Vector3d p_camera = T_camera_world * point->p_world;
      if (p_camera.z() < kMinDepth) continue;
      const Eigen::Vector2d uv = Project(sensor_.camera, p_camera);
      if (!sensor_.bounds.Contains(uv)) continue;
      const Eigen::Vector3d offset = point->p_world - result_.T_world_camera.translation;
      const double distance = offset.norm();
      const auto max_distance = static_cast<double>(point->max_distance_m);
      if (distance < (1.0 - kDistanceSlack) * static_cast<double>(point->min_distance_m) ||
          distance > (1.0 + kDistanceSlack) * max_distance ||
          offset.dot(point->normal.cast<double>()) < min_cosine * distance) {
        continue;
      }
      const int octave = sensor_.model.PredictOctave(max_distance / distance);
      ProjectionQuery query;
      query.uv_px = uv.cast<float>();
      query.disparity_px =
          static_cast<float>(sensor_.camera.fx * sensor_.baseline_m / p_camera.z());
      query.radius_px = static_cast<float>(radius_px * sensor_.model.scale(octave));
      query.min_octave = octave - 1;
      query.max_octave = octave + 1;
      query.descriptor = point->descriptor;
      query.angle_rad = point->angle_rad;
      expected.points.push_back(point);
      expected.queries.push_back(query);
    }
    return expected;
  }

  // Matches anew within radius_px of where the points should be, and refines the pose.
  void SearchAround(const std::vector<const MapPoint*>& points, double radius_px) {
    const Expected expected = Expect(points, radius_px);
    const MatchOptions match{.max_distance = options_.guided_distance,
                             .max_ratio = options_.guided_ratio,
                             .check_rotation = true};
    matches_.assign(features_.size(), nullptr);
    for (const Match& m : MatchByProjection(features_, expected.queries, match, is_taken_)) {
      matches_[static_cast<std::size_t>(m.keypoint)] =
          expected.points[static_cast<std::size_t>(m.query)];
    }
    const Observations o = Observe();
    const PoseSolution solution = OptimizePose(
        sensor_.camera, sensor_.baseline_m, result_.T_world_camera, o.observations, options_.pose);
    result_.T_world_camera = solution.T_world_camera;
    result_.num_expected = static_cast<int>(expected.points.size());
    result_.num_inliers = solution.num_inliers;
    result_.points.assign(features_.size(), PointId());
    for (std::size_t k = 0; k < o.keypoints.size(); ++k) {
      if (solution.is_inlier[k] == 0) continue;
      result_.points[o.keypoints[k]] = matches_[o.keypoints[k]]->id;
    }
    Measure(o, solution);
  }

  void Measure(const Observations& o, const PoseSolution& solution) {
    const PixelDisparityModel model(sensor_.camera, sensor_.baseline_m);
    const PoseOptimizerOptions nominal;
    const Se3 T_camera_world = solution.T_world_camera.Inverse();
    std::vector<double> errors_px;
    std::array<bool, 16> has_inlier{};
    result_.num_strict_inliers = 0;
    for (std::size_t k = 0; k < o.keypoints.size(); ++k) {
      if (solution.is_inlier[k] == 0) continue;
      const PoseObservation& observation = o.observations[k];
      const Eigen::Vector3d p_camera = T_camera_world * observation.p_world;
      const Measurement m = MeasurementOf(observation);
      const double gate = m.has_disparity ? nominal.chi2_depth : nominal.chi2_mono;
      if (Chi2(model, m, p_camera) <= gate) ++result_.num_strict_inliers;
      errors_px.push_back((Project(sensor_.camera, p_camera) - observation.uv_px).norm());
      has_inlier[CellOf(observation.uv_px)] = true;
    }
    result_.num_cells = static_cast<int>(std::count(has_inlier.begin(), has_inlier.end(), true));
    if (!errors_px.empty()) result_.median_error_px = MedianOf(std::move(errors_px));
  }

  std::size_t CellOf(const Eigen::Vector2d& uv) const {
    const ImageBounds& b = sensor_.bounds;
    const auto cell = [](double x, double min, double max) {
      return std::clamp(static_cast<int>(4.0 * (x - min) / (max - min)), 0, 3);
    };
    return static_cast<std::size_t>(4 * cell(uv.y(), b.min_v, b.max_v) +
                                    cell(uv.x(), b.min_u, b.max_u));
  }

  void Judge() {
    // Of those that could have been found: there may be more points in view than features.
    const int most = std::min(result_.num_expected, static_cast<int>(keypoints_.size()));
    const double found_share = static_cast<double>(result_.num_inliers) / std::max(most, 1);
    if (result_.num_inliers < options_.min_inliers) {
      Conclude(VerificationOutcome::kFewInliers,
               fmt::format("{} inliers < {}", result_.num_inliers, options_.min_inliers));
    } else if (result_.num_cells < options_.min_cells) {
      Conclude(VerificationOutcome::kBadlySpread,
               fmt::format("{} inliers in {} cells < {}", result_.num_inliers, result_.num_cells,
                           options_.min_cells));
    } else if (found_share < options_.min_found_share) {
      Conclude(VerificationOutcome::kMissingPoints,
               fmt::format("{} inliers of {} points that should be in view", result_.num_inliers,
                           result_.num_expected));
    } else {
      Conclude(VerificationOutcome::kAccepted, fmt::format("{} inliers", result_.num_inliers));
    }
  }

  void Conclude(VerificationOutcome outcome, std::string reason) {
    result_.outcome = outcome;
    result_.reason = std::move(reason);
  }

  const FrameFeatures& features_;
  const MapView& map_;
  const PlaceSensor& sensor_;
  const VerificationOptions& options_;
  const PointFilter& may_use_;
  std::vector<int> keypoints_;
  std::vector<std::uint8_t> is_taken_;    // keypoints that may not be used
  std::vector<const MapPoint*> matches_;  // one per keypoint, null = none
  PlaceVerification result_;
};

}  // namespace

void Describe(OptionList& list, VerificationOptions& o) {
  list.Add("neighbours", o.neighbours, {0, 50}, "keyframes",
           "Neighbours whose points are matched by looks along with the candidate's own.");
  list.Add("match_distance", o.match_distance, {1, 256}, "bits",
           "Descriptors that differ by more are no match by looks.");
  list.Add("match_ratio", o.match_ratio, {0.1, 1.0}, "",
           "A match by looks must be nearer than this share of the second best's distance.");
  list.Add("min_matches", o.min_matches, {3, 10'000}, "",
           "With fewer matches by looks no pose is searched.");
  list.Add("min_ransac_inliers", o.min_ransac_inliers, {3, 10'000}, "",
           "Matches by looks that must agree on a pose. Wrong ones agree by chance, up to six of "
           "a hundred.");
  list.Group("ransac", o.ransac);
  list.Add("first_radius", o.first_radius_px, {1.0, 200.0}, "px",
           "Search radius around points expected by the first pose, times the level's scale.");
  list.Add("second_radius", o.second_radius_px, {1.0, 200.0}, "px",
           "The same for the second search, of all points around.");
  list.Add("guided_distance", o.guided_distance, {1, 256}, "bits",
           "Descriptors that differ by more are no match within the radius.");
  list.Add("guided_ratio", o.guided_ratio, {0.1, 1.0}, "",
           "A match within the radius must be nearer than this share of the second best's.");
  list.Add("max_local_keyframes", o.max_local_keyframes, {1, 1000}, "keyframes",
           "Keyframes whose points are searched for the second time.");
  list.Add("max_view_angle", o.max_view_angle_deg, {5.0, 90.0}, "deg",
           "Points seen from directions that differ by more are not expected.");
  list.Group("pose", o.pose);
  list.Add("min_inliers", o.min_inliers, {3, 10'000}, "points",
           "Fewest points the final pose must agree with.");
  list.Add("min_cells", o.min_cells, {1, 16}, "cells",
           "Fewest cells of a 4 x 4 grid over the image with an inlier: inliers on one thing only "
           "may stand for that thing, not for the place.");
  list.Add("min_found_share", o.min_found_share, {0.0, 1.0}, "",
           "Share of the points expected in view that must be inliers, of as many as there are "
           "features at most.");
}

PlaceSensor MakePlaceSensor(const Camera& camera, const OrbOptions& orb,
                            const DepthOptions& depth) {
  return {camera, UndistortedBounds(camera), depth.baseline_m,
          MeasurementModel(LevelScales(orb), depth.place_disparity_sigma_px)};
}

PlaceVerification VerifyPlace(const FrameFeatures& features, const MapView& map,
                              KeyframeId candidate, const PlaceSensor& sensor,
                              const VerificationOptions& options, const PointFilter& may_use) {
  CSLAM_CHECK(map.FindKeyframe(candidate) != nullptr, "keyframe {}", candidate.value());
  return Verifier(features, map, sensor, options, may_use).Run(candidate);
}

}  // namespace cslam
