// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/visibility.h"
#include "cslam/scene_eval/scene_run.h"
#include "cslam/scene_eval/scene_score.h"
#include "cslam/scene_eval/scene_truth.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

// How well the objects that a run says are present at its end are those that are.

namespace cslam {

// A thing that is there when the run ends, or a place at which nobody could know better.
struct TruePlace {
  int instance = 0;
  int class_id = -1;
  std::string name = {};
  PlacedBox box = {};
  // Must be found. If not, an object reported here is neither right nor wrong: the thing was never
  // clearly seen here, is being carried, or left and the place was not looked at again.
  bool is_required = false;
};

// Finds them: what rests at the time, what is carried then, and where things were before.
std::vector<TruePlace> TruePlacesAt(const SceneTruth& truth, double start_s, double end_s,
                                    const SceneEvalOptions& options);

enum class ObjectVerdict {
  kMatched,
  kDuplicate,  // near a thing of its class that another object is matched with
  kFalse,
  kNotJudged,  // at a place where nobody could know better
};

struct JudgedObject {
  FoundObject found = {};
  ObjectVerdict verdict = ObjectVerdict::kFalse;
  int instance = 0;                       // kMatched, kDuplicate: of the thing
  double centroid_error_m = 0.0;          // kMatched: to the middle of the true box
  double box_iou = 0.0;                   // kMatched: of the oriented extent with the true box
  double axis_extent_iou = 0.0;           // kMatched: of the paper's extent
  std::optional<int> confused_with = {};  // kFalse: class of a missed thing that stands there
};

struct ObjectScore : DetectionScore {
  int num_duplicates = 0;
  double centroid_error_m = 0.0;  // means over the matched
  double box_iou = 0.0;
  double axis_extent_iou = 0.0;
};

struct ObjectEvaluation {
  std::vector<TruePlace> places;
  std::vector<JudgedObject> objects;   // "present" ones of the classes asked for
  std::map<int, ObjectScore> classes;  // with anything true or reported
  ObjectScore all;
  int num_other_classes = 0;  // present objects of classes nobody asked for
};

ObjectEvaluation EvaluateObjects(const SceneTruth& truth, const SceneRun& run,
                                 const SceneEvalOptions& options = {});

// The same for given places: pure.
ObjectEvaluation JudgeObjects(std::vector<TruePlace> places,
                              const std::vector<FoundObject>& objects,
                              const SceneEvalOptions& options);

// Whether a place's required thing was matched.
bool IsFound(const ObjectEvaluation& evaluation, const TruePlace& place);

}  // namespace cslam
