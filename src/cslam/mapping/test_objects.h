// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Things in a room as keyframes see them: depth, and a sighting of each, without a renderer.

#include "cslam/map/map.h"
#include "cslam/map/test_room.h"
#include "cslam/objects/object_sighting.h"
#include "cslam/util/random.h"
#include "cslam/vision/colour_thumbnail.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace cslam::test {

struct Thing {
  TestBox box;
  int class_id = -1;
  TrackId track;
  float hue = 0.0F;  // bin of its only colour
  bool is_detected = true;
};

struct ThingRoom {
  TestBox walls{{-3.0, -1.3, -3.0}, {3.0, 1.3, 3.0}};
  std::vector<Thing> things;
};

struct ThingView {
  DepthView view;
  cv::Mat bgr_small;                      // grey, and things in their colour
  std::vector<ObjectSighting> sightings;  // of the detected things that show
};

inline DepthRegion RegionOf(const DepthView& view, const cv::Mat& mask) {
  DepthRegion region;
  region.mask = mask;
  region.num_pixels = cv::countNonZero(mask);
  std::vector<float> depths;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Box box{1e9, 1e9, -1e9, -1e9};
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      if (mask.at<std::uint8_t>(v, u) == 0) continue;
      box = {std::min<double>(box.x_min, u * view.step), std::min<double>(box.y_min, v * view.step),
             std::max<double>(box.x_max, (u + 1) * view.step),
             std::max<double>(box.y_max, (v + 1) * view.step)};
      depths.push_back(view.DepthM(u, v));
      sum += view.PointAt(u, v, static_cast<double>(view.DepthM(u, v)));
    }
  }
  if (depths.empty()) return region;
  std::nth_element(depths.begin(), depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2),
                   depths.end());
  region.box = box;
  region.median_m = depths[depths.size() / 2];
  region.centre_camera = sum / static_cast<double>(depths.size());
  region.support = 1.0;
  return region;
}

inline ColourHistogram ColoursWithHue(float hue) {
  ColourHistogram colours{};
  colours[static_cast<std::size_t>(hue)] = 1.0F;
  colours[8 + static_cast<std::size_t>(hue)] = 1.0F;
  colours[16 + static_cast<std::size_t>(hue)] = 1.0F;
  return colours;
}

// Its hue, saturation and value lie in the middle of this bin of theirs.
inline cv::Vec3b PaintOf(float hue) {
  const auto bin = static_cast<double>(hue);
  const double sixths = (bin + 0.5) * 6.0 / 8.0;  // of the way around
  const double value = 32.0 * bin + 16.0;
  const double saturation = value / 255.0;
  const auto channel = [&](double n) {
    const double k = std::fmod(n + sixths, 6.0);
    const double share = std::clamp(std::min(k, 4.0 - k), 0.0, 1.0);
    return static_cast<unsigned char>(std::lround(value * (1.0 - saturation * share)));
  };
  return {channel(1.0), channel(3.0), channel(5.0)};
}

inline ThingView LookAtThings(const ThingRoom& room, const Camera& camera,
                              const Se3& T_world_camera, Stamp stamp) {
  ThingView seen;
  TestRoom walls;
  walls.walls = room.walls;
  for (const Thing& thing : room.things)
    walls.things.push_back(thing.box);
  seen.view = {RoomDepth(walls, camera, T_world_camera), DepthThumbnailStep(camera.width), camera};
  const cv::Mat& depth_mm = seen.view.depth_mm;
  seen.bgr_small = cv::Mat(depth_mm.size() / kDepthPerColourPixel, CV_8UC3, cv::Scalar::all(128));
  for (const Thing& thing : room.things) {
    cv::Mat mask = cv::Mat::zeros(depth_mm.size(), CV_8UC1);
    for (int v = 0; v < mask.rows; ++v) {
      for (int u = 0; u < mask.cols; ++u) {
        const int step = seen.view.step;
        const Eigen::Vector2d uv(u * step + step / 2, v * step + step / 2);
        const Eigen::Vector3d ray = T_world_camera.rotation * Unproject(camera, uv, 1.0);
        const double z = RayToBox(thing.box, T_world_camera.translation, ray);
        if (z < 60.0 && std::lround(1000.0 * z) <= depth_mm.at<std::uint16_t>(v, u)) {
          mask.at<std::uint8_t>(v, u) = 255;
        }
      }
    }
    for (int v = 0; v < seen.bgr_small.rows; ++v) {
      for (int u = 0; u < seen.bgr_small.cols; ++u) {
        if (mask.at<std::uint8_t>(v * kDepthPerColourPixel, u * kDepthPerColourPixel) != 0) {
          seen.bgr_small.at<cv::Vec3b>(v, u) = PaintOf(thing.hue);
        }
      }
    }
    if (!thing.is_detected || cv::countNonZero(mask) < 8) continue;
    ObjectSighting sighting;
    sighting.track = thing.track;
    sighting.class_id = thing.class_id;
    sighting.score = 0.7;
    sighting.region = RegionOf(seen.view, mask);
    sighting.box = sighting.region.box;
    sighting.first_detected = sighting.detected = stamp;
    sighting.colours = ColoursWithHue(thing.hue);
    seen.sightings.push_back(std::move(sighting));
  }
  return seen;
}

// At from, level, looking at a place.
inline Se3 PoseLookingAt(const Eigen::Vector3d& from, const Eigen::Vector3d& place) {
  const Eigen::Vector3d forward = (place - from).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(forward).normalized();
  Eigen::Matrix3d R;
  R << right, forward.cross(right), forward;
  return {Eigen::Quaterniond(R), from};
}

// Of the changes in the order they are told.
inline std::vector<MapChangeKind> KindsToldIn(const MapView& map) {
  std::vector<MapChangeKind> kinds;
  for (const MapChange& change : map.changes())
    kinds.push_back(change.kind);
  return kinds;
}

inline TestBox BoxAt(const Eigen::Vector3d& center, const Eigen::Vector3d& size) {
  return {center - 0.5 * size, center + 0.5 * size};
}

}  // namespace cslam::test
