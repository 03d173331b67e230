// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cslam {

// A file or folder of a Debian package, and where it goes in the asset folder.
struct AssetSource {
  std::string package;
  std::string file;    // below /usr/share of the package
  std::string member;  // of that file, if it is an archive; ends in '/' for a folder; else empty
  std::string target;  // in the asset folder; ends in '/' for a folder
};

// Everything the look "packages" is made of.
std::vector<AssetSource> AllAssetSources();

// Names of the files in an AssetFolder.
std::string CatalogueFile(std::string_view catalogue);
std::string ModelFile(std::string_view catalogue, std::string_view model);
constexpr std::string_view kHumanRigFile = "people/human_rig.blend";

}  // namespace cslam
