// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace cslam {

// What it costs to pair a row with a column, at least 0; nothing: they do not belong together.
using PairCosts = std::vector<std::vector<std::optional<double>>>;

// For each row its column or nothing: as many pairs as possible, of those the cheapest in all
// (Hungarian method). All rows must have the same length.
std::vector<std::optional<std::size_t>> AssignPairs(const PairCosts& costs);

}  // namespace cslam
