// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <utility>

namespace cslam {

// The files taken from Debian packages (see docs/assets.md): models/<catalogue>/..., textures/...,
// posters/..., people/human_rig.blend.
class AssetFolder {
 public:
  explicit AssetFolder(std::filesystem::path root) : root_(std::move(root)) {}

  // The path of a file that is there. Throws Error that names the package and how to get it.
  std::filesystem::path File(std::string_view relative) const;

  const std::filesystem::path& root() const { return root_; }

 private:
  std::filesystem::path root_;
};

}  // namespace cslam
