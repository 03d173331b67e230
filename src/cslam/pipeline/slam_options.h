// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/loop/place_stage.h"
#include "cslam/mapping/full_ba.h"
#include "cslam/mapping/mapper_options.h"
#include "cslam/navigation/occupancy_grid.h"
#include "cslam/pipeline/detection_schedule.h"
#include "cslam/semantics/detector_options.h"
#include "cslam/tracking/tracker_options.h"

namespace cslam {

class OptionList;

struct PipelineOptions {
  int frame_queue = 2;
  int max_proposals_ahead = 0;
  int mapper_nice = 5;
  int library_threads = 1;
};
void Describe(OptionList& list, PipelineOptions& options);

// Every option of SLAM. The keys are listed by `changing-slam config`.
struct SlamOptions {
  TrackerOptions tracking;
  MapperOptions mapping;
  PlaceOptions places;
  FullBaOptions full_ba;
  DetectionOptions detection;
  DetectorOptions detector;  // for whoever makes the detector that Slam is given
  PipelineOptions pipeline;
  OccupancyGridOptions grid;  // for whoever draws one of the finished map
};
void Describe(OptionList& list, SlamOptions& options);

}  // namespace cslam
