// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/clear_view.h"

#include "cslam/dataset/truth_lookup.h"
#include "cslam/util/check.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace cslam {
namespace {

constexpr int kSamplesPerAxis = 4;
constexpr double kInnerShare =
    0.8;                        // of the box, that the samples fill: things rarely fill corners
constexpr double kNearM = 0.1;  // nearer points are not projected
constexpr double kSameTimeS = 1e-6;  // stamps are rounded to microseconds

std::vector<Eigen::Vector3d> SamplesOf(const PlacedBox& box) {
  const auto share = [](int i) { return kInnerShare * (i / (kSamplesPerAxis - 1.0) - 0.5); };
  std::vector<Eigen::Vector3d> samples;
  for (int x = 0; x < kSamplesPerAxis; ++x)
    for (int y = 0; y < kSamplesPerAxis; ++y)
      for (int z = 0; z < kSamplesPerAxis; ++z) {
        const Eigen::Vector3d p(share(x), share(y), share(z));
        samples.push_back(box.T_world_box * Eigen::Vector3d(p.cwiseProduct(box.size_m)));
      }
  return samples;
}

// How far along the way from the camera to a point inside the box the box begins, 0 to 1.
double EntryShare(const PlacedBox& box, const Eigen::Vector3d& camera_world,
                  const Eigen::Vector3d& p_world) {
  const Se3 T_box_world = box.T_world_box.Inverse();
  const Eigen::Vector3d from = T_box_world * camera_world;
  const Eigen::Vector3d way = T_box_world * p_world - from;
  double enter = 0.0;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(way[i]) < std::numeric_limits<double>::epsilon()) continue;
    const double half = way[i] > 0.0 ? -0.5 * box.size_m[i] : 0.5 * box.size_m[i];
    enter = std::max(enter, (half - from[i]) / way[i]);
  }
  return std::min(enter, 1.0);
}

double ClearShare(const PlacedBox& box, const Camera& camera, const Se3& T_world_camera,
                  const cv::Mat& depth_m, double margin_m) {
  const Se3 T_camera_world = T_world_camera.Inverse();
  const std::vector<Eigen::Vector3d> samples = SamplesOf(box);
  const auto num_clear =
      std::count_if(samples.begin(), samples.end(), [&](const Eigen::Vector3d& p_world) {
        const Eigen::Vector3d p = T_camera_world * p_world;
        const std::optional<PixelPlace> pixel = PixelOf(camera, p);
        if (!pixel) return false;
        const auto z_m = static_cast<double>(depth_m.at<float>(pixel->v, pixel->u));
        const double entry_m = p.z() * EntryShare(box, T_world_camera.translation, p_world);
        return z_m > 0.0 && z_m >= entry_m - margin_m;
      });
  return static_cast<double>(num_clear) / static_cast<double>(samples.size());
}

// A query on its way through the frames.
struct Search {
  int num_clear = 0;  // frames one after the other
  double since_s = 0.0;
  std::optional<double> found_s = {};
};

class ViewFinder {
 public:
  ViewFinder(const SceneTruth& truth, std::span<const PlaceQuery> queries,
             const ClearViewOptions& options)
      : truth_(truth), queries_(queries), options_(options), searches_(queries.size()) {}

  std::vector<std::optional<double>> Find() {
    for (std::size_t frame = 0; frame < truth_.frames->size(); ++frame)
      Look(frame);
    std::vector<std::optional<double>> found;
    for (const Search& search : searches_)
      found.push_back(search.found_s);
    return found;
  }

