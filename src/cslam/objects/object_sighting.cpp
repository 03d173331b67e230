// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/object_sighting.h"

namespace cslam {

cv::Mat CoveredByOthers(std::span<const ObjectSighting> sightings, int class_id,
                        const ObjectClasses& classes) {
  cv::Mat covered;
  for (const ObjectSighting& sighting : sightings) {
    if (classes.AreAlike(sighting.class_id, class_id)) continue;
    covered = covered.empty() ? sighting.region.mask : cv::Mat(covered | sighting.region.mask);
  }
  return covered;
}

}  // namespace cslam
