// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/point_creation.h"

#include "cslam/vision/matching.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cslam {
namespace {

constexpr std::size_t Index(int i) {
  return static_cast<std::size_t>(i);
}

Eigen::Vector3d Bearing(const Camera& camera, const Eigen::Vector2f& uv_px) {
  return Unproject(camera, uv_px.cast<double>(), 1.0);
}

// One of the two keyframes of a triangulation.
struct View {
  const Keyframe* keyframe = nullptr;
  std::vector<int> free_keypoints;  // without a point
};

View MakeView(const Map& map, KeyframeId id) {
  View view{.keyframe = map.FindKeyframe(id), .free_keypoints = {}};
  const auto& semantics = view.keyframe->data->features.semantics;
  for (std::size_t i = 0; i < view.keyframe->points.size(); ++i) {
    if (!view.keyframe->points[i].valid() && semantics[i].label != KeypointLabel::kDynamic) {
      view.free_keypoints.push_back(static_cast<int>(i));
    }
  }
  return view;
}

// Pairs of keypoints that lie on each other's epipolar line and look alike.
std::vector<Match> MatchAlongEpipolarLines(const View& a, const View& b, const Camera& camera,
                                           const MeasurementModel& model,
                                           const TriangulationOptions& options) {
  const Se3 T_b_a = b.keyframe->T_world_camera.Inverse() * a.keyframe->T_world_camera;
  const Eigen::Matrix3d essential_b_a = Skew(T_b_a.translation) * T_b_a.R();
  const FrameFeatures& features_a = a.keyframe->data->features;
  const FrameFeatures& features_b = b.keyframe->data->features;

  std::vector<Match> matches;
  std::vector<int> owner(features_b.size(), -1);  // position in matches
  for (const int i : a.free_keypoints) {
    // Epipolar line of keypoint i in b, in pixels.
    const Eigen::Vector3d line_n =
        essential_b_a * Bearing(camera, features_a.keypoints[Index(i)].uv_px);
    const Eigen::Vector3f line(static_cast<float>(line_n.x() / camera.fx),
                               static_cast<float>(line_n.y() / camera.fy),
                               static_cast<float>(line_n.z() - line_n.x() * camera.cx / camera.fx -
                                                  line_n.y() * camera.cy / camera.fy));
    const float norm2 = line.head<2>().squaredNorm();
    if (norm2 < std::numeric_limits<float>::min()) continue;
    Match best{.query = i, .keypoint = -1, .distance = options.match_distance + 1};
    int second = 256;
    for (const int j : b.free_keypoints) {
      const Keypoint& keypoint = features_b.keypoints[Index(j)];
      const float offset = line.x() * keypoint.uv_px.x() + line.y() * keypoint.uv_px.y() + line.z();
      const double chi2 =
          static_cast<double>(offset * offset / norm2) * model.information_px(keypoint.octave);
      if (chi2 > options.max_epipolar_chi2) continue;
      const int distance =
          HammingDistance(features_a.descriptors[Index(i)], features_b.descriptors[Index(j)]);
      if (distance < best.distance) {
        second = best.keypoint >= 0 ? best.distance : second;
        best.distance = distance;
        best.keypoint = j;
      } else {
        second = std::min(second, distance);
      }
    }
    if (best.keypoint < 0 || best.distance > options.match_ratio * second) continue;
    int& previous = owner[Index(best.keypoint)];
    if (previous >= 0 && matches[Index(previous)].distance <= best.distance) continue;
    if (previous >= 0) matches[Index(previous)].keypoint = -1;
    previous = static_cast<int>(matches.size());
    matches.push_back(best);
  }
  std::erase_if(matches, [](const Match& m) { return m.keypoint < 0; });
  return matches;
}

// Linear least squares on the two bearings (DLT); nullopt at infinity.
std::optional<Eigen::Vector3d> Intersect(const Eigen::Vector3d& bearing_a, const Se3& T_world_a,
                                         const Eigen::Vector3d& bearing_b, const Se3& T_world_b) {
  const Eigen::Matrix<double, 3, 4> P_a = T_world_a.Inverse().Matrix().topRows<3>();
  const Eigen::Matrix<double, 3, 4> P_b = T_world_b.Inverse().Matrix().topRows<3>();
  Eigen::Matrix4d A;
  A.row(0) = bearing_a.x() * P_a.row(2) - P_a.row(0);
  A.row(1) = bearing_a.y() * P_a.row(2) - P_a.row(1);
  A.row(2) = bearing_b.x() * P_b.row(2) - P_b.row(0);
  A.row(3) = bearing_b.y() * P_b.row(2) - P_b.row(1);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(A.transpose() * A);
  const Eigen::Vector4d solution = solver.eigenvectors().col(0);
  if (std::abs(solution.w()) < 1e-9) return std::nullopt;
  return Eigen::Vector3d(solution.head<3>() / solution.w());
}

// Reprojection (and disparity) error of a point in a keypoint within its chi2 gate.
bool Agrees(const Eigen::Vector3d& p_world, const Keyframe& keyframe, int keypoint_index,
            const Camera& camera, const MeasurementModel& model) {
  const Keypoint& keypoint = keyframe.data->features.keypoints[Index(keypoint_index)];
  const Eigen::Vector3d p_camera = keyframe.T_world_camera.Inverse() * p_world;
  if (p_camera.z() <= 0.05) return false;
  const Eigen::Vector2d error = Project(camera, p_camera) - keypoint.uv_px.cast<double>();
  const double information = model.information_px(keypoint.octave);
  double chi2 = error.squaredNorm() * information;
  if (!keypoint.HasDepth()) return chi2 < 5.991;  // chi2, 2 dof, 95 %
  const double disparity_metres =
      static_cast<double>(keypoint.disparity_px) * static_cast<double>(keypoint.depth_m);
  const double disparity_error =
      disparity_metres / p_camera.z() - static_cast<double>(keypoint.disparity_px);
  chi2 += disparity_error * disparity_error * model.information_disparity(keypoint.octave);
  return chi2 < 7.815;  // chi2, 3 dof, 95 %
}

// The ratio of distances must fit the ratio of scales at which the corner was found.
bool ScalesAgree(const Eigen::Vector3d& p_world, const Keyframe& a, int i, const Keyframe& b, int j,
                 const MeasurementModel& model) {
  const double distance_a = (p_world - a.T_world_camera.translation).norm();
  const double distance_b = (p_world - b.T_world_camera.translation).norm();
  const double ratio = distance_b / distance_a *
                       model.scale(a.data->features.keypoints[Index(i)].octave) /
                       model.scale(b.data->features.keypoints[Index(j)].octave);
  const double slack = 1.5 * model.scale(std::min(1, model.num_levels() - 1));
  return ratio < slack && ratio > 1.0 / slack;
}

// The point two matched keypoints see: by intersection when the parallax is wide enough,
// otherwise from whichever depth reading is nearer.
std::optional<Eigen::Vector3d> LocatePoint(const Keyframe& a, int i, const Keyframe& b, int j,
                                           const Camera& camera,
                                           const TriangulationOptions& options) {
  const Keypoint& keypoint_a = a.data->features.keypoints[Index(i)];
  const Keypoint& keypoint_b = b.data->features.keypoints[Index(j)];
  const Eigen::Vector3d bearing_a = Bearing(camera, keypoint_a.uv_px);
  const Eigen::Vector3d bearing_b = Bearing(camera, keypoint_b.uv_px);
  const Eigen::Vector3d ray_a = a.T_world_camera.rotation * bearing_a;
  const Eigen::Vector3d ray_b = b.T_world_camera.rotation * bearing_b;
  const double cosine = ray_a.normalized().dot(ray_b.normalized());
  if (cosine > 0.0 && cosine < std::cos(options.min_parallax_deg * std::numbers::pi / 180.0)) {
    return Intersect(bearing_a, a.T_world_camera, bearing_b, b.T_world_camera);
  }
  if (keypoint_a.HasDepth() &&
      (!keypoint_b.HasDepth() || keypoint_a.depth_m <= keypoint_b.depth_m)) {
    return a.T_world_camera * (static_cast<double>(keypoint_a.depth_m) * bearing_a);
  }
  if (keypoint_b.HasDepth()) {
    return b.T_world_camera * (static_cast<double>(keypoint_b.depth_m) * bearing_b);
  }
  return std::nullopt;
}

}  // namespace

