// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/matching.h"

#include "cslam/util/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cslam {
namespace {

constexpr int kNone = std::numeric_limits<int>::max();

struct Best {
  int keypoint = -1;
  int distance = kNone;
  int octave = -1;
  int second_distance = kNone;  // of the best in the same octave

  bool IsGood(const MatchOptions& options) const {
    if (keypoint < 0 || distance > options.max_distance) return false;
    return second_distance == kNone || distance <= options.max_ratio * second_distance;
  }
};

// Keeps the best and, for the ratio test, the second best wherever it lies.
void Offer(Best& best, int& second_octave, int keypoint, int distance, int octave) {
  if (distance < best.distance) {
    best.second_distance = best.distance;
    second_octave = best.octave;
    best.distance = distance;
    best.octave = octave;
    best.keypoint = keypoint;
  } else if (distance < best.second_distance) {
    best.second_distance = distance;
    second_octave = octave;
  }
}

Best FindNear(const FrameFeatures& features, const ProjectionQuery& query,
              std::span<const std::uint8_t> keypoint_is_taken) {
  Best best;
  int second_octave = -1;
  const float radius = query.radius_px;
  features.grid.VisitNear(query.uv_px, radius, [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    const Keypoint& keypoint = features.keypoints[i];
    if (keypoint.octave < query.min_octave || keypoint.octave > query.max_octave) return;
    if (std::abs(keypoint.uv_px.x() - query.uv_px.x()) > radius ||
        std::abs(keypoint.uv_px.y() - query.uv_px.y()) > radius) {
      return;
    }
    if (!keypoint_is_taken.empty() && keypoint_is_taken[i] != 0) return;
    if (query.disparity_px >= 0.0F && keypoint.disparity_px >= 0.0F) {
      // The virtual right image moves with the left one: compare the right coordinates.
      const float right =
          (keypoint.uv_px.x() - keypoint.disparity_px) - (query.uv_px.x() - query.disparity_px);
      if (std::abs(right) > radius) return;
    }
    Offer(best, second_octave, index, HammingDistance(query.descriptor, features.descriptors[i]),
          keypoint.octave);
  });
  // A rival at another scale is often the same corner: no sign of ambiguity.
  if (second_octave != best.octave) best.second_distance = kNone;
  return best;
}

// Keeps the matches in the three fullest bins of a histogram of rotations.
std::vector<Match> KeepMajorityRotation(const std::vector<Match>& matches,
                                        std::span<const float> rotations_rad) {
  constexpr int kBins = 30;
  constexpr double kTwoPi = 2.0 * std::numbers::pi;
  std::array<int, kBins> counts{};
  std::vector<int> bins(matches.size(), -1);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    double rotation = std::fmod(static_cast<double>(rotations_rad[i]), kTwoPi);
    if (rotation < 0.0) rotation += kTwoPi;
    bins[i] = std::min(static_cast<int>(std::lround(rotation / kTwoPi * kBins)) % kBins, kBins - 1);
    ++counts[static_cast<std::size_t>(bins[i])];
  }
  std::array<int, kBins> order{};
  for (int b = 0; b < kBins; ++b)
    order[static_cast<std::size_t>(b)] = b;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return counts[static_cast<std::size_t>(a)] > counts[static_cast<std::size_t>(b)];
  });
  const int largest = counts[static_cast<std::size_t>(order[0])];
  std::array<bool, kBins> keep{};
  for (std::size_t rank = 0; rank < 3; ++rank) {
    const auto bin = static_cast<std::size_t>(order[rank]);
    keep[bin] = 10 * counts[bin] >= largest;  // a bin ten times smaller is noise
  }
  std::vector<Match> kept;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (keep[static_cast<std::size_t>(bins[i])]) kept.push_back(matches[i]);
  }
  return kept;
}

