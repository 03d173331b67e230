// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/second_names.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace cslam {

std::vector<Detection> WithoutSecondNames(std::vector<Detection> detections, double max_iou) {
  std::vector<bool> is_second(detections.size());
  const auto is_better = [&](std::size_t a, std::size_t b) {
    return std::tuple(-detections[a].score, a) < std::tuple(-detections[b].score, b);
  };
  for (std::size_t i = 0; i < detections.size(); ++i) {
    const Detection& one = detections[i];
    if (one.class_id == kPersonClass) continue;
    for (std::size_t j = 0; j < detections.size() && !is_second[i]; ++j) {
      const Detection& other = detections[j];
      is_second[i] = other.class_id != one.class_id && other.class_id != kPersonClass &&
                     is_better(j, i) && Iou(one.box, other.box) >= max_iou;
    }
  }
  std::vector<Detection> kept;
  for (std::size_t i = 0; i < detections.size(); ++i) {
    if (!is_second[i]) kept.push_back(std::move(detections[i]));
  }
  return kept;
}

}  // namespace cslam
