// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/contact_shadow.h"
#include "cslam/sim/facet.h"
#include "cslam/sim/placed_object.h"
#include "cslam/sim/ray_scene.h"
#include "cslam/sim/resting_scene.h"
#include "cslam/sim/world.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace cslam {

// What moves in a world at one moment: things on their way and animated bodies, lit by the resting
// part around them.
class MovingScene {
 public:
  MovingScene(const World& world, double time_s, const RestingScene& resting);

  bool empty() const { return placed_.empty(); }
  const std::vector<PlacedObject>& placed() const { return placed_; }
  const RayScene& rays() const { return *rays_; }  // not if empty()
  const FacetTable& facets() const { return facets_; }
  const ContactShadow& shadow() const { return shadow_; }

  // Of the hit triangle's middle, m/s in the world.
  const Eigen::Vector3f& VelocityOf(const RayHit& hit) const {
    return velocities_[facets_.IndexOf(hit)];
  }

 private:
  void AddVelocities(const PlacedObject& object, const World& world, double time_s);

  std::vector<PlacedObject> placed_;
  std::optional<RayScene> rays_;
  FacetTable facets_;
  ContactShadow shadow_;
  std::vector<Eigen::Vector3f> velocities_;  // m/s, per facet
};

}  // namespace cslam
