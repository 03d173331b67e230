// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/atlas_io/map_file.h"
#include "cslam/pipeline/sink.h"
#include "cslam/pipeline/slam.h"
#include "cslam/util/channel.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace cslam {

struct MapSaverOptions {
  std::filesystem::path path;
  MapFileInfo info;
  double every_s = 30.0;  // of the recording
  Execution execution = Execution::kThreaded;
};

// Saves the map of a run again and again while it grows, so that whoever kills the process loses
// what was added last at most, and once more at the end:
//
//   auto saver = std::make_shared<MapSaver>(options);   // one of the sinks of a run
//   ...
//   saver->SaveFinal(*result.snapshot);
//
// The saves in between happen in a thread of the saver's own (inline: on the caller's); one that
// takes too long makes the next one wait, nothing else.
class MapSaver : public OutputSink {
 public:
  // Throws Error if no file can be made there.
  explicit MapSaver(MapSaverOptions options);
  ~MapSaver() override;
  MapSaver(const MapSaver&) = delete;
  MapSaver& operator=(const MapSaver&) = delete;

  void OnFrame(const TrackingResult& result) override;
  void OnMap(const MapUpdate& update) override { newest_ = update.snapshot; }

  // After the run. Throws Error if it fails. A map without keyframes is not saved: returns false.
  bool SaveFinal(const MapSnapshot& snapshot);

  // Of the saves in between, the first few; after SaveFinal().
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  using Snapshot = std::shared_ptr<const MapSnapshot>;

  void TrySave(const MapSnapshot& snapshot);
  void EndThread();

  const MapSaverOptions options_;
  Snapshot newest_;
  Snapshot last_;  // that was given away to be saved
  std::optional<Stamp> last_saved_;
  std::vector<std::string> problems_;  // owned by the thread while that runs
  Channel<Snapshot> to_save_;
  std::thread thread_;
};

}  // namespace cslam
