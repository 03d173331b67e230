// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/procedural_props.h"

#include "cslam/assets/prop_brush.h"
#include "cslam/sim/paint_tools.h"
#include "cslam/sim/picture_paint.h"
#include "cslam/sim/surface_paint.h"
#include "cslam/util/check.h"

#include <array>

namespace cslam {
namespace {

// Streams of the painters' generators; the variant is the purpose.
constexpr std::uint64_t kLookSeed = 20260;
constexpr std::uint64_t kSurfaceStream = 1000;
constexpr std::uint64_t kPosterStream = 2000;

Rng RngFor(std::uint64_t stream, int variant) {
  return Rng(kLookSeed, stream, static_cast<std::uint64_t>(variant));
}

using ShapeMaker = PropShape (*)(PropBrush&);

constexpr std::array<ShapeMaker, kNumPropKinds> kShapes{
    &ChairShape,      &ArmchairShape, &TeddyBearShape,   &UmbrellaShape, &MonitorShape,
    &TelevisionShape, &SuitcaseShape, &MugShape,         &BooksShape,    &LaptopShape,
    &KeyboardShape,   &BottleShape,   &PottedPlantShape, &BackpackShape, &CouchShape,
    &TableShape,      &DeskShape,     &BookcaseShape,    &CabinetShape,  &CartonShape};

struct SurfaceImage {
  cv::Mat image;
  double period_m;
};

SurfaceImage PaintSurface(SurfaceKind kind, double texels_per_m, Rng rng) {
  const auto texels = [&](double period_m) { return TexelSize(period_m, period_m, texels_per_m); };
  const Rng own(rng.NextUint64());
  const cv::Scalar pale = RandomColor(rng, rng.Uniform(0.02, 0.14), rng.Uniform(0.7, 0.82));
  const cv::Scalar deep = RandomColor(rng, 0.4, 0.45);
  switch (kind) {
    case SurfaceKind::kParquet:
      return {PaintPlanks(texels(2.6), texels_per_m, own), 2.6};
    case SurfaceKind::kCarpet:
      return {PaintFabric(texels(2.0), texels_per_m, deep, own), 2.0};
    case SurfaceKind::kRug:
      return {PaintRug(TexelSize(1.6, 2.4, texels_per_m), texels_per_m, own), 0.0};
    case SurfaceKind::kTiles:
      return {PaintCeiling(texels(2.48), texels_per_m, own), 2.48};
    case SurfaceKind::kBrick:
      return {PaintBricks(texels(2.0), texels_per_m, own), 2.0};
    case SurfaceKind::kPlaster:
      return {PaintPlaster(texels(3.0), texels_per_m, pale, own), 3.0};
    case SurfaceKind::kWallpaper:
      return {PaintWallpaper(texels(2.4), texels_per_m, pale, own), 2.4};
    case SurfaceKind::kWood:
      return {PaintWood(texels(1.2), texels_per_m, {70.0, 112.0, 156.0}, own), 1.2};
  }
  throw InternalError("SurfaceKind", "unknown", std::source_location::current());
}

}  // namespace

Eigen::Vector3d ProceduralProps::SizeM(PropKind kind, int /*variant*/) const {
  return StandardSizeM(kind);
}

double ProceduralProps::TopM(PropKind kind, int /*variant*/) const {
  return StandardTopM(kind);
}

int ProceduralProps::Add(SceneBuilder& scene, PropKind kind, int variant, const std::string& name,
                         const Se3& T_world_prop) const {
  const auto index = static_cast<std::size_t>(kind);
  PropBrush brush(scene, texels_per_m_, RngFor(index, variant));
  return scene.AddObject(name, CocoClassOf(kind), T_world_prop, kShapes.at(index)(brush));
}

int ProceduralProps::AddSurface(SceneBuilder& scene, SurfaceKind kind, int variant) const {
  const auto stream = kSurfaceStream + static_cast<std::uint64_t>(kind);
  const SurfaceImage surface = PaintSurface(kind, texels_per_m_, RngFor(stream, variant));
  if (kind == SurfaceKind::kRug) return scene.AddPicture(surface.image);
  return scene.AddSurface(surface.image, surface.period_m, surface.period_m);
}

cv::Mat ProceduralProps::Poster(int variant) const {
  return PaintPoster({1000, 700}, RngFor(kPosterStream, variant));
}

}  // namespace cslam
