// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/furniture.h"

#include "cslam/sim/paint_tools.h"
#include "cslam/sim/picture_paint.h"
#include "cslam/sim/surface_paint.h"

#include <algorithm>

namespace cslam {
namespace {

constexpr double kHalfTurnRad = 3.14159265358979323846;

BoxLook WithFront(int front, int other) {
  BoxLook look = Uniform(other);
  look[static_cast<std::size_t>(BoxFace::kFront)] = front;
  return look;
}

BoxLook WithTop(int top, int other) {
  BoxLook look = Uniform(other);
  look[static_cast<std::size_t>(BoxFace::kTop)] = top;
  return look;
}

Se3 At(double x, double y, double z, double yaw_rad = 0.0) {
  return Standing(x, y, z, yaw_rad);
}

}  // namespace

Furnisher::Furnisher(SceneBuilder& scene, double texels_per_m)
    : scene_(scene), texels_per_m_(texels_per_m) {
  for (const cv::Scalar& color : {cv::Scalar(70, 112, 156), cv::Scalar(104, 158, 196),
                                  cv::Scalar(44, 66, 98), cv::Scalar(178, 192, 204)}) {
    woods_.push_back(scene_.AddSurface(
        PaintWood(Texels(1.0, 1.0), texels_per_m_, color, scene_.NextRng()), 1.0, 1.0));
  }
  paper_ =
      scene_.AddSurface(PaintPlain(Texels(0.2, 0.2), {208, 218, 222}, scene_.NextRng()), 0.2, 0.2);
  metal_ =
      scene_.AddSurface(PaintPlain(Texels(0.4, 0.4), {120, 118, 114}, scene_.NextRng()), 0.4, 0.4);
  dark_ = scene_.AddSurface(PaintPlain(Texels(0.3, 0.3), {44, 42, 42}, scene_.NextRng()), 0.3, 0.3);
}

cv::Size Furnisher::Texels(double width_m, double height_m) const {
  return TexelSize(width_m, height_m, texels_per_m_);
}

int Furnisher::AnyWood() {
  return woods_[scene_.rng().Index(woods_.size())];
}

void Furnisher::Desk(const Se3& T_world_desk, double width_m) {
  constexpr double kDepthM = 0.75;
  constexpr double kHeightM = 0.74;
  const int wood = AnyWood();
  scene_.AddObject("desk", kNoClass, T_world_desk, [&](MeshBuilder& mesh) {
    mesh.AddBox(At(0.0, 0.0, kHeightM - 0.03), {width_m, kDepthM, 0.03}, Uniform(wood));
    mesh.AddBox(At(0.0, 0.3, 0.3), {width_m - 0.1, 0.02, 0.4}, Uniform(wood));
    for (const double x : {-0.5 * width_m + 0.05, 0.5 * width_m - 0.05}) {
      for (const double y : {-0.5 * kDepthM + 0.06, 0.5 * kDepthM - 0.06})
        mesh.AddBox(At(x, y, 0.0), {0.05, 0.05, kHeightM - 0.03}, Uniform(metal_));
    }
  });
  Cabinet(T_world_desk * At(0.5 * width_m - 0.32, -0.02, 0.0), {0.42, 0.6, 0.62}, 3);
}

void Furnisher::Monitor(const Se3& T_world_monitor, double width_m) {
  const double height_m = 0.6 * width_m;
  const int screen =
      scene_.AddPicture(PaintScreen(Texels(width_m, height_m), scene_.NextRng()), 0.85F);
  scene_.AddObject("monitor", kCocoTv, T_world_monitor, [&](MeshBuilder& mesh) {
    mesh.AddBox(At(0.0, 0.02, 0.0), {0.24, 0.18, 0.015}, Uniform(dark_));
    mesh.AddBox(At(0.0, 0.04, 0.015), {0.06, 0.03, 0.12}, Uniform(dark_));
    mesh.AddBox(At(0.0, 0.0, 0.12), {width_m, 0.04, height_m}, Uniform(dark_));
    mesh.AddRectangle({-0.5 * width_m + 0.015, -0.021, 0.12 + height_m - 0.015},
                      {width_m - 0.03, 0.0, 0.0}, {0.0, 0.0, -height_m + 0.03}, screen);
  });
}

void Furnisher::Keyboard(const Se3& T_world_keyboard) {
  const int keys = Picture(PaintKeyboard(Texels(0.44, 0.15), scene_.NextRng()));
  scene_.AddBox("keyboard", kCocoKeyboard, T_world_keyboard, {0.44, 0.15, 0.02},
                WithTop(keys, dark_));
}

void Furnisher::Books(const Se3& T_world_board, double width_m, double height_m, double depth_m) {
  Rng& rng = scene_.rng();
  double x = -0.5 * width_m + rng.Uniform(0.0, 0.1);
  while (x < 0.5 * width_m - 0.06) {
    if (rng.Uniform() < 0.08) {  // a gap, or a box in between
      const double size_m = std::min(rng.Uniform(0.08, 0.18), 0.5 * width_m - x);
      if (rng.Uniform() < 0.6 && size_m > 0.08) {
        Package(T_world_board * At(x + 0.5 * size_m, rng.Uniform(-0.03, 0.03), 0.0),
                {size_m - 0.01, 0.7 * depth_m, std::min(size_m, height_m - 0.03)});
      }
      x += size_m;
      continue;
    }
    const double thickness_m = rng.Uniform(0.018, 0.055);
    const double book_height_m = std::min(rng.Uniform(0.19, 0.31), height_m - 0.02);
    const double book_depth_m = std::min(depth_m - 0.03, rng.Uniform(0.14, 0.22));
    const int spine = Picture(PaintBookSpine(Texels(thickness_m, book_height_m), scene_.NextRng()));
    const double y = -0.5 * depth_m + 0.5 * book_depth_m + rng.Uniform(0.01, 0.04);
    BoxLook look = Uniform(spine);
    look[static_cast<std::size_t>(BoxFace::kTop)] = paper_;
    look[static_cast<std::size_t>(BoxFace::kBack)] = -1;
    scene_.AddBox("book", kCocoBook, T_world_board * At(x + 0.5 * thickness_m, y, 0.0),
                  {thickness_m, book_depth_m, book_height_m}, look);
    x += thickness_m + 0.002;
  }
}

void Furnisher::Shelf(const Se3& T_world_shelf, const Eigen::Vector3d& size_m, int levels) {
  constexpr double kBoardM = 0.025;
  const int wood = AnyWood();
  const double width_m = size_m.x();
  const double depth_m = size_m.y();
  const double pitch_m = (size_m.z() - kBoardM) / levels;
  scene_.AddObject("shelf", kNoClass, T_world_shelf, [&](MeshBuilder& mesh) {
    for (const double x : {-0.5 * width_m, 0.5 * width_m})
      mesh.AddBox(At(x, 0.0, 0.0), {kBoardM, depth_m, size_m.z()}, Uniform(wood));
    mesh.AddBox(At(0.0, 0.5 * depth_m - 0.005, 0.0), {width_m, 0.01, size_m.z()}, Uniform(wood));
    for (int i = 0; i <= levels; ++i)
      mesh.AddBox(At(0.0, 0.0, i * pitch_m), {width_m - kBoardM, depth_m, kBoardM}, Uniform(wood));
  });
  for (int i = 0; i < levels; ++i) {
    const Se3 T_world_board = T_world_shelf * At(0.0, 0.0, i * pitch_m + kBoardM);
    if (i % 3 == 2) {
      Clutter(T_world_board, width_m - 0.15, depth_m - 0.1, 4);
    } else {
      Books(T_world_board, width_m - 2.0 * kBoardM, pitch_m - kBoardM, depth_m);
    }
  }
  Clutter(T_world_shelf * At(0.0, 0.0, size_m.z()), width_m - 0.2, depth_m - 0.1, 3);
}

void Furnisher::Cabinet(const Se3& T_world_cabinet, const Eigen::Vector3d& size_m, int drawers) {
  const int front = Picture(
      PaintDrawers(Texels(size_m.x(), size_m.z()), drawers, texels_per_m_, scene_.NextRng()));
  scene_.AddBox("cabinet", kNoClass, T_world_cabinet, size_m, WithFront(front, AnyWood()));
}

void Furnisher::Sofa(const Se3& T_world_sofa, double width_m) {
  const int fabric =
      scene_.AddSurface(PaintFabric(Texels(1.0, 1.0), texels_per_m_,
                                    RandomColor(scene_.rng(), 0.35, 0.55), scene_.NextRng()),
                        1.0, 1.0);
  const int cushion = Picture(PaintRug(Texels(0.42, 0.42), texels_per_m_, scene_.NextRng()));
  scene_.AddObject("sofa", kCocoCouch, T_world_sofa, [&](MeshBuilder& mesh) {
    mesh.AddBox(At(0.0, -0.05, 0.08), {width_m, 0.75, 0.34}, Uniform(fabric));
    mesh.AddBox(At(0.0, 0.3, 0.08), {width_m, 0.2, 0.75}, Uniform(fabric));
    for (const double x : {-0.5 * width_m, 0.5 * width_m})
      mesh.AddBox(At(x, -0.03, 0.0), {0.18, 0.82, 0.6}, Uniform(fabric));
  });
  for (const double x : {-0.3 * width_m, 0.28 * width_m}) {
    const Se3 lean(ExpSo3({-0.3, 0.0, 0.0}), {x, 0.1, 0.42});
    scene_.AddBox("cushion", kNoClass, T_world_sofa * lean, {0.42, 0.12, 0.4},
                  WithFront(cushion, fabric));
  }
}

void Furnisher::Chair(const Se3& T_world_chair) {
  const int wood = AnyWood();
  const int seat =
      scene_.AddSurface(PaintFabric(Texels(0.5, 0.5), texels_per_m_,
                                    RandomColor(scene_.rng(), 0.6, 0.6), scene_.NextRng()),
                        0.5, 0.5);
  scene_.AddObject("chair", kCocoChair, T_world_chair, [&](MeshBuilder& mesh) {
    mesh.AddBox(At(0.0, 0.0, 0.43), {0.44, 0.42, 0.05}, WithTop(seat, wood));
    mesh.AddBox(At(0.0, 0.2, 0.62), {0.42, 0.03, 0.3}, Uniform(seat));
    for (const double x : {-0.19, 0.19}) {
      mesh.AddBox(At(x, -0.18, 0.0), {0.035, 0.035, 0.43}, Uniform(wood));
      mesh.AddBox(At(x, 0.19, 0.0), {0.035, 0.035, 0.92}, Uniform(wood));
    }
  });
}

void Furnisher::Table(const Se3& T_world_table, const Eigen::Vector3d& size_m) {
  const int wood = AnyWood();
  scene_.AddObject("table", kNoClass, T_world_table, [&](MeshBuilder& mesh) {
    mesh.AddBox(At(0.0, 0.0, size_m.z() - 0.04), {size_m.x(), size_m.y(), 0.04}, Uniform(wood));
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5})
        mesh.AddBox(At(x * (size_m.x() - 0.1), y * (size_m.y() - 0.1), 0.0),
                    {0.05, 0.05, size_m.z() - 0.04}, Uniform(wood));
    }
  });
}

