// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/scene_truth.h"

#include "cslam/dataset/check_folder.h"
#include "cslam/io/camera_file.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/io/tum_dataset.h"
#include "cslam/semantics/coco.h"
#include "cslam/semantics/detection.h"
#include "cslam/util/check.h"

#include <algorithm>

namespace cslam {
namespace {

constexpr double kSamePlaceM = 1e-4;
constexpr double kSameAngleRad = 1e-4;

void RequireTruthFiles(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw Error("no folder '{}'; give one that 'dataset render' wrote", folder.string());
  for (const char* name :
       {"objects.json", "changes.json", "detections.json", "groundtruth.txt", "camera.yaml"}) {
    if (!std::filesystem::exists(folder / name)) {
      throw Error("'{}' holds no {}; the truth about objects is in folders of 'dataset render'",
                  folder.string(), name);
    }
  }
}

bool IsSamePlace(const Se3& a, const Se3& b) {
  const PoseDifference difference = Difference(a, b);
  return difference.distance_m < kSamePlaceM && difference.angle_rad < kSameAngleRad;
}

}  // namespace

SceneTruth ReadSceneTruth(const std::filesystem::path& folder) {
  RequireTruthFiles(folder);
  SceneTruth truth;
  truth.folder = folder;
  truth.objects = ReadTrueObjects(folder / "objects.json");
  truth.changes = ReadTrueChanges(folder / "changes.json");
  truth.detections = ReadDetections(folder / "detections.json");
  truth.trajectory = ReadTrajectory(folder / "groundtruth.txt");
  truth.frames =
      std::make_unique<FolderFrames>(ReadTumIndex(folder), ReadCameraFile(folder / "camera.yaml"));
  return truth;
}

PlacedBox BoxOf(const TrueObject& object, const Se3& T_world_object) {
  return {.T_world_box = T_world_object * Se3(Eigen::Quaterniond::Identity(), object.box_center),
          .size_m = object.box_size_m};
}

std::vector<Rest> RestsOf(const TrueObject& object) {
  std::vector<Rest> rests;
  if (object.is_deformable) return rests;
  for (const TrueInterval& interval : object.intervals) {
    if (interval.is_moving || interval.poses.empty()) continue;
    const Se3& T_world_object = interval.poses.front().T_world_object;
    const bool goes_on = !rests.empty() && rests.back().to_s >= interval.from_s &&
                         IsSamePlace(rests.back().T_world_object, T_world_object);
    if (goes_on) {
      rests.back().to_s = interval.to_s;
    } else {
      rests.push_back({interval.from_s, interval.to_s, T_world_object});
    }
  }
  return rests;
}

std::set<int> ClassesOf(const TrueObjects& objects) {
  std::set<int> classes;
  for (const TrueObject& object : objects.objects) {
    const bool is_known = object.class_id >= 0 && object.class_id < kNumCocoClasses;
    if (is_known && object.class_id != kPersonClass) classes.insert(object.class_id);
  }
  return classes;
}

}  // namespace cslam
