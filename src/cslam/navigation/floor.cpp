// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/navigation/floor.h"

#include "cslam/util/options.h"
#include "cslam/util/random.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace cslam {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr std::uint64_t kSeed = 6;
constexpr double kBinM = 0.05;            // of heights
constexpr std::size_t kMinElements = 50;  // fewer are no floor
constexpr std::size_t kMaxKeyframes = 80;
constexpr int kStepPx = 4;

using Elements = std::vector<const SurfaceElement*>;

Elements WithNormal(std::span<const SurfaceElement> elements, const Eigen::Vector3d& normal,
                    double tolerance_deg) {
  const double min_cosine = std::cos(tolerance_deg * kRadPerDeg);
  Elements found;
  for (const SurfaceElement& element : elements) {
    if (element.normal_world.dot(normal) > min_cosine) found.push_back(&element);
  }
  return found;
}

double AreaM2(const Elements& elements) {
  double sum = 0.0;
  for (const SurfaceElement* element : elements)
    sum += element->area_m2;
  return sum;
}

Eigen::Vector3d MeanNormal(const Elements& elements) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const SurfaceElement* element : elements)
    sum += element->area_m2 * element->normal_world;
  return sum.normalized();
}

// The direction near the prior in which most surface looks; empty elements if none does.
struct Vertical {
  Eigen::Vector3d up_world;
  Elements horizontal;
};

Vertical FindVertical(std::span<const SurfaceElement> elements, const Eigen::Vector3d& up_prior,
                      const FloorOptions& options) {
  Vertical best{up_prior, {}};
  const Elements candidates = WithNormal(elements, up_prior, options.max_tilt_deg);
  if (candidates.empty()) return best;
  Rng rng(kSeed);
  double best_area_m2 = 0.0;
  for (int i = 0; i < options.num_hypotheses; ++i) {
    const Eigen::Vector3d normal = candidates[rng.Index(candidates.size())]->normal_world;
    Elements inliers = WithNormal(elements, normal, options.normal_tol_deg);
    const double area_m2 = AreaM2(inliers);
    if (area_m2 <= best_area_m2) continue;
    best_area_m2 = area_m2;
    best = {normal, std::move(inliers)};
  }
  for (int i = 0; i < 3; ++i) {
    best.up_world = MeanNormal(best.horizontal);
    best.horizontal = WithNormal(elements, best.up_world, options.normal_tol_deg);
  }
  return best;
}

// The lowest height at which much horizontal surface lies.
double FloorHeight(const Vertical& vertical, double min_share) {
  const auto height = [&](const SurfaceElement* e) { return vertical.up_world.dot(e->p_world); };
  const auto [low, high] = std::minmax_element(
      vertical.horizontal.begin(), vertical.horizontal.end(),
      [&](const SurfaceElement* a, const SurfaceElement* b) { return height(a) < height(b); });
  const double lowest_m = height(*low);
  const auto bin_of = [&](double height_m) {
    return static_cast<std::size_t>((height_m - lowest_m) / kBinM) + 1;
  };
  std::vector<double> areas(bin_of(height(*high)) + 2, 0.0);
  for (const SurfaceElement* element : vertical.horizontal)
    areas[bin_of(height(element))] += element->area_m2;
  std::vector<double> smooth(areas.size(), 0.0);
  for (std::size_t i = 1; i + 1 < areas.size(); ++i)
    smooth[i] = areas[i - 1] + areas[i] + areas[i + 1];
  const double enough_m2 = min_share * *std::max_element(smooth.begin(), smooth.end());
  std::size_t bin = 0;
  while (smooth[bin] < enough_m2)
    ++bin;
  while (bin + 1 < smooth.size() && smooth[bin + 1] > smooth[bin])
    ++bin;
  return lowest_m + (static_cast<double>(bin) - 0.5) * kBinM;
}

