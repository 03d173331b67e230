// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/assets/asset_folder.h"
#include "cslam/assets/asset_sources.h"
#include "cslam/assets/prop_library.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace cslam {

// How far a fetch is. Called a few times a second; may throw to end it.
struct FetchProgress {
  std::string package;
  double done_mb = 0.0;   // of this package
  double total_mb = 0.0;  // 0: not known yet
};
using FetchCallback = std::function<void(const FetchProgress&)>;

struct FetchPlaces {
  std::filesystem::path root;                  // the asset folder to be
  std::filesystem::path share = "/usr/share";  // where installed packages have their files
  bool may_download = true;
};

// $XDG_DATA_HOME/changing-slam/assets, by default below ~/.local/share. Throws Error if neither
// that nor $HOME is set.
std::filesystem::path DefaultAssetRoot();

// Is there a complete folder with just these files?
bool AssetsAreComplete(const std::filesystem::path& root, std::span<const AssetSource> sources);

// Makes the folder unless it is complete: files of installed packages are copied, other packages
// are downloaded by `apt-get download` (which needs no root rights), unpacked in a temporary folder
// and thrown away. The folder appears under its name only when complete. Throws Error that names
// the package, the reason and the remedy.
AssetFolder FetchAssets(const FetchPlaces& places, std::span<const AssetSource> sources,
                        const FetchCallback& progress = {});

enum class Look { kAuto, kPackages, kProcedural };

// "auto", "packages", "procedural"; throws Error for others.
Look ParseLook(std::string_view text);

struct AssetStatus {
  std::shared_ptr<const PropLibrary> props;
  std::optional<AssetFolder> folder;  // of the packages' files; none: the procedural look
  std::string note;                   // why the look is not what one would like, in one line
};

// kPackages: fetches what is missing, throws Error if it cannot be had. kAuto: the same, but then
// the procedural look with a note.
AssetStatus LoadOrFetchAssets(Look wish, const FetchPlaces& places,
                              const FetchCallback& progress = {});
AssetStatus LoadOrFetchAssets(Look wish, const FetchCallback& progress = {});

}  // namespace cslam
