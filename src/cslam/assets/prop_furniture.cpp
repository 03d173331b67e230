// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/prop_brush.h"
#include "cslam/assets/prop_library.h"
#include "cslam/sim/paint_tools.h"
#include "cslam/sim/picture_paint.h"
#include "cslam/sim/surface_paint.h"

#include <algorithm>
#include <vector>

namespace cslam {
namespace {

Se3 At(double x, double y, double z) {
  return Standing(x, y, z);
}

BoxLook With(BoxLook look, BoxFace face, int material) {
  look[static_cast<std::size_t>(face)] = material;
  return look;
}

// Four legs of the given thickness (m) at the corners of a box.
void AddLegs(MeshBuilder& mesh, const Eigen::Vector3d& size_m, double thickness_m, int material) {
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5})
      mesh.AddBox(At(x * (size_m.x() - thickness_m), y * (size_m.y() - thickness_m), 0.0),
                  {thickness_m, thickness_m, size_m.z()}, Uniform(material));
  }
}

// A seat with arms and back, upholstered all over.
PropShape UpholsteredShape(PropKind kind, double arm_m, int fabric) {
  const Eigen::Vector3d size_m = StandardSizeM(kind);
  const double seat_m = StandardTopM(kind);
  return [=](MeshBuilder& mesh) {
    constexpr double kBackM = 0.2;
    constexpr double kFootM = 0.06;
    const double inner_m = size_m.x() - 2.0 * arm_m;
    const double front_y = -0.5 * size_m.y();
    const double seat_depth_m = size_m.y() - kBackM;
    mesh.AddBox(At(0.0, front_y + 0.5 * seat_depth_m, kFootM),
                {inner_m, seat_depth_m, seat_m - kFootM}, Uniform(fabric));
    mesh.AddBox(At(0.0, 0.5 * (size_m.y() - kBackM), kFootM),
                {size_m.x(), kBackM, size_m.z() - kFootM}, Uniform(fabric));
    for (const double side : {-0.5, 0.5})
      mesh.AddBox(At(side * (size_m.x() - arm_m), front_y + 0.5 * seat_depth_m, 0.0),
                  {arm_m, seat_depth_m, seat_m + 0.2}, Uniform(fabric));
  };
}

}  // namespace

PropShape ChairShape(PropBrush& brush) {
  const int wood = brush.Wood();
  const int seat = brush.Fabric(0.6, 0.6);
  const Eigen::Vector3d size_m = StandardSizeM(PropKind::kChair);
  const double seat_m = StandardTopM(PropKind::kChair);
  return [=](MeshBuilder& mesh) {
    constexpr double kLegM = 0.04;
    constexpr double kCushionM = 0.05;
    mesh.AddBox(At(0.0, 0.0, seat_m - kCushionM), {size_m.x() - 0.02, size_m.y() - 0.03, kCushionM},
                With(Uniform(wood), BoxFace::kTop, seat));
    AddLegs(mesh, {size_m.x(), size_m.y(), seat_m - kCushionM}, kLegM, wood);
    const double back_y = 0.5 * (size_m.y() - kLegM);
    for (const double side : {-0.5, 0.5})
      mesh.AddBox(At(side * (size_m.x() - kLegM), back_y, seat_m),
                  {kLegM, kLegM, size_m.z() - seat_m}, Uniform(wood));
    mesh.AddBox(At(0.0, back_y, seat_m + 0.14),
                {size_m.x() - 2.0 * kLegM, 0.03, size_m.z() - seat_m - 0.16}, Uniform(seat));
  };
}

PropShape ArmchairShape(PropBrush& brush) {
  return UpholsteredShape(PropKind::kArmchair, 0.15, brush.RichFabric());
}

PropShape CouchShape(PropBrush& brush) {
  return UpholsteredShape(PropKind::kCouch, 0.18, brush.Fabric(0.35, 0.55));
}

PropShape TableShape(PropBrush& brush) {
  const int wood = brush.Wood();
  const Eigen::Vector3d size_m = StandardSizeM(PropKind::kTable);
  return [=](MeshBuilder& mesh) {
    constexpr double kTopM = 0.04;
    mesh.AddBox(At(0.0, 0.0, size_m.z() - kTopM), {size_m.x(), size_m.y(), kTopM}, Uniform(wood));
    AddLegs(mesh, {size_m.x() - 0.1, size_m.y() - 0.1, size_m.z() - kTopM}, 0.06, wood);
  };
}

