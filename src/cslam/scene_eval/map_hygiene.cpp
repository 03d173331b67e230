// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/map_hygiene.h"

#include "cslam/dataset/truth_lookup.h"
#include "cslam/io/dataset_info.h"
#include "cslam/util/check.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

namespace cslam {
namespace {

// A place something left for good within the run.
struct FormerPlace {
  int instance = 0;
  PlacedBox box;
  double left_s = 0.0;
};

std::vector<FormerPlace> FormerPlaces(const SceneTruth& truth, double start_s, double end_s) {
  constexpr double kSamePlaceM = 0.05;
  std::vector<FormerPlace> places;
  for (const TrueObject& object : truth.objects.objects) {
    const std::vector<Rest> rests = RestsOf(object);
    for (std::size_t i = 0; i < rests.size(); ++i) {
      if (rests[i].to_s <= start_s || rests[i].to_s > end_s) continue;
      const bool comes_back = std::any_of(
          rests.begin() + static_cast<std::ptrdiff_t>(i) + 1, rests.end(), [&](const Rest& later) {
            return later.from_s <= end_s &&
                   Difference(later.T_world_object, rests[i].T_world_object).distance_m <
                       kSamePlaceM;
          });
      if (!comes_back)
        places.push_back({object.instance, BoxOf(object, rests[i].T_world_object), rests[i].to_s});
    }
  }
  return places;
}

// Takes away the places that were not clearly seen again, nor what replaced the thing there.
std::vector<FormerPlace> SeenAgain(const SceneTruth& truth, const std::vector<FormerPlace>& places,
                                   double end_s, const ClearViewOptions& options) {
  std::vector<PlaceQuery> queries;
  for (const FormerPlace& place : places) {
    queries.push_back({.box = place.box, .from_s = place.left_s, .until_s = end_s});
    queries.push_back(ReplacementQuery(truth, place.instance, place.left_s, end_s));
  }
  const auto views = FirstClearViews(truth, queries, options);
  std::vector<FormerPlace> seen;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (views[2 * i] || views[2 * i + 1]) seen.push_back(places[i]);
  }
  return seen;
}

// Looks at depth images for what lies near some points.
class SurfaceSearch {
 public:
  SurfaceSearch(const SceneTruth& truth, std::vector<Eigen::Vector3d> points,
                const GhostOptions& options)
      : truth_(truth), options_(options), points_(std::move(points)), num_seen_(points_.size()) {}

  void Look(std::size_t frame) {
    const std::optional<Se3> T_world_camera = truth_.frames->T_world_camera(frame);
    if (!T_world_camera) return;
    depth_m_ = truth_.frames->DepthM(frame);
    if (depth_m_.empty()) return;
    instances_ = truth_.frames->has_instances() ? truth_.frames->Instances(frame) : cv::Mat();
    if (instances_.size() != depth_m_.size()) instances_.release();
    passing_ = PassingAt(truth_.TimeOf(truth_.frames->stamp(frame)));
    const Se3 T_camera_world = T_world_camera->Inverse();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (num_seen_[i] < options_.min_surface_frames && HasSurfaceAt(T_camera_world * points_[i]))
        ++num_seen_[i];
    }
  }

  // Points without a surface.
  std::vector<Eigen::Vector3d> Bare() const {
    std::vector<Eigen::Vector3d> bare;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (num_seen_[i] < options_.min_surface_frames) bare.push_back(points_[i]);
    }
    return bare;
  }

 private:
  // People, and what is being carried: no surface of the map.
  std::set<int> PassingAt(double time_s) const {
    std::set<int> passing;
    for (const TrueObject& object : truth_.objects.objects) {
      if (object.is_deformable || StateAt(object, time_s).presence == Presence::kMoving)
        passing.insert(object.instance);
    }
    return passing;
  }

  bool HasSurfaceAt(const Eigen::Vector3d& p_camera) const {
    const Camera& camera = truth_.frames->camera();
    const std::optional<PixelPlace> pixel = PixelOf(camera, p_camera);
    if (!pixel) return false;
    const int radius_px = static_cast<int>(
        std::ceil(options_.surface_distance_m * std::max(camera.fx, camera.fy) / p_camera.z()));
    for (int v = std::max(0, pixel->v - radius_px);
         v <= std::min(camera.height - 1, pixel->v + radius_px); ++v) {
      for (int u = std::max(0, pixel->u - radius_px);
           u <= std::min(camera.width - 1, pixel->u + radius_px); ++u) {
        if (IsSurfaceNear(u, v, p_camera)) return true;
      }
    }
    return false;
  }

  bool IsSurfaceNear(int u, int v, const Eigen::Vector3d& p_camera) const {
    const auto z_m = static_cast<double>(depth_m_.at<float>(v, u));
    if (z_m <= 0.0 || std::abs(z_m - p_camera.z()) > options_.surface_distance_m) return false;
    const Camera& camera = truth_.frames->camera();
    Eigen::Vector2d uv(u, v);
    if (camera.HasDistortion()) uv = Undistort(camera, uv);
    if ((Unproject(camera, uv, z_m) - p_camera).norm() > options_.surface_distance_m) return false;
    return instances_.empty() || !passing_.contains(instances_.at<std::uint16_t>(v, u));
  }

  const SceneTruth& truth_;
  const GhostOptions& options_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<int> num_seen_;  // frames that show a surface there
  cv::Mat depth_m_;
  cv::Mat instances_;
  std::set<int> passing_;
};

