// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/stamp.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslam {

// Indices into two lists of stamps that belong together.
struct StampPair {
  std::size_t first = 0;
  std::size_t second = 0;
  bool operator==(const StampPair&) const = default;
};

// Pairs the stamps of two lists one to one, closest pairs first, as the TUM benchmark's
// associate.py does; pairs further apart than max_difference_ns stay unmatched. Both lists must be
// strictly increasing. The result is ordered by first; equal differences go to the earlier stamps.
std::vector<StampPair> AssociateNearest(const std::vector<Stamp>& first,
                                        const std::vector<Stamp>& second,
                                        std::int64_t max_difference_ns);

}  // namespace cslam
