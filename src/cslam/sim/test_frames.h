// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/trajectory.h"
#include "cslam/sim/simulated_sequence.h"

#include <memory>
#include <vector>

namespace cslam::test {

// A simulated sequence, rendered once for all tests of a program.
struct TestFrames {
  Camera camera;
  std::vector<std::shared_ptr<const RgbdFrame>> frames;
  Trajectory truth;  // one pose per frame
};

// The start of the demo tour. every: takes each every-th frame, for faster motion.
inline TestFrames MakeTestFrames(const SequenceOptions& options, int every = 1) {
  const SimulatedSequence sequence = MakeDemoSequence(options);
  TestFrames result;
  result.camera = sequence.camera();
  for (int i = 0; i < sequence.size(); i += every) {
    result.frames.push_back(std::make_shared<const RgbdFrame>(sequence.Frame(i)));
    result.truth.push_back({sequence.stamp(i), sequence.T_world_camera(i)});
  }
  return result;
}

}  // namespace cslam::test
