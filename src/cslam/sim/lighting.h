// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/placed_object.h"
#include "cslam/sim/ray_scene.h"
#include "cslam/sim/scene.h"

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace cslam {

// Holds something that came, went or moved.
struct Ball {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // m, world
  double radius_m = 0.0;
};

// Light that falls on a small thing at a place: irradiance towards +x, -x, +y, -y, +z, -z.
using LightCube = std::array<float, 6>;

// Casts shadow rays to the lights and rays into the surroundings. The same scene gives the same
// light, whatever the number of threads around. Keeps references: rays must outlive it.
class LightBaker {
 public:
  LightBaker(const Lighting& lighting, const RayScene& rays);

  // Irradiance at a place of a surface with this normal; 0 inside of things.
  float Irradiance(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const;
  LightCube CubeAt(const Eigen::Vector3d& p) const;

  // Irradiance per vertex.
  std::vector<float> Bake(const PlacedObject& object) const;

  // The same for an object that has stayed as it was while things changed within the balls: only
  // vertices whose rays can meet one are computed anew, and the result equals Bake()'s.
  std::vector<float> BakeAgain(const PlacedObject& object, const std::vector<float>& before,
                               std::span<const Ball> changed) const;

 private:
  double Openness(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const;
  double FromLight(const AreaLight& light, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& normal) const;
  bool CanMeet(const Ball& ball, const Eigen::Vector3d& p) const;

  Lighting lighting_;
  const RayScene& rays_;
  std::vector<Eigen::Vector3f> hemisphere_;  // unit directions around +z
};

constexpr float kMinGain = 0.12F;  // no place of a room is quite dark

// The factor on a texture's display values that irradiance gives.
float GainOf(float irradiance);

// GainOf() per vertex of a mesh; vertices without any light (buried in other things) take that of
// their neighbours, so that no black spot leaks out from under things.
std::vector<float> GainsOf(const Mesh& mesh, const std::vector<float>& irradiance);

// gains[object][vertex] of a scene at rest.
using VertexGains = std::vector<std::vector<float>>;
VertexGains BakeLighting(const Scene& scene, const RayScene& rays);

}  // namespace cslam
