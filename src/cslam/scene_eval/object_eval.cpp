// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/object_eval.h"

#include "cslam/dataset/truth_lookup.h"
#include "cslam/scene_eval/assignment.h"
#include "cslam/scene_eval/box_overlap.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

namespace cslam {
namespace {

// A place, and what would have to be seen of it to know what is there.
struct OpenPlace {
  TruePlace place;
  PlaceQuery query;
  PlaceQuery replacement = NoQuery();
  bool is_former = false;  // the thing has left it
};

// The places of one thing up to a time.
std::vector<OpenPlace> PlacesOf(const SceneTruth& truth, const TrueObject& object, double start_s,
                                double end_s) {
  std::vector<OpenPlace> places;
  const auto add = [&](const Se3& T_world_object) -> OpenPlace& {
    OpenPlace open;
    open.place.instance = object.instance;
    open.place.class_id = object.class_id;
    open.place.name = object.name;
    open.place.box = open.query.box = BoxOf(object, T_world_object);
    open.query.from_s = start_s;
    open.query.until_s = end_s;
    places.push_back(std::move(open));
    return places.back();
  };
  for (const Rest& rest : RestsOf(object)) {
    if (rest.from_s > end_s) break;
    OpenPlace& open = add(rest.T_world_object);
    open.is_former = rest.to_s <= end_s;
    open.query.from_s = std::max(start_s, open.is_former ? rest.to_s : rest.from_s);
    open.query.shown_instance = open.is_former ? 0 : object.instance;
    if (open.is_former)
      open.replacement = ReplacementQuery(truth, object.instance, rest.to_s, end_s);
  }
  const Placement state = StateAt(object, end_s);
  if (state.presence == Presence::kMoving) {
    OpenPlace& open = add(state.T_world_object);
    open.query.until_s = open.query.from_s - 1.0;  // no view of a moving thing will do
  }
  return places;
}

double DistanceBetween(const FoundObject& object, const TruePlace& place) {
  return (object.centroid - place.box.T_world_box.translation).norm();
}

bool IsNear(const FoundObject& object, const TruePlace& place, const SceneEvalOptions& options) {
  return object.report.class_id == place.class_id &&
         DistanceBetween(object, place) <= options.max_distance_m;
}

class ObjectJudge {
 public:
  ObjectJudge(std::vector<TruePlace> places, const std::vector<FoundObject>& objects,
              const SceneEvalOptions& options)
      : options_(options) {
    evaluation_.places = std::move(places);
    for (const FoundObject& object : objects) {
      if (object.report.state != "present") continue;
      if (options.classes.contains(object.report.class_id)) {
        evaluation_.objects.push_back({.found = object});
      } else {
        ++evaluation_.num_other_classes;
      }
    }
  }

  ObjectEvaluation Judge() {
    Match();
    for (JudgedObject& object : evaluation_.objects) {
      if (object.verdict != ObjectVerdict::kMatched) JudgeRest(object);
    }
    Count();
    return std::move(evaluation_);
  }

 private:
  void Match() {
    std::vector<const TruePlace*> required;
    for (const TruePlace& place : evaluation_.places) {
      if (place.is_required) required.push_back(&place);
    }
    PairCosts costs;
    for (const JudgedObject& object : evaluation_.objects) {
      auto& row = costs.emplace_back(required.size());
      for (std::size_t j = 0; j < required.size(); ++j) {
        if (IsNear(object.found, *required[j], options_))
          row[j] = DistanceBetween(object.found, *required[j]);
      }
    }
    const auto partners = AssignPairs(costs);
    for (std::size_t i = 0; i < partners.size(); ++i) {
      if (partners[i]) SetMatched(evaluation_.objects[i], *required[*partners[i]]);
    }
  }

  static void SetMatched(JudgedObject& object, const TruePlace& place) {
    object.verdict = ObjectVerdict::kMatched;
    object.instance = place.instance;
    object.centroid_error_m = DistanceBetween(object.found, place);
    object.box_iou = IntersectionOverUnion(object.found.box, place.box);
    object.axis_extent_iou = IntersectionOverUnion(object.found.axis_extent, place.box);
  }

