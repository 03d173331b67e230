// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace cslam {

// The 80 classes of COCO, by the contiguous ids that detectors use; kPersonClass and
// kBackgroundClass stand in detection.h.
inline constexpr int kNumCocoClasses = 80;
inline constexpr int kChairClass = 56;
inline constexpr int kTvClass = 62;

// "person", "tv", ...; "background" for -1. The id must be in [-1, 80).
std::string_view CocoClassName(int class_id);

// Takes today's names and those of the first lists ("tv" and "tvmonitor", "couch" and "sofa"),
// with '_' for a blank as well. nullopt for any other.
std::optional<int> FindCocoClass(std::string_view name);

// CocoClassName() with '_' for blanks: fit for option keys and file names.
std::string CocoClassKey(int class_id);

}  // namespace cslam
