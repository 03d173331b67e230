// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/renderer.h"

#include "cslam/sim/moving_scene.h"
#include "cslam/sim/view_caster.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

namespace cslam {
namespace {

// Offsets (px) of the extra rays of an edge pixel: a rotated grid, so that edges of every
// direction get evenly spaced steps.
constexpr std::array<std::array<float, 2>, 4> kEdgeOffsetsPx{
    {{-0.375F, -0.125F}, {0.125F, -0.375F}, {0.375F, 0.125F}, {-0.125F, 0.375F}}};
constexpr int kSameColor = 6;  // grey levels: a weaker step needs no smoothing

Eigen::Vector3f PixelRay(const Camera& camera, double u, double v) {
  return Unproject(camera, Undistort(camera, {u, v}), 1.0).cast<float>();
}

cv::Vec3b ToPixel(const Eigen::Array3f& bgr) {
  const auto byte = [](float value) {
    return static_cast<unsigned char>(std::clamp(value + 0.5F, 0.0F, 255.0F));
  };
  return {byte(bgr[0]), byte(bgr[1]), byte(bgr[2])};
}

bool IsSameColor(const cv::Vec3b& a, const cv::Vec3b& b) {
  for (int c = 0; c < 3; ++c) {
    if (std::abs(int{a[c]} - int{b[c]}) > kSameColor) return false;
  }
  return true;
}

// Pixels whose neighbour shows something else in another colour.
std::vector<std::size_t> EdgePixels(const ViewCaster& caster, std::span<const RayHit> hits,
                                    const cv::Mat& bgr) {
  const auto width = static_cast<std::size_t>(bgr.cols);
  const auto height = static_cast<std::size_t>(bgr.rows);
  const auto* colors = bgr.ptr<cv::Vec3b>();
  std::vector<char> is_edge(hits.size(), 0);
  for (std::size_t v = 0; v < height; ++v) {
    for (std::size_t u = 0; u < width; ++u) {
      const std::size_t i = v * width + u;
      for (const std::size_t j : {u + 1 < width ? i + 1 : i, v + 1 < height ? i + width : i}) {
        if (j == i || !caster.Differ(hits[i], hits[j])) continue;
        if (!IsSameColor(colors[i], colors[j])) is_edge[i] = is_edge[j] = 1;
      }
    }
  }
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (is_edge[i] != 0) pixels.push_back(i);
  }
  return pixels;
}

void SmoothEdges(const ViewCaster& caster, std::span<const RayHit> hits, cv::Mat bgr) {
  constexpr std::size_t kRays = kEdgeOffsetsPx.size();
  const std::vector<std::size_t> edges = EdgePixels(caster, hits, bgr);
  std::vector<std::size_t> pixels;
  std::vector<Eigen::Vector3f> rays;
  pixels.reserve(kRays * edges.size());
  rays.reserve(kRays * edges.size());
  for (const std::size_t pixel : edges) {
    for (const auto& [du, dv] : kEdgeOffsetsPx) {
      pixels.push_back(pixel);
      rays.push_back(caster.RayOf(pixel, du, dv));
    }
  }
  const std::vector<RayHit> edge_hits = caster.Cast(rays, pixels);
  auto* colors = bgr.ptr<cv::Vec3b>();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    for (std::size_t k = i * kRays; k < (i + 1) * kRays; ++k)
      sum += caster.Shade(edge_hits[k], rays[k]);
    colors[edges[i]] = ToPixel(sum / static_cast<float>(kRays));
  }
}

// Surface velocities of what moves.
cv::Mat Velocities(const MovingScene& moving, std::span<const RayHit> hits, cv::Size size) {
  cv::Mat velocity_m_s = cv::Mat::zeros(size, CV_32FC3);
  auto* to = velocity_m_s.ptr<cv::Vec3f>();
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!moving.facets().Has(hits[i].object)) continue;
    const Eigen::Vector3f& velocity = moving.VelocityOf(hits[i]);
    to[i] = {velocity.x(), velocity.y(), velocity.z()};
  }
  return velocity_m_s;
}

}  // namespace

Renderer::Renderer(World world, const Camera& camera)
    : world_(std::move(world)), camera_(camera), resting_(world_) {
  const std::string reason = WhyInvalid(camera);
  CSLAM_CHECK(reason.empty(), "{}", reason);
  CheckScene(world_.scene);
  pixel_rays_.reserve(static_cast<std::size_t>(camera.width) *
                      static_cast<std::size_t>(camera.height));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u)
      pixel_rays_.push_back(PixelRay(camera, u, v));
  }
}

Renderer::Renderer(Scene scene, const Camera& camera)
    : Renderer(World{std::move(scene), {}, {}}, camera) {}

RenderedView Renderer::Render(const Se3& T_world_camera, double time_s) const {
  const std::shared_ptr<const RestingScene> resting = resting_.At(time_s);
  const MovingScene moving(world_, time_s, *resting);
  const ViewCaster caster(world_.scene, *resting, moving, camera_, pixel_rays_, T_world_camera);
  std::vector<std::size_t> pixels(pixel_rays_.size());
  std::iota(pixels.begin(), pixels.end(), std::size_t{0});
  std::vector<Eigen::Vector3f> rays;
  rays.reserve(pixels.size());
  for (const std::size_t pixel : pixels)
    rays.push_back(caster.RayOf(pixel));
  const std::vector<RayHit> hits = caster.Cast(rays, pixels);

  const cv::Size size(camera_.width, camera_.height);
  RenderedView out{cv::Mat::zeros(size, CV_8UC3),
                   cv::Mat::zeros(size, CV_32FC1),
                   cv::Mat::zeros(size, CV_16UC1),
                   {}};
  auto* colors = out.bgr.ptr<cv::Vec3b>();
  auto* depths_m = out.depth_m.ptr<float>();
  auto* instances = out.instances.ptr<std::uint16_t>();
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].object == RayHit::kNone) continue;
    colors[i] = ToPixel(caster.Shade(hits[i], rays[i]));
    depths_m[i] = static_cast<float>(caster.DepthOf(hits[i], rays[i]));
    instances[i] = static_cast<std::uint16_t>(hits[i].object);
  }
  SmoothEdges(caster, hits, out.bgr);
  if (!moving.empty()) out.velocity_m_s = Velocities(moving, hits, size);
  return out;
}

}  // namespace cslam
