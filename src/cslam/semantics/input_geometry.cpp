// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/input_geometry.h"

#include "cslam/util/check.h"

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

// The size the image takes up along one axis; a scale may be far from 1, so it keeps a pixel.
int ContentSize(int image_px, double scale, int input_px) {
  return std::clamp(static_cast<int>(std::lround(image_px * scale)), 1, input_px);
}

}  // namespace

InputGeometry FitImage(ResizeMode mode, int image_width_px, int image_height_px, int input_width_px,
                       int input_height_px) {
  CSLAM_CHECK(image_width_px > 0 && image_height_px > 0, "{} x {}", image_width_px,
              image_height_px);
  CSLAM_CHECK(input_width_px > 0 && input_height_px > 0);
  InputGeometry geometry{.image_width_px = image_width_px,
                         .image_height_px = image_height_px,
                         .content_width_px = input_width_px,
                         .content_height_px = input_height_px};
  if (mode != ResizeMode::kStretch) {
    const double scale = std::min(static_cast<double>(input_width_px) / image_width_px,
                                  static_cast<double>(input_height_px) / image_height_px);
    geometry.content_width_px = ContentSize(image_width_px, scale, input_width_px);
    geometry.content_height_px = ContentSize(image_height_px, scale, input_height_px);
  }
  if (mode == ResizeMode::kLetterboxCentered) {
    geometry.offset_x_px = (input_width_px - geometry.content_width_px) / 2;
    geometry.offset_y_px = (input_height_px - geometry.content_height_px) / 2;
  }
  geometry.scale_x = static_cast<double>(geometry.content_width_px) / image_width_px;
  geometry.scale_y = static_cast<double>(geometry.content_height_px) / image_height_px;
  return geometry;
}

Box ToImage(const InputGeometry& geometry, const Box& input_box) {
  const Box box{(input_box.x_min - geometry.offset_x_px) / geometry.scale_x,
                (input_box.y_min - geometry.offset_y_px) / geometry.scale_y,
                (input_box.x_max - geometry.offset_x_px) / geometry.scale_x,
                (input_box.y_max - geometry.offset_y_px) / geometry.scale_y};
  return Intersect(box, {0.0, 0.0, static_cast<double>(geometry.image_width_px),
                         static_cast<double>(geometry.image_height_px)});
}

}  // namespace cslam
