// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/coco.h"

#include "cslam/semantics/detection.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace cslam {
namespace {

constexpr std::array<std::string_view, kNumCocoClasses> kNames{
    "person",        "bicycle",      "car",
    "motorcycle",    "airplane",     "bus",
    "train",         "truck",        "boat",
    "traffic light", "fire hydrant", "stop sign",
    "parking meter", "bench",        "bird",
    "cat",           "dog",          "horse",
    "sheep",         "cow",          "elephant",
    "bear",          "zebra",        "giraffe",
    "backpack",      "umbrella",     "handbag",
    "tie",           "suitcase",     "frisbee",
    "skis",          "snowboard",    "sports ball",
    "kite",          "baseball bat", "baseball glove",
    "skateboard",    "surfboard",    "tennis racket",
    "bottle",        "wine glass",   "cup",
    "fork",          "knife",        "spoon",
    "bowl",          "banana",       "apple",
    "sandwich",      "orange",       "broccoli",
    "carrot",        "hot dog",      "pizza",
    "donut",         "cake",         "chair",
    "couch",         "potted plant", "bed",
    "dining table",  "toilet",       "tv",
    "laptop",        "mouse",        "remote",
    "keyboard",      "cell phone",   "microwave",
    "oven",          "toaster",      "sink",
    "refrigerator",  "book",         "clock",
    "vase",          "scissors",     "teddy bear",
    "hair drier",    "toothbrush"};

// As the lists of older detectors write them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kOldNames{{
    {"motorbike", "motorcycle"},
    {"aeroplane", "airplane"},
    {"sofa", "couch"},
    {"pottedplant", "potted plant"},
    {"diningtable", "dining table"},
    {"tvmonitor", "tv"},
}};

}  // namespace

std::string_view CocoClassName(int class_id) {
  if (class_id == kBackgroundClass) return "background";
  CSLAM_CHECK(class_id >= 0 && class_id < kNumCocoClasses, "{}", class_id);
  return kNames[static_cast<std::size_t>(class_id)];
}

std::optional<int> FindCocoClass(std::string_view name) {
  std::string wanted(name);
  std::ranges::replace(wanted, '_', ' ');
  for (const auto& [old_name, new_name] : kOldNames) {
    if (wanted == old_name) wanted = new_name;
  }
  const auto found = std::ranges::find(kNames, wanted);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<int>(found - kNames.begin());
}

std::string CocoClassKey(int class_id) {
  std::string key(CocoClassName(class_id));
  std::ranges::replace(key, ' ', '_');
  return key;
}

}  // namespace cslam
