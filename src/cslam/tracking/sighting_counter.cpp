// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/sighting_counter.h"

#include <algorithm>

namespace cslam {

void SightingCounter::Count(std::span<const ExpectedPoint> expected, const FrameMatches& matches,
                            std::size_t num_point_ids) {
  sightings_.resize(std::max(sightings_.size(), num_point_ids));
  std::vector<std::uint8_t> is_expected(sightings_.size(), 0);
  for (const ExpectedPoint& point : expected) {
    ++Entry(point.point).expected;
    is_expected[point.point.index()] = 1;
  }
  for (const Landmark& match : matches) {
    if (match.kind != Landmark::Kind::kMapPoint) continue;
    PointSightings& sightings = Entry(match.point);
    ++sightings.found;
    if (is_expected[match.point.index()] == 0) ++sightings.expected;
  }
}

PointSightings& SightingCounter::Entry(PointId id) {
  PointSightings& sightings = sightings_[id.index()];
  if (!sightings.point.valid()) {
    sightings.point = id;
    sighted_.push_back(id);
  }
  return sightings;
}

std::vector<PointSightings> SightingCounter::Take() {
  std::vector<PointSightings> taken;
  taken.reserve(sighted_.size());
  for (const PointId id : sighted_) {
    taken.push_back(sightings_[id.index()]);
    sightings_[id.index()] = PointSightings{};
  }
  sighted_.clear();
  return taken;
}

}  // namespace cslam