 private:
  void Look(std::size_t frame) {
    const double time_s = truth_.TimeOf(truth_.frames->stamp(frame));
    const std::optional<Se3> T_world_camera = truth_.frames->T_world_camera(frame);
    cv::Mat depth_m;
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      Search& search = searches_[i];
      if (search.found_s) continue;
      const bool may_be_clear = T_world_camera && MayBeClear(queries_[i], frame, *T_world_camera);
      if (may_be_clear && depth_m.empty()) depth_m = truth_.frames->DepthM(frame);
      if (!may_be_clear || depth_m.empty() || !IsClear(queries_[i], *T_world_camera, depth_m)) {
        search.num_clear = 0;
        continue;
      }
      if (search.num_clear == 0) search.since_s = time_s;
      if (++search.num_clear >= options_.min_frames) search.found_s = search.since_s;
    }
  }

  bool MayBeClear(const PlaceQuery& query, std::size_t frame, const Se3& T_world_camera) const {
    const Stamp stamp = truth_.frames->stamp(frame);
    const double time_s = truth_.TimeOf(stamp);
    if (time_s < query.from_s - kSameTimeS || time_s >= query.until_s + kSameTimeS) return false;
    if (time_s > options_.gap_from_s && time_s < options_.gap_to_s) return false;
    if (query.shown_instance != 0 && !Shows(stamp, query.shown_instance)) return false;
    return IsInFrustum(query.box, truth_.frames->camera(), T_world_camera, options_);
  }

  bool IsClear(const PlaceQuery& query, const Se3& T_world_camera, const cv::Mat& depth_m) const {
    return ClearShare(query.box, truth_.frames->camera(), T_world_camera, depth_m,
                      options_.occluder_margin_m) >= options_.min_clear_share;
  }

  bool Shows(Stamp stamp, int instance) const {
    const std::vector<RecordedFrame>& frames = truth_.detections.frames;
    const auto frame =
        std::lower_bound(frames.begin(), frames.end(), stamp,
                         [](const RecordedFrame& f, Stamp wanted) { return f.stamp < wanted; });
    if (frame == frames.end() || frame->stamp != stamp) return false;
    const Camera& camera = truth_.frames->camera();
    const double min_px = options_.min_picture_share * camera.width * camera.height;
    return std::any_of(frame->detections.begin(), frame->detections.end(),
                       [&](const RecordedDetection& d) {
                         return d.instance == instance && d.visible_px >= min_px;
                       });
  }

  const SceneTruth& truth_;
  std::span<const PlaceQuery> queries_;
  ClearViewOptions options_;
  std::vector<Search> searches_;
};

}  // namespace

PlaceQuery NoQuery() {
  constexpr double kForever = std::numeric_limits<double>::infinity();
  return {.from_s = kForever, .until_s = -kForever};
}

PlaceQuery ReplacementQuery(const SceneTruth& truth, int instance, double left_s, double until_s) {
  constexpr double kSameChangeS = 1e-3;  // JSON rounds
  for (const TrueChange& change : truth.changes.changes) {
    const bool is_it = change.kind == ChangeKind::kReplaced && change.instance == instance &&
                       change.time_s >= left_s - kSameChangeS;
    const TrueObject* object = is_it ? FindObject(truth.objects, change.new_instance) : nullptr;
    if (object == nullptr || !change.to) continue;
    PlaceQuery query{.box = BoxOf(*object, *change.to), .from_s = change.time_s};
    query.until_s = until_s;
    query.shown_instance = object->class_id >= 0 ? object->instance : 0;
    for (const Rest& rest : RestsOf(*object)) {
      if (rest.from_s <= change.time_s + kSameChangeS && rest.to_s > change.time_s)
        query.until_s = std::min(until_s, rest.to_s);
    }
    return query;
  }
  return NoQuery();
}

std::vector<std::optional<double>> FirstClearViews(const SceneTruth& truth,
                                                   std::span<const PlaceQuery> queries,
                                                   const ClearViewOptions& options) {
  CSLAM_CHECK(truth.frames != nullptr);
  return ViewFinder(truth, queries, options).Find();
}

std::optional<PixelPlace> PixelOf(const Camera& camera, const Eigen::Vector3d& p_camera) {
  if (p_camera.z() < kNearM) return std::nullopt;
  Eigen::Vector2d uv = Project(camera, p_camera);
  // Far outside the picture a lens model need not hold.
  const bool is_near =
      std::abs(uv.x() - camera.cx) < camera.width && std::abs(uv.y() - camera.cy) < camera.height;
  if (!is_near) return std::nullopt;
  if (camera.HasDistortion()) uv = Distort(camera, uv);
  const PixelPlace pixel{static_cast<int>(std::lround(uv.x())),
                         static_cast<int>(std::lround(uv.y()))};
  const bool is_inside =
      pixel.u >= 0 && pixel.v >= 0 && pixel.u < camera.width && pixel.v < camera.height;
  return is_inside ? std::optional(pixel) : std::nullopt;
}

bool IsInFrustum(const PlacedBox& box, const Camera& camera, const Se3& T_world_camera,
                 const ClearViewOptions& options) {
  const Eigen::Vector3d middle = box.T_world_box.translation;
  if ((middle - T_world_camera.translation).norm() > options.max_distance_m) return false;
  const Se3 T_camera_world = T_world_camera.Inverse();
  if ((T_camera_world * middle).z() < kNearM) return false;
  const std::vector<Eigen::Vector3d> samples = SamplesOf(box);
  const auto num_inside = std::count_if(
      samples.begin(), samples.end(),
      [&](const Eigen::Vector3d& p) { return PixelOf(camera, T_camera_world * p).has_value(); });
  return static_cast<double>(num_inside) >=
         options.min_clear_share * static_cast<double>(samples.size());
}

}  // namespace cslam
