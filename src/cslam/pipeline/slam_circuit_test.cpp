// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// What happens when the camera comes round to where it began.
#include "cslam/pipeline/test_slam.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace cslam {
namespace {

using test::NameOf;
using test::Renamed;

// Fast enough for the picture to be another one at the end.
const test::TestFrames& Frames() {
  static const auto frames =
      test::MakeTestFrames({.width = 320, .height = 240, .fps = 10.0, .num_frames = 100}, 5);
  return frames;
}

class Recorder : public OutputSink {
 public:
  void OnMap(const MapUpdate& update) override {
    if (update.step == MapUpdate::Step::kCorrected) corrections.push_back(*update.correction);
  }
  std::vector<CorrectionReport> corrections;
};

class SlamCircuitTest : public testing::TestWithParam<Execution> {
 protected:
  // The recording, and the same way back. It is short, and sees much at once.
  void GoThereAndBack(bool adjusts_circuits) {
    SlamOptions options = test::SmallOptions();
    options.places.circuit.enabled = adjusts_circuits;
    options.places.circuit.min_shared_points = 100;
    options.places.circuit.min_keyframes_away = 3;
    options.places.circuit.confirmations = 1;
    Slam slam(Frames().camera, options, GetParam(), {recorder_});
    const auto& frames = Frames().frames;
    const std::size_t n = frames.size();
    for (std::size_t i = 0; i < 2 * n; ++i) {
      const auto number = static_cast<std::uint32_t>(i);
      const RgbdFrame& frame = *frames[i < n ? i : 2 * n - 1 - i];
      slam.Feed(Renamed(frame, number, Stamp{0} + std::int64_t{100'000'000} * number));
    }
    result_ = slam.Finish();
  }
  const std::shared_ptr<Recorder> recorder_ = std::make_shared<Recorder>();
  RunResult result_;
};
INSTANTIATE_TEST_SUITE_P(Executions, SlamCircuitTest,
                         testing::Values(Execution::kInline, Execution::kThreaded), NameOf);

TEST_P(SlamCircuitTest, AdjustsTheWholeMapThoughNoLoopIsClosed) {
  GoThereAndBack(true);
  EXPECT_TRUE(result_.snapshot->map.loops().empty());
  ASSERT_FALSE(recorder_->corrections.empty());
  EXPECT_TRUE(recorder_->corrections[0].is_applied()) << recorder_->corrections[0].refusal;
  EXPECT_GT(recorder_->corrections[0].keyframes_moved, 3);
}

TEST_P(SlamCircuitTest, LeavesTheMapAloneIfTurnedOff) {
  GoThereAndBack(false);
  EXPECT_TRUE(recorder_->corrections.empty());
}

}  // namespace
}  // namespace cslam
