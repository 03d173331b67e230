// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/eval/ate.h"
#include "cslam/eval/rpe.h"
#include "cslam/io/dataset.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/pipeline/slam.h"
#include "cslam/util/check.h"

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace cslam::test {

// The folder of recordings named by CSLAM_SHARED, or else "shared" beside the source folder.
inline std::filesystem::path SharedFolder() {
  const char* const shared = std::getenv("CSLAM_SHARED");
  if (shared != nullptr) return shared;
  return std::filesystem::path(CSLAM_SOURCE_DIR).parent_path() / "shared";
}

// A recording under SharedFolder()/data; nullopt when it is not on this machine.
inline std::optional<std::filesystem::path> FindRecording(const std::string& name) {
  const std::filesystem::path folder = SharedFolder() / "data" / name;
  if (!std::filesystem::exists(folder / "rgb.txt")) return std::nullopt;
  return folder;
}

struct RecordingRun {
  std::size_t num_frames = 0;
  std::size_t num_tracked = 0;
  AteResult ate;  // of the final trajectory
  RpeResult rpe;
};

// Runs SLAM inline on the first frames of a recording that has ground truth.
inline RecordingRun RunRecording(const std::filesystem::path& folder, std::size_t num_frames) {
  DatasetOptions options;
  options.frames = num_frames;
  const auto dataset = OpenDataset(folder, options);
  Slam slam(dataset->camera().camera, SlamOptions{}, Execution::kInline);
  for (std::size_t i = 0; i < dataset->size(); ++i) {
    LoadResult loaded = dataset->Load(i);
    if (loaded.frame) slam.Feed(std::make_shared<const RgbdFrame>(std::move(*loaded.frame)));
  }
  const auto ground_truth = dataset->ground_truth();
  CSLAM_CHECK(ground_truth.has_value(), "{} has no ground truth", folder.string());
  const Trajectory reference = ReadTrajectory(*ground_truth);
  const Trajectory estimate = FinalTrajectory(slam.Finish());
  return {.num_frames = dataset->size(),
          .num_tracked = estimate.size(),
          .ate = EvaluateAte(reference, estimate),
          .rpe = EvaluateRpe(reference, estimate)};
}

}  // namespace cslam::test
