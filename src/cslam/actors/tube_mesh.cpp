// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/tube_mesh.h"

#include "cslam/util/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cslam {
namespace {

constexpr std::uint32_t kAround = 20;  // corners of a ring

double Shaped(double value, double boxiness) {
  return std::copysign(std::pow(std::abs(value), 2.0 / boxiness), value);
}

Influence InfluenceOf(const Ring& ring) {
  Influence influence = Only(ring.joint);
  if (ring.other_share > 0.0) {
    influence.joints[1] = static_cast<std::uint8_t>(ring.other);
    influence.weights[0] = static_cast<float>(1.0 - ring.other_share);
    influence.weights[1] = static_cast<float>(ring.other_share);
  }
  return influence;
}

void AddVertex(const Eigen::Vector3d& position, const Eigen::Vector2d& uv,
               const Influence& influence, SkinnedBody& body) {
  body.mesh.positions.push_back(position.cast<float>());
  body.mesh.uvs.push_back(uv.cast<float>());
  body.influences.push_back(influence);
}

std::uint32_t NumVertices(const SkinnedBody& body) {
  return static_cast<std::uint32_t>(body.mesh.positions.size());
}

}  // namespace

void AddTube(std::span<const Ring> rings, const TubeLook& look, SkinnedBody& body) {
  CSLAM_CHECK(rings.size() >= 2);
  const std::uint32_t first = NumVertices(body);
  double length_m = 0.0;
  double girth_m = 0.0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (i > 0) length_m += (rings[i].center - rings[i - 1].center).norm();
    girth_m = std::max(girth_m, std::numbers::pi * (rings[i].front_m + rings[i].side_m));
  }
  const double u_scale = look.picture_width_m > 0.0 ? girth_m / look.picture_width_m : 1.0;
  const double v_scale = 1.0 / (look.picture_height_m > 0.0 ? look.picture_height_m : length_m);
  double along_m = 0.0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const Ring& ring = rings[i];
    if (i > 0) along_m += (ring.center - rings[i - 1].center).norm();
    for (std::uint32_t k = 0; k <= kAround; ++k) {  // the seam has two vertices
      const double share = static_cast<double>(k) / kAround;
      const double angle = 2.0 * std::numbers::pi * (share - 0.5);
      const Eigen::Vector3d position =
          ring.center + ring.front_m * Shaped(std::cos(angle), look.boxiness) * look.first_axis +
          ring.side_m * Shaped(std::sin(angle), look.boxiness) * look.second_axis;
      AddVertex(position, {u_scale * share, v_scale * along_m}, InfluenceOf(ring), body);
    }
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    body.mesh.triangles.push_back({{first + a, first + b, first + c}, look.picture});
  };
  constexpr std::uint32_t kRow = kAround + 1;
  const auto num_rings = static_cast<std::uint32_t>(rings.size());
  for (std::uint32_t i = 0; i + 1 < num_rings; ++i) {
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = i * kRow + k;
      add(a, a + kRow, a + 1);
      add(a + 1, a + kRow, a + kRow + 1);
    }
  }
  for (const std::uint32_t ring : {0U, num_rings - 1U}) {  // caps
    const auto center = NumVertices(body) - first;
    AddVertex(rings[ring].center, {0.5 * u_scale, ring == 0 ? 0.0 : v_scale * length_m},
              InfluenceOf(rings[ring]), body);
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = ring * kRow + k;
      if (ring == 0) {
        add(center, a, a + 1);
      } else {
        add(center, a + 1, a);
      }
    }
  }
}

}  // namespace cslam
