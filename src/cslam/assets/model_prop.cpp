// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/model_prop.h"

#include "cslam/assets/mesh_tools.h"
#include "cslam/io/image_codec.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cslam {
namespace {

constexpr double kMaxSideM = 0.12;        // of triangles: light is stored per vertex
constexpr double kMinAreaM2 = 1e-9;       // a square of 0.03 mm: nothing one could see
constexpr double kCreaseRad = 0.7;        // edges sharper than 40 degrees stay sharp
constexpr double kMinOpacity = 0.5;       // less is glass
constexpr int kMaxTexturePx = 1024;       // larger pictures are halved
constexpr float kScreenEmission = 0.85F;  // of the texture: a lit screen in a lit room
constexpr double kFrameLevel = 38.0;  // grey level of screens' frames: detectors expect them dark
constexpr double kDarkest = 20.0;     // grey levels: nothing in a room is blacker or whiter
constexpr double kBrightest = 228.0;

enum class Role { kPicture, kScreen, kFabric, kPlain };

Role RoleOf(const ObjMaterial& material, const PackageModel& choice) {
  if (!choice.screen.empty() && material.name == choice.screen) return Role::kScreen;
  if (choice.fabric == "*" || (!choice.fabric.empty() && material.name == choice.fabric))
    return Role::kFabric;
  return material.texture.empty() ? Role::kPlain : Role::kPicture;
}

// Texture coordinates that stretch one picture over the material's triangles, seen from the front.
Mesh WithFrontUvs(Mesh mesh, int material) {
  Eigen::AlignedBox3f bounds;
  for (const Triangle& triangle : mesh.triangles) {
    if (triangle.material != material) continue;
    for (const std::uint32_t v : triangle.vertices)
      bounds.extend(mesh.positions[v]);
  }
  for (const Triangle& triangle : mesh.triangles) {
    if (triangle.material != material) continue;
    for (const std::uint32_t v : triangle.vertices) {
      const Eigen::Vector3f share =
          (mesh.positions[v] - bounds.min()).cwiseQuotient(bounds.sizes().cwiseMax(1e-6F));
      mesh.uvs[v] = {share.x(), 1.0F - share.z()};
    }
  }
  return mesh;
}

bool NameHas(const std::string& name, std::initializer_list<std::string_view> words) {
  std::string lower = name;
  std::ranges::transform(lower, lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return std::ranges::any_of(
      words, [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

// Is other colours of it all right? There are no blue plants and no pink bears.
bool TakesTint(PropKind kind) {
  switch (kind) {
    case PropKind::kChair:
    case PropKind::kCouch:
    case PropKind::kSuitcase:
    case PropKind::kMug:
    case PropKind::kBackpack:
      return true;
    default:
      return false;
  }
}

// The picture with its hues turned, paler; grey stays grey, and wood stays wood.
cv::Mat Tinted(const cv::Mat& bgr, int tint) {
  if (tint == 0) return bgr;
  constexpr int kHues = 180;     // of OpenCV's 8-bit HSV
  constexpr int kWoodFirst = 6;  // orange to brown
  constexpr int kWoodLast = 26;
  constexpr int kStep = 67;       // visits all hues, neighbours far apart
  constexpr double kPale = 0.65;  // of the saturation: detectors know no glaring furniture
  cv::Mat hsv;
  cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV);
  for (int y = 0; y < hsv.rows; ++y) {
    for (int x = 0; x < hsv.cols; ++x) {
      auto& pixel = hsv.at<cv::Vec3b>(y, x);
      const bool is_wood = pixel[0] >= kWoodFirst && pixel[0] <= kWoodLast;
      if (is_wood) continue;
      pixel[0] = static_cast<uchar>((pixel[0] + tint * kStep) % kHues);
      pixel[1] = static_cast<uchar>(kPale * pixel[1]);
    }
  }
  cv::Mat result;
  cv::cvtColor(hsv, result, cv::COLOR_HSV2BGR);
  return result;
}

cv::Mat LimitedSize(const cv::Mat& image) {
  const double scale = static_cast<double>(kMaxTexturePx) / std::max(image.cols, image.rows);
  if (scale >= 1.0) return image;
  cv::Mat result;
  cv::resize(image, result, cv::Size(), scale, scale, cv::INTER_AREA);
  return result;
}

cv::Scalar PlainColor(const ObjMaterial& material, int tint) {
  const auto level = [](double share) {
    return static_cast<uchar>(std::clamp(255.0 * share, kDarkest, kBrightest));
  };
  const Eigen::Vector3d& rgb = material.diffuse;
  const cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(level(rgb.z()), level(rgb.y()), level(rgb.x())));
  const cv::Vec3b color = Tinted(pixel, tint).at<cv::Vec3b>(0, 0);
  return {static_cast<double>(color[0]), static_cast<double>(color[1]),
          static_cast<double>(color[2])};
}

int PaintPlainMaterial(const ObjMaterial& material, PropKind kind, int tint, PropBrush& brush) {
  if (kind == PropKind::kMonitor || kind == PropKind::kTelevision)
    return brush.Plain(cv::Scalar::all(kFrameLevel));
  if (NameHas(material.name, {"wood", "oak", "walnut", "pine", "legno", "madera"}))
    return brush.Wood(PlainColor(material, 0));
  const cv::Scalar color = PlainColor(material, tint);
  if (NameHas(material.name, {"textile", "fabric", "cloth", "cushion", "cuscin", "sofa", "seat"}))
    return brush.Fabric(color);
  return brush.Plain(color);
}

}  // namespace

ModelFit FitModel(const PackageModel& choice, const CatalogueEntry& entry) {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  const Eigen::Matrix3d R_z_up =
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Eigen::Matrix3d R_yaw =
      Eigen::AngleAxisd(choice.yaw_deg * kRadPerDeg, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  ModelFit fit;
  fit.R_prop_model = R_yaw * R_z_up * entry.R_upright_model;
  // Right angles only: the box's sides change places.
  const Eigen::Vector3d own_m = (R_yaw * entry.size_m).cwiseAbs();
  const Eigen::Vector3d ratios = StandardSizeM(choice.kind).cwiseQuotient(own_m);
  const double common = ratios.minCoeff();
  fit.size_m = own_m.cwiseProduct(ratios.cwiseMin(common * choice.max_stretch));
  const bool has_seat = choice.kind == PropKind::kChair || choice.kind == PropKind::kArmchair ||
                        choice.kind == PropKind::kCouch;
  if (has_seat && entry.top_m) {
    fit.top_m = *entry.top_m * fit.size_m.z() / entry.size_m.z();
  } else if (StandardTopM(choice.kind) < StandardSizeM(choice.kind).z()) {
    fit.top_m = StandardTopM(choice.kind);
  } else {
    fit.top_m = fit.size_m.z();
  }
  return fit;
}

Mesh PrepareModel(ObjModel model, const PackageModel& choice, const ModelFit& fit) {
  const auto material_of = [&](std::size_t t) -> const ObjMaterial& {
    return model.materials[static_cast<std::size_t>(model.mesh.triangles[t].material)];
  };
  Mesh mesh =
      Filtered(model.mesh, [&](std::size_t t) { return material_of(t).opacity >= kMinOpacity; });
  mesh = Mapped(std::move(mesh), Eigen::Affine3d(fit.R_prop_model));
  const Eigen::AlignedBox3d bounds = BoundsOf(mesh);
  const Eigen::Vector3d bottom(bounds.center().x(), bounds.center().y(), bounds.min().z());
  const Eigen::Vector3d scale = fit.size_m.cwiseQuotient(bounds.sizes().cwiseMax(1e-9));
  mesh = Mapped(std::move(mesh), Eigen::Scaling(scale) * Eigen::Translation3d(-bottom));
  mesh = Cleaned(mesh, kMinAreaM2);
  mesh = WithNormals(FacingOutwards(std::move(mesh)), kCreaseRad);
  for (std::size_t m = 0; m < model.materials.size(); ++m) {
    const int index = static_cast<int>(m);
    switch (RoleOf(model.materials[m], choice)) {
      case Role::kPicture:
        break;
      case Role::kScreen:
        mesh = WithFrontUvs(std::move(mesh), index);
        break;
      case Role::kFabric:
        mesh = WithBoxUvs(std::move(mesh), index, PropBrush::kRichM);
        break;
      case Role::kPlain:
        mesh = WithBoxUvs(std::move(mesh), index, PropBrush::kPatchM);
        break;
    }
  }
  return Welded(Subdivided(mesh, kMaxSideM));
}

std::vector<int> PaintModel(const std::vector<ObjMaterial>& materials, const PackageModel& choice,
                            int round, PropBrush& brush) {
  const int tint = TakesTint(choice.kind) ? round : 0;
  std::vector<int> indices;
  for (const ObjMaterial& material : materials) {
    switch (RoleOf(material, choice)) {
      case Role::kPicture:
        indices.push_back(
            brush.Picture(Tinted(LimitedSize(ReadColorImage(material.texture)), tint)));
        break;
      case Role::kScreen:
        indices.push_back(brush.Picture(PaintLitScreen(brush.Texels(0.5, 0.3), brush.NextRng()),
                                        kScreenEmission));
        break;
      case Role::kFabric:
        indices.push_back(brush.RichFabric());
        break;
      case Role::kPlain:
        indices.push_back(PaintPlainMaterial(material, choice.kind, tint, brush));
        break;
    }
  }
  return indices;
}

}  // namespace cslam
