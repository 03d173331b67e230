// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/association.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>

namespace cslam {
namespace {

struct Candidate {
  std::int64_t difference_ns = 0;
  StampPair pair;

  bool operator<(const Candidate& other) const {
    return std::tie(difference_ns, pair.first, pair.second) <
           std::tie(other.difference_ns, other.pair.first, other.pair.second);
  }
};

std::vector<Candidate> CandidatesWithin(const std::vector<Stamp>& first,
                                        const std::vector<Stamp>& second,
                                        std::int64_t max_difference_ns) {
  std::vector<Candidate> candidates;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    while (begin < second.size() && second[begin].ns < first[i].ns - max_difference_ns)
      ++begin;
    for (std::size_t j = begin; j < second.size(); ++j) {
      if (second[j].ns > first[i].ns + max_difference_ns) break;
      candidates.push_back({.difference_ns = std::abs(second[j].ns - first[i].ns), .pair = {i, j}});
    }
  }
  return candidates;
}

}  // namespace

std::vector<StampPair> AssociateNearest(const std::vector<Stamp>& first,
                                        const std::vector<Stamp>& second,
                                        std::int64_t max_difference_ns) {
  std::vector<Candidate> candidates = CandidatesWithin(first, second, max_difference_ns);
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> first_taken(first.size(), false);
  std::vector<bool> second_taken(second.size(), false);
  std::vector<StampPair> pairs;
  for (const Candidate& candidate : candidates) {
    const auto [i, j] = candidate.pair;
    if (first_taken[i] || second_taken[j]) continue;
    first_taken[i] = true;
    second_taken[j] = true;
    pairs.push_back(candidate.pair);
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const StampPair& a, const StampPair& b) { return a.first < b.first; });
  return pairs;
}

}  // namespace cslam
