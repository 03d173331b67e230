// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/assets/asset_folder.h"
#include "cslam/assets/furniture_catalogue.h"
#include "cslam/assets/package_models.h"
#include "cslam/assets/procedural_props.h"

#include <map>
#include <string_view>

namespace cslam {

// Models and pictures of Debian packages; the procedural ones where there are none. A variant
// picks the model, and with numbers beyond the models of its kind, other colours.
class PackageProps : public PropLibrary {
 public:
  explicit PackageProps(AssetFolder folder, double texels_per_m = 640.0);

  std::string_view look() const override { return "packages"; }
  Eigen::Vector3d SizeM(PropKind kind, int variant) const override;
  double TopM(PropKind kind, int variant) const override;
  int Add(SceneBuilder& scene, PropKind kind, int variant, const std::string& name,
          const Se3& T_world_prop) const override;
  int AddSurface(SceneBuilder& scene, SurfaceKind kind, int variant) const override;
  cv::Mat Poster(int variant) const override;

 private:
  AssetFolder folder_;
  double texels_per_m_;
  ProceduralProps procedural_;
  std::map<std::string_view, FurnitureCatalogue> catalogues_;
};

}  // namespace cslam
