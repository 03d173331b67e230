// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/resting_cache.h"

#include <algorithm>
#include <limits>

namespace cslam {
namespace {

// Frames rendered on a few threads lie in one or two stretches between changes.
constexpr std::size_t kMaxEntries = 3;

}  // namespace

RestingCache::RestingCache(const World& world) : world_(world), changes_s_(TimesOfChange(world)) {}

std::shared_ptr<const RestingScene> RestingCache::At(double time_s) const {
  const auto next = std::ranges::upper_bound(changes_s_, time_s);
  const auto epoch = static_cast<std::size_t>(next - changes_s_.begin());
  const std::lock_guard lock(mutex_);
  const auto at = std::ranges::find(entries_, epoch, &Entry::epoch);
  if (at != entries_.end()) {
    std::rotate(entries_.begin(), at, at + 1);
    return entries_.front().scene;
  }
  const double first_s =
      epoch == 0 ? -std::numeric_limits<double>::infinity() : changes_s_[epoch - 1];
  const RestingScene* similar = entries_.empty() ? nullptr : entries_.front().scene.get();
  auto scene = std::make_shared<const RestingScene>(world_, first_s, similar);
  entries_.insert(entries_.begin(), {epoch, scene});
  if (entries_.size() > kMaxEntries) entries_.pop_back();
  return scene;
}

}  // namespace cslam