PropShape DeskShape(PropBrush& brush) {
  const int wood = brush.Wood();
  const int metal = brush.Plain({120, 118, 114});
  const Eigen::Vector3d size_m = StandardSizeM(PropKind::kDesk);
  const int front = brush.Picture(
      PaintDrawers(brush.Texels(0.42, 0.6), 3, brush.texels_per_m(), brush.NextRng()));
  return [=](MeshBuilder& mesh) {
    constexpr double kTopM = 0.03;
    mesh.AddBox(At(0.0, 0.0, size_m.z() - kTopM), {size_m.x(), size_m.y(), kTopM}, Uniform(wood));
    mesh.AddBox(At(0.0, 0.4 * size_m.y(), 0.3), {size_m.x() - 0.12, 0.02, 0.4}, Uniform(wood));
    AddLegs(mesh, {size_m.x() - 0.04, size_m.y() - 0.04, size_m.z() - kTopM}, 0.05, metal);
    mesh.AddBox(At(0.5 * size_m.x() - 0.3, -0.02, 0.04), {0.42, 0.6, 0.6},
                With(Uniform(wood), BoxFace::kFront, front));
  };
}

PropShape BookcaseShape(PropBrush& brush) {
  struct Book {
    Eigen::Vector3d at;
    Eigen::Vector3d size_m;
    int spine;
  };
  constexpr double kBoardM = 0.025;
  constexpr int kLevels = 5;
  const Eigen::Vector3d size_m = StandardSizeM(PropKind::kBookcase);
  const double pitch_m = (size_m.z() - kBoardM) / kLevels;
  const int wood = brush.Wood();
  const int paper = brush.Plain({208, 218, 222});
  std::vector<Book> books;
  Rng rng = brush.NextRng();
  for (int level = 0; level < kLevels; ++level) {
    const double right_m = 0.5 * size_m.x() - kBoardM;
    double x = -right_m + rng.Uniform(0.0, 0.05);
    while (true) {
      const Eigen::Vector3d book_m(rng.Uniform(0.02, 0.055), rng.Uniform(0.16, 0.24),
                                   rng.Uniform(0.65, 0.98) * (pitch_m - kBoardM - 0.02));
      if (x + book_m.x() > right_m) break;
      const int spine =
          brush.Picture(PaintBookSpine(brush.Texels(book_m.x(), book_m.z()), brush.NextRng()));
      const double y = -0.5 * size_m.y() + 0.5 * book_m.y() + rng.Uniform(0.01, 0.04);
      books.push_back({{x + 0.5 * book_m.x(), y, level * pitch_m + kBoardM}, book_m, spine});
      x += book_m.x() + (rng.Uniform() < 0.08 ? rng.Uniform(0.04, 0.15) : 0.002);
    }
  }
  return [=, books = std::move(books)](MeshBuilder& mesh) {
    for (const double side : {-0.5, 0.5})
      mesh.AddBox(At(side * (size_m.x() - kBoardM), 0.0, 0.0), {kBoardM, size_m.y(), size_m.z()},
                  Uniform(wood));
    mesh.AddBox(At(0.0, 0.5 * size_m.y() - 0.005, 0.0),
                {size_m.x() - 2.0 * kBoardM, 0.01, size_m.z()}, Uniform(wood));
    for (int i = 0; i <= kLevels; ++i)
      mesh.AddBox(At(0.0, -0.005, i * pitch_m),
                  {size_m.x() - 2.0 * kBoardM, size_m.y() - 0.01, kBoardM}, Uniform(wood));
    for (const Book& book : books)
      mesh.AddBox(At(book.at.x(), book.at.y(), book.at.z()), book.size_m,
                  {book.spine, -1, book.spine, book.spine, paper, -1});
  };
}

PropShape CabinetShape(PropBrush& brush) {
  const Eigen::Vector3d size_m = StandardSizeM(PropKind::kCabinet);
  const int wood = brush.Wood();
  const int front = brush.Picture(
      PaintDrawers(brush.Texels(size_m.x(), size_m.z()), 3, brush.texels_per_m(), brush.NextRng()));
  return [=](MeshBuilder& mesh) {
    mesh.AddBox(Se3(), size_m, With(Uniform(wood), BoxFace::kFront, front));
  };
}

PropShape CartonShape(PropBrush& brush) {
  const Eigen::Vector3d size_m = StandardSizeM(PropKind::kCarton);
  std::vector<int> sides;
  for (int i = 0; i < 5; ++i)
    sides.push_back(brush.Picture(PaintCardboard(brush.Texels(size_m.x(), size_m.z()),
                                                 brush.texels_per_m(), brush.NextRng())));
  return [=](MeshBuilder& mesh) {
    mesh.AddBox(Se3(), size_m, {sides[0], sides[1], sides[2], sides[3], sides[4], sides[4]});
  };
}

}  // namespace cslam
