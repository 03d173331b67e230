// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/package_props.h"

#include "cslam/assets/asset_sources.h"
#include "cslam/assets/model_prop.h"
#include "cslam/io/image_codec.h"
#include "cslam/sim/paint_tools.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace cslam {
namespace {

// Streams of the painters' generators; the variant is the purpose.
constexpr std::uint64_t kLookSeed = 20261;
constexpr std::uint64_t kSurfaceStream = 1000;

// The variant's place in a list, and how often the list was gone through before.
struct Pick {
  std::size_t index;
  int round;
};

Pick PickFrom(std::size_t count, int variant) {
  const auto number = static_cast<std::uint32_t>(variant);
  return {number % count, static_cast<int>(number / count % 1000)};
}

// The texture laid side by side, then aged unevenly so that no two places look the same.
cv::Mat Laid(const cv::Mat& tile, int count, double texels_per_m, Rng rng) {
  constexpr double kShade = 0.16;  // share by which light and dark differ from the mean
  cv::Mat image;
  cv::repeat(tile, count, count, image);
  const cv::Size2d spacing(0.5 * texels_per_m, 0.5 * texels_per_m);
  const cv::Mat noise = FractalNoise(image.size(), spacing, 7, rng);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const double factor = 1.0 + kShade * static_cast<double>(noise.at<float>(y, x));
      auto& pixel = image.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c)
        pixel[c] = cv::saturate_cast<uchar>(factor * pixel[c]);
    }
  }
  return image;
}

// Upright pictures in white mounts: detectors take wide ones on a wall for screens.
constexpr int kPosterWidthPx = 1000;
constexpr double kHeightPerWidth = 1.35;
constexpr double kMountShare = 0.07;  // of the poster's width, on each side

cv::Mat UprightPart(const cv::Mat& image, double height_share, Rng& rng) {
  const double height_px = std::min(height_share * image.rows, kHeightPerWidth * image.cols);
  const cv::Size part(static_cast<int>(height_px / kHeightPerWidth), static_cast<int>(height_px));
  return image(cv::Rect(
      {RandomInt(rng, 0, image.cols - part.width), RandomInt(rng, 0, image.rows - part.height)},
      part));
}

cv::Mat Framed(const cv::Mat& picture) {
  constexpr double kWhite = 215.0;  // grey level
  const int mount_px = static_cast<int>(kMountShare * kPosterWidthPx);
  const int width_px = kPosterWidthPx - 2 * mount_px;
  cv::Mat poster;
  cv::resize(picture, poster, {width_px, width_px * picture.rows / picture.cols}, 0.0, 0.0,
             cv::INTER_AREA);
  cv::copyMakeBorder(poster, poster, mount_px, mount_px, mount_px, mount_px, cv::BORDER_CONSTANT,
                     cv::Scalar::all(kWhite));
  return poster;
}

}  // namespace

PackageProps::PackageProps(AssetFolder folder, double texels_per_m)
    : folder_(std::move(folder)), texels_per_m_(texels_per_m), procedural_(texels_per_m) {
  for (const PackageModel& model : PackageModels()) {
    if (catalogues_.contains(model.catalogue)) continue;
    catalogues_.emplace(model.catalogue,
                        FurnitureCatalogue::Read(folder_.File(CatalogueFile(model.catalogue))));
  }
}

Eigen::Vector3d PackageProps::SizeM(PropKind kind, int /*variant*/) const {
  return StandardSizeM(kind);
}

double PackageProps::TopM(PropKind kind, int variant) const {
  const std::vector<PackageModel> models = ModelsOf(kind);
  if (models.empty()) return procedural_.TopM(kind, variant);
  const PackageModel& choice = models[PickFrom(models.size(), variant).index];
  return FitModel(choice, catalogues_.at(choice.catalogue).Entry(choice.path)).top_m;
}

int PackageProps::Add(SceneBuilder& scene, PropKind kind, int variant, const std::string& name,
                      const Se3& T_world_prop) const {
  const std::vector<PackageModel> models = ModelsOf(kind);
  if (models.empty()) return procedural_.Add(scene, kind, variant, name, T_world_prop);
  const Pick pick = PickFrom(models.size(), variant);
  const PackageModel& choice = models[pick.index];
  const CatalogueEntry& entry = catalogues_.at(choice.catalogue).Entry(choice.path);
  ObjModel model = ReadObjModel(folder_.File(ModelFile(choice.catalogue, choice.path)));
  PropBrush brush(
      scene, texels_per_m_,
      Rng(kLookSeed, static_cast<std::uint64_t>(kind), static_cast<std::uint64_t>(variant)));
  const std::vector<int> materials = PaintModel(model.materials, choice, pick.round, brush);
  Mesh mesh = PrepareModel(std::move(model), choice, FitModel(choice, entry));
  for (Triangle& triangle : mesh.triangles)
    triangle.material = materials[static_cast<std::size_t>(triangle.material)];
  return scene.AddObject(name, CocoClassOf(kind), T_world_prop,
                         [&](MeshBuilder& builder) { builder.AddMesh(mesh); });
}

int PackageProps::AddSurface(SceneBuilder& scene, SurfaceKind kind, int variant) const {
  std::vector<PackageTexture> textures;
  std::ranges::copy_if(PackageTextures(), std::back_inserter(textures),
                       [&](const PackageTexture& texture) { return texture.kind == kind; });
  if (textures.empty()) return procedural_.AddSurface(scene, kind, variant);
  const PackageTexture& choice = textures[PickFrom(textures.size(), variant).index];
  cv::Mat tile = ReadColorImage(folder_.File("textures/" + std::string(choice.file)));
  if (kind == SurfaceKind::kRug) return scene.AddPicture(tile);
  constexpr double kWholeM = 3.0;  // about what the finished picture shows
  const int count = std::max(1, static_cast<int>(std::lround(kWholeM / choice.period_m)));
  const double tile_height_m = choice.period_m * tile.rows / tile.cols;
  cv::resize(tile, tile, TexelSize(choice.period_m, tile_height_m, texels_per_m_), 0.0, 0.0,
             cv::INTER_CUBIC);
  const Rng rng(kLookSeed, kSurfaceStream + static_cast<std::uint64_t>(kind),
                static_cast<std::uint64_t>(variant));
  return scene.AddSurface(Laid(tile, count, texels_per_m_, rng), count * choice.period_m,
                          count * tile_height_m);
}

cv::Mat PackageProps::Poster(int variant) const {
  constexpr double kPartShare = 0.6;  // of a picture's height that later rounds show
  const Pick pick = PickFrom(PackagePosters().size(), variant);
  const cv::Mat image = ReadColorImage(folder_.File(PosterFile(PackagePosters()[pick.index])));
  Rng rng(kLookSeed, static_cast<std::uint64_t>(variant));
  return Framed(UprightPart(image, pick.round > 0 ? kPartShare : 1.0, rng));
}

}  // namespace cslam
