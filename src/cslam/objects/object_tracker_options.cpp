// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/object_tracker_options.h"

#include "cslam/util/options.h"

namespace cslam {

void Describe(OptionList& list, ObjectTrackerOptions& o) {
  list.Add("enabled", o.enabled, "Leave out people and moving things; off: all is background.");
  list.Add("label_movable", o.label_movable,
           "Hold back the keypoints of things that may move, not those of people alone.");
  list.Add(
      "hold_back_new", o.hold_back_new,
      "Hold back movable things until they are known to rest (the paper), instead of from when "
      "they are seen to move.");
  list.Add("filter_motion", o.filter_motion,
           "Use movable things again once their filter finds them static.");
  list.Add("min_iou", o.min_iou, {0.01, 1.0}, "",
           "Overlap of boxes from which on a detection is taken for a known object.");
  list.Add("second_name_iou", o.second_name_iou, {0.01, 1.0}, "",
           "Overlap of two boxes of different classes from which on they are one thing, called by "
           "two names; the better one stays.");
  list.Add("min_inside", o.min_inside, {0.0, 1.0}, "",
           "Share of a thing's region that must lie within a detection's for it to be the same, "
           "or a piece of it; not of people, who stand before one another.");
  list.Add("bridge", o.bridge_s, {0.0, 60.0}, "s",
           "How long an object is carried on by its depth while the detector misses it.");
  list.Add("first_bridge", o.first_bridge_s, {0.0, 60.0}, "s",
           "The same for what was detected once; it grows with the time it has been seen, since "
           "detectors of people are set to find too many rather than too few.");
  list.Add("max_history", o.max_history_frames, {1, 1000}, "frames",
           "How late detections may come.");
  list.Add("left_behind", o.left_behind_m, {0.0, 100.0}, "m",
           "A nameless thing that was seen to move so far is left out while it stays in view, even "
           "at rest: what was brought is likely to be taken away again.");
  list.Add("max_growth", o.max_growth, {1.0, 100.0}, "",
           "A carried region stops growing at so many times its detected size.");
  list.Add("fixed", o.fixed,
           "Classes that count as room, with blanks between: furniture that nobody moves, and what "
           "detectors take for it, such as rugs and shelves.");
  list.Add("map_flat_on_walls", o.map_flat_on_walls,
           "Things that do not stand out from a wall become objects of the map instead of counting "
           "as room: pictures pass for screens.");
  list.Add("max_flat", o.max_flat_m, {0.0, 100.0}, "m",
           "What does not stand out from floor or table and is larger counts as room: a rug that "
           "passes for a bed.");
  list.Add("max_moving_share", o.max_moving_share, {0.0, 1.0}, "",
           "Share of the picture from which on a thing with a name that seems to move is held back "
           "only where the room suffices: a shelf that passes for a refrigerator and fills the "
           "picture seems to move whenever the camera does.");
  list.Add("flat_score", o.flat_score, {0.0, 1.0}, "",
           "What the score of a thing counts, as far as the map of objects goes, that does not "
           "stand out from the wall or table: pictures pass for screens.");
  list.Group("region", o.region);
  list.Group("labels", o.labels);
  list.Group("filter", o.filter);
  list.Group("unknown", o.unknown);
}

}  // namespace cslam
