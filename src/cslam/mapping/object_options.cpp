// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_options.h"

#include "cslam/util/check.h"
#include "cslam/util/options.h"

namespace cslam {

void Describe(OptionList& list, MapObjectOptions& o) {
  list.Add("enabled", o.enabled,
           "Keep objects in the map, with a belief in each; off: their points are like others.");
  list.Add("belief_update", o.belief_update,
           "'view': beliefs change with every view that tells something; 'visit': once, when an "
           "object was not seen for visit_gap keyframes (the paper).");
  list.Add("visit_gap", o.visit_gap_keyframes, {1, 10'000}, "keyframes",
           "What ends a visit (N in the paper).");
  list.Add("extent", o.extent,
           "'surface': centroid and oriented box of the measured surface; 'points': of the map "
           "points, along the world's axes (the paper).");
  list.Add("voxel", o.voxel_m, {0.005, 0.2}, "m",
           "Cells in which a surface is kept, at most; small things have smaller ones.");
  list.Add("min_overlap", o.min_overlap, {0.0, 1.0}, "",
           "Share of a sighting's surface on an object's from which on they are one.");
  list.Add("same_surface", o.same_surface, {0.0, 1.0}, "",
           "Share of each on the other from which on they are one even if their classes differ.");
  list.Add("same_size", o.same_size, {0.0, 1.0}, "",
           "... if the smaller one is so large, as share of the other; a smaller thing of another "
           "class is no part of a larger one, but sits on it.");
  list.Add("merge_overlap", o.merge_overlap, {0.0, 1.0}, "",
           "Share of the smaller of two objects' surfaces from which on they are one.");
  list.Add("max_union", o.max_union, {1.0, 10.0}, "",
           "A sighting without overlap is no part of an object if both together would be larger "
           "than so many class distances: two chairs side by side.");
  list.Add("min_voxels", o.min_voxels, {1, 10'000}, "cells", "Less surface makes no object.");
  list.Add("min_likeness", o.min_likeness, {0.0, 1.0}, "",
           "Common share of the colours of one thing seen in two places, or again at its own.");
  list.Add("sure_likeness", o.sure_likeness, {0.0, 1.0}, "",
           "The same where nobody had seen the new place without it: it may have stood there all "
           "along.");
  list.Add("recognise_after", o.recognise_after_s, {0.0, 3600.0}, "s",
           "What was out of sight for so long is known by its colours as well; what was only "
           "suspected until then counts as new.");
  list.Add("max_size_ratio", o.max_size_ratio, {1.0, 10.0}, "",
           "How much larger one may seem than the other.");
  list.Add("sure_max_size_ratio", o.sure_max_size_ratio, {1.0, 10.0}, "",
           "The same if their colours have sure_likeness: at first little of a thing may be seen.");
  list.Add("replace_distance", o.replace_distance_m, {0.0, 5.0}, "m",
           "How far from a vanished thing another one replaces it.");
  list.Add("min_views_before", o.min_views_before, {1, 1000}, "keyframes",
           "Earlier keyframes that saw a place empty before what stands there counts as added.");
  list.Add("settled_sightings", o.settled_sightings, {1, 1000}, "keyframes",
           "Until so many have seen a thing, whether it is new where it stands is asked anew.");
  list.Add(
      "max_strays", o.max_strays, {1, 1000}, "keyframes",
      "So many in a row that see a thing, followed without a break, off its surface make a new "
      "object of it: the first one was something else.");
  list.Add("sweep_for", o.sweep_for_s, {0.0, 3600.0}, "s",
           "So long after a thing has gone, points at its place that are looked through go too, "
           "though nobody had named them.");
  list.Add("sweep_margin", o.sweep_margin_m, {0.0, 5.0}, "m",
           "... and so far around it: there may have been more of it than ever had its name.");
  list.Add("min_doubt_views", o.min_doubt_views, {1, 100'000}, "frames",
           "A thing that was wholly in view, near by, so often ...");
  list.Add("min_named_share", o.min_named_share, {0.0, 1.0}, "",
           "... and was detected in less than this share of the views, was taken for something "
           "by mistake.");
  list.Add("min_displaced", o.min_displaced, {0.0, 1.0}, "",
           "Share of a thing's surface in the box of one that came later: two cannot be there.");
  list.Add("min_displacing_views", o.min_displacing_views, {1, 1000}, "keyframes",
           "How often that must have been seen, and the old thing not at all.");
  list.Group("past", o.past);
  list.Group("classes", o.classes);
  list.Group("belief", o.belief);
  list.Group("view", o.view);
}

BeliefUpdate BeliefUpdateOf(const MapObjectOptions& options) {
  if (options.belief_update == "view") return BeliefUpdate::kPerView;
  if (options.belief_update == "visit") return BeliefUpdate::kPerVisit;
  throw Error("belief_update must be 'view' or 'visit', not '{}'", options.belief_update);
}

ExtentSource ExtentSourceOf(const MapObjectOptions& options) {
  if (options.extent == "surface") return ExtentSource::kSurface;
  if (options.extent == "points") return ExtentSource::kPoints;
  throw Error("extent must be 'surface' or 'points', not '{}'", options.extent);
}

}  // namespace cslam