// The plane through the surface near a first guess, least squares.
Floor Refine(const Vertical& vertical, double height_m, const FloorOptions& options) {
  Floor floor{.up_world = vertical.up_world, .offset_m = height_m, .is_seen = true};
  for (int iteration = 0; iteration < 3; ++iteration) {
    Elements near;
    for (const SurfaceElement* element : vertical.horizontal) {
      if (std::abs(floor.HeightM(element->p_world)) < options.plane_tol_m) near.push_back(element);
    }
    if (near.size() < kMinElements) return floor;
    const double area_m2 = AreaM2(near);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const SurfaceElement* element : near)
      mean += element->area_m2 / area_m2 * element->p_world;
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const SurfaceElement* element : near) {
      const Eigen::Vector3d d = element->p_world - mean;
      scatter += element->area_m2 / area_m2 * d * d.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
    Eigen::Vector3d normal = solver.eigenvectors().col(0);
    if (normal.dot(vertical.up_world) < 0.0) normal = -normal;
    // A narrow strip of floor leaves the tilt across it open.
    const double cosine = normal.dot(vertical.up_world);
    if (cosine > std::cos(0.5 * options.normal_tol_deg * kRadPerDeg)) floor.up_world = normal;
    floor.offset_m = floor.up_world.dot(mean);
  }
  return floor;
}

// What is certain without any horizontal surface: nothing lies far below the lowest reading.
Floor AssumeFloor(std::span<const SurfaceElement> elements, const Eigen::Vector3d& up_prior) {
  constexpr double kStrayShare = 0.01;
  std::vector<double> heights_m;
  for (const SurfaceElement& element : elements)
    heights_m.push_back(up_prior.dot(element.p_world));
  Floor floor{.up_world = up_prior};
  if (heights_m.empty()) return floor;
  const auto low = heights_m.begin() +
                   static_cast<std::ptrdiff_t>(kStrayShare * static_cast<double>(heights_m.size()));
  std::nth_element(heights_m.begin(), low, heights_m.end());
  floor.offset_m = *low;
  return floor;
}

}  // namespace

void Describe(OptionList& list, FloorOptions& o) {
  list.Add("max_tilt", o.max_tilt_deg, {0.0, 80.0}, "deg",
           "How far true up may be from the mean upright of the cameras.");
  list.Add("normal_tolerance", o.normal_tol_deg, {1.0, 45.0}, "deg",
           "A surface within this of horizontal is; the normals of far readings are noisy.");
  list.Add("plane_tolerance", o.plane_tol_m, {0.005, 0.5}, "m",
           "Readings within this of the floor belong to it; noise and drift.");
  list.Add("min_share", o.min_share, {0.001, 1.0}, "",
           "A surface with this share of the largest horizontal one is floor if none is lower.");
  list.Add("num_hypotheses", o.num_hypotheses, {1, 10'000}, "",
           "Directions tried for the vertical (RANSAC).");
}

Floor EstimateFloor(std::span<const SurfaceElement> elements, const Eigen::Vector3d& up_prior,
                    const FloorOptions& options) {
  const Vertical vertical = FindVertical(elements, up_prior, options);
  if (vertical.horizontal.size() < kMinElements) return AssumeFloor(elements, up_prior);
  return Refine(vertical, FloorHeight(vertical, options.min_share), options);
}

Floor EstimateFloor(const std::vector<const Keyframe*>& keyframes, const PixelRays& rays,
                    double max_depth_m, const FloorOptions& options) {
  const std::size_t step = (keyframes.size() + kMaxKeyframes - 1) / kMaxKeyframes;
  std::vector<SurfaceElement> elements;
  Eigen::Vector3d up_sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < keyframes.size(); i += step) {
    const std::vector<SurfaceElement> more =
        SurfaceElements(*keyframes[i], rays, kStepPx, max_depth_m);
    elements.insert(elements.end(), more.begin(), more.end());
    up_sum -= keyframes[i]->T_world_camera.rotation * Eigen::Vector3d::UnitY();
  }
  const bool has_upright = up_sum.norm() > 1e-6;
  return EstimateFloor(elements, has_upright ? up_sum.normalized() : -Eigen::Vector3d::UnitY(),
                       options);
}

}  // namespace cslam
