// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace cslam {

class OptionList;
struct DetectionRecord;
struct ModelDescription;

// How a recorded detector is made worse, to see what detections of less quality cost.
struct DegradeOptions {
  double drop_probability = 0.0;       // of each box by itself
  double jitter = 0.0;                 // standard deviation of each side, in box widths or heights
  double false_boxes_per_frame = 0.0;  // mean number of boxes where nothing is
  int delay_frames = 0;                // a call returns what belongs to the frame this many before
  int seed = 1;
};

struct DetectorOptions {
  std::string kind = "dnn";  // "dnn", "recorded" or "none"
  std::string model;         // dnn: name of an installed one, or a file; empty: the best installed
  std::string detections;    // recorded: file in the format of detections.json
  double person_threshold = 0.0;  // score; 0: as the model's description says, or all recorded
  double object_threshold = 0.0;  // of all other classes; 0: likewise
  std::string class_thresholds;   // "chair=0.5,tv=0.3": after the two above
  double nms_iou = 0.0;           // 0: as the model's description says
  int threads = 1;                // of OpenCV
  DegradeOptions degrade;         // recorded
};

void Describe(OptionList& list, DegradeOptions& o);
void Describe(OptionList& list, DetectorOptions& o);

// Puts the options' thresholds into a model's description. Throws Error for an unknown class.
void ApplyOptions(const DetectorOptions& options, ModelDescription& model);
// The same for what was recorded, which has no thresholds of its own.
void ApplyOptions(const DetectorOptions& options, DetectionRecord& record);

}  // namespace cslam