void Furnisher::Carton(const Se3& T_world_carton, const Eigen::Vector3d& size_m) {
  const int front =
      Picture(PaintCardboard(Texels(size_m.x(), size_m.z()), texels_per_m_, scene_.NextRng()));
  const int side =
      Picture(PaintCardboard(Texels(size_m.y(), size_m.z()), texels_per_m_, scene_.NextRng()));
  scene_.AddBox("carton", kNoClass, T_world_carton, size_m, {front, side, side, front, side, -1});
}

void Furnisher::Package(const Se3& T_world_package, const Eigen::Vector3d& size_m) {
  const int front = Picture(PaintPackage(Texels(size_m.x(), size_m.z()), scene_.NextRng()));
  const int side = Picture(PaintPackage(Texels(size_m.y(), size_m.z()), scene_.NextRng()));
  const int top = Picture(PaintPackage(Texels(size_m.x(), size_m.y()), scene_.NextRng()));
  scene_.AddBox("package", kNoClass, T_world_package, size_m, {front, side, side, side, top, -1});
}

void Furnisher::Page(const Se3& T_world_page) {
  const int page = Picture(PaintPage(Texels(0.21, 0.297), scene_.NextRng()));
  scene_.AddBox("page", kNoClass, T_world_page, {0.21, 0.297, 0.004}, WithTop(page, paper_));
}

