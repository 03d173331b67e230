// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/visibility.h"
#include "cslam/eval/ate.h"
#include "cslam/geometry/trajectory.h"
#include "cslam/io/report_files.h"
#include "cslam/util/stamp.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

// An object as a run tells of it, moved into the frame of the truth.
struct FoundObject {
  ReportedObject report = {};  // as told, in the run's own frame
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  PlacedBox box = {};          // its oriented extent
  PlacedBox axis_extent = {};  // the paper's
};

// A loop or merge that a run accepted.
struct AcceptedLoop {
  Stamp query;
  Stamp match;
  Se3 T_match_query;
};

// The time of a session.
struct SessionTime {
  Stamp from;
  Stamp to;
};

// What a run folder says, in the frame of the truth.
struct SceneRun {
  std::filesystem::path folder = {};
  Trajectory trajectory = {};
  TrajectoryAlignment alignment = TrajectoryAlignment::kSe3;
  Se3 T_truth_run = {};
  double ate_rmse_m = 0.0;
  std::optional<std::vector<FoundObject>> objects = {};         // absent: no such file
  std::optional<std::vector<ReportedChange>> changes = {};      // places moved, ids as told
  std::optional<std::vector<Eigen::Vector3d>> map_points = {};  // active ones
  std::optional<std::vector<AcceptedLoop>> loops = {};

  // The session whose map the run went on with, on the same sequence; absent: it began with
  // nothing.
  std::optional<SessionTime> earlier = {};

  // From when the map may know of things.
  Stamp memory_start() const { return earlier ? earlier->from : first_stamp(); }
  Stamp first_stamp() const { return trajectory.front().stamp; }
  Stamp last_stamp() const { return trajectory.back().stamp; }
};

// Aligns the run's trajectory with the truth's: rigidly, or, where the camera moved on a line or
// hardly at all, by the first pair of poses. Objects of other maps than the one that holds most
// points of objects are left out: their frame is not that of the trajectory. Throws Error without a
// trajectory, or for a broken file.
SceneRun ReadSceneRun(const std::filesystem::path& folder, const Trajectory& true_trajectory);

// The time of the session that wrote that run folder.
SessionTime ReadSessionTime(const std::filesystem::path& folder);

// The same for what is in memory.
FoundObject MoveToTruth(const ReportedObject& object, const Se3& T_truth_run);
ReportedChange MoveToTruth(const ReportedChange& change, const Se3& T_truth_run);

}  // namespace cslam
