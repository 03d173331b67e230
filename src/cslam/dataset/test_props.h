// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/assets/prop_library.h"

#include <opencv2/core/mat.hpp>

#include <string>
#include <string_view>

namespace cslam {

// Every prop as a plain box of its standard size: all that the geometry of a story needs, made in
// no time.
class BoxProps : public PropLibrary {
 public:
  std::string_view look() const override { return "boxes"; }

  Eigen::Vector3d SizeM(PropKind kind, int) const override { return StandardSizeM(kind); }
  double TopM(PropKind kind, int) const override { return StandardTopM(kind); }

  int Add(SceneBuilder& scene, PropKind kind, int variant, const std::string& name,
          const Se3& T_world_prop) const override {
    return scene.AddBox(name, CocoClassOf(kind), T_world_prop, SizeM(kind, variant),
                        Uniform(scene.AddPicture(Grey())));
  }

  int AddSurface(SceneBuilder& scene, SurfaceKind, int) const override {
    return scene.AddSurface(Grey(), 1.0, 1.0);
  }

  cv::Mat Poster(int) const override { return Grey(); }

 private:
  static cv::Mat Grey() { return {3, 4, CV_8UC3, cv::Scalar(128, 128, 128)}; }
};

}  // namespace cslam
