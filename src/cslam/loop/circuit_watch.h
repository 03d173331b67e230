// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_view.h"

namespace cslam {

class OptionList;

// When the camera has come round to a part of the map that it had left.
struct CircuitOptions {
  bool enabled = true;
  int min_shared_points = 15;   // of two keyframes that see the same part
  int min_keyframes_away = 10;  // in a row, on the way round ...
  double min_share_away = 0.1;  // ... and so much of the map
  int confirmations = 3;        // keyframes in a row that are back
};
void Describe(OptionList& list, CircuitOptions& options);

// Notices circuits that need no loop to be closed, for the tracker knew the place again by itself.
// The drift of the way round then sits where its ends meet, until the whole map is adjusted.
class CircuitWatch {
 public:
  explicit CircuitWatch(const CircuitOptions& options) : options_(options) {}

  // For every new keyframe. True once for each circuit.
  bool IsClosedBy(const Keyframe& keyframe, const MapView& map);

  // Forgets the way so far: a loop has been closed.
  void Reset();

 private:
  int MinAway(const MapView& map) const;
  bool IsBack(const Keyframe& keyframe, const MapView& map) const;

  CircuitOptions options_;
  MapId map_;
  int num_away_ = 0;
  int num_back_ = 0;
};

}  // namespace cslam
