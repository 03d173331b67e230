// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/rpe.h"

#include "cslam/util/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cslam {
namespace {

// How far along each matched pose is, in the unit of delta; never decreases.
std::vector<double> Progress(const std::vector<PosePair>& pairs, DeltaUnit unit) {
  std::vector<double> progress;
  double path_m = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i > 0)
      path_m += (pairs[i].reference.translation - pairs[i - 1].reference.translation).norm();
    switch (unit) {
      case DeltaUnit::kFrames:
        progress.push_back(static_cast<double>(i));
        break;
      case DeltaUnit::kSeconds:
        progress.push_back(SecondsBetween(pairs[i].stamp, pairs.front().stamp));
        break;
      case DeltaUnit::kMetres:
        progress.push_back(path_m);
        break;
    }
  }
  return progress;
}

// The later pose nearest to delta after pose first, if it is within the tolerance.
std::optional<std::size_t> FindPartner(const std::vector<double>& progress, std::size_t first,
                                       double delta, double tolerance) {
  const double wanted = progress[first] + delta;
  const auto begin = progress.begin() + static_cast<std::ptrdiff_t>(first) + 1;
  if (begin == progress.end()) return std::nullopt;
  auto nearest = std::lower_bound(begin, progress.end(), wanted);
  if (nearest == progress.end() ||
      (nearest != begin && wanted - *(nearest - 1) <= *nearest - wanted)) {
    --nearest;
  }
  // Room for rounding, so that stamps 0.1 s apart are.
  constexpr double kRounding = 1e-9;
  if (std::abs(*nearest - wanted) > tolerance + kRounding) return std::nullopt;
  return static_cast<std::size_t>(nearest - progress.begin());
}

RelativeError Compare(const std::vector<PosePair>& pairs, std::size_t first, std::size_t last) {
  const Se3 true_motion = pairs[first].reference.Inverse() * pairs[last].reference;
  const Se3 motion = pairs[first].estimate.Inverse() * pairs[last].estimate;
  const PoseDifference difference = Difference(true_motion, motion);
  return {first, last, difference.distance_m, difference.angle_rad};
}

std::vector<RelativeError> CompareMotions(const std::vector<PosePair>& pairs,
                                          const RpeOptions& options) {
  const std::vector<double> progress = Progress(pairs, options.unit);
  const double tolerance =
      options.unit == DeltaUnit::kFrames ? 0.0 : options.tolerance * options.delta;
  std::vector<RelativeError> errors;
  std::size_t first = 0;
  while (first < pairs.size()) {
    const std::optional<std::size_t> last = FindPartner(progress, first, options.delta, tolerance);
    if (last) errors.push_back(Compare(pairs, first, *last));
    first = last && options.pairs == RpePairs::kConsecutive ? *last : first + 1;
  }
  return errors;
}

void CheckOptions(const RpeOptions& options) {
  if (!(options.delta > 0.0 && std::isfinite(options.delta)))
    throw Error("delta {} is not a positive number", options.delta);
  if (options.unit == DeltaUnit::kFrames && options.delta != std::floor(options.delta))
    throw Error("delta {} is not a whole number of frames", options.delta);
  if (!(options.tolerance >= 0.0 && options.tolerance < 1.0))
    throw Error("delta tolerance {} is not between 0 and 1", options.tolerance);
}

const char* UnitName(const RpeOptions& options) {
  switch (options.unit) {
    case DeltaUnit::kFrames:
      return options.delta == 1.0 ? "frame" : "frames";
    case DeltaUnit::kSeconds:
      return "s";
    case DeltaUnit::kMetres:
      return "m";
  }
  return "";
}

}  // namespace

RpeResult EvaluateRpe(const Trajectory& reference, const Trajectory& estimate,
                      const RpeOptions& options) {
  CheckOptions(options);
  RpeResult result;
  result.options = options;
  result.association = AssociatePosesOrThrow(reference, estimate, options.association);
  result.errors = CompareMotions(result.association.pairs, options);
  if (result.errors.empty()) {
    throw Error("no two of the {} matched poses are {:g} {} apart; choose another --delta",
                result.association.pairs.size(), options.delta, UnitName(options));
  }
  std::vector<double> translations_m;
  std::vector<double> rotations_rad;
  for (const RelativeError& error : result.errors) {
    translations_m.push_back(error.translation_m);
    rotations_rad.push_back(error.rotation_rad);
  }
  result.translation_m = Summarise(translations_m);
  result.rotation_rad = Summarise(rotations_rad);
  return result;
}

std::string DescribeDelta(const RpeOptions& options) {
  const bool all = options.pairs == RpePairs::kAll;
  return fmt::format("delta {:g} {}, {} pairs", options.delta, UnitName(options),
                     all ? "all" : "consecutive");
}

}  // namespace cslam
