// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/lighting.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace cslam {
namespace {

constexpr double kGamma = 2.2;
constexpr float kOffsetM = 0.002F;  // rays start this far off the surface
constexpr double kInsetM = 0.01;    // and this far from the face's border, out of the corners
constexpr float kMinGain = 0.12F;

// The i-th of count well-spread points of the unit square (Hammersley).
Eigen::Vector2d Hammersley(int i, int count) {
  double bits = 0.0;
  double unit = 0.5;
  for (int k = i; k > 0; k /= 2, unit *= 0.5)
    bits += unit * (k % 2);
  return {(i + 0.5) / count, bits};
}

// Cosine-weighted directions around +z.
std::vector<Eigen::Vector3f> HemisphereDirections(int count) {
  std::vector<Eigen::Vector3f> directions;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d xi = Hammersley(i, count);
    const double radius = std::sqrt(xi.x());
    const double angle_rad = 2.0 * std::numbers::pi * xi.y();
    directions.emplace_back(static_cast<float>(radius * std::cos(angle_rad)),
                            static_cast<float>(radius * std::sin(angle_rad)),
                            static_cast<float>(std::sqrt(1.0 - xi.x())));
  }
  return directions;
}

class Baker {
 public:
  Baker(const Scene& scene, const RayScene& rays)
      : lighting_(scene.lighting),
        rays_(rays),
        hemisphere_(HemisphereDirections(scene.lighting.samples)) {}

  double Irradiance(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
    double sum = lighting_.ambient * Openness(p, normal);
    for (const AreaLight& light : lighting_.lights)
      sum += FromLight(light, p, normal);
    return lighting_.exposure * sum;
  }

 private:
  // Share of the hemisphere in which nothing is near.
  double Openness(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
    const Eigen::Quaternionf rotation =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal).cast<float>();
    std::vector<Eigen::Vector3f> directions;
    directions.reserve(hemisphere_.size());
    for (const Eigen::Vector3f& d : hemisphere_)
      directions.emplace_back(static_cast<float>(lighting_.ambient_reach_m) * (rotation * d));
    const std::vector<bool> blocked = rays_.AreBlocked(p.cast<float>(), directions);
    const auto open = std::count(blocked.begin(), blocked.end(), false);
    return static_cast<double>(open) / static_cast<double>(blocked.size());
  }

  double FromLight(const AreaLight& light, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d area = light.edge_u.cross(light.edge_v);
    if ((p - light.corner).dot(area) <= 0.0) return 0.0;
    std::vector<Eigen::Vector3f> directions;
    std::vector<double> contributions;
    for (int i = 0; i < lighting_.samples; ++i) {
      const Eigen::Vector2d xi = Hammersley(i, lighting_.samples);
      const Eigen::Vector3d to_light =
          light.corner + xi.x() * light.edge_u + xi.y() * light.edge_v - p;
      const double cos_receiver = normal.dot(to_light);
      const double cos_light = -area.dot(to_light);
      if (cos_receiver <= 0.0 || cos_light <= 0.0) continue;
      const double distance2 = to_light.squaredNorm();
      directions.push_back((0.995 * to_light).cast<float>());
      contributions.push_back(cos_receiver * cos_light /
                              (std::numbers::pi * distance2 * distance2));
    }
    const std::vector<bool> blocked = rays_.AreBlocked(p.cast<float>(), directions);
    double sum = 0.0;
    for (std::size_t i = 0; i < blocked.size(); ++i)
      sum += blocked[i] ? 0.0 : contributions[i];
    return light.radiance * sum / lighting_.samples;
  }

  const Lighting& lighting_;
  const RayScene& rays_;
  std::vector<Eigen::Vector3f> hemisphere_;
};

// The centres of the triangles around each vertex, averaged: where to step away from borders.
std::vector<Eigen::Vector3f> InwardPoints(const Mesh& mesh) {
  std::vector<Eigen::Vector3f> sums(mesh.positions.size(), Eigen::Vector3f::Zero());
  std::vector<float> counts(mesh.positions.size(), 0.0F);
  for (const Triangle& triangle : mesh.triangles) {
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    for (const std::uint32_t v : triangle.vertices)
      centre += mesh.positions[v] / 3.0F;
    for (const std::uint32_t v : triangle.vertices) {
      sums[v] += centre;
      counts[v] += 1.0F;
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v)
    sums[v] = counts[v] > 0.0F ? Eigen::Vector3f(sums[v] / counts[v]) : mesh.positions[v];
  return sums;
}

// A vertex inside another object sees nothing at all; it takes the light of its neighbours, so
// that no black spot leaks out from under things.
std::vector<std::optional<float>> FillBuried(const Mesh& mesh,
                                             std::vector<std::optional<float>> gains) {
  for (int round = 0; round < 8; ++round) {
    std::vector<float> sums(gains.size(), 0.0F);
    std::vector<float> counts(gains.size(), 0.0F);
    for (const Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t from : triangle.vertices) {
        if (!gains[from]) continue;
        for (const std::uint32_t to : triangle.vertices) {
          sums[to] += *gains[from];
          counts[to] += 1.0F;
        }
      }
    }
    for (std::size_t v = 0; v < gains.size(); ++v) {
      if (!gains[v] && counts[v] > 0.0F) gains[v] = sums[v] / counts[v];
    }
  }
  return gains;
}

std::vector<float> BakeObject(const SceneObject& object, const Baker& baker) {
  const Mesh& mesh = object.mesh;
  const std::vector<Eigen::Vector3f> inward = InwardPoints(mesh);
  const Eigen::Matrix3d R = object.T_world_object.R();
  std::vector<std::optional<float>> gains(mesh.positions.size());
  for (std::size_t v = 0; v < gains.size(); ++v) {
    const Eigen::Vector3d normal = R * mesh.normals[v].cast<double>();
    const Eigen::Vector3d p = object.T_world_object * mesh.positions[v].cast<double>();
    const Eigen::Vector3d to_centre = R * (inward[v] - mesh.positions[v]).cast<double>();
    const double length = to_centre.norm();
    const Eigen::Vector3d inset = length > 1e-9
                                      ? Eigen::Vector3d(to_centre * std::min(0.5, kInsetM / length))
                                      : Eigen::Vector3d::Zero();
    const double irradiance =
        baker.Irradiance(p + inset + static_cast<double>(kOffsetM) * normal, normal);
    if (irradiance > 0.0) gains[v] = static_cast<float>(std::pow(irradiance, 1.0 / kGamma));
  }
  std::vector<float> result;
  result.reserve(gains.size());
  for (const std::optional<float>& gain : FillBuried(mesh, std::move(gains)))
    result.push_back(std::max(kMinGain, gain.value_or(kMinGain)));
  return result;
}

}  // namespace

VertexGains BakeLighting(const Scene& scene, const RayScene& rays) {
  const Baker baker(scene, rays);
  VertexGains gains;
  gains.reserve(scene.objects.size());
  for (const SceneObject& object : scene.objects)
    gains.push_back(BakeObject(object, baker));
  return gains;
}

}  // namespace cslam
