// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/package_models.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace cslam {
namespace {

constexpr std::string_view kCc0 = "BlendSwap-CC-0";
constexpr std::string_view kCcBy = "BlendSwap-CC-BY";
constexpr std::string_view kKator = "KatorLegaz";
constexpr std::string_view kScopia = "Scopia";

constexpr int kUnused = -1;

// Authors and licences: docs/assets.md. What is fetched depends on this list's order, too: models
// no longer used stay in it until something else is added.
constexpr auto kModels = std::to_array<PackageModel>({
    {PropKind::kChair, kCc0, "/blendswap-cc-0/chair2/chair2.obj", 0.0, 1.15, {}, {}, 1},
    {PropKind::kChair, kCcBy, "/blendswap-cc-by/plaidChair/plaidChair.obj", 0.0, 1.15, {}, {}, 3},
    {PropKind::kChair,
     kCc0,
     "/blendswap-cc-0/chairWithCushion/chairWithCushion.obj",
     0.0,
     1.15,
     {},
     {},
     kUnused},
    {PropKind::kChair,
     kCcBy,
     "/blendswap-cc-by/ella_chair_f/ella_chair_f.obj",
     0.0,
     1.15,
     {},
     {},
     0},
    {PropKind::kChair, kScopia, "/scopia/chair4/chair4.obj", 0.0, 1.15, {}, {}, 2},
    {PropKind::kArmchair, kScopia, "/scopia/armchair/armchair.obj", 0.0, 1.2, {}, "sillon_ref"},
    {PropKind::kArmchair,
     kKator,
     "/katorlegaz/mid-century-chair/mid-century-chair.obj",
     0.0,
     1.2,
     {},
     "TEXTILE_generic"},
    {PropKind::kTeddyBear, kCc0, "/blendswap-cc-0/teddyBear/teddyBear.obj", 0.0, 1.2},
    {PropKind::kMonitor, kCc0, "/blendswap-cc-0/led_tv/led_tv.obj", 0.0, 1.3, "screen"},
    {PropKind::kTelevision, kCc0, "/blendswap-cc-0/led_tv/led_tv.obj", 0.0, 1.1, "screen"},
    {PropKind::kSuitcase, kCcBy, "/blendswap-cc-by/suitcase/suitcase.obj"},
    {PropKind::kMug, kKator, "/katorlegaz/coffee-mug/coffee-mug.obj", 90.0},
    {PropKind::kLaptop, kCcBy, "/blendswap-cc-by/laptop/laptop.obj", 0.0, 1.15, "Screen"},
    {PropKind::kBottle, kKator, "/katorlegaz/red-wine-bottle-01/red-wine-bottle-01.obj"},
    {PropKind::kBottle, kScopia, "/scopia/wine_bottle/wine_bottle.obj"},
    {PropKind::kPottedPlant, kScopia, "/scopia/maceta/maceta.obj", 0.0, 1.3},
    {PropKind::kPottedPlant, kCc0, "/blendswap-cc-0/plant/plant.obj", 0.0, 1.3},
    {PropKind::kPottedPlant, kCcBy, "/blendswap-cc-by/decorativePlant/decorativePlant.obj", 0.0,
     1.3},
    {PropKind::kBackpack, kCcBy, "/blendswap-cc-by/backpack/backpack.obj"},
    {PropKind::kCouch, kScopia, "/scopia/sofa_white_beige/sofa_white_beige.obj", 0.0, 1.2},
    {PropKind::kCouch, kCc0, "/blendswap-cc-0/sofa2/sofa2.obj", 0.0, 1.2},
    {PropKind::kCouch, kCcBy, "/blendswap-cc-by/sofa3/sofa3.obj", 0.0, 1.2},
    {PropKind::kTable, kScopia, "/scopia/wooden_table_office/wooden_table_office.obj"},
    {PropKind::kTable, kCcBy, "/blendswap-cc-by/table/table.obj"},
    {PropKind::kDesk, kCcBy, "/blendswap-cc-by/simpleDesk/simpleDesk.obj"},
    {PropKind::kDesk, kCcBy, "/blendswap-cc-by/biurko3/biurko3.obj", 0.0, 1.25},
    {PropKind::kBookcase, kKator, "/katorlegaz/full-bookcase/full-bookcase.obj", 0.0, 1.25},
    {PropKind::kCabinet, kCcBy, "/blendswap-cc-by/bedsideTable/bedsideTable.obj", 0.0, 1.4},
    {PropKind::kCabinet, kCc0, "/blendswap-cc-0/bedsideTable2/bedsideTable2.obj", 0.0, 1.4},
});

constexpr auto kTextures = std::to_array<PackageTexture>({
    {SurfaceKind::kParquet, "floor_wood01.png", 1.2},
    {SurfaceKind::kParquet, "floor039.png", 1.0},
    {SurfaceKind::kParquet, "floor035.png", 0.9},
    {SurfaceKind::kRug, "carpet018.png"},
    {SurfaceKind::kRug, "carpet010.png"},
    {SurfaceKind::kRug, "carpet012.png"},
    {SurfaceKind::kRug, "carpet002.png"},
    {SurfaceKind::kCarpet, "carpet029.png", 0.5},
    {SurfaceKind::kCarpet, "carpet028.png", 0.5},
    {SurfaceKind::kTiles, "floor013.png", 1.2},
    {SurfaceKind::kTiles, "floor008.png", 1.0},
    {SurfaceKind::kBrick, "wall_brick01.png", 1.2},
    {SurfaceKind::kBrick, "wall043.png", 1.2},
    {SurfaceKind::kWallpaper, "wallpaper004.jpg", 0.7},
    {SurfaceKind::kWallpaper, "wallpaper001.jpg", 0.6},
});

constexpr auto kPosters = std::to_array<PackagePoster>({
    {"OneStandsOut", "2560x1600.jpg"},
    {"Altai", "5120x2880.png"},
    {"FallenLeaf", "2560x1600.jpg"},
    {"Path", "2560x1600.jpg"},
    {"Shell", "5120x2880.jpg"},
    {"Cascade", "3840x2160.png"},
    {"Volna", "5120x2880.jpg"},
    {"PastelHills", "3200x2000.jpg"},
});

}  // namespace

std::span<const PackageModel> PackageModels() {
  return kModels;
}

std::vector<PackageModel> ModelsOf(PropKind kind) {
  std::vector<PackageModel> models;
  std::ranges::copy_if(kModels, std::back_inserter(models), [&](const PackageModel& model) {
    return model.kind == kind && model.rank >= 0;
  });
  std::ranges::stable_sort(models, {}, &PackageModel::rank);
  return models;
}

std::span<const PackageTexture> PackageTextures() {
  return kTextures;
}

std::span<const PackagePoster> PackagePosters() {
  return kPosters;
}

std::string PosterFile(const PackagePoster& poster) {
  return fmt::format("posters/{}{}", poster.name, poster.file.substr(poster.file.rfind('.')));
}

}  // namespace cslam
