// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace cslam {

struct ChannelStats {
  std::uint64_t pushed = 0;
  std::uint64_t dropped = 0;        // discarded because the channel was full (kDropOldest)
  std::size_t high_water_mark = 0;  // most items that ever waited
};

enum class OnFull { kBlock, kDropOldest };

// A bounded, closable queue between two threads. All state lives under one mutex.
// Push() may block and is used only forward (source -> tracker -> mapper); an edge that goes
// back uses PushFeedback() or a Latest<T>, so the graph of blocking edges has no cycle.
template <typename T>
class Channel {
 public:
  explicit Channel(std::size_t capacity, OnFull on_full = OnFull::kBlock)
      : capacity_(capacity), on_full_(on_full) {}

  // False once the channel is closed; the value is then discarded.
  bool Push(T value) {
    std::unique_lock lock(mutex_);
    if (on_full_ == OnFull::kBlock) {
      not_full_.wait(lock, [this] { return closed_ || items_.size() < capacity_; });
    } else {
      while (!closed_ && items_.size() >= capacity_) {
        items_.pop_front();
        ++stats_.dropped;
      }
    }
    return Append(std::move(value));
  }

  // Never blocks and ignores the capacity: the protocol bounds what is outstanding.
  bool PushFeedback(T value) {
    const std::scoped_lock lock(mutex_);
    return Append(std::move(value));
  }

  // As PushFeedback(), but leaves value with the caller when the channel is closed.
  bool TryPushFeedback(T& value) {
    const std::scoped_lock lock(mutex_);
    return !closed_ && Append(std::move(value));
  }

  // Waits for an item; nullopt once the channel is closed and drained.
  std::optional<T> Pop() {
    std::unique_lock lock(mutex_);
    not_empty_.wait(lock, [this] { return closed_ || !items_.empty(); });
    if (items_.empty()) return std::nullopt;
    std::optional<T> item(std::move(items_.front()));
    items_.pop_front();
    not_full_.notify_one();
    return item;
  }

  // Refuses further items and wakes everyone; items already inside can still be popped.
  void Close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
    not_empty_.notify_all();
    not_full_.notify_all();
  }

  // Throws away what waits.
  void Discard() {
    std::deque<T> discarded;  // destroyed outside the lock
    const std::scoped_lock lock(mutex_);
    std::swap(items_, discarded);
    not_full_.notify_all();
  }

  // Whether something waits. Only a hint: another thread may take it before the caller does.
  bool HasWaiting() const {
    const std::scoped_lock lock(mutex_);
    return !items_.empty();
  }

  ChannelStats stats() const {
    const std::scoped_lock lock(mutex_);
    return stats_;
  }

 private:
  bool Append(T value) {
    if (closed_) return false;
    items_.push_back(std::move(value));
    ++stats_.pushed;
    if (items_.size() > stats_.high_water_mark) stats_.high_water_mark = items_.size();
    not_empty_.notify_one();
    return true;
  }

  const std::size_t capacity_;
  const OnFull on_full_;
  mutable std::mutex mutex_;
  std::condition_variable not_empty_;
  std::condition_variable not_full_;
  std::deque<T> items_;
  ChannelStats stats_;
  bool closed_ = false;
};

}  // namespace cslam
