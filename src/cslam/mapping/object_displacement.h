// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map.h"
#include "cslam/mapping/object_options.h"
#include "cslam/messages/messages.h"
#include "cslam/objects/object_classes.h"

#include <vector>

namespace cslam {

// Things in whose place a newcomer stands, though nobody could look through it.
struct Displacement {
  std::vector<ObjectId> gone;         // large things first: of a chair with a bear, the chair
  std::vector<ObjectId> still_there;  // to be seen in the keyframe, beside the newcomer or on it
};

// Looks for present things unlike the newcomer, most of whose surface lies in its box and that have
// not been seen since it came. Empty until the newcomer is known well enough.
Displacement FindDisplaced(const Map& map, ObjectId comer_id, const KeyframeProposal& proposal,
                           const ObjectClasses& classes, const MapObjectOptions& options);

}  // namespace cslam