std::vector<PointId> CreatePointsFromDepth(Map& map, KeyframeId id, const Camera& camera,
                                           const DepthOptions& depth, int min_near_points) {
  const Keyframe keyframe = *map.FindKeyframe(id);
  const FrameFeatures& features = keyframe.data->features;
  std::vector<int> by_depth;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const bool may_use = features.semantics[i].label != KeypointLabel::kDynamic;
    if (features.keypoints[i].HasDepth() && may_use) by_depth.push_back(static_cast<int>(i));
  }
  std::stable_sort(by_depth.begin(), by_depth.end(), [&](int a, int b) {
    return features.keypoints[Index(a)].depth_m < features.keypoints[Index(b)].depth_m;
  });
  std::vector<PointId> created;
  int num_points = 0;
  for (const int i : by_depth) {
    const Keypoint& keypoint = features.keypoints[Index(i)];
    const auto z = static_cast<double>(keypoint.depth_m);
    if (z > depth.near_depth_m() && num_points >= min_near_points) break;
    ++num_points;
    if (keyframe.points[Index(i)].valid()) continue;
    const Eigen::Vector3d p_camera = Unproject(camera, keypoint.uv_px.cast<double>(), z);
    const PointId point = map.AddPoint(keyframe.T_world_camera * p_camera, id);
    map.AddObservation(point, id, i);
    map.RefreshAppearance(point);
    created.push_back(point);
  }
  return created;
}

std::vector<PointId> TriangulatePoints(Map& map, KeyframeId id, const Camera& camera,
                                       const MeasurementModel& model, int min_shared_points,
                                       const TriangulationOptions& options) {
  std::vector<PointId> created;
  const auto neighbours =
      map.Neighbours(id, min_shared_points, static_cast<std::size_t>(options.neighbours));
  for (const CovisibleKeyframe& neighbour : neighbours) {
    const View a = MakeView(map, id);
    const View b = MakeView(map, neighbour.id);
    const double baseline =
        Difference(a.keyframe->T_world_camera, b.keyframe->T_world_camera).distance_m;
    if (baseline < options.min_baseline_m) continue;
    for (const Match& match : MatchAlongEpipolarLines(a, b, camera, model, options)) {
      const Keyframe& at_a = *map.FindKeyframe(id);
      const Keyframe& at_b = *map.FindKeyframe(neighbour.id);
      const int i = match.query;
      const int j = match.keypoint;
      const auto p_world = LocatePoint(at_a, i, at_b, j, camera, options);
      if (!p_world || !p_world->allFinite() || !Agrees(*p_world, at_a, i, camera, model) ||
          !Agrees(*p_world, at_b, j, camera, model) ||
          !ScalesAgree(*p_world, at_a, i, at_b, j, model)) {
        continue;
      }
      const PointId point = map.AddPoint(*p_world, id);
      map.AddObservation(point, id, i);
      map.AddObservation(point, neighbour.id, j);
      map.RefreshAppearance(point);
      created.push_back(point);
    }
  }
  return created;
}

}  // namespace cslam
