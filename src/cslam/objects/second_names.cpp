// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/second_names.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace cslam {

std::vector<Detection> WithoutSecondNames(std::vector<Detection> detections, double max_iou) {
  std::vector<std::size_t> by_score(detections.size());
  std::iota(by_score.begin(), by_score.end(), std::size_t{0});
  std::stable_sort(by_score.begin(), by_score.end(), [&](std::size_t a, std::size_t b) {
    return detections[a].score > detections[b].score;
  });
  std::vector<std::size_t> first_names;
  for (const std::size_t i : by_score) {
    const Detection& one = detections[i];
    const bool is_second = std::any_of(first_names.begin(), first_names.end(), [&](std::size_t j) {
      const Detection& other = detections[j];
      return one.class_id != other.class_id && one.class_id != kPersonClass &&
             other.class_id != kPersonClass && Iou(one.box, other.box) >= max_iou;
    });
    if (!is_second) first_names.push_back(i);
  }
  std::sort(first_names.begin(), first_names.end());
  std::vector<Detection> kept;
  kept.reserve(first_names.size());
  for (const std::size_t i : first_names)
    kept.push_back(std::move(detections[i]));
  return kept;
}

}  // namespace cslam
