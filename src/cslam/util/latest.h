// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace cslam {

// One slot that always holds the newest value; publishing never waits for readers.
template <typename T>
class Latest {
 public:
  void Publish(std::shared_ptr<const T> value) {
    {
      const std::scoped_lock lock(mutex_);
      std::swap(value_, value);
    }
    // The previous value, perhaps the last reference to it, is released outside the lock.
  }

  // Null before the first Publish().
  std::shared_ptr<const T> Get() const {
    const std::scoped_lock lock(mutex_);
    return value_;
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const T> value_;
};

}  // namespace cslam
