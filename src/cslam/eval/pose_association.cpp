// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/pose_association.h"

#include "cslam/util/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace cslam {
namespace {

struct IndexPair {
  std::size_t in_few = 0;
  std::size_t in_many = 0;
  std::int64_t difference_ns = 0;
};

std::int64_t DifferenceNs(const StampedPose& a, const StampedPose& b) {
  return std::abs(a.stamp.ns - b.stamp.ns);
}

std::vector<IndexPair> MatchNearest(const Trajectory& few, const Trajectory& many,
                                    std::int64_t window_ns) {
  std::vector<IndexPair> matches;
  if (many.empty()) return matches;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < few.size(); ++i) {
    while (nearest + 1 < many.size() &&
           DifferenceNs(few[i], many[nearest + 1]) < DifferenceNs(few[i], many[nearest])) {
      ++nearest;
    }
    const IndexPair match{i, nearest, DifferenceNs(few[i], many[nearest])};
    if (match.difference_ns > window_ns) continue;
    if (!matches.empty() && matches.back().in_many == nearest) {
      if (match.difference_ns < matches.back().difference_ns) matches.back() = match;
    } else {
      matches.push_back(match);
    }
  }
  return matches;
}

PoseAssociation AssociateNearest(const Trajectory& reference, const Trajectory& estimate,
                                 double window_s) {
  const bool estimate_is_few = estimate.size() <= reference.size();
  const Trajectory& few = estimate_is_few ? estimate : reference;
  const Trajectory& many = estimate_is_few ? reference : estimate;
  PoseAssociation association;
  for (const IndexPair& match : MatchNearest(few, many, std::llround(1e9 * window_s))) {
    const StampedPose& e = estimate[estimate_is_few ? match.in_few : match.in_many];
    const StampedPose& r = reference[estimate_is_few ? match.in_many : match.in_few];
    association.pairs.push_back({e.stamp, r.T_world_camera, e.T_world_camera});
    association.max_difference_s =
        std::max(association.max_difference_s, 1e-9 * static_cast<double>(match.difference_ns));
  }
  return association;
}

PoseAssociation AssociateInterpolated(const Trajectory& reference, const Trajectory& estimate,
                                      double max_gap_s) {
  PoseAssociation association;
  auto after = reference.begin();
  for (const auto& [stamp, T_world_camera] : estimate) {
    while (after != reference.end() && after->stamp < stamp)
      ++after;
    if (after == reference.end()) break;
    if (after->stamp == stamp) {
      association.pairs.push_back({stamp, after->T_world_camera, T_world_camera});
      continue;
    }
    if (after == reference.begin()) continue;
    const StampedPose& before = *(after - 1);
    const double gap_s = SecondsBetween(after->stamp, before.stamp);
    if (gap_s > max_gap_s) continue;
    const double alpha = SecondsBetween(stamp, before.stamp) / gap_s;
    association.pairs.push_back(
        {stamp, Interpolate(before.T_world_camera, after->T_world_camera, alpha), T_world_camera});
  }
  return association;
}

void CheckSeconds(double seconds, const char* name) {
  constexpr double kLongest = 1e6;
  if (!(seconds >= 0.0 && seconds <= kLongest))
    throw Error("{} of {} s is not between 0 and {} s", name, seconds, kLongest);
}

double Share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

double PoseAssociation::EstimateShare() const {
  return Share(pairs.size(), num_estimate);
}

double PoseAssociation::ReferenceShare() const {
  return Share(pairs.size(), num_reference);
}

PoseAssociation AssociatePoses(const Trajectory& reference, const Trajectory& estimate,
                               const PoseAssociationOptions& options) {
  CheckSeconds(options.window_s, "association window");
  CheckSeconds(options.max_interpolated_gap_s, "longest interpolated gap");
  PoseAssociation association =
      options.mode == PoseAssociationMode::kNearest
          ? AssociateNearest(reference, estimate, options.window_s)
          : AssociateInterpolated(reference, estimate, options.max_interpolated_gap_s);
  association.num_reference = reference.size();
  association.num_estimate = estimate.size();
  return association;
}

PoseAssociation AssociatePosesOrThrow(const Trajectory& reference, const Trajectory& estimate,
                                      const PoseAssociationOptions& options) {
  if (reference.empty()) throw Error("the reference trajectory has no poses");
  if (estimate.empty()) throw Error("the estimated trajectory has no poses");
  PoseAssociation association = AssociatePoses(reference, estimate, options);
  if (association.pairs.empty()) {
    throw Error("no poses match ({}): the reference covers {} to {} s, the estimate {} to {} s",
                Describe(options), FormatStamp(reference.front().stamp, 3),
                FormatStamp(reference.back().stamp, 3), FormatStamp(estimate.front().stamp, 3),
                FormatStamp(estimate.back().stamp, 3));
  }
  return association;
}

std::string Describe(const PoseAssociationOptions& options) {
  if (options.mode == PoseAssociationMode::kNearest)
    return fmt::format("nearest stamp within {:g} s", options.window_s);
  return fmt::format("reference interpolated across gaps of at most {:g} s",
                     options.max_interpolated_gap_s);
}

}  // namespace cslam
