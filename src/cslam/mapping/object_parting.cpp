// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_parting.h"

#include "cslam/mapping/object_geometry.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

constexpr int kMinKnownSightings = 2;
constexpr double kMinLeft = 0.4;  // share of a sighting that must remain

bool IsSmallerPart(const MapObject& other, const MapObject* known, const PlacedSighting& sighting,
                   const ObjectClasses& classes, const MapObjectOptions& options) {
  if (other.state == ObjectState::kAbsent || !other.surface ||
      other.num_sightings < kMinKnownSightings ||
      classes.AreAlike(other.class_id, sighting.sighting->class_id)) {
    return false;
  }
  if (known != nullptr && classes.AreAlike(other.class_id, known->class_id)) return false;
  const bool has_size = known != nullptr && known->num_sightings >= kMinKnownSightings;
  const double size_m = has_size ? known->box.size_m.maxCoeff() : sighting.extent_m;
  return other.box.size_m.maxCoeff() < options.same_size * size_m;
}

bool IsNear(const MapView& map, const MapObject& other, const PlacedSighting& sighting) {
  const double reach_m = sighting.extent_m + other.box.size_m.maxCoeff();
  return (map.CentroidOf(other) - sighting.centroid_world).norm() < reach_m;
}

// Sets the pixels of covered in which the surface stands.
void Cover(cv::Mat& covered, const ObjectSurface& surface, const Se3& T_camera_surface,
           const DepthView& view, const ExpectedViewOptions& options) {
  for (const Eigen::Vector3f& point : TrustedPoints(surface)) {
    const Eigen::Vector3d p = T_camera_surface * point.cast<double>();
    if (p.z() < 0.1) continue;
    const Eigen::Vector2d uv = Project(view.camera, p) / view.step;
    const double radius_px = 0.5 * surface.voxel_m * view.camera.fx / (p.z() * view.step);
    const cv::Rect cell(cv::Point(static_cast<int>(std::floor(uv.x() - radius_px)),
                                  static_cast<int>(std::floor(uv.y() - radius_px))),
                        cv::Point(static_cast<int>(std::floor(uv.x() + radius_px)) + 1,
                                  static_cast<int>(std::floor(uv.y() + radius_px)) + 1));
    const cv::Rect inside = cell & cv::Rect(0, 0, covered.cols, covered.rows);
    const double tolerance_m = surface.voxel_m + options.ToleranceM(p.z());
    for (int v = inside.y; v < inside.br().y; ++v) {
      for (int u = inside.x; u < inside.br().x; ++u) {
        const double z_m = static_cast<double>(view.DepthM(u, v));
        if (z_m > 0.0 && std::abs(z_m - p.z()) <= tolerance_m) covered.at<std::uint8_t>(v, u) = 255;
      }
    }
  }
}

}  // namespace

PlacedSighting PartFromOthers(const MapView& map, MapId map_id, const PlacedSighting& sighting,
                              const MapObject* known, const DepthView& view,
                              const Se3& T_world_camera, const ObjectClasses& classes,
                              const MapObjectOptions& options) {
  cv::Mat covered;
  for (const ObjectId id : map.Objects()) {
    const MapObject& other = *map.FindObject(id);
    if (other.map != map_id || (known != nullptr && known->id == id) ||
        !IsSmallerPart(other, known, sighting, classes, options) || !IsNear(map, other, sighting)) {
      continue;
    }
    if (covered.empty()) covered = cv::Mat::zeros(view.depth_mm.size(), CV_8UC1);
    Cover(covered, *other.surface, T_world_camera.Inverse() * map.T_world_object(other), view,
          options.view);
  }
  if (covered.empty()) return sighting;
  DepthRegion region = sighting.region;
  region.mask = region.mask & ~covered;
  region.num_pixels = cv::countNonZero(region.mask);
  if (region.num_pixels == sighting.region.num_pixels ||
      region.num_pixels < kMinLeft * sighting.region.num_pixels) {
    return sighting;
  }
  PlacedSighting parted = Place(*sighting.sighting, region, view, T_world_camera);
  return static_cast<int>(parted.points_camera.size()) < options.min_voxels ? sighting : parted;
}

}  // namespace cslam
