// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/prop_brush.h"
#include "cslam/assets/prop_library.h"
#include "cslam/sim/paint_tools.h"
#include "cslam/sim/picture_paint.h"
#include "cslam/sim/surface_paint.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace cslam {
namespace {

constexpr double kPi = std::numbers::pi;

Se3 At(double x, double y, double z) {
  return Standing(x, y, z);
}

CurvedLook Metric(int material, double cell_m = 0.03) {
  return {material, PropBrush::kPatchM, cell_m};
}

// A leaf that rises from the stem's point and droops outwards.
Mesh Leaf(const Eigen::Vector3d& from, double yaw_rad, double length_m, double rise_m,
          double width_m, const CurvedLook& look) {
  const Eigen::Vector3d out(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
  const Eigen::Vector3d across(-out.y(), out.x(), 0.0);
  const auto point = [&](double a, double b) -> Eigen::Vector3d {
    const double half_m = 0.5 * width_m * std::sin(kPi * (0.04 + 0.92 * b));
    const double fold_m = 0.3 * half_m * (2.0 * a - 1.0) * (2.0 * a - 1.0);
    const double z = rise_m * (1.6 * b - 1.2 * b * b) - fold_m;
    return from + b * length_m * out - (2.0 * a - 1.0) * half_m * across +
           z * Eigen::Vector3d::UnitZ();
  };
  const Mesh upper = ParametricSurface(point, look);
  return Join(Flipped(upper, 0.002), upper);
}

}  // namespace

PropShape TeddyBearShape(PropBrush& brush) {
  const double tone = brush.rng().Uniform(0.75, 1.15);
  const int fur = brush.Fur({tone * 62.0, tone * 104.0, tone * 158.0});
  const int muzzle = brush.Fur({tone * 120.0, tone * 160.0, tone * 196.0});
  const int dark = brush.Plain({28, 26, 26});
  const int bow = brush.Plain(RandomColor(brush.rng(), 0.8, 0.7));
  return [=](MeshBuilder& mesh) {
    const auto add = [&](int material, const Eigen::Vector3d& at, const Eigen::Vector3d& radii_m) {
      mesh.AddMesh(Ellipsoid(at, radii_m, Metric(material, 0.025)));
    };
    add(fur, {0.0, 0.04, 0.12}, {0.095, 0.085, 0.12});        // trunk
    add(muzzle, {0.0, -0.02, 0.12}, {0.065, 0.04, 0.085});    // belly
    add(fur, {0.0, 0.02, 0.30}, {0.088, 0.08, 0.082});        // head
    add(muzzle, {0.0, -0.05, 0.282}, {0.042, 0.035, 0.034});  // muzzle
    add(dark, {0.0, -0.083, 0.295}, {0.014, 0.01, 0.01});     // nose
    add(bow, {0.0, -0.045, 0.215}, {0.035, 0.018, 0.016});
    for (const double side : {-1.0, 1.0}) {
      add(dark, {side * 0.032, -0.052, 0.322}, {0.01, 0.008, 0.01});  // eyes
      add(fur, {side * 0.068, 0.03, 0.38}, {0.034, 0.02, 0.034});     // ears
      add(muzzle, {side * 0.068, 0.014, 0.38}, {0.022, 0.01, 0.022});
      add(fur, {side * 0.115, -0.01, 0.155}, {0.036, 0.045, 0.085});    // arms
      add(fur, {side * 0.1, -0.06, 0.05}, {0.05, 0.095, 0.05});         // legs
      add(muzzle, {side * 0.1, -0.143, 0.055}, {0.034, 0.014, 0.038});  // soles
    }
  };
}

PropShape UmbrellaShape(PropBrush& brush) {
  const cv::Scalar color = RandomColor(brush.rng(), 0.8, 0.6);
  const int cloth = brush.Plain(color);
  const int other = brush.Plain(Shift(color, 70.0));
  const int dark = brush.Plain({40, 40, 44});
  return [=](MeshBuilder& mesh) {
    constexpr double kRadiusM = 0.5;
    constexpr double kArchM = 0.28;   // from the rim's plane to the top
    constexpr double kShaftM = 0.62;  // below the rim's plane
    constexpr int kPanels = 8;
    // It lies open on the end of its shaft and on the rim, its top towards the front.
    const double tilt_rad = std::atan2(kShaftM, kRadiusM);
    const Se3 T_prop_dome(ExpSo3({tilt_rad, 0.0, 0.0}),
                          {0.0, -0.08, kRadiusM * std::sin(tilt_rad) + 0.01});
    Mesh all;
    for (int i = 0; i < kPanels; ++i) {
      const auto point = [&](double a, double b) -> Eigen::Vector3d {
        const double angle = 2.0 * kPi * (i + a) / kPanels;
        const double sag = 0.04 * b * std::sin(kPi * a);  // cloth hangs in between the ribs
        const double radius = kRadiusM * (1.0 - b);
        const double height = kArchM * (1.0 - (1.0 - b) * (1.0 - b));
        return {(radius - sag * (1.0 - b)) * std::cos(angle),
                (radius - sag * (1.0 - b)) * std::sin(angle), height - sag * (1.0 - b)};
      };
      const Mesh outside = ParametricSurface(point, Metric(i % 2 == 0 ? cloth : other, 0.04));
      all = Join(Join(std::move(all), outside), Flipped(outside, 0.003));
    }
    all = Join(std::move(all),
               Bar({0.0, 0.0, -kShaftM}, {0.0, 0.0, kArchM + 0.03}, 0.008, Metric(dark)));
    mesh.AddMesh(Transformed(std::move(all), T_prop_dome));
  };
}

PropShape MugShape(PropBrush& brush) {
  const Eigen::Vector3d size_m = StandardSizeM(PropKind::kMug);
  const int print = brush.Picture(PaintPackage(brush.Texels(0.25, size_m.z()), brush.NextRng()));
  const int white = brush.Plain({214, 220, 222});
  const int coffee = brush.Plain({28, 40, 62});
  return [=](MeshBuilder& mesh) {
    constexpr double kRadiusM = 0.042;
    constexpr double kWallM = 0.004;
    const Eigen::Vector3d centre(-0.5 * size_m.x() + kRadiusM, 0.0, 0.0);
    const double h = size_m.z();
    mesh.AddMesh(Lathe(centre, {{kRadiusM, 0.0}, {kRadiusM, h}}, {print, 0.0, 0.015}));
    const double inner_m = kRadiusM - kWallM;
    mesh.AddMesh(Lathe(centre, {{0.0, 0.0}, {kRadiusM, 0.0}}, Metric(white, 0.015)));
    mesh.AddMesh(
        Lathe(centre, {{kRadiusM, h}, {inner_m, h}, {inner_m, h - 0.02}}, Metric(white, 0.015)));
    mesh.AddMesh(Lathe(centre, {{inner_m, h - 0.02}, {0.0, h - 0.02}}, Metric(coffee, 0.015)));
    const Eigen::Vector3d handle = centre + Eigen::Vector3d(kRadiusM - 0.004, 0.0, 0.5 * h);
    mesh.AddMesh(ParametricSurface(
        [&](double a, double b) -> Eigen::Vector3d {
          const double round = 2.0 * kPi * a;
          const double along = kPi * (b - 0.5);
          const double reach_m = 0.028 + 0.006 * std::cos(round);
          return handle + Eigen::Vector3d(reach_m * std::cos(along), 0.006 * std::sin(round),
                                          reach_m * std::sin(along));
        },
        Metric(white, 0.01)));
  };
}

PropShape BottleShape(PropBrush& brush) {
  const cv::Scalar glass = RandomColor(brush.rng(), 0.7, 0.35);
  const int body = brush.Plain(glass);
  const int label = brush.Picture(PaintPackage(brush.Texels(0.24, 0.09), brush.NextRng()));
  const int cap = brush.Plain(RandomColor(brush.rng(), 0.8, 0.7));
  return [=](MeshBuilder& mesh) {
    const Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    const CurvedLook look = Metric(body, 0.015);
    mesh.AddMesh(Lathe(centre, {{0.0, 0.0}, {0.036, 0.0}, {0.038, 0.01}, {0.038, 0.06}}, look));
    mesh.AddMesh(Lathe(centre, {{0.039, 0.06}, {0.039, 0.15}}, {label, 0.0, 0.015}));
    mesh.AddMesh(Lathe(
        centre, {{0.038, 0.15}, {0.038, 0.17}, {0.03, 0.2}, {0.016, 0.225}, {0.014, 0.265}}, look));
    mesh.AddMesh(Lathe(centre, {{0.014, 0.265}, {0.016, 0.265}, {0.016, 0.288}, {0.0, 0.288}},
                       Metric(cap, 0.015)));
  };
}

PropShape PottedPlantShape(PropBrush& brush) {
  const int pot = brush.Plain(RandomColor(brush.rng(), 0.5, 0.6));
  const int soil = brush.Fur({32, 44, 58});
  const std::vector<int> greens{brush.Fur({44, 118, 62}), brush.Fur({52, 146, 92}),
                                brush.Fur({36, 92, 48})};
  const Rng seed = brush.NextRng();
  return [=](MeshBuilder& mesh) {
    Rng rng = seed;
    const Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    mesh.AddMesh(Lathe(centre, {{0.0, 0.0}, {0.12, 0.0}, {0.17, 0.32}, {0.15, 0.32}, {0.15, 0.29}},
                       Metric(pot, 0.05)));
    mesh.AddMesh(Lathe(centre, {{0.15, 0.29}, {0.0, 0.29}}, Metric(soil, 0.05)));
    constexpr int kLeaves = 26;
    for (int i = 0; i < kLeaves; ++i) {
      const double yaw_rad = 2.4 * i + rng.Uniform(-0.3, 0.3);
      const double height_m = 0.3 + 0.4 * i / kLeaves;
      mesh.AddMesh(Leaf({0.0, 0.0, height_m}, yaw_rad, rng.Uniform(0.18, 0.28),
                        rng.Uniform(0.1, 0.5), rng.Uniform(0.06, 0.1),
                        Metric(greens[rng.Index(greens.size())], 0.03)));
    }
    mesh.AddMesh(Bar({0.0, 0.0, 0.28}, {0.0, 0.0, 0.72}, 0.012, Metric(soil, 0.05)));
  };
}

PropShape BackpackShape(PropBrush& brush) {
  const cv::Scalar color = RandomColor(brush.rng(), 0.7, 0.45);
  const int cloth = brush.Fur(color);
  const int pocket = brush.Fur(Shift(color, -30.0));
  const int strap = brush.Plain({38, 38, 40});
  return [=](MeshBuilder& mesh) {
    const auto pillow = [&](const Eigen::Vector3d& at, const Eigen::Vector3d& half_m,
                            int material) {
      // A box with very round edges.
      const auto soft = [](double v) { return std::copysign(std::pow(std::abs(v), 0.5), v); };
      mesh.AddMesh(ParametricSurface(
          [&](double a, double b) -> Eigen::Vector3d {
            const double lon = 2.0 * kPi * a;
            const double lat = kPi * (b - 0.5);
            return at + half_m.cwiseProduct(Eigen::Vector3d(
                            soft(std::cos(lat)) * soft(std::cos(lon)),
                            soft(std::cos(lat)) * soft(std::sin(lon)), soft(std::sin(lat))));
          },
          Metric(material, 0.025)));
    };
    pillow({0.0, 0.02, 0.225}, {0.15, 0.08, 0.225}, cloth);
    pillow({0.0, -0.07, 0.14}, {0.12, 0.045, 0.12}, pocket);
    for (const double x : {-0.08, 0.08})
      mesh.AddBox(At(x, 0.107, 0.06), {0.05, 0.012, 0.33}, Uniform(strap));
  };
}

}  // namespace cslam
