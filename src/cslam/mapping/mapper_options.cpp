// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/mapper_options.h"

#include "cslam/util/options.h"

namespace cslam {

void Describe(OptionList& list, TriangulationOptions& o) {
  list.Add("neighbours", o.neighbours, {0, 100}, "keyframes",
           "Covisible keyframes with which new points are triangulated.");
  list.Add("min_baseline", o.min_baseline_m, {0.0, 10.0}, "m",
           "Keyframes nearer to each other than this are not used.");
  list.Add("min_parallax", o.min_parallax_deg, {0.01, 45.0}, "deg",
           "Smallest angle between the two rays of a triangulated point.");
  list.Add("max_epipolar_chi2", o.max_epipolar_chi2, {0.1, 100.0}, "",
           "Gate on the distance to the epipolar line (chi2, 1 dof, 95 %).");
  list.Add("match_distance", o.match_distance, {1, 256}, "bits",
           "Most differing descriptor bits of a match to be triangulated.");
  list.Add("match_ratio", o.match_ratio, {0.1, 1.0}, "",
           "Best descriptor distance over second best along the epipolar line.");
}

void Describe(OptionList& list, FusionOptions& o) {
  list.Add("neighbours", o.neighbours, {0, 100}, "keyframes",
           "Covisible keyframes whose points are fused with those of a new keyframe.");
  list.Add("second_neighbours", o.second_neighbours, {0, 100}, "keyframes",
           "Neighbours of each neighbour that take part too.");
  list.Add("nearby_keyframes", o.nearby_keyframes, {0, 100}, "keyframes",
           "Keyframes that take part because they looked from nearby, though they share no points "
           "(yet): this ties a revisited place to its old points while drift is small.");
  list.Add("nearby_distance", o.nearby_distance_m, {0.0, 100.0}, "m",
           "How far apart two cameras may be to count as nearby.");
  list.Add("nearby_angle", o.nearby_angle_deg, {0.0, 180.0}, "deg",
           "How far their viewing directions may differ.");
  list.Add("radius", o.radius_px, {0.5, 50.0}, "px",
           "Search radius at level 0 around a point's projection.");
  list.Add("match_distance", o.match_distance, {1, 256}, "bits",
           "Most differing descriptor bits of two sightings of one point.");
}

void Describe(OptionList& list, CullingOptions& o) {
  list.Add("min_found_ratio", o.min_found_ratio, {0.0, 1.0}, "",
           "New points found in a smaller share of the frames that should see them are erased.");
  list.Add("min_observations", o.min_observations, {1, 100}, "keyframes",
           "New points seen by fewer keyframes two keyframes later are erased.");
  list.Add("probation", o.probation_keyframes, {1, 100}, "keyframes",
           "Points older than this many keyframes are no longer on probation.");
  list.Add("redundant_share", o.redundant_share, {0.1, 1.0}, "",
           "A keyframe is culled when this share of its near points is seen elsewhere ...");
  list.Add("redundant_observers", o.redundant_observers, {1, 100}, "keyframes",
           "... by at least this many others at the same scale or finer.");
}

void Describe(OptionList& list, LocalBaOptions& o) {
  list.Group("solver", o.solver);
  list.Add("max_keyframes", o.max_keyframes, {1, 1000}, "keyframes",
           "Most keyframes whose poses a local bundle adjustment moves.");
  list.Add("max_fixed_keyframes", o.max_fixed_keyframes, {1, 1000}, "keyframes",
           "Most further keyframes that hold it in place.");
}

void Describe(OptionList& list, MapperOptions& o) {
  list.Add("min_near_points", o.min_near_points, {0, 10'000}, "points",
           "With fewer near points in view, points are made from one view at any depth.");
  list.Add("min_shared_points", o.min_shared_points, {1, 1000}, "points",
           "Points two keyframes share to count as neighbours.");
  list.Group("triangulation", o.triangulation);
  list.Group("fusion", o.fusion);
  list.Group("culling", o.culling);
  list.Group("local_ba", o.local_ba);
  list.Group("objects", o.objects);
  list.Add("check_invariants", o.check_invariants,
           "Recheck the whole map after every commit (slow; always on in debug builds).");
}

}  // namespace cslam
