// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/scene.h"
#include "cslam/sim/world.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

namespace cslam {

// An object of a scene where (and, for bodies, in the shape in which) it is at some moment. Points
// into the scene, which must outlive it.
struct PlacedObject {
  int instance = 0;
  const Mesh* mesh = nullptr;                // for triangles and uvs
  std::vector<Eigen::Vector3d> positions_m;  // per vertex, world
  std::vector<Eigen::Vector3f> normals;      // per vertex, unit, world
};

PlacedObject Place(const Scene& scene, int instance, const Se3& T_world_object);
// The shape must have as many vertices as the object's mesh.
PlacedObject Place(const Scene& scene, int instance, const BodyShape& shape);

// All objects at their poses in the scene.
std::vector<PlacedObject> PlaceAll(const Scene& scene);

Eigen::AlignedBox3d BoundsOf(const PlacedObject& object);

}  // namespace cslam
