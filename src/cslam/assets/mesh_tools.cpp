// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/mesh_tools.h"

#include "cslam/sim/ray_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace cslam {
namespace {

Eigen::Vector3f Cross(const Mesh& mesh, const Triangle& triangle) {
  const Eigen::Vector3f& a = mesh.positions[triangle.vertices[0]];
  return (mesh.positions[triangle.vertices[1]] - a)
      .cross(Eigen::Vector3f(mesh.positions[triangle.vertices[2]] - a));
}

using Key = std::tuple<float, float, float>;
Key KeyOf(const Eigen::Vector3f& p) {
  return {p.x(), p.y(), p.z()};
}

// Directions over the half space around +z, long enough to leave the mesh.
std::vector<Eigen::Vector3f> Fan(const Eigen::Vector3f& axis, float reach_m) {
  constexpr int kSpokes = 5;
  const Eigen::Vector3f x = axis.unitOrthogonal();
  const Eigen::Vector3f y = axis.cross(x);
  std::vector<Eigen::Vector3f> directions{reach_m * axis};
  for (int i = 0; i < kSpokes; ++i) {
    for (const float tilt_rad : {0.55F, 1.1F}) {
      const float turn_rad = 1.2566F * static_cast<float>(i) + tilt_rad;
      directions.emplace_back(
          reach_m * (std::cos(tilt_rad) * axis +
                     std::sin(tilt_rad) * (std::cos(turn_rad) * x + std::sin(turn_rad) * y)));
    }
  }
  return directions;
}

struct Vertex {
  Eigen::Vector3f position, normal;
  Eigen::Vector2f uv;
};

Vertex Middle(const Vertex& a, const Vertex& b) {
  Eigen::Vector3f normal = a.normal + b.normal;
  if (normal.norm() > 1e-6F) normal.normalize();
  return {0.5F * (a.position + b.position), normal, 0.5F * (a.uv + b.uv)};
}

void AddCut(Mesh& mesh, const std::array<Vertex, 3>& corners, int material, float max_side_m) {
  std::size_t longest = 0;
  float length_m = 0.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    const float side_m = (corners[i].position - corners[(i + 1) % 3].position).norm();
    if (side_m > length_m) {
      length_m = side_m;
      longest = i;
    }
  }
  if (length_m <= max_side_m) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vertex& v : corners) {
      mesh.positions.push_back(v.position);
      mesh.normals.push_back(v.normal);
      mesh.uvs.push_back(v.uv);
    }
    mesh.triangles.push_back({{first, first + 1, first + 2}, material});
    return;
  }
  const Vertex& a = corners[longest];
  const Vertex& b = corners[(longest + 1) % 3];
  const Vertex& c = corners[(longest + 2) % 3];
  const Vertex middle = Middle(a, b);
  AddCut(mesh, {a, middle, c}, material, max_side_m);
  AddCut(mesh, {middle, b, c}, material, max_side_m);
}

}  // namespace

Eigen::AlignedBox3d BoundsOf(const Mesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3f& p : mesh.positions)
    bounds.extend(p.cast<double>());
  return bounds;
}

Mesh Mapped(Mesh mesh, const Eigen::Affine3d& T_b_a) {
  const Eigen::Matrix3d normal_map = T_b_a.linear().inverse().transpose();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v] = (T_b_a * mesh.positions[v].cast<double>()).cast<float>();
    const Eigen::Vector3d normal = normal_map * mesh.normals[v].cast<double>();
    mesh.normals[v] = normal.norm() > 0.0 ? normal.normalized().cast<float>().eval()
                                          : Eigen::Vector3f::Zero().eval();
  }
  return mesh;
}

