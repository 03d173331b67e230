// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// How far tracking runs ahead of a detector that takes its time.
#include "cslam/pipeline/test_slam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>

namespace cslam {
namespace {

using test::Frames;
using test::Renamed;
using test::SmallOptions;

// How far tracking has come, for those who wait for it.
class Progress : public OutputSink {
 public:
  void OnFrame(const TrackingResult& result) override {
    const std::scoped_lock lock(mutex_);
    newest_ = result.frame.value();
    changed_.notify_all();
  }
  // How many frames tracking is ahead of one, once that is more than at_least or it takes too long.
  std::uint32_t WaitUntilAhead(FrameId frame, std::uint32_t at_least,
                               std::chrono::milliseconds at_most) {
    std::unique_lock lock(mutex_);
    const auto ahead = [&] { return newest_ > frame.value() ? newest_ - frame.value() : 0U; };
    changed_.wait_for(lock, at_most, [&] { return ahead() > at_least; });
    return ahead();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint32_t newest_ = 0;
};

// Finds nothing, and is done with a frame only once tracking is more than so far ahead of it.
class SlowDetector : public Detector {
 public:
  SlowDetector(std::shared_ptr<Progress> progress, std::uint32_t until_ahead,
               std::chrono::milliseconds at_most, std::atomic<std::uint32_t>& most_ahead)
      : progress_(std::move(progress)),
        until_ahead_(until_ahead),
        at_most_(at_most),
        most_ahead_(most_ahead) {}
  Detections Detect(const RgbdFrame& frame) override {
    const bool is_waited_for = frame.id.value() == 0;
    if (!is_waited_for) {
      most_ahead_ =
          std::max(most_ahead_.load(), progress_->WaitUntilAhead(frame.id, until_ahead_, at_most_));
    }
    return {frame.id, frame.stamp, {}};
  }
  DetectorInfo info() const override { return {.kind = "slow", .name = "", .source = ""}; }

 private:
  const std::shared_ptr<Progress> progress_;
  const std::uint32_t until_ahead_;
  const std::chrono::milliseconds at_most_;
  std::atomic<std::uint32_t>& most_ahead_;
};

class ThreadedSlamWithSlowDetector : public testing::Test {
 protected:
  ThreadedSlamWithSlowDetector() {
    options_.detection.live_stride = 1;
    options_.detection.live_max_ahead = 1;
  }
  std::unique_ptr<Slam> MakeSlam(FeedPolicy policy, std::chrono::milliseconds at_most) {
    return std::make_unique<Slam>(
        Frames().camera, options_, Execution::kThreaded,
        std::vector<std::shared_ptr<OutputSink>>{progress_}, policy,
        std::make_unique<SlowDetector>(progress_, kLimit, at_most, most_ahead_));
  }
  std::shared_ptr<const RgbdFrame> Frame(std::uint32_t id) const {
    const auto& frames = Frames().frames;
    return Renamed(*frames[id % frames.size()], id, Stamp{1 + id * 1'000'000LL});
  }

  static constexpr std::uint32_t kLimit = 6;  // the two, two in the queue, one on either side of it
  SlamOptions options_ = SmallOptions();
  const std::shared_ptr<Progress> progress_ = std::make_shared<Progress>();
  std::atomic<std::uint32_t> most_ahead_ = 0;
};

TEST_F(ThreadedSlamWithSlowDetector, DoesNotRunAheadOfItWhenToldToWait) {
  const auto slam = MakeSlam(FeedPolicy::kWait, std::chrono::milliseconds(50));
  for (std::uint32_t id = 0; id < 60; ++id)
    slam->Feed(Frame(id));
  EXPECT_EQ(slam->Finish().frames.size(), 60U);
  EXPECT_LE(most_ahead_, kLimit);
}

TEST_F(ThreadedSlamWithSlowDetector, DoesNotWaitForItWithACamera) {
  const auto slam = MakeSlam(FeedPolicy::kDropOldest, std::chrono::seconds(2));
  for (std::uint32_t id = 0; id < 200 && most_ahead_ <= kLimit; ++id)
    slam->Track(Frame(id));
  slam->Finish();
  EXPECT_GT(most_ahead_, kLimit);
}

}  // namespace
}  // namespace cslam