// Frames after something left that have its place in the picture.
std::vector<std::size_t> FramesOf(const SceneTruth& truth, const FormerPlace& place, double end_s,
                                  const GhostOptions& options) {
  ClearViewOptions frustum = options.clear_view;
  frustum.min_clear_share = 0.1;  // each frame can tell of the points it has
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < truth.frames->size(); ++i) {
    const double time_s = truth.TimeOf(truth.frames->stamp(i));
    if (time_s < place.left_s || time_s > end_s) continue;
    const std::optional<Se3> T_world_camera = truth.frames->T_world_camera(i);
    if (T_world_camera && IsInFrustum(place.box, truth.frames->camera(), *T_world_camera, frustum))
      frames.push_back(i);
  }
  std::vector<std::size_t> picked;
  for (const std::size_t k : EvenSample(frames.size(), options.max_frames))
    picked.push_back(frames[k]);
  return picked;
}

bool IsBefore(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

std::optional<double> GhostCount::Share() const {
  if (num_points == 0) return std::nullopt;
  return static_cast<double>(ghosts.size()) / static_cast<double>(num_points);
}

std::optional<double> ActiveShare::Share() const {
  if (num_points == 0) return std::nullopt;
  return static_cast<double>(num_active) / num_points;
}

GhostCount CountGhosts(const SceneTruth& truth, const SceneRun& run, const GhostOptions& options) {
  if (!run.map_points) throw Error("'{}' holds no map.ply", run.folder.string());
  const double end_s = truth.TimeOf(run.last_stamp());
  const std::vector<FormerPlace> places =
      SeenAgain(truth, FormerPlaces(truth, truth.TimeOf(run.memory_start()), end_s), end_s,
                options.clear_view);
  GhostCount count{.num_points = run.map_points->size(),
                   .num_former_places = static_cast<int>(places.size()),
                   .ghosts = {}};
  for (const FormerPlace& place : places) {
    std::vector<Eigen::Vector3d> suspects;
    for (const Eigen::Vector3d& point : *run.map_points) {
      if (DistanceTo(place.box, point) <= options.box_margin_m) suspects.push_back(point);
    }
    if (suspects.empty()) continue;
    SurfaceSearch search(truth, std::move(suspects), options);
    for (const std::size_t frame : FramesOf(truth, place, end_s, options))
      search.Look(frame);
    for (const Eigen::Vector3d& ghost : search.Bare())
      count.ghosts.push_back(ghost);
  }
  // A point may be in the boxes of two things.
  std::sort(count.ghosts.begin(), count.ghosts.end(), IsBefore);
  count.ghosts.erase(std::unique(count.ghosts.begin(), count.ghosts.end()), count.ghosts.end());
  return count;
}

ActiveShare ShareOfActivePoints(const ObjectEvaluation& evaluation, Stamp last_stamp,
                                double settled_after_s) {
  ActiveShare share;
  for (const JudgedObject& object : evaluation.objects) {
    const ReportedObject& report = object.found.report;
    const bool is_settled = SecondsBetween(last_stamp, report.first_seen) >= settled_after_s;
    if (object.verdict != ObjectVerdict::kMatched || !is_settled) continue;
    share.num_points += report.num_points;
    share.num_active += report.num_active_points;
  }
  return share;
}

}  // namespace cslam
