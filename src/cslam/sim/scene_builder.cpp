// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/scene_builder.h"

#include <utility>

namespace cslam {

int SceneBuilder::AddPicture(const cv::Mat& image, float emission) {
  Material material;
  material.texture = static_cast<int>(scene_.textures.size());
  material.emission = emission;
  scene_.textures.emplace_back(image);
  scene_.materials.push_back(material);
  return static_cast<int>(scene_.materials.size()) - 1;
}

int SceneBuilder::AddSurface(const cv::Mat& image, double width_m, double height_m) {
  const int material = AddPicture(image);
  scene_.materials.back().period_m = {width_m, height_m};
  return material;
}

int SceneBuilder::AddObject(const std::string& name, int class_id, const Se3& T_world_object,
                            const std::function<void(MeshBuilder&)>& shape) {
  MeshBuilder mesh(scene_.materials, light_cell_m_, NextRng());
  shape(mesh);
  scene_.objects.push_back({name, class_id, T_world_object, mesh.Take()});
  return static_cast<int>(scene_.objects.size()) - 1;
}

int SceneBuilder::AddBox(const std::string& name, int class_id, const Se3& T_world_object,
                         const Eigen::Vector3d& size_m, const BoxLook& look) {
  return AddObject(name, class_id, T_world_object,
                   [&](MeshBuilder& mesh) { mesh.AddBox(Se3(), size_m, look); });
}

Scene SceneBuilder::Take(const Lighting& lighting) {
  scene_.lighting = lighting;
  return std::move(scene_);
}

}  // namespace cslam
