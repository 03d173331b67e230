// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/facet.h"
#include "cslam/sim/lighting.h"
#include "cslam/sim/placed_object.h"
#include "cslam/sim/ray_scene.h"
#include "cslam/sim/world.h"

#include <memory>
#include <vector>

namespace cslam {

// What rests in a world at some time, lit and ready for rays. Immutable.
class RestingScene {
 public:
  // similar: the same world at another time; its light is kept where nothing has changed. The
  // result does not depend on it. The world must outlive this.
  RestingScene(const World& world, double time_s, const RestingScene* similar = nullptr);
  RestingScene(const RestingScene&) = delete;
  RestingScene& operator=(const RestingScene&) = delete;

  const RayScene& rays() const { return rays_; }
  const FacetTable& facets() const { return facets_; }
  const LightBaker& baker() const { return baker_; }

  // Irradiance per vertex of an object; empty if it does not rest here.
  const std::vector<float>& irradiance(int instance) const;

 private:
  struct Resting {
    Se3 T_world_object;
    std::vector<float> irradiance;  // per vertex
    bool is_here = false;
  };
  std::vector<Ball> ChangesSince(const RestingScene& similar) const;
  Ball Around(int instance) const;

  const World& world_;
  std::vector<Resting> resting_;  // by instance
  std::vector<PlacedObject> placed_;
  RayScene rays_;
  LightBaker baker_;
  FacetTable facets_;
};

}  // namespace cslam
