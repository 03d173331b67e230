// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/scene_score.h"

namespace cslam {
namespace {

std::optional<double> Share(int part, int whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / whole;
}

}  // namespace

SceneEvalOptions WithKnownClasses(const SceneEvalOptions& options, const TrueObjects& objects) {
  SceneEvalOptions known = options;
  if (known.classes.empty()) known.classes = ClassesOf(objects);
  return known;
}

SceneEvalOptions WithGapOf(const SceneEvalOptions& options, const SceneTruth& truth,
                           const SceneRun& run) {
  SceneEvalOptions with_gap = options;
  if (!run.earlier) return with_gap;
  with_gap.clear_view.gap_from_s = truth.TimeOf(run.earlier->to);
  with_gap.clear_view.gap_to_s = truth.TimeOf(run.first_stamp());
  return with_gap;
}

std::optional<double> DetectionScore::Precision() const {
  return Share(num_matched, num_reported);
}

std::optional<double> DetectionScore::Recall() const {
  return Share(num_matched, num_true);
}

std::optional<double> DetectionScore::F1() const {
  return Share(2 * num_matched, num_true + num_reported);
}

DetectionScore& DetectionScore::operator+=(const DetectionScore& other) {
  num_true += other.num_true;
  num_reported += other.num_reported;
  num_matched += other.num_matched;
  return *this;
}

}  // namespace cslam
