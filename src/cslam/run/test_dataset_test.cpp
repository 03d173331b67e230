// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/test_dataset.h"

#include "cslam/sim/simulated_sequence.h"

#include <utility>

namespace cslam {
namespace {

MemoryDataset Render(int num_frames) {
  const SimulatedSequence sequence = MakeDemoSequence({.width = 320, .height = 240});
  CameraConfig camera;
  camera.camera = sequence.camera();
  camera.name = "simulated";
  std::vector<RgbdFrame> frames;
  Trajectory truth;
  for (int i = 0; i < num_frames; ++i) {
    frames.push_back(sequence.Frame(i));
    truth.push_back({sequence.stamp(i), sequence.T_world_camera(i)});
  }
  return {std::move(camera), std::move(frames), std::move(truth)};
}

}  // namespace

const MemoryDataset& RenderedDataset() {
  static const MemoryDataset kDataset = Render(20);
  return kDataset;
}

}  // namespace cslam