void Furnisher::BookPile(const Se3& T_world_pile, int num_books) {
  Rng& rng = scene_.rng();
  double z = 0.0;
  for (int i = 0; i < num_books; ++i) {
    const Eigen::Vector3d size_m(rng.Uniform(0.2, 0.27), rng.Uniform(0.14, 0.2),
                                 rng.Uniform(0.015, 0.045));
    const int cover = Picture(PaintPoster(Texels(size_m.x(), size_m.y()), scene_.NextRng()));
    const int spine = Picture(PaintPackage(Texels(size_m.x(), size_m.z()), scene_.NextRng()));
    scene_.AddBox("book", kCocoBook,
                  T_world_pile * At(rng.Uniform(-0.02, 0.02), rng.Uniform(-0.02, 0.02), z,
                                    rng.Uniform(-0.3, 0.3)),
                  size_m, {spine, paper_, paper_, paper_, cover, -1});
    z += size_m.z();
  }
}

void Furnisher::Cup(const Se3& T_world_cup) {
  const int side = Picture(PaintPackage(Texels(0.08, 0.1), scene_.NextRng()));
  scene_.AddObject("cup", kCocoCup, T_world_cup, [&](MeshBuilder& mesh) {
    // Two boxes crossed at 45 degrees: nearly round.
    mesh.AddBox(Se3(), {0.075, 0.075, 0.1}, WithTop(dark_, side));
    mesh.AddBox(At(0.0, 0.0, 0.0, 0.25 * kHalfTurnRad), {0.075, 0.075, 0.1}, WithTop(dark_, side));
  });
}