// One query per keypoint: the smaller distance wins, then the smaller query index.
std::vector<Match> MakeUnique(const std::vector<Match>& matches, std::size_t num_keypoints) {
  std::vector<int> winner(num_keypoints, -1);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    int& w = winner[static_cast<std::size_t>(matches[i].keypoint)];
    if (w < 0 || matches[i].distance < matches[static_cast<std::size_t>(w)].distance) {
      w = static_cast<int>(i);
    }
  }
  std::vector<Match> unique;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (winner[static_cast<std::size_t>(matches[i].keypoint)] == static_cast<int>(i)) {
      unique.push_back(matches[i]);
    }
  }
  return unique;
}

}  // namespace

std::vector<Match> MatchByProjection(const FrameFeatures& features,
                                     std::span<const ProjectionQuery> queries,
                                     const MatchOptions& options,
                                     std::span<const std::uint8_t> keypoint_is_taken) {
  CSLAM_CHECK(keypoint_is_taken.empty() || keypoint_is_taken.size() == features.size());
  std::vector<Match> matches;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const Best best = FindNear(features, queries[q], keypoint_is_taken);
    if (!best.IsGood(options)) continue;
    matches.push_back({static_cast<int>(q), best.keypoint, best.distance});
  }
  matches = MakeUnique(matches, features.size());
  if (!options.check_rotation) return matches;
  std::vector<float> rotations;
  rotations.reserve(matches.size());
  for (const Match& match : matches) {
    rotations.push_back(queries[static_cast<std::size_t>(match.query)].angle_rad -
                        features.keypoints[static_cast<std::size_t>(match.keypoint)].angle_rad);
  }
  return KeepMajorityRotation(matches, rotations);
}

std::vector<Match> MatchByDescriptor(const FrameFeatures& a, std::span<const int> indices_a,
                                     const FrameFeatures& b, std::span<const int> indices_b,
                                     const MatchOptions& options) {
  std::vector<int> best_a_of_b(indices_b.size(), -1);
  std::vector<int> distance_of_b(indices_b.size(), kNone);
  std::vector<Match> one_way;  // keypoint: position in indices_b for now
  for (const int index_a : indices_a) {
    const Descriptor& descriptor = a.descriptors[static_cast<std::size_t>(index_a)];
    Best best;
    for (std::size_t j = 0; j < indices_b.size(); ++j) {
      const int distance =
          HammingDistance(descriptor, b.descriptors[static_cast<std::size_t>(indices_b[j])]);
      if (distance < distance_of_b[j]) {
        distance_of_b[j] = distance;
        best_a_of_b[j] = index_a;
      }
      if (distance < best.distance) {
        best.second_distance = best.distance;
        best.distance = distance;
        best.keypoint = static_cast<int>(j);
      } else if (distance < best.second_distance) {
        best.second_distance = distance;
      }
    }
    if (best.IsGood(options)) one_way.push_back({index_a, best.keypoint, best.distance});
  }
  std::vector<Match> mutual;
  std::vector<float> rotations;
  for (const Match& match : one_way) {
    const auto j = static_cast<std::size_t>(match.keypoint);
    if (best_a_of_b[j] != match.query) continue;
    mutual.push_back({match.query, indices_b[j], match.distance});
    rotations.push_back(a.keypoints[static_cast<std::size_t>(match.query)].angle_rad -
                        b.keypoints[static_cast<std::size_t>(indices_b[j])].angle_rad);
  }
  if (!options.check_rotation || mutual.empty()) return mutual;
  return KeepMajorityRotation(mutual, rotations);
}

std::size_t MedoidIndex(std::span<const Descriptor> descriptors) {
  CSLAM_CHECK(!descriptors.empty());
  std::size_t best = 0;
  int best_median = kNone;
  std::vector<int> distances(descriptors.size());
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    for (std::size_t j = 0; j < descriptors.size(); ++j) {
      distances[j] = HammingDistance(descriptors[i], descriptors[j]);
    }
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>((distances.size() - 1) / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    if (*middle < best_median) {
      best_median = *middle;
      best = i;
    }
  }
  return best;
}

}  // namespace cslam
