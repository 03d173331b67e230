// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/assets/prop_library.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cslam {

// A model of the package sweethome3d-furniture and how to use it.
struct PackageModel {
  PropKind kind = PropKind::kChair;
  std::string_view catalogue;    // "Scopia": the archive without .sh3f
  std::string_view path;         // in the archive, as its catalogue says it
  double yaw_deg = 0.0;          // turns the model's front to the prop's, seen from above
  double max_stretch = 1.15;     // of one axis against another, to fill the standard size
  std::string_view screen = {};  // the material that shows a picture
  std::string_view fabric = {};  // the material that gets a rich pattern
  int rank = 0;                  // among the kind's variants; negative: fetched but not used
};

std::span<const PackageModel> PackageModels();

// The variants of a kind, best known to detectors first. Kinds without any are procedural.
std::vector<PackageModel> ModelsOf(PropKind kind);

// A picture of the package ufoai-textures.
struct PackageTexture {
  SurfaceKind kind = SurfaceKind::kParquet;
  std::string_view file;  // in textures/tex_buildings
  double period_m = 1.0;  // what its width shows; rugs: unused
};
std::span<const PackageTexture> PackageTextures();

// A picture of the package plasma-workspace-wallpapers.
struct PackagePoster {
  std::string_view name;
  std::string_view file;
};
std::span<const PackagePoster> PackagePosters();
std::string PosterFile(const PackagePoster& poster);  // in an AssetFolder

}  // namespace cslam
