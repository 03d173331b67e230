// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/facet.h"

#include "cslam/util/check.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace cslam {
namespace {

constexpr double kMinAreaM2 = 1e-14;  // smaller triangles are never met by a ray

Facet MakeFacet(const PlacedObject& object, const Triangle& triangle, const Material& material,
                std::span<const float> gains) {
  const auto [a, b, c] = triangle.vertices;
  const std::vector<Eigen::Vector3d>& p = object.positions_m;
  const std::vector<Eigen::Vector2f>& uvs = object.mesh->uvs;
  const bool shines = material.emission > 0.0F;
  const auto gain = [&](std::uint32_t v) { return shines ? material.emission : gains[v]; };
  Facet facet;
  facet.p0 = p[a].cast<float>();
  facet.uv0 = uvs[a];
  facet.gain0 = gain(a);
  facet.texture = material.texture;
  const Eigen::Vector3d ab = p[b] - p[a];
  const Eigen::Vector3d ac = p[c] - p[a];
  const Eigen::Vector3d area = ab.cross(ac);
  const double squared = area.squaredNorm();
  if (squared < kMinAreaM2 * kMinAreaM2) return facet;
  // Rows that turn p - p0 into edge coordinates.
  Eigen::Matrix<double, 2, 3> barycentric;
  barycentric << ac.cross(area).transpose() / squared, area.cross(ab).transpose() / squared;
  Eigen::Matrix2d uv_edges;
  uv_edges << (uvs[b] - uvs[a]).cast<double>(), (uvs[c] - uvs[a]).cast<double>();
  const Eigen::RowVector2d gain_edges(static_cast<double>(gain(b) - gain(a)),
                                      static_cast<double>(gain(c) - gain(a)));
  facet.normal = (area / std::sqrt(squared)).cast<float>();
  facet.d_uv = (uv_edges * barycentric).cast<float>();
  facet.d_gain = (gain_edges * barycentric).transpose().cast<float>();
  return facet;
}

}  // namespace

void FacetTable::Add(const PlacedObject& object, std::span<const float> gains) {
  CSLAM_CHECK(gains.size() == object.positions_m.size(), "object {}", object.instance);
  const auto instance = static_cast<std::size_t>(object.instance);
  if (first_.size() <= instance) first_.resize(instance + 1, kAbsent);
  first_[instance] = facets_.size();
  facets_.reserve(facets_.size() + object.mesh->triangles.size());
  for (const Triangle& triangle : object.mesh->triangles) {
    const Material& material = scene_.materials[static_cast<std::size_t>(triangle.material)];
    facets_.push_back(MakeFacet(object, triangle, material, gains));
  }
}

}  // namespace cslam
