// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/scene.h"

#include "cslam/util/check.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace cslam {

void MeshBuilder::AddRectangle(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge_u,
                               const Eigen::Vector3d& edge_v, int material) {
  CSLAM_CHECK(material >= 0 && material < static_cast<int>(materials_.size()));
  const double length_u = edge_u.norm();
  const double length_v = edge_v.norm();
  const Eigen::Vector2d period_m = materials_[static_cast<std::size_t>(material)].period_m;
  const bool is_metric = period_m.x() > 0.0;
  const Eigen::Vector2d offset =
      is_metric ? Eigen::Vector2d(rng_.Uniform(), rng_.Uniform()) : Eigen::Vector2d(0.0, 0.0);
  const Eigen::Vector2d scale = is_metric
                                    ? Eigen::Vector2d(length_u, length_v).cwiseQuotient(period_m)
                                    : Eigen::Vector2d(1.0, 1.0);
  const Eigen::Vector3f normal = edge_v.cross(edge_u).normalized().cast<float>();
  const auto cells = [&](double length) {
    return static_cast<std::uint32_t>(std::max(1.0, std::ceil(length / cell_m_)));
  };
  const std::uint32_t columns = cells(length_u);
  const std::uint32_t rows = cells(length_v);
  const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
  for (std::uint32_t r = 0; r <= rows; ++r) {
    for (std::uint32_t c = 0; c <= columns; ++c) {
      const Eigen::Vector2d ab(static_cast<double>(c) / columns, static_cast<double>(r) / rows);
      mesh_.positions.push_back((corner + ab.x() * edge_u + ab.y() * edge_v).cast<float>());
      mesh_.normals.push_back(normal);
      mesh_.uvs.push_back((offset + ab.cwiseProduct(scale)).cast<float>());
    }
  }
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t a = first + r * (columns + 1) + c;
      const std::uint32_t b = a + columns + 1;
      mesh_.triangles.push_back({{a, b, a + 1}, material});
      mesh_.triangles.push_back({{a + 1, b, b + 1}, material});
    }
  }
}

void MeshBuilder::AddBox(const Se3& T_object_box, const Eigen::Vector3d& size_m,
                         const BoxLook& look) {
  const Eigen::Matrix3d R = T_object_box.R();
  const double x = 0.5 * size_m.x();
  const double y = 0.5 * size_m.y();
  const double h = size_m.z();
  const Eigen::Vector3d ex(size_m.x(), 0.0, 0.0);
  const Eigen::Vector3d ey(0.0, size_m.y(), 0.0);
  const Eigen::Vector3d down(0.0, 0.0, -h);
  struct Face {
    BoxFace face;
    Eigen::Vector3d corner, edge_u, edge_v;
  };
  // Each face as seen from outside: its top left corner, its direction to the right and down.
  const std::array<Face, 6> faces{{{BoxFace::kFront, {-x, -y, h}, ex, down},
                                   {BoxFace::kBack, {x, y, h}, -ex, down},
                                   {BoxFace::kLeft, {-x, y, h}, -ey, down},
                                   {BoxFace::kRight, {x, -y, h}, ey, down},
                                   {BoxFace::kTop, {-x, y, h}, ex, -ey},
                                   {BoxFace::kBottom, {-x, -y, 0.0}, ex, ey}}};
  for (const Face& f : faces) {
    const int material = look[static_cast<std::size_t>(f.face)];
    if (material < 0) continue;
    AddRectangle(T_object_box * f.corner, R * f.edge_u, R * f.edge_v, material);
  }
}

void MeshBuilder::AddMesh(const Mesh& part) {
  const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(mesh_.positions, part.positions);
  append(mesh_.normals, part.normals);
  append(mesh_.uvs, part.uvs);
  for (Triangle triangle : part.triangles) {
    for (std::uint32_t& v : triangle.vertices)
      v += first;
    mesh_.triangles.push_back(triangle);
  }
}

Se3 Standing(double x, double y, double z, double yaw_rad) {
  return {ExpSo3({0.0, 0.0, yaw_rad}), {x, y, z}};
}

void CheckScene(const Scene& scene) {
  for (const Material& material : scene.materials) {
    CSLAM_CHECK(material.texture >= 0 &&
                material.texture < static_cast<int>(scene.textures.size()));
  }
  for (const SceneObject& object : scene.objects) {
    const Mesh& mesh = object.mesh;
    const std::size_t count = mesh.positions.size();
    CSLAM_CHECK(mesh.normals.size() == count && mesh.uvs.size() == count, "{}", object.name);
    for (const Triangle& triangle : mesh.triangles) {
      CSLAM_CHECK(std::ranges::all_of(triangle.vertices, [&](auto v) { return v < count; }), "{}",
                  object.name);
      CSLAM_CHECK(
          triangle.material >= 0 && triangle.material < static_cast<int>(scene.materials.size()),
          "{}", object.name);
    }
  }
}

}  // namespace cslam
