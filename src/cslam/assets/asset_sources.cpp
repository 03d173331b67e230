// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/asset_sources.h"

#include "cslam/assets/package_models.h"

#include <fmt/core.h>

#include <set>

namespace cslam {
namespace {

constexpr std::string_view kCatalogueName = "PluginFurnitureCatalog.properties";

// A member of a model archive that is a whole folder: "/scopia/chair/chair.obj" -> "scopia/chair/".
std::string FolderOf(std::string_view model) {
  return std::string(model.substr(1, model.rfind('/')));
}

}  // namespace

std::string CatalogueFile(std::string_view catalogue) {
  return fmt::format("models/{}/{}", catalogue, kCatalogueName);
}

std::string ModelFile(std::string_view catalogue, std::string_view model) {
  return fmt::format("models/{}{}", catalogue, model);
}

std::vector<AssetSource> AllAssetSources() {
  std::vector<AssetSource> sources;
  const auto archive = [](std::string_view catalogue) {
    return fmt::format("sweethome3d/furniture/{}.sh3f", catalogue);
  };
  std::set<std::string> folders;
  std::set<std::string_view> catalogues;
  for (const PackageModel& model : PackageModels()) {
    catalogues.insert(model.catalogue);
    const std::string folder = FolderOf(model.path);
    if (!folders.insert(folder).second) continue;
    sources.push_back({"sweethome3d-furniture", archive(model.catalogue), folder,
                       fmt::format("models/{}/{}", model.catalogue, folder)});
  }
  for (const std::string_view catalogue : catalogues)
    sources.push_back({"sweethome3d-furniture", archive(catalogue), std::string(kCatalogueName),
                       CatalogueFile(catalogue)});
  for (const PackageTexture& texture : PackageTextures())
    sources.push_back({"ufoai-textures", "games/ufoai/base/0textures.pk3",
                       fmt::format("textures/tex_buildings/{}", texture.file),
                       fmt::format("textures/{}", texture.file)});
  for (const PackagePoster& poster : PackagePosters())
    sources.push_back({"plasma-workspace-wallpapers",
                       fmt::format("wallpapers/{}/contents/images/{}", poster.name, poster.file),
                       "", PosterFile(poster)});
  sources.push_back({"morse-simulator-data", "morse/data/robots/human_rig.blend", "",
                     std::string(kHumanRigFile)});
  return sources;
}

}  // namespace cslam
