// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/view_caster.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

constexpr float kSameFaceCosine = 0.97F;
constexpr float kSamePlaneM = 0.002F;
constexpr double kNearM = 0.05;        // nearer vertices have no useful place in the picture
constexpr float kRectMarginPx = 2.0F;  // edge pixels cast rays beside their centres
// A plane seen flatter than this gives no depth in float; its first corner stands in.
constexpr double kMinCosine = 1e-4;

}  // namespace

ViewCaster::ViewCaster(const Scene& scene, const RestingScene& resting, const MovingScene& moving,
                       const Camera& camera, std::span<const Eigen::Vector3f> pixel_rays,
                       const Se3& T_world_camera)
    : scene_(scene),
      resting_(resting),
      moving_(moving),
      pixel_rays_(pixel_rays),
      origin_(T_world_camera.translation),
      R_world_camera_(T_world_camera.R().cast<float>()),
      step_x_(R_world_camera_.col(0) / static_cast<float>(camera.fx)),
      step_y_(R_world_camera_.col(1) / static_cast<float>(camera.fy)) {
  if (moving.empty()) return;
  may_show_mover_.assign(pixel_rays.size(), 0);
  for (const PlacedObject& mover : moving.placed())
    MarkPixelsOf(mover, camera, T_world_camera.Inverse());
}

void ViewCaster::MarkPixelsOf(const PlacedObject& mover, const Camera& camera,
                              const Se3& T_camera_world) {
  Eigen::AlignedBox2d rect;  // of x / z and y / z
  bool is_near = false;
  const Eigen::Matrix3d R = T_camera_world.R();
  for (const Eigen::Vector3d& p_world : mover.positions_m) {
    const Eigen::Vector3d p = R * p_world + T_camera_world.translation;
    is_near = is_near || (p.z() < kNearM && p.norm() < 1.0);
    if (p.z() >= kNearM) rect.extend(Eigen::Vector2d(p.x() / p.z(), p.y() / p.z()));
  }
  if (is_near) {
    std::ranges::fill(may_show_mover_, 1);
    return;
  }
  if (rect.isEmpty()) return;
  const Eigen::Array2f margin(kRectMarginPx / static_cast<float>(camera.fx),
                              kRectMarginPx / static_cast<float>(camera.fy));
  const Eigen::Array2f low = rect.min().cast<float>().array() - margin;
  const Eigen::Array2f high = rect.max().cast<float>().array() + margin;
  for (std::size_t i = 0; i < pixel_rays_.size(); ++i) {
    const Eigen::Vector3f& ray = pixel_rays_[i];
    if (ray.x() >= low.x() && ray.x() <= high.x() && ray.y() >= low.y() && ray.y() <= high.y())
      may_show_mover_[i] = 1;
  }
}

double ViewCaster::DepthTo(const Facet& facet, const Eigen::Vector3f& ray) const {
  const Eigen::Vector3d normal = facet.normal.cast<double>();
  const Eigen::Vector3d to_p0 = facet.p0.cast<double>() - origin_;
  const double slope = normal.dot(ray.cast<double>());
  if (std::abs(slope) < kMinCosine) return R_world_camera_.col(2).cast<double>().dot(to_p0);
  return normal.dot(to_p0) / slope;
}

std::vector<RayHit> ViewCaster::Cast(std::span<const Eigen::Vector3f> rays,
                                     std::span<const std::size_t> pixels) const {
  const Eigen::Vector3f origin = origin_.cast<float>();
  std::vector<RayHit> hits = resting_.rays().Cast(origin, rays);
  if (moving_.empty()) return hits;
  std::vector<std::size_t> chosen;
  std::vector<Eigen::Vector3f> chosen_rays;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (may_show_mover_[pixels[i]] == 0) continue;
    chosen.push_back(i);
    chosen_rays.push_back(rays[i]);
  }
  const std::vector<RayHit> mover_hits = moving_.rays().Cast(origin, chosen_rays);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const RayHit& mover = mover_hits[k];
    RayHit& hit = hits[chosen[k]];
    if (mover.object == RayHit::kNone) continue;
    if (hit.object == RayHit::kNone ||
        DepthOf(mover, chosen_rays[k]) < DepthOf(hit, chosen_rays[k]))
      hit = mover;
  }
  return hits;
}

Eigen::Array3f ViewCaster::Shade(const RayHit& hit, const Eigen::Vector3f& ray) const {
  if (hit.object == RayHit::kNone) return Eigen::Array3f::Zero();
  const Facet& facet = FacetOf(hit);
  const double depth_m = DepthTo(facet, ray);
  const Eigen::Vector3d p = origin_ + depth_m * ray.cast<double>();
  const Eigen::Vector3f from_p0 = (p - facet.p0.cast<double>()).cast<float>();
  // How the point on the plane moves from one pixel to the next: along the ray's change, and
  // along the ray itself to stay in the plane.
  const auto depth = static_cast<float>(depth_m);
  const float along = facet.normal.dot(ray);
  const float slope = std::abs(along) < static_cast<float>(kMinCosine) ? 0.0F : 1.0F / along;
  const auto footprint = [&](const Eigen::Vector3f& step) -> Eigen::Vector2f {
    return facet.d_uv * (depth * (step - ray * (facet.normal.dot(step) * slope)));
  };
  const Eigen::Vector2f uv = facet.uv0 + facet.d_uv * from_p0;
  float gain = facet.gain0 + facet.d_gain.dot(from_p0);
  if (!moving_.empty() && !IsMoving(hit)) {
    const Eigen::Vector3f facing = along < 0.0F ? facet.normal : Eigen::Vector3f(-facet.normal);
    gain *= moving_.shadow().GainAt(p.cast<float>(), facing);
  }
  const Texture& texture = scene_.textures[static_cast<std::size_t>(facet.texture)];
  return gain * texture.Sample(uv, footprint(step_x_), footprint(step_y_));
}

bool ViewCaster::Differ(const RayHit& a, const RayHit& b) const {
  if (a.object != b.object) return true;
  if (a.object == RayHit::kNone || a.triangle == b.triangle) return false;
  const Facet& facet_a = FacetOf(a);
  const Facet& facet_b = FacetOf(b);
  if (facet_a.normal.dot(facet_b.normal) < kSameFaceCosine) return true;
  if (facet_a.texture != facet_b.texture) return true;
  return std::abs(facet_a.normal.dot(facet_b.p0 - facet_a.p0)) > kSamePlaneM;
}

}  // namespace cslam
