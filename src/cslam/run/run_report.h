// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/run/process_info.h"
#include "cslam/run/run_accuracy.h"
#include "cslam/run/run_sequence.h"
#include "cslam/run/stage_times.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

// Which run it was.
struct RunIdentity {
  std::string version;
  std::string commit;
  std::vector<std::string> arguments;  // after the name of the program
  std::filesystem::path sequence;
  std::filesystem::path folder;  // of the results
  RunSettings settings;
  DetectorInfo detector = {};           // kind "none" if there was none
  std::string schedule = {};            // of its detections: "every-frame" or "live"
  std::filesystem::path map = {};       // that it went on in; empty: none
  std::filesystem::path save_map = {};  // where its map was saved; empty: nowhere
};

// Input frames are those that were read or should have been: all of the sequence, or of the part
// asked for, up to an interruption.
struct FrameCounts {
  std::size_t input = 0;
  std::size_t unreadable = 0;  // skipped
  std::uint64_t dropped = 0;   // the tracker was busy (sensor rate)
  std::size_t processed = 0;   // the rest, by state:
  std::size_t initialising = 0;
  std::size_t tracking = 0;
  std::size_t recently_lost = 0;
  std::size_t lost = 0;
  std::size_t in_trajectory = 0;  // tracked in the map that holds most frames

  double TrackedPercent() const;  // of the input frames, in the trajectory
};

struct MapCounts {
  std::size_t num_maps = 0;           // in which frames were tracked; merged ones count once
  std::size_t keyframes = 0;          // of the map that holds most frames
  std::size_t earlier_keyframes = 0;  // of these, made by earlier runs
  std::size_t points = 0;
  double mean_keyframe_bytes = 0.0;  // estimated: features, descriptors, small depth image, links
};

// Everything there is to tell about a finished run, in plain values.
struct RunReport {
  RunIdentity identity;
  CameraConfig camera;
  HostInfo host;
  bool was_interrupted = false;
  FrameCounts frames;
  std::vector<std::string> frame_problems;  // of unreadable frames, the first few
  MapCounts map;
  MappingCounts mapping;
  std::string last_reason;   // why the last frame's state is what it is
  double recording_s = 0.0;  // from the first frame to the last, by their stamps
  double path_length_m = 0.0;
  RunCost cost;
  std::optional<double> first_pose_ms;  // since the process was started
  std::vector<StageSummary> stages;
  RunAccuracy accuracy;

  double RealTimeFactor() const;  // seconds of recording per second of work; 0 if unknown
};

// The final and the live trajectory of a run and its keyframes, all in one map's world frame.
struct RunTrajectories {
  Trajectory final_poses;
  Trajectory live_poses;
  Trajectory keyframes;
};
RunTrajectories ExtractTrajectories(const RunResult& result);

RunReport MakeReport(RunIdentity identity, const DatasetReader& dataset, const RunOutcome& outcome,
                     const RunTrajectories& trajectories);

}  // namespace cslam
