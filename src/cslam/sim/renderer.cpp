// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/renderer.h"

#include "cslam/util/check.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cslam {
namespace {

// Offsets (px) of the extra rays of an edge pixel: a rotated grid, so that edges of every
// direction get evenly spaced steps.
constexpr std::array<std::array<double, 2>, 4> kEdgeOffsetsPx{
    {{-0.375, -0.125}, {0.125, -0.375}, {0.375, 0.125}, {-0.125, 0.375}}};
constexpr float kSameFaceCosine = 0.97F;

Eigen::Vector3f RayOf(const Camera& camera, double u, double v) {
  return Unproject(camera, Undistort(camera, {u, v}), 1.0).cast<float>();
}

cv::Vec3b ToPixel(const Eigen::Array3f& bgr) {
  const auto byte = [](float value) {
    return static_cast<unsigned char>(std::clamp(value + 0.5F, 0.0F, 255.0F));
  };
  return {byte(bgr[0]), byte(bgr[1]), byte(bgr[2])};
}

}  // namespace

// The camera's place and its axes in the world, as shading needs them.
struct Renderer::ViewPoint {
  Eigen::Vector3d origin;  // m, world
  Eigen::Matrix3f R;       // R_world_camera
  Eigen::Vector3f step_x;  // change of a ray (z = 1) from one pixel to the next, world
  Eigen::Vector3f step_y;

  ViewPoint(const Camera& camera, const Se3& T_world_camera)
      : origin(T_world_camera.translation),
        R(T_world_camera.R().cast<float>()),
        step_x(R.col(0) / static_cast<float>(camera.fx)),
        step_y(R.col(1) / static_cast<float>(camera.fy)) {}

  // Distance to the facet's plane in units of the ray: the z depth for rays with z = 1. Not taken
  // from Embree, whose reciprocals are approximate and differ between processors.
  double DepthTo(const Facet& facet, const Eigen::Vector3f& ray_world) const {
    const Eigen::Vector3d normal = facet.normal.cast<double>();
    return normal.dot(facet.p0.cast<double>() - origin) / normal.dot(ray_world.cast<double>());
  }
};

Renderer::Renderer(Scene scene, const Camera& camera)
    : Renderer(World{std::move(scene), {}, {}}, camera) {}

Renderer::Renderer(World world, const Camera& camera)
    : world_(std::move(world)), camera_(camera), rays_(world_.scene) {
  const std::string reason = WhyInvalid(camera);
  CSLAM_CHECK(reason.empty(), "{}", reason);
  CheckScene(world_.scene);
  MakeFacets(BakeLighting(world_.scene, rays_));
  pixel_rays_.reserve(static_cast<std::size_t>(camera.width) *
                      static_cast<std::size_t>(camera.height));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u)
      pixel_rays_.push_back(RayOf(camera, u, v));
  }
}

void Renderer::MakeFacets(const VertexGains& gains) {
  for (std::size_t i = 0; i < world_.scene.objects.size(); ++i) {
    const SceneObject& object = world_.scene.objects[i];
    const Mesh& mesh = object.mesh;
    first_facet_.push_back(facets_.size());
    for (const Triangle& triangle : mesh.triangles) {
      const auto [a, b, c] = triangle.vertices;
      const auto world = [&](std::uint32_t v) -> Eigen::Vector3d {
        return object.T_world_object * mesh.positions[v].cast<double>();
      };
      // Columns: the two edges and the normal; its inverse turns p - p0 into edge coordinates.
      Eigen::Matrix3d edges;
      edges.col(0) = world(b) - world(a);
      edges.col(1) = world(c) - world(a);
      edges.col(2) = edges.col(0).cross(edges.col(1)).normalized();
      const Eigen::Matrix<double, 2, 3> barycentric = edges.inverse().topRows<2>();
      Eigen::Matrix2d uv_edges;
      uv_edges << (mesh.uvs[b] - mesh.uvs[a]).cast<double>(),
          (mesh.uvs[c] - mesh.uvs[a]).cast<double>();
      const Material& material =
          world_.scene.materials[static_cast<std::size_t>(triangle.material)];
      const bool shines = material.emission > 0.0F;
      const auto gain = [&](std::uint32_t v) { return shines ? material.emission : gains[i][v]; };
      const Eigen::RowVector2d gain_edges(static_cast<double>(gain(b) - gain(a)),
                                          static_cast<double>(gain(c) - gain(a)));
      Facet facet;
      facet.p0 = world(a).cast<float>();
      facet.normal = edges.col(2).cast<float>();
      facet.uv0 = mesh.uvs[a];
      facet.d_uv = (uv_edges * barycentric).cast<float>();
      facet.d_gain = (gain_edges * barycentric).transpose().cast<float>();
      facet.gain0 = gain(a);
      facet.texture = material.texture;
      facets_.push_back(facet);
    }
  }
}

