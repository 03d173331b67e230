// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/asset_folder.h"

#include "cslam/util/check.h"

#include <system_error>

namespace cslam {
namespace {

std::string_view PackageOf(std::string_view relative) {
  if (relative.starts_with("textures/")) return "ufoai-textures";
  if (relative.starts_with("posters/")) return "plasma-workspace-wallpapers";
  if (relative.starts_with("people/")) return "morse-simulator-data";
  return "sweethome3d-furniture";
}

}  // namespace

std::filesystem::path AssetFolder::File(std::string_view relative) const {
  std::filesystem::path path = root_ / relative;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) return path;
  const std::string_view package = PackageOf(relative);
  throw Error(
      "'{}' is missing, a file of the Debian package {}; install it (sudo apt-get install "
      "{}), then remove '{}' so that it is filled anew",
      path.string(), package, package, root_.string());
}

}  // namespace cslam
