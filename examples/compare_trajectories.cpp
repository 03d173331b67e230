// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Prints the absolute trajectory error of an estimate: compare_trajectories REFERENCE ESTIMATE
#include "cslam/eval/ate.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/util/check.h"

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s REFERENCE ESTIMATE\n", argv[0]);
    return 2;
  }
  try {
    const cslam::AteResult result =
        cslam::EvaluateAte(cslam::ReadTrajectory(argv[1]), cslam::ReadTrajectory(argv[2]));
    std::printf("%zu poses matched, ATE RMSE %.4f m\n", result.errors_m.size(),
                result.statistics_m.rmse);
  } catch (const cslam::Error& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 1;
  }
  return 0;
}
