// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/map_cloud.h"

#include "cslam/util/check.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace cslam {
namespace {

constexpr std::array<std::uint8_t, 3> kUnknownColour = {128, 128, 128};

// Where to look for a point's colour.
struct ColourSource {
  std::size_t point = 0;  // index into the cloud
  Eigen::Vector2f raw_px;
};
using SourcesByKeyframe = std::map<KeyframeId, std::vector<ColourSource>>;

// Bright, and far from that of the next id: steps of the golden angle round the circle of hues.
std::array<std::uint8_t, 3> ColourOfObject(ObjectId id) {
  const double hue = 6.0 * std::fmod(0.381966 * id.value() + 0.02, 1.0);
  const auto channel = [&](double offset) {
    const double x = std::fmod(hue + offset, 6.0);
    return static_cast<std::uint8_t>(255.0 * std::clamp(std::abs(x - 3.0) - 1.0, 0.0, 1.0));
  };
  return {channel(0.0), channel(4.0), channel(2.0)};
}

// The observation in the reference keyframe, else the first one.
const PointObservation* FindBestObservation(const MapPoint& point) {
  if (point.observations.empty()) return nullptr;
  const auto found =
      std::find_if(point.observations.begin(), point.observations.end(),
                   [&](const PointObservation& o) { return o.keyframe == point.reference; });
  return found == point.observations.end() ? &point.observations.front() : &*found;
}

// The colour image taken at stamp, from disk.
cv::Mat LoadColour(const DatasetReader& dataset, Stamp stamp) {
  std::size_t begin = 0;
  std::size_t end = dataset.size();
  while (begin < end) {
    const std::size_t middle = begin + (end - begin) / 2;
    if (dataset.stamp(middle) < stamp) {
      begin = middle + 1;
    } else {
      end = middle;
    }
  }
  if (begin == dataset.size() || dataset.stamp(begin) != stamp) return {};
  try {
    const LoadResult loaded = dataset.Load(begin);
    return loaded.frame ? loaded.frame->bgr : cv::Mat();
  } catch (const Error&) {  // strict, and the file has changed since
    return {};
  }
}

std::array<std::uint8_t, 3> ColourAt(const cv::Mat& bgr, const Eigen::Vector2f& raw_px) {
  const int x = std::clamp(static_cast<int>(std::lround(raw_px.x())), 0, bgr.cols - 1);
  const int y = std::clamp(static_cast<int>(std::lround(raw_px.y())), 0, bgr.rows - 1);
  const auto& pixel = bgr.at<cv::Vec3b>(y, x);
  return {pixel[2], pixel[1], pixel[0]};
}

}  // namespace

std::vector<ColoredPoint> ColourMap(const RunResult& result, const DatasetReader& dataset) {
  const MapView& view = result.snapshot->map;
  const MapId map = LargestMap(result);
  std::vector<ColoredPoint> cloud;
  SourcesByKeyframe sources;
  for (std::size_t i = 0; i < view.num_point_ids(); ++i) {
    const MapPoint* const point = view.FindPoint(PointId(static_cast<std::uint32_t>(i)));
    if (point == nullptr || !IsUsable(*point) || point->map != map) continue;
    if (point->object.valid()) {
      cloud.push_back({point->p_world.cast<float>(), ColourOfObject(point->object)});
      continue;
    }
    const PointObservation* const seen = FindBestObservation(*point);
    const Keyframe* const keyframe = seen == nullptr ? nullptr : view.FindKeyframe(seen->keyframe);
    if (keyframe != nullptr && IsOfThisRun(view, keyframe->id)) {
      const auto keypoint = static_cast<std::size_t>(seen->keypoint);
      const Eigen::Vector2f raw_px = keyframe->data->features.keypoints[keypoint].raw_px;
      sources[keyframe->id].push_back({.point = cloud.size(), .raw_px = raw_px});
    }
    cloud.push_back({.position_m = point->p_world.cast<float>(), .rgb = kUnknownColour});
  }
  for (const auto& [id, points] : sources) {
    const cv::Mat bgr = LoadColour(dataset, view.FindKeyframe(id)->data->stamp);
    if (bgr.empty()) continue;
    for (const ColourSource& source : points)
      cloud[source.point].rgb = ColourAt(bgr, source.raw_px);
  }
  return cloud;
}

}  // namespace cslam
