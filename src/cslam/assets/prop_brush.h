// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/assets/curved_shapes.h"
#include "cslam/sim/scene_builder.h"
#include "cslam/util/random.h"

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <functional>

namespace cslam {

// Paints the materials of one procedural prop. What it paints depends on the generator alone, not
// on what else is in the scene.
class PropBrush {
 public:
  PropBrush(SceneBuilder& scene, double texels_per_m, Rng rng)
      : scene_(scene), texels_per_m_(texels_per_m), rng_(rng) {}

  // All but pictures repeat with the period kPatchM.
  int Wood();
  int Wood(const cv::Scalar& color_bgr);
  int Fabric(double saturation, double value);
  int Fabric(const cv::Scalar& color_bgr);
  int Plain(const cv::Scalar& color_bgr);
  int Fur(const cv::Scalar& color_bgr);
  int RichFabric();  // period kRichM
  int Picture(const cv::Mat& image, float emission = 0.0F) {
    return scene_.AddPicture(image, emission);
  }

  cv::Size Texels(double width_m, double height_m) const;
  double texels_per_m() const { return texels_per_m_; }
  Rng& rng() { return rng_; }
  Rng NextRng() { return Rng(rng_.NextUint64()); }

  static constexpr double kPatchM = 0.5;
  static constexpr double kRichM = 1.0;

 private:
  SceneBuilder& scene_;
  double texels_per_m_;
  Rng rng_;
};

// An irregular, rich pattern for upholstery: flowers, leaves and blots of many sizes, with no
// regular lattice. CV_8UC3.
cv::Mat PaintRichFabric(cv::Size size, double texels_per_m, Rng rng);

// What a screen shows: a dark desktop with two windows. CV_8UC3.
cv::Mat PaintLitScreen(cv::Size size, Rng rng);

using PropShape = std::function<void(MeshBuilder&)>;

// Each paints its materials and returns what fills a mesh of the kind's standard size.
PropShape ChairShape(PropBrush& brush);
PropShape ArmchairShape(PropBrush& brush);
PropShape CouchShape(PropBrush& brush);
PropShape TableShape(PropBrush& brush);
PropShape DeskShape(PropBrush& brush);
PropShape BookcaseShape(PropBrush& brush);
PropShape CabinetShape(PropBrush& brush);
PropShape CartonShape(PropBrush& brush);

PropShape MonitorShape(PropBrush& brush);
PropShape TelevisionShape(PropBrush& brush);
PropShape LaptopShape(PropBrush& brush);
PropShape KeyboardShape(PropBrush& brush);
PropShape BooksShape(PropBrush& brush);
PropShape SuitcaseShape(PropBrush& brush);

PropShape TeddyBearShape(PropBrush& brush);
PropShape UmbrellaShape(PropBrush& brush);
PropShape MugShape(PropBrush& brush);
PropShape BottleShape(PropBrush& brush);
PropShape PottedPlantShape(PropBrush& brush);
PropShape BackpackShape(PropBrush& brush);

}  // namespace cslam
