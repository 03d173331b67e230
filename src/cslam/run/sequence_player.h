// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/dataset.h"
#include "cslam/pipeline/slam.h"
#include "cslam/util/stopwatch.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

enum class PlayRate : std::uint8_t {
  kMax,     // as fast as SLAM takes them, none is dropped
  kSensor,  // when their stamps say, as a live camera would
};
const char* ToString(PlayRate rate);

// What became of the frames on their way from disk to SLAM.
struct PlayReport {
  std::size_t frames_read = 0;
  std::size_t frames_unreadable = 0;
  std::vector<std::string> problems;  // one line per unreadable frame, the first few
  std::vector<LapTime> loads;         // one per frame read
  std::optional<Stamp> first_stamp;   // of the frames read
  std::optional<Stamp> last_stamp;
  bool was_interrupted = false;
};

// Feeds a data set to SLAM. Reads ahead in a thread of its own when read_ahead is set.
// is_interrupted is asked before every frame.
struct PlayOptions {
  PlayRate rate = PlayRate::kMax;
  bool read_ahead = true;
};
PlayReport Play(const DatasetReader& dataset, Slam& slam, const PlayOptions& options,
                const std::function<bool()>& is_interrupted);

}  // namespace cslam
