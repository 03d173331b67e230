// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/curved_shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cslam {
namespace {

constexpr double kStep = 1e-4;        // of finite differences, in parameters
constexpr int kMinCells = 3;          // per direction, so that round things look round
constexpr int kMaxCells = 48;         // per direction
constexpr double kDegenerate = 1e-9;  // m; shorter derivatives are those of a pole

using PointFunction = std::function<Eigen::Vector3d(double, double)>;

// Length of the longest line of constant a (or b).
double Extent(const PointFunction& point, bool along_a) {
  constexpr int kLines = 5;
  constexpr int kSteps = 16;
  double longest_m = 0.0;
  for (int i = 0; i < kLines; ++i) {
    const double fixed = static_cast<double>(i) / (kLines - 1);
    double length_m = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      const double from = static_cast<double>(k) / kSteps;
      const double to = static_cast<double>(k + 1) / kSteps;
      length_m += along_a ? (point(to, fixed) - point(from, fixed)).norm()
                          : (point(fixed, to) - point(fixed, from)).norm();
    }
    longest_m = std::max(longest_m, length_m);
  }
  return longest_m;
}

Eigen::Vector3d NormalAt(const PointFunction& point, double a, double b) {
  // Where lines run together, a little further in.
  for (const double inset : {0.0, 0.01, 0.05}) {
    const double a_in = std::clamp(a, inset, 1.0 - inset);
    const double b_in = std::clamp(b, inset, 1.0 - inset);
    const Eigen::Vector3d da = point(a_in + kStep, b_in) - point(a_in - kStep, b_in);
    const Eigen::Vector3d db = point(a_in, b_in + kStep) - point(a_in, b_in - kStep);
    const Eigen::Vector3d normal = da.cross(db);
    if (normal.norm() > kDegenerate * kStep) return normal.normalized();
  }
  return Eigen::Vector3d::UnitZ();
}

int Cells(double length_m, double cell_m) {
  return std::clamp(static_cast<int>(std::ceil(length_m / cell_m)), kMinCells, kMaxCells);
}

}  // namespace

Mesh ParametricSurface(const PointFunction& point, const CurvedLook& look) {
  const double length_a_m = Extent(point, true);
  const double length_b_m = Extent(point, false);
  const auto columns = static_cast<std::uint32_t>(Cells(length_a_m, look.cell_m));
  const auto rows = static_cast<std::uint32_t>(Cells(length_b_m, look.cell_m));
  const Eigen::Vector2d periods =
      look.period_m > 0.0 ? Eigen::Vector2d(length_a_m / look.period_m, length_b_m / look.period_m)
                          : Eigen::Vector2d(1.0, 1.0);
  Mesh mesh;
  for (std::uint32_t r = 0; r <= rows; ++r) {
    for (std::uint32_t c = 0; c <= columns; ++c) {
      const double a = static_cast<double>(c) / columns;
      const double b = static_cast<double>(r) / rows;
      mesh.positions.push_back(point(a, b).cast<float>());
      mesh.normals.push_back(NormalAt(point, a, b).cast<float>());
      mesh.uvs.emplace_back(static_cast<float>(a * periods.x()),
                            static_cast<float>((1.0 - b) * periods.y()));
    }
  }
  const auto add = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const Eigen::Vector3f cross =
        (mesh.positions[j] - mesh.positions[i])
            .cross(Eigen::Vector3f(mesh.positions[k] - mesh.positions[i]));
    if (cross.norm() > 1e-9F) mesh.triangles.push_back({{i, j, k}, look.material});
  };
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t low = r * (columns + 1) + c;
      const std::uint32_t high = low + columns + 1;
      add(low, low + 1, high);
      add(low + 1, high + 1, high);
    }
  }
  return mesh;
}

Mesh Ellipsoid(const Eigen::Vector3d& centre, const Eigen::Matrix3d& axes, const CurvedLook& look) {
  return ParametricSurface(
      [&](double a, double b) -> Eigen::Vector3d {
        const double longitude = 2.0 * std::numbers::pi * a;
        const double latitude = std::numbers::pi * (b - 0.5);
        return centre + axes * Eigen::Vector3d(std::cos(latitude) * std::cos(longitude),
                                               std::cos(latitude) * std::sin(longitude),
                                               std::sin(latitude));
      },
      look);
}

Mesh Ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii_m,
               const CurvedLook& look) {
  return Ellipsoid(centre, Eigen::Matrix3d(radii_m.asDiagonal()), look);
}

Mesh Lathe(const Eigen::Vector3d& centre, const std::vector<Eigen::Vector2d>& profile_m,
           const CurvedLook& look) {
  Mesh mesh;
  for (std::size_t i = 0; i + 1 < profile_m.size(); ++i) {
    const Eigen::Vector2d low = profile_m[i];
    const Eigen::Vector2d high = profile_m[i + 1];
    const Mesh ring = ParametricSurface(
        [&](double a, double b) -> Eigen::Vector3d {
          const double angle = 2.0 * std::numbers::pi * a;
          const Eigen::Vector2d p = low + b * (high - low);
          return centre + Eigen::Vector3d(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y());
        },
        look);
    mesh = Join(std::move(mesh), ring);
  }
  return mesh;
}

Mesh Bar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_m,
         const CurvedLook& look) {
  const Eigen::Vector3d along = to - from;
  const double length_m = along.norm();
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), along / length_m);
  const Mesh upright =
      Lathe(Eigen::Vector3d::Zero(),
            {{0.0, 0.0}, {radius_m, 0.0}, {radius_m, length_m}, {0.0, length_m}}, look);
  return Transformed(upright, Se3(turn, from));
}

Mesh Join(Mesh first, const Mesh& second) {
  const auto offset = static_cast<std::uint32_t>(first.positions.size());
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(first.positions, second.positions);
  append(first.normals, second.normals);
  append(first.uvs, second.uvs);
  for (Triangle triangle : second.triangles) {
    for (std::uint32_t& v : triangle.vertices)
      v += offset;
    first.triangles.push_back(triangle);
  }
  return first;
}

Mesh Flipped(Mesh mesh, double shift_inwards_m) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v] -= static_cast<float>(shift_inwards_m) * mesh.normals[v];
    mesh.normals[v] = -mesh.normals[v];
  }
  for (Triangle& triangle : mesh.triangles)
    std::swap(triangle.vertices[1], triangle.vertices[2]);
  return mesh;
}

Mesh Transformed(Mesh mesh, const Se3& T_b_a) {
  const Eigen::Matrix3f R = T_b_a.R().cast<float>();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v] = (T_b_a * mesh.positions[v].cast<double>()).cast<float>();
    mesh.normals[v] = (R * mesh.normals[v]).normalized();
  }
  return mesh;
}

}  // namespace cslam
