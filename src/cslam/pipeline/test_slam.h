// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// A short recording, small and quick to go through, for tests of the whole system.

#include "cslam/pipeline/slam.h"
#include "cslam/sim/test_frames.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace cslam::test {

inline const TestFrames& Frames() {
  static const auto frames =
      MakeTestFrames({.width = 320, .height = 240, .fps = 10.0, .num_frames = 20});
  return frames;
}

inline SlamOptions SmallOptions() {
  SlamOptions options;
  options.tracking.orb.num_features = 500;
  options.tracking.keyframe.max_interval_frames = 4;
  options.tracking.recently_lost_s = 1000.0;  // however slow the machine is
  options.mapping.check_invariants = true;
  return options;
}

// The frame as it is, but of the given id and stamp.
inline std::shared_ptr<const RgbdFrame> Renamed(const RgbdFrame& frame, std::uint32_t id,
                                                Stamp stamp) {
  RgbdFrame renamed = frame;
  renamed.id = FrameId(id);
  renamed.stamp = stamp;
  return std::make_shared<const RgbdFrame>(std::move(renamed));
}

inline std::string NameOf(const testing::TestParamInfo<Execution>& info) {
  return info.param == Execution::kInline ? "Inline" : "Threaded";
}

}  // namespace cslam::test
