// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/past_options.h"

#include "cslam/util/options.h"

namespace cslam {

void Describe(OptionList& list, PastOptions& o) {
  list.Add("enabled", o.enabled,
           "Look for where a thing that came stood before, though nobody named it there.");
  list.Add("max_compared", o.max_compared, {1, 10'000}, "keyframes",
           "Earlier keyframes that a new one is held against to see what has gone.");
  list.Add("min_looks", o.min_looks, {1, 255}, "keyframes",
           "So many must look through a reading before it counts as gone.");
  list.Add("min_pixels", o.min_pixels, {1, 100'000}, "px",
           "Of an image of 80 x 60 that a gone thing covers.");
  list.Add("min_views", o.min_views, {1, 1000}, "keyframes", "That must have seen it there ...");
  list.Add("same_place", o.same_place_m, {0.01, 10.0}, "m",
           "... with its middle so near to where others saw it.");
  list.Add("min_colour_share", o.min_colour_share, {0.0, 1.0}, "",
           "Colours that make up less of a thing are not looked for.");
  list.Add("min_likeness", o.min_likeness, {0.0, 1.0}, "",
           "Common share of the colours of what has gone and of what came.");
  list.Add("max_size_ratio", o.max_size_ratio, {1.0, 10.0}, "",
           "How much larger one may seem than the other.");
  list.Add("sure_likeness", o.sure_likeness, {0.0, 1.0}, "",
           "The common share of the colours where what has gone had another name, or seems to have "
           "been seen once more after the other came.");
  list.Add("sure_max_size_ratio", o.sure_max_size_ratio, {1.0, 10.0}, "",
           "How much larger one may seem than the other in these cases.");
}

}  // namespace cslam
