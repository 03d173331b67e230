// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/sequence_player.h"

#include "cslam/util/channel.h"

#include <chrono>
#include <exception>
#include <thread>
#include <utility>

namespace cslam {
namespace {

constexpr std::size_t kMaxProblemsKept = 20;
constexpr std::size_t kFramesAhead = 4;

struct TimedLoad {
  LoadResult result;
  LapTime time;
};

TimedLoad LoadTimed(const DatasetReader& dataset, std::size_t index) {
  const Stopwatch watch;
  LoadResult result = dataset.Load(index);
  return {.result = std::move(result), .time = watch.Elapsed()};
}

// Loads frames in order, in a thread of its own when asked to.
class FrameSource {
 public:
  FrameSource(const DatasetReader& dataset, bool read_ahead)
      : dataset_(dataset), loaded_(kFramesAhead) {
    if (read_ahead) thread_ = std::thread([this] { ReadAll(); });
  }
  ~FrameSource() {
    loaded_.Close();
    if (thread_.joinable()) thread_.join();
  }
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  // nullopt after the last frame. Throws what reading threw (strict mode).
  std::optional<TimedLoad> Next() {
    if (!thread_.joinable()) {
      if (next_ >= dataset_.size()) return std::nullopt;
      return LoadTimed(dataset_, next_++);
    }
    auto loaded = loaded_.Pop();
    if (!loaded) {
      thread_.join();
      next_ = dataset_.size();
      if (failure_) std::rethrow_exception(failure_);
    }
    return loaded;
  }

 private:
  void ReadAll() {
    try {
      for (std::size_t i = 0; i < dataset_.size(); ++i) {
        if (!loaded_.Push(LoadTimed(dataset_, i))) break;
      }
    } catch (...) {
      failure_ = std::current_exception();  // read only after the thread has been joined
    }
    loaded_.Close();
  }

  const DatasetReader& dataset_;
  Channel<TimedLoad> loaded_;
  std::size_t next_ = 0;
  std::exception_ptr failure_;
  std::thread thread_;
};

// Waits until a frame is due, counted from the first.
class SensorClock {
 public:
  void WaitFor(Stamp stamp) {
    if (!first_) {
      first_ = stamp;
      start_ = std::chrono::steady_clock::now();
    }
    std::this_thread::sleep_until(start_ + std::chrono::nanoseconds(stamp.ns - first_->ns));
  }

 private:
  std::optional<Stamp> first_;
  std::chrono::steady_clock::time_point start_;
};

void Count(const TimedLoad& loaded, PlayReport& report) {
  if (!loaded.result.frame) {
    ++report.frames_unreadable;
    if (report.problems.size() < kMaxProblemsKept) report.problems.push_back(loaded.result.problem);
    return;
  }
  ++report.frames_read;
  report.loads.push_back(loaded.time);
  report.last_stamp = loaded.result.frame->stamp;
  if (!report.first_stamp) report.first_stamp = report.last_stamp;
}

}  // namespace

const char* ToString(PlayRate rate) {
  return rate == PlayRate::kSensor ? "sensor" : "max";
}

PlayReport Play(const DatasetReader& dataset, Slam& slam, const PlayOptions& options,
                const std::function<bool()>& is_interrupted) {
  PlayReport report;
  FrameSource source(dataset, options.read_ahead);
  SensorClock clock;
  while (!(report.was_interrupted = is_interrupted())) {
    auto loaded = source.Next();
    if (!loaded) break;
    Count(*loaded, report);
    auto& frame = loaded->result.frame;
    if (!frame) continue;
    if (options.rate == PlayRate::kSensor) clock.WaitFor(frame->stamp);
    slam.Feed(std::make_shared<const RgbdFrame>(std::move(*frame)));
  }
  return report;
}

}  // namespace cslam
