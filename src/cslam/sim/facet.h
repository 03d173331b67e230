// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/placed_object.h"
#include "cslam/sim/ray_scene.h"
#include "cslam/sim/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace cslam {

// A triangle ready for shading: everything on it is affine in the world point p.
struct Facet {
  Eigen::Vector3f p0 = Eigen::Vector3f::Zero();                          // m, world
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();                     // unit, world
  Eigen::Vector2f uv0 = Eigen::Vector2f::Zero();                         // texture periods at p0
  Eigen::Matrix<float, 2, 3> d_uv = Eigen::Matrix<float, 2, 3>::Zero();  // per m of p
  Eigen::Vector3f d_gain = Eigen::Vector3f::Zero();                      // per m of p
  float gain0 = 1.0F;                                                    // light factor at p0
  int texture = 0;
};

// The facets of some objects of a scene.
class FacetTable {
 public:
  explicit FacetTable(const Scene& scene) : scene_(scene) {}

  // gains: the light factor per vertex; materials that shine by themselves have their own.
  void Add(const PlacedObject& object, std::span<const float> gains);

  bool Has(std::uint32_t instance) const {
    return instance < first_.size() && first_[instance] != kAbsent;
  }
  std::size_t IndexOf(const RayHit& hit) const { return first_[hit.object] + hit.triangle; }
  const Facet& At(const RayHit& hit) const { return facets_[IndexOf(hit)]; }

 private:
  static constexpr std::size_t kAbsent = static_cast<std::size_t>(-1);

  const Scene& scene_;
  std::vector<Facet> facets_;       // object by object
  std::vector<std::size_t> first_;  // per instance
};

}  // namespace cslam
