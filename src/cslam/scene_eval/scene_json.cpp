// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/scene_report.h"
#include "cslam/semantics/coco.h"

#include <nlohmann/json.hpp>

namespace cslam {
namespace {

// Keeps the order in which the fields are written.
using Json = nlohmann::ordered_json;

Json ClassJson(int class_id) {
  if (class_id < 0 || class_id >= kNumCocoClasses) return nullptr;
  return std::string(CocoClassName(class_id));
}

template <typename T>
Json OrNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json ToJson(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

Json ToJson(const std::optional<Eigen::Vector3d>& place) {
  return place ? ToJson(*place) : Json(nullptr);
}

Json ToJson(const PlacedBox& box) {
  const Eigen::Quaterniond& q = box.T_world_box.rotation;
  return {{"center_m", ToJson(box.T_world_box.translation)},
          {"size_m", ToJson(box.size_m)},
          {"rotation_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

Json ToJson(const DetectionScore& score) {
  return {{"num_true", score.num_true},       {"num_reported", score.num_reported},
          {"num_matched", score.num_matched}, {"precision", OrNull(score.Precision())},
          {"recall", OrNull(score.Recall())}, {"f1", OrNull(score.F1())}};
}

Json ToJson(const ObjectScore& score) {
  const auto mean = [&](double value) { return score.num_matched > 0 ? Json(value) : nullptr; };
  Json json = ToJson(static_cast<const DetectionScore&>(score));
  json["num_duplicates"] = score.num_duplicates;
  json["centroid_error_m"] = mean(score.centroid_error_m);
  json["box_iou"] = mean(score.box_iou);
  json["extent_iou"] = mean(score.axis_extent_iou);
  return json;
}

Json Head(const char* metric, const SceneTruth& truth, const SceneRun& run,
          const SceneEvalOptions& options) {
  Json classes = Json::array();
  for (const int class_id : options.classes)
    classes.push_back(ClassJson(class_id));
  return {{"metric", metric},
          {"truth", truth.folder.string()},
          {"run", run.folder.string()},
          {"from_s", truth.TimeOf(run.first_stamp())},
          {"to_s", truth.TimeOf(run.last_stamp())},
          {"alignment", Describe(run.alignment)},
          {"ate_rmse_m", run.ate_rmse_m},
          {"distance_m", options.max_distance_m},
          {"classes", classes}};
}

Json ToJson(const TruePlace& place, const ObjectEvaluation& evaluation) {
  return {{"instance", place.instance},
          {"name", place.name},
          {"class", ClassJson(place.class_id)},
          {"is_required", place.is_required},
          {"is_found", IsFound(evaluation, place)},
          {"box", ToJson(place.box)}};
}

Json ToJson(const JudgedObject& object) {
  const bool is_matched = object.verdict == ObjectVerdict::kMatched;
  const auto if_matched = [&](double value) { return is_matched ? Json(value) : nullptr; };
  return {{"id", object.found.report.id},
          {"class", ClassJson(object.found.report.class_id)},
          {"verdict", NameOf(object.verdict)},
          {"instance", object.instance != 0 ? Json(object.instance) : nullptr},
          {"confused_with", object.confused_with ? ClassJson(*object.confused_with) : nullptr},
          {"centroid_m", ToJson(object.found.centroid)},
          {"centroid_error_m", if_matched(object.centroid_error_m)},
          {"box_iou", if_matched(object.box_iou)},
          {"extent_iou", if_matched(object.axis_extent_iou)},
          {"box", ToJson(object.found.box)}};
}

Json ToJson(const GhostCount& count) {
  return {{"num_ghosts", count.ghosts.size()},
          {"num_points", count.num_points},
          {"share", OrNull(count.Share())},
          {"num_former_places", count.num_former_places}};
}

Json ToJson(const JudgedChange& change, const ChangeEvaluation& evaluation) {
  const TrueChange& truth = change.truth.change;
  const bool is_replaced = truth.kind == ChangeKind::kReplaced;
  const Json told = change.report ? Json(evaluation.reports[*change.report].time_s) : Json(nullptr);
  return {{"kind", NameOf(truth.kind)},
          {"class", ClassJson(truth.class_id)},
          {"new_class", is_replaced ? ClassJson(truth.new_class_id) : nullptr},
          {"instance", truth.instance},
          {"time_s", truth.time_s},
          {"num_merged", change.truth.num_merged},
          {"from_m", ToJson(change.truth.from)},
          {"to_m", ToJson(change.truth.to)},
          {"old_view_s", OrNull(change.truth.old_view_s)},
          {"new_view_s", OrNull(change.truth.new_view_s)},
          {"first_glimpse_s", OrNull(change.truth.first_glimpse_s)},
          {"counts", change.truth.counts()},
          {"why_not", change.truth.why_not},
          {"is_matched", change.report.has_value()},
          {"is_partial", change.is_partial},
          {"is_early", change.is_early},
          {"told_s", told},
          {"delay_s", OrNull(change.delay_s)},
          {"delay_from_old_place_s", OrNull(change.delay_from_old_place_s)}};
}

Json ToJson(const JudgedReport& report) {
  const bool is_replaced = report.report.kind == ChangeKind::kReplaced;
  return {{"kind", NameOf(report.report.kind)},
          {"class", ClassJson(report.report.class_id)},
          {"new_class", is_replaced ? ClassJson(report.report.new_class_id) : nullptr},
          {"object", report.report.object},
          {"from_m", ToJson(report.report.from)},
          {"to_m", ToJson(report.report.to)},
          {"told_s", report.time_s},
          {"verdict", NameOf(report.verdict)}};
}

Json ToJson(const LoopEvaluation& loops) {
  Json list = Json::array();
  for (const JudgedLoop& loop : loops.loops) {
    list.push_back({{"query_stamp", FormatStamp(loop.loop.query, 9)},
                    {"match_stamp", FormatStamp(loop.loop.match, 9)},
                    {"error_m", loop.error_m},
                    {"error_deg", loop.error_deg},
                    {"is_false", loop.is_false}});
  }
  return {{"num_accepted", loops.loops.size() + loops.num_without_truth},
          {"num_false", loops.num_false},
          {"num_without_truth", loops.num_without_truth},
          {"accepted", list}};
}

std::string Dump(const Json& json) {
  // A path need not be UTF-8; its odd bytes are replaced rather than thrown at the user.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string FormatJson(const ObjectReport& report, const SceneTruth& truth, const SceneRun& run) {
  Json json = Head("objects", truth, run, report.options);
  json["all"] = ToJson(report.objects.all);
  json["per_class"] = Json::object();
  for (const auto& [class_id, score] : report.objects.classes)
    json["per_class"][ClassJson(class_id).get<std::string>()] = ToJson(score);
  json["num_other_classes"] = report.objects.num_other_classes;
  json["ghosts"] = report.ghosts ? ToJson(*report.ghosts) : Json(nullptr);
  json["active"] = {{"num_active", report.active.num_active},
                    {"num_points", report.active.num_points},
                    {"share", OrNull(report.active.Share())}};
  json["places"] = Json::array();
  for (const TruePlace& place : report.objects.places)
    json["places"].push_back(ToJson(place, report.objects));
  json["objects"] = Json::array();
  for (const JudgedObject& object : report.objects.objects)
    json["objects"].push_back(ToJson(object));
  return Dump(json);
}

std::string FormatJson(const ChangeReport& report, const SceneTruth& truth, const SceneRun& run) {
  const ChangeEvaluation& changes = report.changes;
  Json json = Head("changes", truth, run, report.options);
  json["all"] = ToJson(changes.all);
  json["per_kind"] = Json::object();
  for (const auto& [kind, score] : changes.kinds)
    json["per_kind"][std::string(NameOf(kind))] = ToJson(score);
  json["num_partial"] = changes.num_partial;
  json["num_early"] = changes.num_early;
  json["num_other_classes"] = changes.num_other_classes;
  json["median_delay_s"] = OrNull(changes.median_delay_s);
  json["max_delay_s"] = OrNull(changes.max_delay_s);
  json["loops"] = report.loops ? ToJson(*report.loops) : Json(nullptr);
  json["changes"] = Json::array();
  for (const JudgedChange& change : changes.changes)
    json["changes"].push_back(ToJson(change, changes));
  json["reports"] = Json::array();
  for (const JudgedReport& told : changes.reports)
    json["reports"].push_back(ToJson(told));
  return Dump(json);
}

}  // namespace cslam
