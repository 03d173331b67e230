// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/pipeline/slam_options.h"

#include "cslam/util/options.h"

namespace cslam {

void Describe(OptionList& list, PipelineOptions& o) {
  list.Add("frame_queue", o.frame_queue, {1, 100}, "frames",
           "Frames that may wait for the tracker; at sensor rate the oldest is dropped then.");
  list.Add(
      "max_proposals_ahead", o.max_proposals_ahead, {0, 100}, "keyframes",
      "At --rate max the source waits while more proposals than this are in flight; with 0 the "
      "mapper finishes nearly every bundle adjustment, as it does at sensor rate.");
  list.Add("mapper_nice", o.mapper_nice, {0, 19}, "",
           "How much lower the mapping thread's priority is than the tracking thread's.");
  list.Add("library_threads", o.library_threads, {1, 64}, "threads",
           "Size of OpenCV's thread pool.");
}

void Describe(OptionList& list, SlamOptions& o) {
  list.Group("tracking", o.tracking);
  list.Group("mapping", o.mapping);
  list.Group("places", o.places);
  list.Group("full_ba", o.full_ba);
  list.Group("detection", o.detection);
  list.Group("detector", o.detector);
  list.Group("pipeline", o.pipeline);
  list.Group("grid", o.grid);
}

}  // namespace cslam
