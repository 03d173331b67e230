// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/assets/prop_library.h"

namespace cslam {

// Everything painted and built here: boxes, ellipsoids, turned and bent sheets. Needs no files.
class ProceduralProps : public PropLibrary {
 public:
  explicit ProceduralProps(double texels_per_m = 640.0) : texels_per_m_(texels_per_m) {}

  std::string_view look() const override { return "procedural"; }
  Eigen::Vector3d SizeM(PropKind kind, int variant) const override;
  double TopM(PropKind kind, int variant) const override;
  int Add(SceneBuilder& scene, PropKind kind, int variant, const std::string& name,
          const Se3& T_world_prop) const override;
  int AddSurface(SceneBuilder& scene, SurfaceKind kind, int variant) const override;
  cv::Mat Poster(int variant) const override;

 private:
  double texels_per_m_;
};

}  // namespace cslam
