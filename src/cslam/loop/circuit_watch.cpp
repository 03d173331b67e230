// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/circuit_watch.h"

#include "cslam/util/options.h"

#include <algorithm>

namespace cslam {

void Describe(OptionList& list, CircuitOptions& o) {
  list.Add("enabled", o.enabled,
           "Adjust the whole map where the camera comes round to a part of it that it had left, "
           "though no loop had to be closed.");
  list.Add("min_shared_points", o.min_shared_points, {1, 10'000}, "points",
           "That two keyframes share if they see the same part.");
  list.Add("min_keyframes_away", o.min_keyframes_away, {1, 10'000}, "keyframes",
           "In a row that must not have been back.");
  list.Add("min_share_away", o.min_share_away, {0.0, 1.0}, "",
           "And at least this share of the map's keyframes: to adjust a large map takes long.");
  list.Add("confirmations", o.confirmations, {1, 1000}, "keyframes", "In a row that must be back.");
}

// Shares points with keyframes of long ago, and next to none with those in between.
bool CircuitWatch::IsBack(const Keyframe& keyframe, const MapView& map) const {
  int num_between = 0;
  bool has_shared = false;
  auto next = keyframe.covisible.begin();
  for (const KeyframeId id : map.Keyframes()) {
    if (!(id < keyframe.id)) break;
    if (map.FindKeyframe(id)->map != keyframe.map) continue;
    while (next != keyframe.covisible.end() && next->id < id)
      ++next;
    const bool is_shared = next != keyframe.covisible.end() && next->id == id &&
                           next->shared_points >= options_.min_shared_points;
    if (is_shared && has_shared && num_between >= options_.min_keyframes_away) return true;
    has_shared = has_shared || is_shared;
    num_between = is_shared ? 0 : num_between + 1;
  }
  return has_shared && num_between >= options_.min_keyframes_away;
}

// A short way makes little drift, and of a large map more has to be new to be worth the time.
int CircuitWatch::MinAway(const MapView& map) const {
  return std::max(
      options_.min_keyframes_away,
      static_cast<int>(options_.min_share_away * static_cast<double>(map.num_keyframes())));
}

bool CircuitWatch::IsClosedBy(const Keyframe& keyframe, const MapView& map) {
  if (!options_.enabled) return false;
  if (keyframe.map != map_) Reset();
  map_ = keyframe.map;
  if (!IsBack(keyframe, map)) {
    ++num_away_;
    num_back_ = 0;
    return false;
  }
  if (num_away_ < MinAway(map)) {
    num_away_ = 0;
    return false;
  }
  if (++num_back_ < options_.confirmations) return false;
  Reset();
  return true;
}

void CircuitWatch::Reset() {
  num_away_ = num_back_ = 0;
}

}  // namespace cslam
