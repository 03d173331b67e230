// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/person.h"

#include "cslam/actors/person_model.h"
#include "cslam/actors/plain_body.h"
#include "cslam/actors/pose_solver.h"
#include "cslam/actors/rigged_body.h"
#include "cslam/assets/asset_folder.h"
#include "cslam/assets/asset_sources.h"
#include "cslam/assets/blend_file_contents.h"
#include "cslam/util/check.h"

#include <utility>

namespace cslam {
namespace {

constexpr int kCocoPerson = 0;

}  // namespace

std::shared_ptr<const PersonModel> MakePersonModel(const AssetFolder* assets, int variant) {
  const PersonLook look = LookOf(variant);
  if (assets == nullptr)
    return std::make_shared<const PersonModel>(PersonModel{MakePlainBody(look)});
  const std::filesystem::path file = assets->File(kHumanRigFile);
  return std::make_shared<const PersonModel>(
      PersonModel{MakeRiggedBody(ReadBlendContents(file), look, file)});
}

BodyShape ShapeOf(const PersonModel& model, const PersonPose& pose) {
  BodyShape shape = Deform(model.body, SolvePose(model.body.skeleton, pose));
  shape.T_world_body = pose.T_world_body;
  return shape;
}

int AddPerson(SceneBuilder& scene, const PersonModel& model, const std::string& name) {
  std::vector<int> materials;
  for (const cv::Mat& picture : model.body.pictures)
    materials.push_back(scene.AddPicture(picture));
  BodyShape standing = ShapeOf(model, StandingPose());
  Mesh mesh = model.body.mesh;
  mesh.positions = std::move(standing.positions);
  mesh.normals = std::move(standing.normals);
  for (Triangle& triangle : mesh.triangles)
    triangle.material = materials[static_cast<std::size_t>(triangle.material)];
  return scene.AddObject(name, kCocoPerson, Se3(),
                         [&](MeshBuilder& object) { object.AddMesh(mesh); });
}

Animation Animate(std::shared_ptr<const PersonModel> model,
                  std::shared_ptr<const PersonMotion> motion) {
  CSLAM_CHECK(model != nullptr && motion != nullptr);
  return [model = std::move(model),
          motion = std::move(motion)](double time_s) -> std::optional<BodyShape> {
    const std::shared_ptr<const PersonPose> pose = motion->At(time_s);
    if (!pose) return std::nullopt;
    return ShapeOf(*model, *pose);
  };
}

}  // namespace cslam
