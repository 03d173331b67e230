// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/lighting.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cslam {
namespace {

constexpr double kGamma = 2.2;
constexpr double kOffsetM = 0.002;  // rays start this far off the surface
constexpr double kInsetM = 0.01;    // and this far from the face's border, out of the corners

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

// The centres of the triangles around each vertex, averaged: where to step away from borders.
std::vector<Eigen::Vector3d> InwardPoints(const PlacedObject& object) {
  const std::vector<Eigen::Vector3d>& positions = object.positions_m;
  std::vector<Eigen::Vector3d> sums(positions.size(), Eigen::Vector3d::Zero());
  std::vector<double> counts(positions.size(), 0.0);
  for (const Triangle& triangle : object.mesh->triangles) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const std::uint32_t v : triangle.vertices)
      centre += positions[v] / 3.0;
    for (const std::uint32_t v : triangle.vertices) {
      sums[v] += centre;
      counts[v] += 1.0;
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v)
    sums[v] = counts[v] > 0.0 ? Eigen::Vector3d(sums[v] / counts[v]) : positions[v];
  return sums;
}

// A vertex without light takes the mean of its neighbours', round by round.
std::vector<float> FillBuried(const Mesh& mesh, std::vector<float> gains) {
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds && std::ranges::count(gains, 0.0F) > 0; ++round) {
    std::vector<float> sums(gains.size(), 0.0F);
    std::vector<float> counts(gains.size(), 0.0F);
    for (const Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t from : triangle.vertices) {
        if (gains[from] == 0.0F) continue;
        for (const std::uint32_t to : triangle.vertices) {
          sums[to] += gains[from];
          counts[to] += 1.0F;
        }
      }
    }
    for (std::size_t v = 0; v < gains.size(); ++v) {
      if (gains[v] == 0.0F && counts[v] > 0.0F) gains[v] = sums[v] / counts[v];
    }
  }
  return gains;
}

// Where the rays of each vertex start: a little off the surface and out of corners.
std::vector<Eigen::Vector3d> RayOrigins(const PlacedObject& object) {
  std::vector<Eigen::Vector3d> origins = InwardPoints(object);
  for (std::size_t v = 0; v < origins.size(); ++v) {
    const Eigen::Vector3d& p = object.positions_m[v];
    const Eigen::Vector3d to_centre = origins[v] - p;
    const double length_m = to_centre.norm();
    const double share = length_m > 1e-9 ? std::min(0.5, kInsetM / length_m) : 0.0;
    origins[v] = p + share * to_centre + kOffsetM * object.normals[v].cast<double>();
  }
  return origins;
}

double DistanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double squared = along.squaredNorm();
  const double share = squared > 0.0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (a + share * along - p).norm();
}

}  // namespace

LightBaker::LightBaker(const Lighting& lighting, const RayScene& rays)
    : lighting_(lighting), rays_(rays), hemisphere_(HemisphereDirections(lighting.samples)) {}

float LightBaker::Irradiance(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
  double sum = lighting_.ambient * Openness(p, normal);
  for (const AreaLight& light : lighting_.lights)
    sum += FromLight(light, p, normal);
  return static_cast<float>(lighting_.exposure * sum);
}

LightCube LightBaker::CubeAt(const Eigen::Vector3d& p) const {
  LightCube cube{};
  for (std::size_t side = 0; side < cube.size(); ++side) {
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    cube[side] = Irradiance(p, sign * Eigen::Vector3d::Unit(static_cast<Eigen::Index>(side / 2)));
  }
  return cube;
}

// Share of the hemisphere in which nothing is near.
double LightBaker::Openness(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
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

double LightBaker::FromLight(const AreaLight& light, const Eigen::Vector3d& p,
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
    contributions.push_back(cos_receiver * cos_light / (std::numbers::pi * distance2 * distance2));
  }
  const std::vector<bool> blocked = rays_.AreBlocked(p.cast<float>(), directions);
  double sum = 0.0;
  for (std::size_t i = 0; i < blocked.size(); ++i)
    sum += blocked[i] ? 0.0 : contributions[i];
  return light.radiance * sum / lighting_.samples;
}

bool LightBaker::CanMeet(const Ball& ball, const Eigen::Vector3d& p) const {
  const double reach_m = ball.radius_m + kOffsetM + kInsetM + kInsetM;
  if ((p - ball.center).norm() <= reach_m + lighting_.ambient_reach_m) return true;
  return std::ranges::any_of(lighting_.lights, [&](const AreaLight& light) {
    const Eigen::Vector3d half = 0.5 * (light.edge_u + light.edge_v);
    const double light_radius_m = std::max(half.norm(), (half - light.edge_u).norm());
    return DistanceToSegment(ball.center, p, light.corner + half) <= reach_m + light_radius_m;
  });
}

std::vector<float> LightBaker::Bake(const PlacedObject& object) const {
  const std::vector<Eigen::Vector3d> origins = RayOrigins(object);
  std::vector<float> irradiance(origins.size());
  for (std::size_t v = 0; v < origins.size(); ++v)
    irradiance[v] = Irradiance(origins[v], object.normals[v].cast<double>());
  return irradiance;
}

std::vector<float> LightBaker::BakeAgain(const PlacedObject& object,
                                         const std::vector<float>& before,
                                         std::span<const Ball> changed) const {
  std::vector<float> irradiance = before;
  const std::vector<Eigen::Vector3d> origins = RayOrigins(object);
  for (std::size_t v = 0; v < origins.size(); ++v) {
    const auto can_meet = [&](const Ball& ball) { return CanMeet(ball, origins[v]); };
    if (std::ranges::any_of(changed, can_meet))
      irradiance[v] = Irradiance(origins[v], object.normals[v].cast<double>());
  }
  return irradiance;
}

float GainOf(float irradiance) {
  return static_cast<float>(std::pow(static_cast<double>(irradiance), 1.0 / kGamma));
}

std::vector<float> GainsOf(const Mesh& mesh, const std::vector<float>& irradiance) {
  std::vector<float> gains(irradiance.size());
  std::ranges::transform(irradiance, gains.begin(), [](float e) { return GainOf(e); });
  gains = FillBuried(mesh, std::move(gains));
  for (float& gain : gains)
    gain = std::max(kMinGain, gain);
  return gains;
}

VertexGains BakeLighting(const Scene& scene, const RayScene& rays) {
  const LightBaker baker(scene.lighting, rays);
  VertexGains gains;
  gains.reserve(scene.objects.size());
  for (const PlacedObject& object : PlaceAll(scene))
    gains.push_back(GainsOf(*object.mesh, baker.Bake(object)));
  return gains;
}

}  // namespace cslam
