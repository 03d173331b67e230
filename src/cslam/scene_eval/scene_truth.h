// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/check_frames.h"
#include "cslam/dataset/visibility.h"
#include "cslam/geometry/trajectory.h"
#include "cslam/io/truth_files.h"
#include "cslam/util/stamp.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace cslam {

// What really was where in a rendered sequence, and its frames to see what the camera could see.
// Times are seconds since the sequence's start.
struct SceneTruth {
  std::filesystem::path folder = {};
  TrueObjects objects = {};
  TrueChanges changes = {};
  DetectionRecord detections = {};
  Trajectory trajectory = {};                      // of the camera
  std::unique_ptr<const CheckFrames> frames = {};  // never null

  double TimeOf(Stamp stamp) const { return SecondsBetween(stamp, objects.start); }
};

// Throws Error if folder is no rendered sequence, or one of its files is broken.
SceneTruth ReadSceneTruth(const std::filesystem::path& folder);

// The box of an object, were it at that pose.
PlacedBox BoxOf(const TrueObject& object, const Se3& T_world_object);

// A stretch of time in which a rigid object rests in one place.
struct Rest {
  double from_s = 0.0;
  double to_s = 0.0;
  Se3 T_world_object;
};
std::vector<Rest> RestsOf(const TrueObject& object);

// The COCO classes of the truth's objects, without people.
std::set<int> ClassesOf(const TrueObjects& objects);

}  // namespace cslam
