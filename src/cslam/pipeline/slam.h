// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/map/map.h"
#include "cslam/pipeline/run_result.h"
#include "cslam/pipeline/sink.h"
#include "cslam/pipeline/slam_options.h"
#include "cslam/semantics/detector.h"

#include <memory>
#include <vector>

namespace cslam {

enum class Execution : std::uint8_t {
  kInline,    // one thread, bit-for-bit repeatable
  kThreaded,  // mapping runs beside tracking, which never waits for it
};

// What Feed() does when the tracker cannot keep up (threaded only).
enum class FeedPolicy : std::uint8_t {
  kWait,        // for recordings: no frame is lost, the caller waits
  kDropOldest,  // for live cameras: the oldest waiting frame is dropped and counted
};

// The system behind one door. Feed it frames in order of time:
//
//   Slam slam(camera, SlamOptions{}, Execution::kThreaded);
//   const TrackingResult result = slam.Track(frame);
//   if (result.T_world_camera) ...
//
// An error inside a stage surfaces as an exception at the next call. Call from one thread.
class Slam {
 public:
  // Throws Error when the camera or an option is unusable. detector: finds people and objects;
  // null: none does.
  Slam(const Camera& camera, const SlamOptions& options, Execution execution,
       std::vector<std::shared_ptr<OutputSink>> sinks = {},
       FeedPolicy feed_policy = FeedPolicy::kWait, std::unique_ptr<Detector> detector = nullptr);
  ~Slam();  // without Finish(), frames that still wait are discarded
  Slam(const Slam&) = delete;
  Slam& operator=(const Slam&) = delete;

  // Processes the frame and returns its pose. Frames must have the camera's size and increasing
  // stamps; throws Error otherwise.
  TrackingResult Track(std::shared_ptr<const RgbdFrame> frame);

  // Hands the frame over; its result goes to the sinks.
  void Feed(std::shared_ptr<const RgbdFrame> frame);

  // The newest map. Null before the first keyframe.
  std::shared_ptr<const MapSnapshot> map() const;

  // Forgets map and trajectory and starts anew with the next frame.
  void Reset();

  // The same, but goes on in the maps of an earlier run (LoadMap() in atlas_io/map_file.h). The
  // place of the next frames is searched there; if it is not found for tracking.recently_lost_time,
  // a new map starts, and is merged with an old one where both show the same place. Throws Error
  // if the image pyramid was another one. The camera must be the one that made the map.
  void Continue(Map map);

  // For frames handed over from now on, whenever wanted. What is on its way to the mapper then is
  // still mapped.
  void SetMode(TrackingMode mode);

  // Waits until everything fed is processed, tells the sinks, and returns the outcome.
  // Nothing can be fed afterwards.
  const RunResult& Finish();

 private:
  void CheckFrame(const RgbdFrame& frame);

  class Executor;
  class InlineExecutor;
  class ThreadedExecutor;

  const Camera camera_;
  std::unique_ptr<Executor> executor_;
  Stamp last_stamp_;
  bool has_last_stamp_ = false;
  bool is_finished_ = false;
  RunResult result_;
};

}  // namespace cslam