void Furnisher::Clutter(const Se3& T_world_surface, double width_m, double depth_m, int count) {
  Rng& rng = scene_.rng();
  for (int i = 0; i < count; ++i) {  // one thing per slot, so that they do not overlap
    const double slot_m = width_m / count;
    const double x = -0.5 * width_m + (i + 0.5) * slot_m;
    const double y = 0.3 * depth_m * rng.Uniform(-1.0, 1.0);
    const Se3 T_world_item = T_world_surface * At(x, y, 0.0, rng.Uniform(-0.5, 0.5));
    const double width_item_m = std::min(0.8 * slot_m, rng.Uniform(0.1, 0.3));
    const double kind = rng.Uniform();
    if (kind < 0.5) {
      Package(T_world_item, {width_item_m, std::min(0.6 * depth_m, rng.Uniform(0.06, 0.2)),
                             rng.Uniform(0.08, 0.28)});
    } else if (kind < 0.75 && slot_m > 0.2) {
      BookPile(T_world_item, RandomInt(rng, 2, 5));
    } else if (kind < 0.9) {
      Cup(T_world_item);
    } else {
      Carton(T_world_item, {width_item_m, 0.5 * depth_m, rng.Uniform(0.1, 0.22)});
    }
  }
}

void Furnisher::OnWall(const char* name, const Se3& T_world_item, double width_m, double height_m,
                       const cv::Mat& image) {
  scene_.AddBox(name, kNoClass, T_world_item * At(0.0, -0.0075, 0.0), {width_m, 0.015, height_m},
                WithFront(Picture(image), paper_));
}

}  // namespace cslam
