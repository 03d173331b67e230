// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace cslam {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

class ProgressSinkTest : public testing::Test {
 protected:
  // What was printed so far.
  std::string Printed() {
    std::fflush(stream_.get());
    std::rewind(stream_.get());
    std::string text;
    for (int c = std::fgetc(stream_.get()); c != EOF; c = std::fgetc(stream_.get()))
      text += static_cast<char>(c);
    return text;
  }

  static TrackingResult Frame(std::uint32_t id, TrackingState state, const char* reason) {
    TrackingResult result;
    result.frame = FrameId(id);
    result.state = state;
    result.reason = reason;
    result.num_inliers = 90;
    return result;
  }

  std::FILE* stream() const { return stream_.get(); }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> stream_{std::tmpfile()};
};

TEST_F(ProgressSinkTest, CountsFromTheFirstFrameWhenLinesAreDue) {
  ProgressSink sink(stream(), {.first_frame = 100, .num_frames = 20, .interval_ms = 0.0});
  sink.OnFrame(Frame(104, TrackingState::kTracking, ""));
  EXPECT_THAT(Printed(), HasSubstr("frame 5 of 20, tracking, 90 inliers, 0 keyframes"));
}

TEST_F(ProgressSinkTest, SaysNothingBeforeTheNextLineIsDue) {
  ProgressSink sink(stream(), {.num_frames = 20, .interval_ms = 1e9});
  sink.OnFrame(Frame(0, TrackingState::kTracking, ""));
  sink.OnFinish(RunResult());
  EXPECT_EQ(Printed(), "");
}

TEST_F(ProgressSinkTest, TellsLossAndRecoveryWithReasonAtOnce) {
  ProgressSink sink(stream(), {.num_frames = 20, .interval_ms = 1e9});
  sink.OnFrame(Frame(0, TrackingState::kTracking, "map 0 starts"));
  sink.OnFrame(Frame(1, TrackingState::kRecentlyLost, "11 inliers < 30"));
  sink.OnFrame(Frame(2, TrackingState::kRecentlyLost, "8 inliers < 30"));
  sink.OnFrame(Frame(3, TrackingState::kTracking, "50 inliers"));
  EXPECT_EQ(Printed(),
            "frame 1 (0.000000 s): recently_lost: 11 inliers < 30\n"
            "frame 3 (0.000000 s): tracking: 50 inliers\n");
}

TEST_F(ProgressSinkTest, LeavesNoBarBehindWhenItEnds) {
  {
    ProgressSink sink(stream(), {.style = ProgressStyle::kBar, .num_frames = 2});
    while (Printed().empty())  // until the first bar is due
      sink.OnFrame(Frame(0, TrackingState::kTracking, ""));
    EXPECT_THAT(Printed(), HasSubstr("[############............] frame 1 of 2"));
  }
  EXPECT_THAT(Printed(), EndsWith("\r\033[K"));
}

TrackingResult MakeFrame() {
  TrackingResult result;
  result.frame = FrameId(0);
  return result;
}

TEST(ProgressSink, GoesOnWhenTheStreamTakesNothing) {
  std::FILE* const full = std::fopen("/dev/full", "w");
  ASSERT_NE(full, nullptr);
  ProgressSink sink(full, {.num_frames = 2, .interval_ms = 0.0});
  EXPECT_NO_THROW(sink.OnFrame(MakeFrame()));
  std::fclose(full);
}

}  // namespace
}  // namespace cslam
