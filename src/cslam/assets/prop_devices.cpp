// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/prop_brush.h"
#include "cslam/assets/prop_library.h"
#include "cslam/sim/paint_tools.h"
#include "cslam/sim/picture_paint.h"
#include "cslam/sim/surface_paint.h"

#include <vector>

namespace cslam {
namespace {

constexpr float kScreenEmission = 0.85F;  // of the texture: a lit screen in a lit room

Se3 At(double x, double y, double z, double yaw_rad = 0.0) {
  return Standing(x, y, z, yaw_rad);
}

// A flat panel on a foot that fills the kind's box.
PropShape ScreenOnFootShape(PropKind kind, double foot_height_m, int screen, int dark) {
  const Eigen::Vector3d size_m = StandardSizeM(kind);
  return [=](MeshBuilder& mesh) {
    constexpr double kPanelM = 0.04;
    constexpr double kFrameM = 0.015;
    constexpr double kProudM = 0.001;  // the picture lies this far before the frame
    const double panel_height_m = size_m.z() - foot_height_m;
    mesh.AddBox(Se3(), {0.45 * size_m.x(), size_m.y(), 0.015}, Uniform(dark));
    mesh.AddBox(At(0.0, 0.04, 0.015), {0.12 * size_m.x(), 0.03, foot_height_m}, Uniform(dark));
    mesh.AddBox(At(0.0, 0.0, foot_height_m), {size_m.x(), kPanelM, panel_height_m}, Uniform(dark));
    mesh.AddRectangle({-0.5 * size_m.x() + kFrameM, -0.5 * kPanelM - kProudM, size_m.z() - kFrameM},
                      {size_m.x() - 2.0 * kFrameM, 0.0, 0.0},
                      {0.0, 0.0, -panel_height_m + 2.0 * kFrameM}, screen);
  };
}

}  // namespace

PropShape MonitorShape(PropBrush& brush) {
  const int dark = brush.Plain({44, 42, 42});
  const int screen =
      brush.Picture(PaintLitScreen(brush.Texels(0.5, 0.3), brush.NextRng()), kScreenEmission);
  return ScreenOnFootShape(PropKind::kMonitor, 0.14, screen, dark);
}

PropShape TelevisionShape(PropBrush& brush) {
  const int dark = brush.Plain({36, 34, 34});
  const int screen =
      brush.Picture(PaintLitScreen(brush.Texels(1.0, 0.6), brush.NextRng()), kScreenEmission);
  return ScreenOnFootShape(PropKind::kTelevision, 0.09, screen, dark);
}

PropShape LaptopShape(PropBrush& brush) {
  const Eigen::Vector3d size_m = StandardSizeM(PropKind::kLaptop);
  const int shell = brush.Plain({130, 128, 124});
  const int keys =
      brush.Picture(PaintKeyboard(brush.Texels(size_m.x() - 0.04, 0.13), brush.NextRng()));
  const int screen = brush.Picture(
      PaintLitScreen(brush.Texels(size_m.x() - 0.02, 0.2), brush.NextRng()), kScreenEmission);
  return [=](MeshBuilder& mesh) {
    constexpr double kBaseM = 0.018;
    constexpr double kBaseDepthM = 0.24;
    constexpr double kLidM = 0.235;
    constexpr double kLidThicknessM = 0.008;
    constexpr double kLeanRad = 0.35;  // the lid leans back from the vertical
    constexpr double kProudM = 0.001;
    const double front_y = -0.5 * size_m.y();
    mesh.AddBox(At(0.0, front_y + 0.5 * kBaseDepthM, 0.0), {size_m.x(), kBaseDepthM, kBaseM},
                Uniform(shell));
    mesh.AddRectangle({-0.5 * size_m.x() + 0.02, front_y + kBaseDepthM - 0.02, kBaseM + kProudM},
                      {size_m.x() - 0.04, 0.0, 0.0}, {0.0, -0.13, 0.0}, keys);
    const Se3 T_lid(ExpSo3({-kLeanRad, 0.0, 0.0}), {0.0, front_y + kBaseDepthM, kBaseM});
    mesh.AddBox(T_lid, {size_m.x(), kLidThicknessM, kLidM}, Uniform(shell));
    const Eigen::Vector3d corner =
        T_lid *
        Eigen::Vector3d(-0.5 * size_m.x() + 0.01, -0.5 * kLidThicknessM - kProudM, kLidM - 0.01);
    mesh.AddRectangle(corner, {size_m.x() - 0.02, 0.0, 0.0},
                      T_lid.R() * Eigen::Vector3d(0.0, 0.0, -kLidM + 0.025), screen);
  };
}

PropShape KeyboardShape(PropBrush& brush) {
  const Eigen::Vector3d size_m = StandardSizeM(PropKind::kKeyboard);
  const int dark = brush.Plain({44, 42, 42});
  const int keys =
      brush.Picture(PaintKeyboard(brush.Texels(size_m.x(), size_m.y()), brush.NextRng()));
  return [=](MeshBuilder& mesh) {
    mesh.AddBox(Se3(), size_m, {dark, dark, dark, dark, keys, dark});
  };
}

PropShape BooksShape(PropBrush& brush) {
  struct Book {
    Se3 T_pile_book;
    Eigen::Vector3d size_m;
    int cover, spine;
  };
  const Eigen::Vector3d pile_m = StandardSizeM(PropKind::kBooks);
  const int paper = brush.Plain({208, 218, 222});
  Rng rng = brush.NextRng();
  std::vector<Book> books;
  double z = 0.0;
  while (z < pile_m.z() - 0.02) {
    const Eigen::Vector3d size_m(rng.Uniform(0.19, 0.23), rng.Uniform(0.13, 0.165),
                                 std::min(rng.Uniform(0.02, 0.045), pile_m.z() - z));
    const int cover =
        brush.Picture(PaintPoster(brush.Texels(size_m.x(), size_m.y()), brush.NextRng()));
    const int spine =
        brush.Picture(PaintPackage(brush.Texels(size_m.x(), size_m.z()), brush.NextRng()));
    books.push_back(
        {At(rng.Uniform(-0.01, 0.01), rng.Uniform(-0.005, 0.005), z, rng.Uniform(-0.18, 0.18)),
         size_m, cover, spine});
    z += size_m.z();
  }
  return [=, books = std::move(books)](MeshBuilder& mesh) {
    for (const Book& book : books)
      mesh.AddBox(book.T_pile_book, book.size_m,
                  {book.spine, paper, paper, paper, book.cover, book.cover});
  };
}

PropShape SuitcaseShape(PropBrush& brush) {
  const Eigen::Vector3d size_m = StandardSizeM(PropKind::kSuitcase);
  const cv::Scalar color = RandomColor(brush.rng(), 0.7, 0.5);
  const int shell = brush.Plain(color);
  const int rib = brush.Plain(Shift(color, -40.0));
  const int dark = brush.Plain({40, 40, 42});
  const int label = brush.Picture(PaintPackage(brush.Texels(0.14, 0.09), brush.NextRng()));
  return [=](MeshBuilder& mesh) {
    constexpr double kWheelM = 0.05;
    constexpr double kRibM = 0.008;  // height of the ribs over the shell
    const Eigen::Vector3d body_m(size_m.x(), size_m.y() - 2.0 * kRibM, size_m.z() - kWheelM);
    mesh.AddBox(At(0.0, 0.0, kWheelM), body_m, Uniform(shell));
    for (const double side : {-1.0, 1.0}) {
      for (int i = -2; i <= 2; ++i)
        mesh.AddBox(At(i * 0.095, side * 0.5 * (body_m.y() + kRibM), kWheelM + 0.03),
                    {0.035, kRibM, body_m.z() - 0.06}, Uniform(rib));
      for (const double y : {-0.09, 0.09})
        mesh.AddBox(At(side * 0.2, y, 0.0), {0.03, 0.05, kWheelM}, Uniform(dark));
    }
    mesh.AddRectangle({-0.07, -0.5 * size_m.y(), 0.5}, {0.14, 0.0, 0.0}, {0.0, 0.0, -0.09}, label);
  };
}

}  // namespace cslam
