// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/scene.h"
#include "cslam/util/random.h"

#include <opencv2/core/mat.hpp>

#include <functional>
#include <string>

namespace cslam {

// Puts a scene together: materials first, then objects made of them. Every object and every
// painter gets its own generator, so that an addition does not change the rest of its kind.
class SceneBuilder {
 public:
  SceneBuilder(std::uint64_t seed, double light_cell_m) : rng_(seed), light_cell_m_(light_cell_m) {}

  // image (CV_8UC3) stretched over each face.
  int AddPicture(const cv::Mat& image, float emission = 0.0F);
  // image repeated with the given period, at random offsets.
  int AddSurface(const cv::Mat& image, double width_m, double height_m);

  // shape fills the mesh in the object's frame. Returns the instance id.
  int AddObject(const std::string& name, int class_id, const Se3& T_world_object,
                const std::function<void(MeshBuilder&)>& shape);

  // A box that stands on its bottom at T_world_object.
  int AddBox(const std::string& name, int class_id, const Se3& T_world_object,
             const Eigen::Vector3d& size_m, const BoxLook& look);

  Rng NextRng() { return Rng(rng_.NextUint64()); }
  Rng& rng() { return rng_; }
  double light_cell_m() const { return light_cell_m_; }

  Scene Take(const Lighting& lighting);

 private:
  Scene scene_;
  Rng rng_;
  double light_cell_m_;
};

}  // namespace cslam
