// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/map_saver.h"

#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"

#include <utility>

namespace cslam {
namespace {

constexpr std::size_t kMaxProblemsKept = 3;

}  // namespace

MapSaver::MapSaver(MapSaverOptions options)
    : options_(std::move(options)), to_save_(1, OnFull::kDropOldest) {
  const AtomicFile probe(options_.path, Durability::kRename);  // removed at once
  if (options_.execution == Execution::kInline) return;
  thread_ = std::thread([this] {
    while (const auto snapshot = to_save_.Pop())
      TrySave(**snapshot);
  });
}

MapSaver::~MapSaver() {
  EndThread();
}

void MapSaver::EndThread() {
  to_save_.Close();
  if (thread_.joinable()) thread_.join();
}

void MapSaver::OnFrame(const TrackingResult& result) {
  if (!last_saved_) last_saved_ = result.stamp;
  if (SecondsBetween(result.stamp, *last_saved_) < options_.every_s) return;
  if (newest_ == nullptr || newest_ == last_ || newest_->map.num_keyframes() == 0) return;
  last_saved_ = result.stamp;
  last_ = newest_;
  if (options_.execution == Execution::kInline) {
    TrySave(*newest_);
  } else {
    to_save_.Push(newest_);
  }
}

void MapSaver::TrySave(const MapSnapshot& snapshot) {
  try {
    SaveMap(options_.path, snapshot.map, options_.info);
  } catch (const Error& error) {
    if (problems_.size() < kMaxProblemsKept) problems_.emplace_back(error.what());
  }
}

bool MapSaver::SaveFinal(const MapSnapshot& snapshot) {
  EndThread();
  if (snapshot.map.num_keyframes() == 0) return false;
  SaveMap(options_.path, snapshot.map, options_.info);
  return true;
}

}  // namespace cslam
