// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/semantics/coco.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cslam {

// What the numbers a network puts out mean (decoder.h).
enum class DecoderKind { kNanoDet, kNanoDetPlus, kYolox, kYolov8 };
std::string_view NameOf(DecoderKind kind);  // "nanodet", "nanodet-plus", "yolox", "yolov8"

// How an image is brought to the input size: squeezed to fit, or scaled evenly and padded.
enum class ResizeMode { kStretch, kLetterboxTopLeft, kLetterboxCentered };
std::string_view NameOf(ResizeMode mode);  // "stretch", "letterbox-top-left", "letterbox-centered"

// Score a detection needs, for each COCO class; above 1: never.
using ClassThresholds = std::array<double, kNumCocoClasses>;

// One network and how to use it: the YAML file beside <model>.onnx.
struct ModelDescription {
  std::string name;
  std::filesystem::path description_file;  // empty if it was not read from one
  std::filesystem::path onnx_file;
  std::string source;   // where the weights come from
  std::string licence;  // of the weights

  DecoderKind decoder = DecoderKind::kNanoDetPlus;
  int width_px = 416;  // of the input; multiples of 32
  int height_px = 416;
  ResizeMode resize = ResizeMode::kStretch;
  double pad_value = 114.0;                        // grey level of a letterbox' border
  bool is_rgb = false;                             // order of the input's channels
  std::array<double, 3> mean{0.0, 0.0, 0.0};       // subtracted, in the input's order
  std::array<double, 3> deviation{1.0, 1.0, 1.0};  // then divided by, in the input's order

  std::vector<int> strides{8, 16, 32};  // px of the input per cell, one level each
  bool is_logits = true;                // class scores still need a sigmoid
  bool is_decoded = false;              // YOLOX: boxes are in px already
  int num_bins = 8;                     // NanoDet: of each side's distance distribution
  double cell_offset = 0.0;             // NanoDet: of a cell's centre, in cells
  double nms_iou = 0.6;                 // overlap of two boxes of a class
  ClassThresholds thresholds{};
};

// What a decoder's models have in common; thresholds at 0.4.
ModelDescription DefaultDescription(DecoderKind decoder);

// Reads a model's YAML file. file: it, or the .onnx beside it. Throws Error "file:line: ..." for
// what is wrong in it, and one that says how to make it where there is none.
ModelDescription ReadModelDescription(const std::filesystem::path& file);

// "person=0.25,chair=0.5" sets these, "default=0.4" all of them; applied from left to right.
// Throws Error for an unknown class or a number outside 0 to 2.
void SetThresholds(ClassThresholds& thresholds, std::string_view text);

}  // namespace cslam
