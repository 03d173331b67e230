// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/gone_surfaces.h"

#include "cslam/mapping/object_geometry.h"
#include "cslam/objects/colour_histogram.h"
#include "cslam/vision/colour_thumbnail.h"
#include "cslam/vision/depth_thumbnail.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <limits>

namespace cslam {
namespace {

// Millimetres at a pixel of the colour thumbnail; 0: none.
std::uint16_t DepthMm(const KeyframeData& data, int u, int v) {
  return data.depth_small_mm.at<std::uint16_t>(v * kDepthPerColourPixel + 1,
                                               u * kDepthPerColourPixel + 1);
}

}  // namespace

// What one keyframe saw of what may have been the thing.
struct GoneSurfaces::Trace {
  KeyframeId keyframe;
  std::vector<Eigen::Vector3f> points;  // camera frame
  Eigen::Vector3d centre_world = Eigen::Vector3d::Zero();
  ColourHistogram colours{};
  double likeness = 0.0;  // of them to the thing's
};

GoneSurfaces::GoneSurfaces(const Camera& camera, const ExpectedViewOptions& view,
                           const PastOptions& options)
    : camera_(camera),
      view_(view),
      options_(options),
      rays_(camera, cv::Size(camera.width, camera.height) / DepthThumbnailStep(camera.width)) {}

bool GoneSurfaces::HasThumbnails(const Keyframe& keyframe) const {
  return keyframe.IsAlive() && keyframe.data->depth_small_mm.size() == rays_.size() &&
         keyframe.data->bgr_small.size() == rays_.size() / kDepthPerColourPixel;
}

Eigen::Vector3d GoneSurfaces::PointAt(const KeyframeData& data, int u, int v) const {
  return 1e-3 * DepthMm(data, u, v) *
         rays_.At(u * kDepthPerColourPixel + 1, v * kDepthPerColourPixel + 1);
}

// Earlier keyframes that saw some of what this one sees, spread over time if there are many.
std::vector<KeyframeId> GoneSurfaces::Overlapping(const MapView& map,
                                                  const Keyframe& keyframe) const {
  constexpr int kSpacing = 12;       // pixels of the colour thumbnail
  constexpr double kMinShare = 0.2;  // of its readings that must lie in this one's picture
  const Se3 T_camera_world = keyframe.T_world_camera.Inverse();
  const DepthSampler sampler = ThumbnailSampler(keyframe.data->depth_small_mm, camera_);
  std::vector<KeyframeId> found;
  for (const KeyframeId id : map.Keyframes()) {
    if (!(id < keyframe.id)) break;
    const Keyframe& other = *map.FindKeyframe(id);
    if (other.map != keyframe.map || !HasThumbnails(other)) continue;
    const Se3 T_camera_other = T_camera_world * other.T_world_camera;
    int num_points = 0;
    int num_seen = 0;
    for (int v = kSpacing / 2; v < other.data->bgr_small.rows; v += kSpacing) {
      for (int u = kSpacing / 2; u < other.data->bgr_small.cols; u += kSpacing) {
        if (DepthMm(*other.data, u, v) == 0) continue;
        ++num_points;
        num_seen += Look(other, T_camera_other, u, v, sampler) != PointVerdict::kOutside ? 1 : 0;
      }
    }
    if (num_points > 0 && num_seen >= kMinShare * num_points) found.push_back(id);
  }
  const auto max_count = static_cast<std::size_t>(options_.max_compared);
  if (found.size() <= max_count) return found;
  std::vector<KeyframeId> some;
  for (std::size_t i = 0; i < max_count; ++i)  // not always the same ones
    some.push_back(
        found[(i * found.size() + keyframe.id.index() % found.size()) / max_count % found.size()]);
  return some;
}

bool GoneSurfaces::LookThrough(const MapView& map, KeyframeId id) {
  std::erase_if(num_looks_, [&](const auto& entry) {
    const Keyframe* keyframe = map.FindKeyframe(entry.first);
    return keyframe == nullptr || !keyframe->IsAlive();
  });
  const Keyframe& keyframe = *map.FindKeyframe(id);
  if (!options_.enabled || !HasThumbnails(keyframe)) return false;
  bool has_news = false;
  for (const KeyframeId other_id : Overlapping(map, keyframe)) {
    const Keyframe& other = *map.FindKeyframe(other_id);
    const cv::Size size = other.data->bgr_small.size();
    cv::Mat& looks = num_looks_.try_emplace(other_id, size, CV_8UC1, cv::Scalar(0)).first->second;
    has_news = Compare(other, keyframe, looks) || has_news;
  }
  return has_news;
}

PointVerdict GoneSurfaces::Look(const Keyframe& earlier, const Se3& T_later_earlier, int u, int v,
                                const DepthSampler& later) const {
  if (DepthMm(*earlier.data, u, v) == 0) return PointVerdict::kUnclear;
  return LookAtPoint(T_later_earlier * PointAt(*earlier.data, u, v), later, 0.0, view_);
}

// Of each cell the reading in its middle tells whether it, and what is around it, is worth a look.
// Returns whether anything counts as gone that did not before.
bool GoneSurfaces::Compare(const Keyframe& earlier, const Keyframe& later, cv::Mat& looks) const {
  constexpr int kCell = 3;
  const Se3 T_later_earlier = later.T_world_camera.Inverse() * earlier.T_world_camera;
  const DepthSampler sampler = ThumbnailSampler(later.data->depth_small_mm, camera_);
  cv::Mat cells(looks.size() / kCell, CV_8UC1, cv::Scalar(0));
  for (int v = 0; v < cells.rows; ++v) {
    for (int u = 0; u < cells.cols; ++u) {
      const cv::Point middle(u * kCell + kCell / 2, v * kCell + kCell / 2);
      const bool is_through =
          Look(earlier, T_later_earlier, middle.x, middle.y, sampler) == PointVerdict::kThrough;
      if (is_through || looks.at<std::uint8_t>(middle) > 0) cells.at<std::uint8_t>(v, u) = 1;
    }
  }
  cv::dilate(cells, cells, cv::Mat());
  bool has_news = false;
  for (int v = 0; v < cells.rows * kCell; ++v) {
    for (int u = 0; u < cells.cols * kCell; ++u) {
      if (cells.at<std::uint8_t>(v / kCell, u / kCell) == 0) continue;
      auto& count = looks.at<std::uint8_t>(v, u);
      const PointVerdict verdict = Look(earlier, T_later_earlier, u, v, sampler);
      if (verdict == PointVerdict::kStanding) count = 0;
      if (verdict != PointVerdict::kThrough || count == std::numeric_limits<std::uint8_t>::max())
        continue;
      has_news = ++count == options_.min_looks || has_news;
    }
  }
  return has_news;
}

std::vector<GoneSurfaces::Trace> GoneSurfaces::TracesIn(const Keyframe& keyframe,
                                                        const cv::Mat& looks,
                                                        const MapObject& object) const {
  const cv::Mat gone = looks >= options_.min_looks;
  if (cv::countNonZero(gone) < options_.min_pixels) return {};
  const cv::Mat like = gone & PixelsOfColours(keyframe.data->bgr_small, object.colours,
                                              static_cast<float>(options_.min_colour_share));
  cv::Mat labels;
  const int num_labels = cv::connectedComponents(like, labels, 8, CV_32S);
  std::vector<Trace> traces;
  for (int label = 1; label < num_labels; ++label) {
    const cv::Mat mask = labels == label;
    if (cv::countNonZero(mask) < options_.min_pixels) continue;
    Trace trace;
    trace.keyframe = keyframe.id;
    trace.colours = ColoursOf(keyframe.data->bgr_small, mask);
    trace.likeness = ColourLikeness(trace.colours, object.colours);
    for (int v = 0; v < mask.rows; ++v) {
      for (int u = 0; u < mask.cols; ++u) {
        if (mask.at<std::uint8_t>(v, u) == 0) continue;
        trace.points.push_back(PointAt(*keyframe.data, u, v).cast<float>());
      }
    }
    trace.centre_world = keyframe.T_world_camera * MeanOf(trace.points);
    traces.push_back(std::move(trace));
  }
  return traces;
}

// Of another thing of its kind, that is known to have stood there: then it is known what that did.
// Traces may be of different ends of it, each same_place from its middle.
bool GoneSurfaces::IsOfOther(const MapView& map, const Trace& trace, const MapObject& object,
                             const ObjectClasses& classes) const {
  for (const ObjectId id : map.Objects()) {
    const MapObject& other = *map.FindObject(id);
    if (id == object.id || other.map != object.map || !other.surface ||
        other.state == ObjectState::kCandidate ||
        !classes.AreAlike(other.class_id, object.class_id)) {
      continue;
    }
    if ((map.CentroidOf(other) - trace.centre_world).norm() <= 2.0 * options_.same_place_m)
      return true;
  }
  return false;
}

void GoneSurfaces::CountLater(const MapView& map, PastPlace& place) const {
  const Keyframe& reference = *map.FindKeyframe(place.reference);
  for (const KeyframeId id : map.Keyframes()) {
    const Keyframe& keyframe = *map.FindKeyframe(id);
    if (!(place.last_keyframe < id) || keyframe.map != reference.map || !HasThumbnails(keyframe))
      continue;
    const ExpectedView view =
        LookAtPlace(place.points, keyframe.T_world_camera.Inverse() * reference.T_world_camera,
                    ThumbnailSampler(keyframe.data->depth_small_mm, camera_), 0.0, view_);
    if (view.verdict != PlaceVerdict::kLookedThrough) continue;
    if (place.num_through++ == 0) place.first_through = keyframe.data->stamp;
  }
}

bool GoneSurfaces::IsAsLarge(const MapView& map, const Trace& trace, const MapObject& object,
                             const Eigen::Vector3d& up_world) const {
  const Eigen::Vector3d up =
      map.FindKeyframe(trace.keyframe)->T_world_camera.R().transpose() * up_world;
  return SizeRatio(BoxAround(trace.points, up), object.box) <= options_.max_size_ratio;
}

// All of before it came that may have been it, but for their size: pieces tell where it stood, too.
std::vector<GoneSurfaces::Trace> GoneSurfaces::TracesOf(const MapView& map, const MapObject& object,
                                                        const ObjectClasses& classes) const {
  std::vector<Trace> traces;
  for (const auto& [id, looks] : num_looks_) {
    const Keyframe* keyframe = map.FindKeyframe(id);
    if (!(id < object.arrived_keyframe) || keyframe == nullptr || !keyframe->IsAlive() ||
        keyframe->map != object.map) {
      continue;
    }
    for (Trace& trace : TracesIn(*keyframe, looks, object)) {
      if (!IsOfOther(map, trace, object, classes)) traces.push_back(std::move(trace));
    }
  }
  return traces;
}

// As one of its traces shows it; the others tell when it was seen there.
PastPlace GoneSurfaces::PlaceOf(const Trace& trace, const std::vector<Trace>& all) const {
  PastPlace place;
  place.reference = place.first_keyframe = place.last_keyframe = trace.keyframe;
  place.points = trace.points;
  place.colours = trace.colours;
  for (const Trace& other : all) {
    if ((trace.centre_world - other.centre_world).norm() > options_.same_place_m) continue;
    ++place.num_views;
    place.first_keyframe = std::min(place.first_keyframe, other.keyframe);
    place.last_keyframe = std::max(place.last_keyframe, other.keyframe);
  }
  return place;
}

std::optional<PastPlace> GoneSurfaces::FindPast(const MapView& map, const MapObject& object,
                                                const ObjectClasses& classes,
                                                const Eigen::Vector3d& up_world) const {
  const std::vector<Trace> traces = TracesOf(map, object, classes);
  std::optional<PastPlace> best;
  double best_likeness = 0.0;
  for (const Trace& trace : traces) {
    if (trace.likeness < options_.min_likeness || trace.likeness <= best_likeness ||
        !IsAsLarge(map, trace, object, up_world)) {
      continue;
    }
    PastPlace place = PlaceOf(trace, traces);
    if (place.num_views < options_.min_views) continue;
    best_likeness = trace.likeness;
    best = std::move(place);
  }
  if (best) CountLater(map, *best);
  return best && best->num_through > 0 ? best : std::nullopt;
}

}  // namespace cslam