  void JudgeRest(JudgedObject& object) const {
    const TruePlace* nearest = nullptr;
    for (const TruePlace& place : evaluation_.places) {
      if (!IsNear(object.found, place, options_)) continue;
      if (!place.is_required) {
        object.verdict = ObjectVerdict::kNotJudged;
        return;
      }
      if (nearest == nullptr ||
          DistanceBetween(object.found, place) < DistanceBetween(object.found, *nearest))
        nearest = &place;
    }
    if (nearest != nullptr) {
      object.verdict = ObjectVerdict::kDuplicate;
      object.instance = nearest->instance;
      return;
    }
    for (const TruePlace& place : evaluation_.places) {
      const bool is_there = DistanceBetween(object.found, place) <= options_.max_distance_m;
      if (is_there && place.is_required && !IsFound(evaluation_, place))
        object.confused_with = place.class_id;
    }
  }

  void Count() {
    for (const TruePlace& place : evaluation_.places) {
      if (place.is_required) ++evaluation_.classes[place.class_id].num_true;
    }
    for (const JudgedObject& object : evaluation_.objects) {
      if (object.verdict == ObjectVerdict::kNotJudged) continue;
      ObjectScore& score = evaluation_.classes[object.found.report.class_id];
      ++score.num_reported;
      if (object.verdict == ObjectVerdict::kDuplicate) ++score.num_duplicates;
      if (object.verdict != ObjectVerdict::kMatched) continue;
      ++score.num_matched;
      score.centroid_error_m += object.centroid_error_m;
      score.box_iou += object.box_iou;
      score.axis_extent_iou += object.axis_extent_iou;
    }
    for (const auto& [class_id, score] : evaluation_.classes) {
      evaluation_.all += score;
      evaluation_.all.num_duplicates += score.num_duplicates;
      evaluation_.all.centroid_error_m += score.centroid_error_m;
      evaluation_.all.box_iou += score.box_iou;
      evaluation_.all.axis_extent_iou += score.axis_extent_iou;
    }
    for (auto& [class_id, score] : evaluation_.classes)
      Average(score);
    Average(evaluation_.all);
  }

  static void Average(ObjectScore& score) {
    if (score.num_matched == 0) return;
    for (double* sum : {&score.centroid_error_m, &score.box_iou, &score.axis_extent_iou})
      *sum /= score.num_matched;
  }

  const SceneEvalOptions& options_;
  ObjectEvaluation evaluation_;
};

}  // namespace

std::vector<TruePlace> TruePlacesAt(const SceneTruth& truth, double start_s, double end_s,
                                    const SceneEvalOptions& options) {
  const std::set<int> classes = WithKnownClasses(options, truth.objects).classes;
  std::vector<OpenPlace> open;
  for (const TrueObject& object : truth.objects.objects) {
    if (!classes.contains(object.class_id) || object.is_deformable) continue;
    for (OpenPlace& place : PlacesOf(truth, object, start_s, end_s))
      open.push_back(std::move(place));
  }
  std::vector<PlaceQuery> queries;
  for (const OpenPlace& place : open)
    queries.insert(queries.end(), {place.query, place.replacement});
  const auto views = FirstClearViews(truth, queries, options.clear_view);
  std::vector<TruePlace> places;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const bool is_seen = views[2 * i] || views[2 * i + 1];
    if (open[i].is_former && is_seen) continue;  // known to be gone: an object there is wrong
    open[i].place.is_required = !open[i].is_former && is_seen;
    places.push_back(std::move(open[i].place));
  }
  return places;
}

ObjectEvaluation EvaluateObjects(const SceneTruth& truth, const SceneRun& run,
                                 const SceneEvalOptions& options) {
  if (!run.objects)
    throw Error("'{}' holds no objects.json; run with the object layer on", run.folder.string());
  const SceneEvalOptions known = WithGapOf(WithKnownClasses(options, truth.objects), truth, run);
  return JudgeObjects(
      TruePlacesAt(truth, truth.TimeOf(run.memory_start()), truth.TimeOf(run.last_stamp()), known),
      *run.objects, known);
}

ObjectEvaluation JudgeObjects(std::vector<TruePlace> places,
                              const std::vector<FoundObject>& objects,
                              const SceneEvalOptions& options) {
  return ObjectJudge(std::move(places), objects, options).Judge();
}

bool IsFound(const ObjectEvaluation& evaluation, const TruePlace& place) {
  return place.is_required && std::any_of(evaluation.objects.begin(), evaluation.objects.end(),
                                          [&](const JudgedObject& object) {
                                            return object.verdict == ObjectVerdict::kMatched &&
                                                   object.instance == place.instance;
                                          });
}

}  // namespace cslam
