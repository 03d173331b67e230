// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/run_accuracy.h"

#include "cslam/io/trajectory_file.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <functional>
#include <system_error>

namespace cslam {
namespace {

namespace fs = std::filesystem;

fs::path CameraGroundTruth(const fs::path& ground_truth) {
  const fs::path path = ground_truth.parent_path() / "groundtruth_camera.txt";
  std::error_code ignored;
  return fs::exists(path, ignored) ? path : ground_truth;
}

// Runs one step; an Error becomes a problem, told once.
void Attempt(const char* what, RunAccuracy& accuracy, const std::function<void()>& step) {
  try {
    step();
  } catch (const Error& error) {
    std::string problem = fmt::format("{} cannot be measured: {}", what, error.what());
    auto& problems = accuracy.problems;
    if (std::find(problems.begin(), problems.end(), problem) == problems.end()) {
      problems.push_back(std::move(problem));
    }
  }
}

}  // namespace

RunAccuracy MeasureAccuracy(const fs::path& ground_truth, const Trajectory& final_poses,
                            const Trajectory& live_poses) {
  RunAccuracy accuracy;
  accuracy.ate_reference = ground_truth.string();
  accuracy.rpe_reference = CameraGroundTruth(ground_truth).string();
  Attempt("ATE", accuracy, [&] {
    accuracy.reference = ReadTrajectory(accuracy.ate_reference);
    accuracy.final_poses.ate = EvaluateAte(accuracy.reference, final_poses);
    accuracy.live_poses.ate = EvaluateAte(accuracy.reference, live_poses);
  });
  Attempt("RPE", accuracy, [&] {
    const Trajectory reference = ReadTrajectory(accuracy.rpe_reference);
    accuracy.final_poses.rpe = EvaluateRpe(reference, final_poses);
    accuracy.live_poses.rpe = EvaluateRpe(reference, live_poses);
  });
  return accuracy;
}

}  // namespace cslam