Mesh Filtered(const Mesh& mesh, const std::function<bool(std::size_t)>& keep) {
  Mesh result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!keep(t)) continue;
    Triangle triangle = mesh.triangles[t];
    for (std::uint32_t& v : triangle.vertices) {
      result.positions.push_back(mesh.positions[v]);
      result.normals.push_back(mesh.normals[v]);
      result.uvs.push_back(mesh.uvs[v]);
      v = static_cast<std::uint32_t>(result.positions.size() - 1);
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

Mesh Cleaned(const Mesh& mesh, double min_area_m2) {
  const auto min_cross = static_cast<float>(2.0 * min_area_m2);
  std::set<std::array<Key, 3>> places;
  return Filtered(mesh, [&](std::size_t t) {
    const Triangle& triangle = mesh.triangles[t];
    if (Cross(mesh, triangle).norm() < min_cross) return false;
    std::array<Key, 3> place;
    for (std::size_t i = 0; i < 3; ++i)
      place.at(i) = KeyOf(mesh.positions[triangle.vertices.at(i)]);
    std::ranges::sort(place);
    return places.insert(place).second;
  });
}

Mesh FacingOutwards(Mesh mesh) {
  constexpr float kOffsetShare = 1e-4F;  // of the mesh's size: where rays start off the surface
  const auto size_m = static_cast<float>(BoundsOf(mesh).diagonal().norm());
  Scene scene;
  scene.objects.push_back({"mesh", kNoClass, Se3(), mesh});
  const RayScene rays(scene);
  for (Triangle& triangle : mesh.triangles) {
    const Eigen::Vector3f normal = Cross(mesh, triangle).normalized();
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    for (const std::uint32_t v : triangle.vertices)
      centre += mesh.positions[v] / 3.0F;
    const auto openness = [&](const Eigen::Vector3f& side) {
      const std::vector<Eigen::Vector3f> fan = Fan(side, size_m);
      const std::vector<bool> blocked = rays.AreBlocked(centre + kOffsetShare * size_m * side, fan);
      return std::count(blocked.begin(), blocked.end(), false);
    };
    if (openness(-normal) > openness(normal)) std::swap(triangle.vertices[1], triangle.vertices[2]);
  }
  return mesh;
}

Mesh WithNormals(Mesh mesh, double crease_rad) {
  const auto min_cosine = static_cast<float>(std::cos(crease_rad));
  std::map<Key, std::vector<std::size_t>> around;  // triangles at a position
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t].vertices)
      around[KeyOf(mesh.positions[v])].push_back(t);
  }
  std::vector<Eigen::Vector3f> crosses;
  crosses.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles)
    crosses.push_back(Cross(mesh, triangle));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3f own = crosses[t].normalized();
    for (const std::uint32_t v : mesh.triangles[t].vertices) {
      Eigen::Vector3f& normal = mesh.normals[v];
      if (normal.norm() > 0.5F) {
        normal = normal.dot(own) < 0.0F ? Eigen::Vector3f(-normal.normalized())
                                        : Eigen::Vector3f(normal.normalized());
        continue;
      }
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (const std::size_t other : around[KeyOf(mesh.positions[v])]) {
        if (crosses[other].dot(own) >= min_cosine * crosses[other].norm()) sum += crosses[other];
      }
      normal = sum.norm() > 0.0F ? Eigen::Vector3f(sum.normalized()) : own;
    }
  }
  return mesh;
}

Mesh Subdivided(const Mesh& mesh, double max_side_m) {
  Mesh result;
  for (const Triangle& triangle : mesh.triangles) {
    std::array<Vertex, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = triangle.vertices.at(i);
      corners.at(i) = {mesh.positions[v], mesh.normals[v], mesh.uvs[v]};
    }
    AddCut(result, corners, triangle.material, static_cast<float>(max_side_m));
  }
  return result;
}

Mesh WithBoxUvs(Mesh mesh, int material, double period_m) {
  const auto scale = static_cast<float>(1.0 / period_m);
  for (const Triangle& triangle : mesh.triangles) {
    if (triangle.material != material) continue;
    Eigen::Index axis = 0;
    Cross(mesh, triangle).cwiseAbs().maxCoeff(&axis);
    for (const std::uint32_t v : triangle.vertices) {
      const Eigen::Vector3f p = scale * mesh.positions[v];
      // Each axis shows another part of the texture.
      if (axis == 0) {
        mesh.uvs[v] = {p.y() + 0.37F, -p.z()};
      } else if (axis == 1) {
        mesh.uvs[v] = {p.x(), -p.z()};
      } else {
        mesh.uvs[v] = {p.x() + 0.71F, -p.y() + 0.53F};
      }
    }
  }
  return mesh;
}

Mesh Welded(const Mesh& mesh) {
  using VertexKey = std::array<float, 8>;
  std::map<VertexKey, std::uint32_t> known;
  Mesh result;
  for (Triangle triangle : mesh.triangles) {
    for (std::uint32_t& v : triangle.vertices) {
      const Eigen::Vector3f& p = mesh.positions[v];
      const Eigen::Vector3f& n = mesh.normals[v];
      const Eigen::Vector2f& uv = mesh.uvs[v];
      const auto [entry, is_new] =
          known.try_emplace({p.x(), p.y(), p.z(), n.x(), n.y(), n.z(), uv.x(), uv.y()},
                            static_cast<std::uint32_t>(result.positions.size()));
      if (is_new) {
        result.positions.push_back(p);
        result.normals.push_back(n);
        result.uvs.push_back(uv);
      }
      v = entry->second;
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace cslam
