// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/placed_object.h"

#include "cslam/util/check.h"

namespace cslam {

PlacedObject Place(const Scene& scene, int instance, const Se3& T_world_object) {
  const Mesh& mesh = scene.objects[static_cast<std::size_t>(instance)].mesh;
  PlacedObject placed{instance, &mesh, {}, {}};
  placed.positions_m.reserve(mesh.positions.size());
  placed.normals.reserve(mesh.normals.size());
  const Eigen::Matrix3d R = T_world_object.R();
  for (const Eigen::Vector3f& p : mesh.positions)
    placed.positions_m.emplace_back(T_world_object * p.cast<double>());
  for (const Eigen::Vector3f& n : mesh.normals)
    placed.normals.emplace_back((R * n.cast<double>()).cast<float>());
  return placed;
}

PlacedObject Place(const Scene& scene, int instance, const BodyShape& shape) {
  const SceneObject& object = scene.objects[static_cast<std::size_t>(instance)];
  const Mesh& mesh = object.mesh;
  CSLAM_CHECK(shape.positions.size() == mesh.positions.size() &&
                  shape.normals.size() == mesh.positions.size(),
              "'{}' has {} vertices, its shape {}", object.name, mesh.positions.size(),
              shape.positions.size());
  PlacedObject placed{instance, &mesh, {}, shape.normals};
  placed.positions_m.reserve(shape.positions.size());
  for (const Eigen::Vector3f& p : shape.positions)
    placed.positions_m.emplace_back(p.cast<double>());
  return placed;
}

std::vector<PlacedObject> PlaceAll(const Scene& scene) {
  std::vector<PlacedObject> placed;
  placed.reserve(scene.objects.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    placed.push_back(Place(scene, static_cast<int>(i), scene.objects[i].T_world_object));
  return placed;
}

Eigen::AlignedBox3d BoundsOf(const PlacedObject& object) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& p : object.positions_m)
    bounds.extend(p);
  return bounds;
}

}  // namespace cslam
