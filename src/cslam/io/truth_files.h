// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/util/stamp.h"
#include "cslam/vision/box.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The truth about a rendered sequence: detections.json, objects.json and changes.json
// (docs/formats.md). SLAM never reads them unless they are named on the command line; evaluation,
// `dataset check` and the recorded detector do.

namespace cslam {

constexpr int kTruthFileVersion = 1;

// detections.json --------------------------------------------------------------------------------

struct RecordedDetection {
  int instance = 0;  // id in the instance images; 0: not known (a real detector's recording)
  int class_id = 0;  // COCO
  double score = 1.0;
  Box box;             // around the visible pixels, exact
  int visible_px = 0;  // pixels of the instance in the image

  bool operator==(const RecordedDetection&) const = default;
};

struct RecordedFrame {
  Stamp stamp;
  std::vector<RecordedDetection> detections;  // by instance id

  bool operator==(const RecordedFrame&) const = default;
};

struct DetectionRecord {
  std::string sequence;
  int width_px = 0;
  int height_px = 0;
  std::vector<RecordedFrame> frames;  // in order of time, frames without detections included
};

// objects.json -----------------------------------------------------------------------------------

// A stretch of time in which an object is there: resting (one pose) or moving (many).
struct TrueInterval {
  double from_s = 0.0;  // since the sequence's start
  double to_s = 0.0;
  bool is_moving = false;
  struct Sample {
    double time_s = 0.0;
    Se3 T_world_object;
  };
  std::vector<Sample> poses;  // one at from_s if it rests
};

struct TrueObject {
  int instance = 0;
  std::string name;
  int class_id = -1;           // COCO; -1: none of its classes
  bool is_deformable = false;  // people: the box holds the body in all its poses
  Eigen::Vector3d box_center = Eigen::Vector3d::Zero();  // m, object frame
  Eigen::Vector3d box_size_m = Eigen::Vector3d::Zero();  // along the object's axes
  std::vector<TrueInterval> intervals = {};              // in order of time
};

struct TrueObjects {
  std::string sequence;
  double duration_s = 0.0;
  Stamp start;                      // stamp of time 0
  std::vector<TrueObject> objects;  // by instance id, the room (0) not among them
};

// changes.json -----------------------------------------------------------------------------------

enum class ChangeKind { kRemoved, kAdded, kMoved, kReplaced };
std::string_view NameOf(ChangeKind kind);  // "removed", ...

struct TrueChange {
  ChangeKind kind = ChangeKind::kMoved;
  double time_s = 0.0;  // when it is done
  int instance = 0;     // what left or moved; for kAdded what came
  int class_id = -1;
  int new_instance = 0;  // kReplaced: what stands there now; otherwise 0
  int new_class_id = -1;
  std::optional<Se3> from = {};     // T_world_object before; none for kAdded
  std::optional<Se3> to = {};       // and after; none for kRemoved
  bool is_carried_in_view = false;  // somebody moves it while the camera may watch
};

struct TrueChanges {
  std::string sequence;
  std::vector<TrueChange> changes;  // in order of time
};

// Readers throw Error with file and the place in it (line of broken JSON, path of a wrong value);
// a newer version is an error that says so. Writers are atomic.
DetectionRecord ReadDetections(const std::filesystem::path& file);
TrueObjects ReadTrueObjects(const std::filesystem::path& file);
TrueChanges ReadTrueChanges(const std::filesystem::path& file);
void WriteDetections(const std::filesystem::path& file, const DetectionRecord& record);
void WriteTrueObjects(const std::filesystem::path& file, const TrueObjects& objects);
void WriteTrueChanges(const std::filesystem::path& file, const TrueChanges& changes);

}  // namespace cslam
