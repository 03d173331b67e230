// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/semantics/model_description.h"
#include "cslam/vision/box.h"

namespace cslam {

// Where an image lies in a network's input: input = image * scale + offset, edges of pixels to
// edges of pixels.
struct InputGeometry {
  int image_width_px = 0;
  int image_height_px = 0;
  int content_width_px = 0;  // of the image within the input, whole pixels
  int content_height_px = 0;
  int offset_x_px = 0;
  int offset_y_px = 0;
  double scale_x = 1.0;  // input px per image px
  double scale_y = 1.0;
};

// All sizes positive.
InputGeometry FitImage(ResizeMode mode, int image_width_px, int image_height_px, int input_width_px,
                       int input_height_px);

// A box of the input, in px of the image and cut to it; empty() if nothing is left.
Box ToImage(const InputGeometry& geometry, const Box& input_box);

}  // namespace cslam
