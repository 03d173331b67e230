// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/run_writer.h"

#include "cslam/eval/trajectory_plot.h"
#include "cslam/io/config.h"
#include "cslam/io/point_cloud_file.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/navigation/grid_file.h"
#include "cslam/run/frames_csv.h"
#include "cslam/run/loops_json.h"
#include "cslam/run/map_cloud.h"
#include "cslam/run/object_report.h"
#include "cslam/run/run_json.h"
#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"
#include "cslam/util/options.h"

#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace cslam {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPoseColumns =
    "timestamp tx ty tz qx qy qz qw (s, m, unit quaternion; camera to world)";

std::string EffectiveYaml(SlamOptions options) {
  OptionList list;
  Describe(list, options);
  return DumpYaml(list);
}

void WritePlot(const fs::path& path, const RunReport& report, const Trajectory& estimate) {
  WriteTrajectorySvg(path, {.title = SequenceName(report.identity.sequence),
                            .estimate = estimate,
                            .reference = report.accuracy.reference,
                            .ate = report.accuracy.final_poses.ate});
}

void WritePoses(const fs::path& path, const Trajectory& trajectory, const char* what) {
  WriteTrajectory(path, trajectory, fmt::format("{}\n{}", what, kPoseColumns));
}

void WriteGrid(const fs::path& path, const RunReport& report, const RunResult& result,
               const OccupancyGridOptions& options) {
  const MapView& map = result.snapshot->map;
  const MapId id = LargestMap(result);
  const auto grid =
      BuildOccupancyGrid(map, id, report.camera.camera, AbsentObjects(map, id), options);
  if (grid) WriteOccupancyGrid(path, *grid);
}

// Runs every step, whatever becomes of the others.
class Steps {
 public:
  void Run(const std::function<void()>& step) {
    try {
      step();
    } catch (const Error& error) {
      if (!first_error_) first_error_ = error;
    }
  }

  void ThrowFirstError() const {
    if (first_error_) throw Error(*first_error_);
  }

 private:
  std::optional<Error> first_error_;
};

}  // namespace

void PrepareRunFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw Error("cannot create the output folder '{}': {}", folder.string(), error.message());
  }
  const AtomicFile probe(folder / "run.json", Durability::kRename);  // removed at once
  fs::remove(folder / "run.json", error);
  if (error) {
    throw Error("cannot replace the earlier run in '{}': {}", folder.string(), error.message());
  }
}

void WriteRunFolder(const RunReport& report, const RunOutcome& outcome,
                    const RunTrajectories& trajectories, const DatasetReader& dataset,
                    const SlamOptions& options) {
  const fs::path& folder = report.identity.folder;
  Steps steps;
  steps.Run([&] {
    WritePoses(folder / "trajectory.txt", trajectories.final_poses, "final poses of the frames");
  });
  steps.Run([&] {
    WritePoses(folder / "trajectory_live.txt", trajectories.live_poses,
               "poses of the frames as first published");
  });
  steps.Run([&] {
    WritePoses(folder / "keyframes.txt", trajectories.keyframes, "final poses of the keyframes");
  });
  steps.Run([&] { WriteFileAtomically(folder / "config.yaml", EffectiveYaml(options)); });
  steps.Run(
      [&] { WriteFileAtomically(folder / "frames.csv", FormatFramesCsv(outcome.log.frames)); });
  steps.Run(
      [&] { WriteFileAtomically(folder / "loops.json", FormatLoopsJson(outcome.log.loops)); });
  const std::string sequence = SequenceName(report.identity.sequence);
  steps.Run([&] {
    WriteReportedObjects(folder / "objects.json", ReportObjects(outcome.result, sequence));
  });
  steps.Run([&] {
    WriteReportedChanges(folder / "changes.json", ReportChanges(outcome.result, sequence));
  });
  steps.Run([&] {
    WritePointCloud(folder / "map.ply", ColourMap(outcome.result, dataset),
                    "map points, metres, world frame of trajectory.txt");
  });
  steps.Run([&] { WriteGrid(folder / "grid.yaml", report, outcome.result, options.grid); });
  steps.Run([&] { WritePlot(folder / "trajectory.svg", report, trajectories.final_poses); });
  steps.ThrowFirstError();
  WriteFileAtomically(folder / "run.json", FormatRunJson(report));
}

std::string SequenceName(const fs::path& sequence) {
  const fs::path path = fs::absolute(sequence).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

}  // namespace cslam
