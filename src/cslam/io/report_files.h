// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/truth_files.h"
#include "cslam/util/stamp.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// What a run says about objects and changes: objects.json and changes.json of a run folder
// (docs/formats.md). World: that of the run's trajectory.

namespace cslam {

// objects.json -----------------------------------------------------------------------------------

struct BeliefSample {
  Stamp stamp;
  double belief = 0.5;  // 0 to 1, that the object is where it was seen
  std::string cause;    // "seen", "absent", "moved", "merged", ...
};

struct ReportedObject {
  int id = -1;
  int map = 0;
  int class_id = -1;  // COCO
  std::string state;  // "candidate", "present" or "absent"
  double belief = 0.5;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // m, world: mean of its points
  // Oriented, robust extent.
  Eigen::Vector3d box_center = Eigen::Vector3d::Zero();              // m, world
  Eigen::Vector3d box_size_m = Eigen::Vector3d::Zero();              // along the box's own axes
  Eigen::Quaterniond box_rotation = Eigen::Quaterniond::Identity();  // box to world
  // The paper's extent, along the axes of the world.
  Eigen::Vector3d extent_min = Eigen::Vector3d::Zero();
  Eigen::Vector3d extent_max = Eigen::Vector3d::Zero();
  int num_points = 0;
  int num_active_points = 0;
  Stamp first_seen = {};
  Stamp last_seen = {};
  std::optional<Stamp> absent_since = {};  // when it was last found to be gone, if it is
  std::vector<BeliefSample> history = {};  // in order of time
};

struct ReportedObjects {
  std::string sequence;
  std::vector<ReportedObject> objects;  // ids are unique
};

// changes.json -----------------------------------------------------------------------------------

struct ReportedChange {
  ChangeKind kind = ChangeKind::kMoved;
  int object = -1;      // what left or moved; for kAdded what came
  int new_object = -1;  // kMoved: its id at the new place; kReplaced: what is there now
  int class_id = -1;
  int new_class_id = -1;
  std::optional<Eigen::Vector3d> from = {};  // centroid before, m, world; none for kAdded
  std::optional<Eigen::Vector3d> to = {};    // and after; none for kRemoved
  Stamp last_seen_there = {};                // for kAdded: when the place was last seen without it
  std::optional<Stamp> first_seen_absent = {};  // absent if nobody saw the old place empty
  Stamp reported = {};
  double confidence = 0.0;  // 0 to 1
  int num_absent_views = 0;
  int num_seen_views = 0;
  bool is_between_sessions = false;

  bool operator==(const ReportedChange&) const = default;
};

struct ReportedChanges {
  std::string sequence;
  std::vector<ReportedChange> changes;
};

// Readers throw Error with file and the place in it; a newer version is an error that says so.
// Writers are atomic.
ReportedObjects ReadReportedObjects(const std::filesystem::path& file);
ReportedChanges ReadReportedChanges(const std::filesystem::path& file);
void WriteReportedObjects(const std::filesystem::path& file, const ReportedObjects& objects);
void WriteReportedChanges(const std::filesystem::path& file, const ReportedChanges& changes);

}  // namespace cslam
