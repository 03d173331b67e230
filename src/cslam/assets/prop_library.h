// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/sim/scene_builder.h"

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <memory>
#include <string>
#include <string_view>

namespace cslam {

// Things a story may place. Each stands on the bottom centre of its pose with its front towards
// -y of the pose (as in furniture.h), whatever the look it comes in.
enum class PropKind {
  kChair,        // 56, plain, 0.9 m
  kArmchair,     // 56, large, richly and irregularly textured
  kTeddyBear,    // 77, sits, about 0.4 m
  kUmbrella,     // 25, open, tilted towards the front, about 1 m wide
  kMonitor,      // 62 (tv)
  kTelevision,   // 62, large, on a foot
  kSuitcase,     // 28, upright
  kMug,          // 41 (cup)
  kBooks,        // 73, a pile
  kLaptop,       // 63, open
  kKeyboard,     // 66
  kBottle,       // 39
  kPottedPlant,  // 58
  kBackpack,     // 24
  kCouch,        // 57
  kTable,        // 60 (dining table)
  kDesk,         // kNoClass
  kBookcase,     // kNoClass, filled with books
  kCabinet,      // kNoClass
  kCarton,       // kNoClass: a cardboard box, 0.4 m
};

constexpr int kNumPropKinds = static_cast<int>(PropKind::kCarton) + 1;

int CocoClassOf(PropKind kind);
std::string_view NameOf(PropKind kind);  // "teddy_bear"

// The box of a kind (m), the same for every look and variant.
Eigen::Vector3d StandardSizeM(PropKind kind);
// The height of its seat or top (m), for looks that do not know better.
double StandardTopM(PropKind kind);

// What a floor, wall or rug is made of.
enum class SurfaceKind { kParquet, kCarpet, kRug, kTiles, kBrick, kPlaster, kWallpaper, kWood };

// Where the meshes and pictures of a story come from: files of Debian packages, or, where they
// cannot be had, plain procedural ones (textured boxes and the like). Both looks have the same
// kinds, sizes and orientation, so that one story fits both. `variant` picks among the models,
// colours and pictures of a kind; any number is valid. Const: one library serves many threads.
class PropLibrary {
 public:
  virtual ~PropLibrary() = default;

  virtual std::string_view look() const = 0;  // "packages" or "procedural"

  // Width (x), depth (y), height (z) of the prop's box; the mesh fits into it.
  virtual Eigen::Vector3d SizeM(PropKind kind, int variant) const = 0;

  // Height above the prop's bottom of what one can put things on (seat of a chair, top of a table
  // or of a suitcase).
  virtual double TopM(PropKind kind, int variant) const = 0;

  // Adds the prop to the scene as an object of its COCO class; returns its instance id.
  virtual int Add(SceneBuilder& scene, PropKind kind, int variant, const std::string& name,
                  const Se3& T_world_prop) const = 0;

  // A material for the builder's rectangles that repeats with its natural period; a rug (about
  // 2 : 3, the longer side along the texture's v) fills the rectangle once.
  virtual int AddSurface(SceneBuilder& scene, SurfaceKind kind, int variant) const = 0;

  // CV_8UC3, about 1000 px wide: a poster for a wall, with nothing on it that a detector would take
  // for an object or a person.
  virtual cv::Mat Poster(int variant) const = 0;
};

}  // namespace cslam
