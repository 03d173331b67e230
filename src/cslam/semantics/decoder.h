// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/semantics/detection.h"
#include "cslam/semantics/model_description.h"

#include <span>
#include <string>
#include <vector>

namespace cslam {

// One output of a network: row-major values in the given shape.
struct TensorView {
  std::vector<int> shape;
  std::span<const float> values;
};

// "[1, 112, 2773]"
std::string ShapeText(const std::vector<int>& shape);

// Boxes in px of the network's input, not yet cut to it, of every place whose best class passes
// its threshold; before non-maximum suppression, in the order of the places. Scores and boxes
// that are not finite are left out. Cells are counted row by row, levels in the order of strides.
//
// nanodet, nanodet-plus: one output [1, C, N] or [1, N, C], or one [1, C, h, w] for each level,
//   C = 80 classes + 4 sides x bins. A side's distance from the cell's centre is the mean of the
//   softmax over its bins, in strides.
// yolox: [1, N, 85] or [1, 85, N]: x, y, w, h, objectness, 80 classes; score = product. Boxes are
//   relative to the cell and in strides (w and h as logarithms) unless is_decoded.
// yolov8: [1, 84, N] or [1, N, 84]: centre x, y, w, h in px, 80 class scores.
//
// Throws Error that names the model and both shapes if an output is not of the shape expected.
std::vector<Detection> DecodeOutputs(const ModelDescription& model,
                                     std::span<const TensorView> outputs);

}  // namespace cslam