Eigen::Array3f Renderer::Shade(const ViewPoint& view, const RayHit& hit,
                               const Eigen::Vector3f& ray_world) const {
  if (hit.object == RayHit::kNone) return Eigen::Array3f::Zero();
  const Facet& facet = FacetOf(hit);
  const double depth_m = view.DepthTo(facet, ray_world);
  const Eigen::Vector3f from_p0 =
      (view.origin + depth_m * ray_world.cast<double>() - facet.p0.cast<double>()).cast<float>();
  // How the point on the plane moves from one pixel to the next: along the ray's change, and
  // along the ray itself to stay in the plane.
  const auto depth = static_cast<float>(depth_m);
  const float slope = 1.0F / facet.normal.dot(ray_world);
  const auto footprint = [&](const Eigen::Vector3f& step) -> Eigen::Vector2f {
    return facet.d_uv * (depth * (step - ray_world * (facet.normal.dot(step) * slope)));
  };
  const Eigen::Vector2f uv = facet.uv0 + facet.d_uv * from_p0;
  const float gain = facet.gain0 + facet.d_gain.dot(from_p0);
  return gain * world_.scene.textures[static_cast<std::size_t>(facet.texture)].Sample(
                    uv, footprint(view.step_x), footprint(view.step_y));
}

std::vector<std::size_t> Renderer::EdgePixels(std::span<const RayHit> hits) const {
  const auto width = static_cast<std::size_t>(camera_.width);
  const auto height = static_cast<std::size_t>(camera_.height);
  const auto differ = [&](const RayHit& a, const RayHit& b) {
    if (a.object != b.object) return true;
    if (a.object == RayHit::kNone || a.triangle == b.triangle) return false;
    const Facet& facet_a = FacetOf(a);
    const Facet& facet_b = FacetOf(b);
    if (facet_a.normal.dot(facet_b.normal) < kSameFaceCosine) return true;
    if (facet_a.texture != facet_b.texture) return true;
    constexpr float kSamePlaneM = 0.002F;
    return std::abs(facet_a.normal.dot(facet_b.p0 - facet_a.p0)) > kSamePlaneM;
  };
  std::vector<char> is_edge(hits.size(), 0);
  for (std::size_t v = 0; v < height; ++v) {
    for (std::size_t u = 0; u < width; ++u) {
      const std::size_t i = v * width + u;
      for (const std::size_t j : {u + 1 < width ? i + 1 : i, v + 1 < height ? i + width : i}) {
        if (j != i && differ(hits[i], hits[j])) is_edge[i] = is_edge[j] = 1;
      }
    }
  }
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (is_edge[i] != 0) pixels.push_back(i);
  }
  return pixels;
}

void Renderer::SmoothEdges(const ViewPoint& view, std::span<const RayHit> hits, cv::Mat bgr) const {
  const std::vector<std::size_t> pixels = EdgePixels(hits);
  std::vector<Eigen::Vector3f> rays;
  rays.reserve(pixels.size() * kEdgeOffsetsPx.size());
  for (const std::size_t pixel : pixels) {
    for (const auto& [du, dv] : kEdgeOffsetsPx) {
      rays.emplace_back(view.R * pixel_rays_[pixel] + static_cast<float>(du) * view.step_x +
                        static_cast<float>(dv) * view.step_y);
    }
  }
  const std::vector<RayHit> edge_hits = rays_.Cast(view.origin.cast<float>(), rays);
  auto* colours = bgr.ptr<cv::Vec3b>();
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    for (std::size_t k = i * kEdgeOffsetsPx.size(); k < (i + 1) * kEdgeOffsetsPx.size(); ++k)
      sum += Shade(view, edge_hits[k], rays[k]);
    colours[pixels[i]] = ToPixel(sum / static_cast<float>(kEdgeOffsetsPx.size()));
  }
}

RenderedView Renderer::Render(const Se3& T_world_camera, double /*time_s*/) const {
  const ViewPoint view(camera_, T_world_camera);
  std::vector<Eigen::Vector3f> rays;
  rays.reserve(pixel_rays_.size());
  for (const Eigen::Vector3f& ray : pixel_rays_)
    rays.emplace_back(view.R * ray);
  const std::vector<RayHit> hits = rays_.Cast(view.origin.cast<float>(), rays);

  RenderedView out{cv::Mat::zeros(camera_.height, camera_.width, CV_8UC3),
                   cv::Mat::zeros(camera_.height, camera_.width, CV_32FC1),
                   cv::Mat::zeros(camera_.height, camera_.width, CV_16UC1)};
  auto* colours = out.bgr.ptr<cv::Vec3b>();
  auto* depths_m = out.depth_m.ptr<float>();
  auto* instances = out.instances.ptr<std::uint16_t>();
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].object == RayHit::kNone) continue;
    colours[i] = ToPixel(Shade(view, hits[i], rays[i]));
    depths_m[i] = static_cast<float>(view.DepthTo(FacetOf(hits[i]), rays[i]));
    instances[i] = static_cast<std::uint16_t>(hits[i].object);
  }
  SmoothEdges(view, hits, out.bgr);
  return out;
}

}  // namespace cslam
