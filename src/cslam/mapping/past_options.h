// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cslam {

class OptionList;

// How a thing that nobody named where it stood is found there afterwards.
struct PastOptions {
  bool enabled = true;
  int max_compared = 12;      // earlier keyframes that a new one is held against
  int min_looks = 2;          // keyframes that looked through a reading before it counts as gone
  int min_pixels = 12;        // of the colour thumbnail that a gone thing covers
  int min_views = 2;          // keyframes that saw it
  double same_place_m = 0.3;  // from one view's centre to another's
  double min_colour_share = 0.15;
  double min_likeness = 0.78;   // of its colours to those of the thing that came
  double max_size_ratio = 1.8;  // and of its size
  double sure_likeness = 0.93;  // the same of what stood there under another name
  double sure_max_size_ratio = 1.3;
};
void Describe(OptionList& list, PastOptions& options);

}  // namespace cslam
