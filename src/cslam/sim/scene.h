// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/sim/texture.h"
#include "cslam/util/random.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cslam {

// How a surface looks. Light multiplies the texture unless the surface shines by itself.
struct Material {
  int texture = 0;                                     // index into Scene::textures
  Eigen::Vector2d period_m = Eigen::Vector2d::Zero();  // size of one period; zero: fit the face
  float emission = 0.0F;  // 0: lit by the scene; otherwise a constant factor on the texture
};

struct Triangle {
  std::array<std::uint32_t, 3> vertices{};
  int material = 0;  // index into Scene::materials
};

// Parallel arrays, one entry per vertex; flat faces do not share vertices.
struct Mesh {
  std::vector<Eigen::Vector3f> positions;  // m, object frame
  std::vector<Eigen::Vector3f> normals;    // unit, pointing out of the object
  std::vector<Eigen::Vector2f> uvs;        // texture periods
  std::vector<Triangle> triangles;
};

constexpr int kNoClass = -1;

// A thing with an identity. Its index in Scene::objects is its instance id in rendered images.
struct SceneObject {
  std::string name;
  int class_id = kNoClass;  // COCO class index (0 person, 56 chair, ...), kNoClass for background
  Se3 T_world_object;
  Mesh mesh;
};

// A rectangle that emits evenly to the side its normal (edge_u x edge_v) points to.
struct AreaLight {
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();  // m, world
  Eigen::Vector3d edge_u = Eigen::Vector3d::Zero();  // m
  Eigen::Vector3d edge_v = Eigen::Vector3d::Zero();  // m
  double radiance = 1.0;  // 1: a surface right before it shows its texture's own colours
};

struct Lighting {
  std::vector<AreaLight> lights;
  double ambient = 0.5;          // irradiance where nothing is near
  double ambient_reach_m = 1.5;  // things nearer than this take ambient light away
  double exposure = 1.0;         // factor on all light
  int samples = 32;              // rays per vertex for lights and for ambient, each
};

// The world: z up, metres. A plain value; object 0 is the room itself.
struct Scene {
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<SceneObject> objects;
  Lighting lighting;
};

// Order of a box's faces.
enum class BoxFace { kFront, kBack, kLeft, kRight, kTop, kBottom };  // -y, +y, -x, +x, +z, -z

// A material per BoxFace; a negative one leaves the face out.
using BoxLook = std::array<int, 6>;
constexpr BoxLook Uniform(int material) {
  return {material, material, material, material, material, material};
}

// Collects textured rectangles and boxes into a mesh. Faces are cut into a grid no coarser than
// cell_m so that light can be stored per vertex. The generator places metric textures at random
// offsets, so that no two faces look the same.
class MeshBuilder {
 public:
  MeshBuilder(const std::vector<Material>& materials, double cell_m, Rng rng)
      : materials_(materials), cell_m_(cell_m), rng_(rng) {}

  // The rectangle corner + a edge_u + b edge_v, 0 <= a, b <= 1: the texture's u runs along edge_u,
  // its v (down) along edge_v; visible from the side edge_v x edge_u.
  void AddRectangle(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge_u,
                    const Eigen::Vector3d& edge_v, int material);

  // A box of the given size (m) whose bottom centre is at the origin of T_object_box.
  void AddBox(const Se3& T_object_box, const Eigen::Vector3d& size_m, const BoxLook& look);

  // A ready mesh, kept as it is: its materials are indices into the scene's.
  void AddMesh(const Mesh& part);

  Mesh Take() { return std::move(mesh_); }

 private:
  const std::vector<Material>& materials_;
  double cell_m_;
  Rng rng_;
  Mesh mesh_;
};

// T_world_object of something that stands at (x, y, z) (m), turned by yaw_rad about the vertical.
Se3 Standing(double x, double y, double z, double yaw_rad = 0.0);

// Sanity of indices and array lengths; throws InternalError that names the object.
void CheckScene(const Scene& scene);

}  // namespace cslam
