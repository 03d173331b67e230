// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/prop_library.h"

#include "cslam/util/check.h"

#include <array>

namespace cslam {
namespace {

struct KindFacts {
  PropKind kind;
  std::string_view name;
  int coco_class;
  double width_m, depth_m, height_m;
  double top_m;
};

constexpr std::array<KindFacts, kNumPropKinds> kKinds{{
    {PropKind::kChair, "chair", 56, 0.48, 0.52, 0.92, 0.46},
    {PropKind::kArmchair, "armchair", 56, 0.90, 0.85, 1.00, 0.44},
    {PropKind::kTeddyBear, "teddy_bear", 77, 0.36, 0.32, 0.42, 0.42},
    {PropKind::kUmbrella, "umbrella", 25, 1.02, 0.96, 0.90, 0.90},
    {PropKind::kMonitor, "monitor", 62, 0.54, 0.20, 0.46, 0.46},
    {PropKind::kTelevision, "television", 62, 1.05, 0.26, 0.72, 0.72},
    {PropKind::kSuitcase, "suitcase", 28, 0.66, 0.26, 0.54, 0.54},
    {PropKind::kMug, "mug", 41, 0.12, 0.09, 0.10, 0.10},
    {PropKind::kBooks, "books", 73, 0.28, 0.22, 0.16, 0.16},
    {PropKind::kLaptop, "laptop", 63, 0.36, 0.34, 0.24, 0.02},
    {PropKind::kKeyboard, "keyboard", 66, 0.44, 0.15, 0.03, 0.03},
    {PropKind::kBottle, "bottle", 39, 0.08, 0.08, 0.29, 0.29},
    {PropKind::kPottedPlant, "potted_plant", 58, 0.60, 0.60, 1.00, 0.35},
    {PropKind::kBackpack, "backpack", 24, 0.34, 0.30, 0.46, 0.46},
    {PropKind::kCouch, "couch", 57, 1.90, 0.92, 0.85, 0.44},
    {PropKind::kTable, "table", 60, 1.60, 0.90, 0.74, 0.74},
    {PropKind::kDesk, "desk", kNoClass, 1.40, 0.75, 0.74, 0.74},
    {PropKind::kBookcase, "bookcase", kNoClass, 0.90, 0.32, 1.90, 1.90},
    {PropKind::kCabinet, "cabinet", kNoClass, 0.50, 0.50, 0.66, 0.66},
    {PropKind::kCarton, "carton", kNoClass, 0.40, 0.40, 0.40, 0.40},
}};

const KindFacts& FactsOf(PropKind kind) {
  const KindFacts& facts = kKinds.at(static_cast<std::size_t>(kind));
  CSLAM_CHECK(facts.kind == kind, "{}", facts.name);
  return facts;
}

}  // namespace

int CocoClassOf(PropKind kind) {
  return FactsOf(kind).coco_class;
}

std::string_view NameOf(PropKind kind) {
  return FactsOf(kind).name;
}

Eigen::Vector3d StandardSizeM(PropKind kind) {
  const KindFacts& facts = FactsOf(kind);
  return {facts.width_m, facts.depth_m, facts.height_m};
}

double StandardTopM(PropKind kind) {
  return FactsOf(kind).top_m;
}

}  // namespace cslam
