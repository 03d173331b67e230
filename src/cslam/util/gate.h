// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace cslam {

// Counts work in flight between two stages and lets the source wait until little is left.
class Gate {
 public:
  void Enter() {
    const std::scoped_lock lock(mutex_);
    ++in_flight_;
  }

  void Leave(std::size_t count = 1) {
    const std::scoped_lock lock(mutex_);
    in_flight_ -= count;
    changed_.notify_all();
  }

  // Waits until at most limit items are in flight, or the gate is opened for good.
  void WaitUntilAtMost(std::size_t limit) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return is_open_ || in_flight_ <= limit; });
  }

  // Nobody waits any more.
  void Open() {
    const std::scoped_lock lock(mutex_);
    is_open_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t in_flight_ = 0;
  bool is_open_ = false;
};

}  // namespace cslam
