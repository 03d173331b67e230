// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/scene_run.h"

#include "cslam/io/json_reader.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/io/truth_json.h"
#include "cslam/scene_eval/ply_points.h"
#include "cslam/util/check.h"

#include <map>
#include <utility>

namespace cslam {
namespace {

Trajectory ReadRunTrajectory(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "trajectory.txt";
  if (!std::filesystem::exists(file))
    throw Error("'{}' holds no trajectory.txt; give a folder that 'run' wrote", folder.string());
  Trajectory trajectory = ReadTrajectory(file);
  if (trajectory.empty()) throw Error("'{}' has no poses: the run tracked nothing", file.string());
  return trajectory;
}

AteResult AlignToTruth(const Trajectory& truth, const Trajectory& run) {
  AteOptions options;
  const PoseAssociation association = AssociatePosesOrThrow(truth, run, options.association);
  std::vector<Eigen::Vector3d> true_centres;
  std::vector<Eigen::Vector3d> centres;
  for (const PosePair& pair : association.pairs) {
    true_centres.push_back(pair.reference.translation);
    centres.push_back(pair.estimate.translation);
  }
  if (!AlignPoints(true_centres, centres).is_unique)
    options.alignment = TrajectoryAlignment::kOrigin;
  return EvaluateAte(truth, run, options);
}

// The map whose objects have the most points; of equals the first.
int LargestMap(const std::vector<ReportedObject>& objects) {
  std::map<int, int> num_points;
  for (const ReportedObject& object : objects)
    num_points[object.map] += 1 + object.num_points;
  int largest = 0;
  int most = 0;
  for (const auto& [map, count] : num_points) {
    if (count <= most) continue;
    largest = map;
    most = count;
  }
  return largest;
}

std::vector<FoundObject> ReadObjects(const std::filesystem::path& file, const Se3& T_truth_run) {
  const ReportedObjects reported = ReadReportedObjects(file);
  const int map = LargestMap(reported.objects);
  std::vector<FoundObject> objects;
  for (const ReportedObject& object : reported.objects) {
    if (object.map == map) objects.push_back(MoveToTruth(object, T_truth_run));
  }
  return objects;
}

std::vector<ReportedChange> ReadChanges(const std::filesystem::path& file, const Se3& T_truth_run) {
  std::vector<ReportedChange> changes = ReadReportedChanges(file).changes;
  for (ReportedChange& change : changes)
    change = MoveToTruth(change, T_truth_run);
  return changes;
}

std::vector<Eigen::Vector3d> ReadPoints(const std::filesystem::path& file, const Se3& T_truth_run) {
  std::vector<Eigen::Vector3d> points = ReadPlyPoints(file);
  for (Eigen::Vector3d& point : points)
    point = T_truth_run * point;
  return points;
}

std::vector<AcceptedLoop> ReadLoops(const std::filesystem::path& file) {
  const JsonFile json(file);
  RequireFormat(json.root(), "loops");
  std::vector<AcceptedLoop> loops;
  for (const JsonValue& item : json.root().At("candidates").Items()) {
    const std::string verdict = item.At("verdict").Text();
    const JsonValue pose = item.At("T_match_query");
    if ((verdict != "closed" && verdict != "merged") || pose.IsNull()) continue;
    const auto number = [&](const char* key) { return pose.At(key).Number(); };
    const Eigen::Quaterniond q(number("qw"), number("qx"), number("qy"), number("qz"));
    loops.push_back({.query = ReadStamp(item.At("query_stamp")),
                     .match = ReadStamp(item.At("match_stamp")),
                     .T_match_query = Se3(q, {number("tx_m"), number("ty_m"), number("tz_m")})});
  }
  return loops;
}

// What a reader makes of a file; nothing if it is not there.
template <typename Reader>
auto ReadIfThere(const std::filesystem::path& file, const Reader& reader)
    -> std::optional<decltype(reader(file))> {
  if (!std::filesystem::exists(file)) return std::nullopt;
  return reader(file);
}

}  // namespace

FoundObject MoveToTruth(const ReportedObject& object, const Se3& T_truth_run) {
  const Eigen::Vector3d middle = 0.5 * (object.extent_min + object.extent_max);
  return {.report = object,
          .centroid = T_truth_run * object.centroid,
          .box = {T_truth_run * Se3(object.box_rotation, object.box_center), object.box_size_m},
          .axis_extent = {T_truth_run * Se3(Eigen::Quaterniond::Identity(), middle),
                          object.extent_max - object.extent_min}};
}

ReportedChange MoveToTruth(const ReportedChange& change, const Se3& T_truth_run) {
  ReportedChange moved = change;
  if (change.from) moved.from = T_truth_run * *change.from;
  if (change.to) moved.to = T_truth_run * *change.to;
  return moved;
}

SessionTime ReadSessionTime(const std::filesystem::path& folder) {
  const Trajectory trajectory = ReadRunTrajectory(folder);
  return {.from = trajectory.front().stamp, .to = trajectory.back().stamp};
}

SceneRun ReadSceneRun(const std::filesystem::path& folder, const Trajectory& true_trajectory) {
  SceneRun run;
  run.folder = folder;
  run.trajectory = ReadRunTrajectory(folder);
  const AteResult ate = AlignToTruth(true_trajectory, run.trajectory);
  run.alignment = ate.options.alignment;
  run.T_truth_run = ate.alignment.T_a_b;
  run.ate_rmse_m = ate.statistics_m.rmse;
  const Se3& T = run.T_truth_run;
  run.objects = ReadIfThere(folder / "objects.json",
                            [&](const std::filesystem::path& f) { return ReadObjects(f, T); });
  run.changes = ReadIfThere(folder / "changes.json",
                            [&](const std::filesystem::path& f) { return ReadChanges(f, T); });
  run.map_points = ReadIfThere(folder / "map.ply",
                               [&](const std::filesystem::path& f) { return ReadPoints(f, T); });
  run.loops = ReadIfThere(folder / "loops.json", ReadLoops);
  return run;
}

}  // namespace cslam
