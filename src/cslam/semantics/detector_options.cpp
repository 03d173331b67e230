// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/detector_options.h"

#include "cslam/io/truth_files.h"
#include "cslam/semantics/detection.h"
#include "cslam/semantics/model_description.h"
#include "cslam/util/options.h"

namespace cslam {
namespace {

void ApplyThresholds(const DetectorOptions& options, ClassThresholds& thresholds) {
  const double person = thresholds[kPersonClass];
  if (options.object_threshold > 0.0) thresholds.fill(options.object_threshold);
  thresholds[kPersonClass] = options.person_threshold > 0.0 ? options.person_threshold : person;
  SetThresholds(thresholds, options.class_thresholds);
}

double ThresholdOf(const ClassThresholds& thresholds, int class_id) {
  const auto index = static_cast<std::size_t>(class_id);
  return index < thresholds.size() ? thresholds[index] : 0.0;
}

}  // namespace

void Describe(OptionList& list, DegradeOptions& o) {
  list.Add("drop", o.drop_probability, {0.0, 1.0}, "", "Probability that a box is missed.");
  list.Add("jitter", o.jitter, {0.0, 1.0}, "box size", "Standard deviation of each side of a box.");
  list.Add("false_boxes", o.false_boxes_per_frame, {0.0, 100.0}, "per frame",
           "Mean number of boxes where nothing is.");
  list.Add("delay", o.delay_frames, {0, 100}, "frames",
           "A result belongs to the frame this many before the newest.");
  list.Add("seed", o.seed, {0, 1'000'000}, "", "Other seeds, other errors.");
}

void Describe(OptionList& list, DetectorOptions& o) {
  list.Add("kind", o.kind, "dnn (a network), recorded (from a file) or none.");
  list.Add("model", o.model, "Name of an installed model or its file; empty: the best installed.");
  list.Add("detections", o.detections, "File for the recorded detector, like detections.json.");
  list.Add("person_threshold", o.person_threshold, {0.0, 2.0}, "score",
           "Least score of a person; 0: the model's own, or all that was recorded.");
  list.Add("object_threshold", o.object_threshold, {0.0, 2.0}, "score",
           "Least score of anything else; 0: likewise.");
  list.Add("class_thresholds", o.class_thresholds,
           "Least scores of single classes, like \"chair=0.5,tv=0.3\".");
  list.Add("nms_iou", o.nms_iou, {0.0, 1.0}, "",
           "Of two boxes of a class that overlap by more, one stays; 0: the model's own.");
  list.Add("threads", o.threads, {1, 64}, "", "Threads of the network, and of OpenCV elsewhere.");
  list.Group("degrade", o.degrade);
}

void ApplyOptions(const DetectorOptions& options, ModelDescription& model) {
  ApplyThresholds(options, model.thresholds);
  if (options.nms_iou > 0.0) model.nms_iou = options.nms_iou;
}

void ApplyOptions(const DetectorOptions& options, DetectionRecord& record) {
  ClassThresholds thresholds{};
  ApplyThresholds(options, thresholds);
  for (RecordedFrame& frame : record.frames) {
    std::erase_if(frame.detections, [&](const RecordedDetection& detection) {
      return detection.score < ThresholdOf(thresholds, detection.class_id);
    });
  }
}

}  // namespace cslam
