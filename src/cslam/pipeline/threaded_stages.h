// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/pipeline/executor.h"
#include "cslam/util/channel.h"
#include "cslam/util/gate.h"
#include "cslam/util/latest.h"

#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <variant>

namespace cslam {

// The stages of the threaded executor, a thread for each, and all that runs between them.
struct Slam::ThreadedExecutor::Stages {
  // The promise is kept once tracker, mapper and places have forgotten everything, or have taken
  // over the map. Nobody changes the map on its way; the mapper is the last to look at it, and
  // takes it.
  struct ResetRequest {
    std::shared_ptr<std::promise<void>> done;
    std::shared_ptr<Map> map;                     // to go on in; null: none
    std::shared_ptr<const MapSnapshot> snapshot;  // the mapper's, once that has taken the map over
  };

  // A frame on its way to the tracker, or a request to forget all. No variant: GCC 12 believes its
  // destructor to be reached uninitialised.
  struct TrackerInput {
    std::shared_ptr<const RgbdFrame> frame;                // null: reset
    std::shared_ptr<const Detections> detections;          // of this frame, if it waited for them
    std::shared_ptr<std::promise<TrackingResult>> answer;  // set when somebody waits for the pose
    TrackingMode mode = TrackingMode::kMapping;
    ResetRequest reset;
  };

  // A frame for the live detector.
  struct Look {
    std::shared_ptr<const RgbdFrame> frame;
    std::size_t number = 0;  // 1 for the first frame tracked
  };

  using MapperInput =
      std::variant<std::unique_ptr<const KeyframeProposal>, ResetRequest,
                   std::unique_ptr<const MapCorrection>, std::unique_ptr<const PoseRefinement>>;
  using Event = std::variant<TrackingResult, MapUpdate, ResetRequest, LoopRecord>;

  // What the places thread works on.
  struct RefinedKeyframe {
    KeyframeId keyframe;
    std::shared_ptr<const MapSnapshot> snapshot;
  };
  struct CorrectedMap {
    MapId map;
    std::shared_ptr<const MapSnapshot> snapshot;
  };
  using PlaceInput = std::variant<RefinedKeyframe, CorrectedMap, LostFrame, ResetRequest>;

  Stages(const Camera& camera, const SlamOptions& options, Sinks all_sinks, FeedPolicy policy,
         std::unique_ptr<Detector> some_detector);
  ~Stages();

  void WaitForStagesBehind();
  void RunLiveDetector();
  void RunDetectorFirst();
  std::shared_ptr<const Detections> NewestDetections(const std::shared_ptr<const RgbdFrame>& frame);
  void RunTracker();
  void ForgetAll(ResetRequest request);
  void RunMapper();
  void ResetMapper(ResetRequest& request);
  void MapKeyframe(const KeyframeProposal& proposal);
  void Correct(const MapperInput& input);
  void RunPlaces();
  void RecognisePlaces(const RefinedKeyframe& refined);
  void SendRefinement(const MapSnapshot& snapshot, MapId map);
  void SendCorrection(MapperInput correction);
  void RunSinks();
  void Publish(const MapUpdate& update);
  void Guard(const std::function<void()>& run);
  // The answer of a stage, or the failure because of which there is none.
  template <typename T>
  T WaitFor(std::future<T> answer);
  void RethrowFailure();
  void CloseAll();
  void Join();

  const FeedPolicy feed_policy;
  const std::size_t max_proposals_ahead;
  const int mapper_nice;
  const DetectionOptions detection;
  const bool is_live;
  const Sinks sinks;

  const std::unique_ptr<Detector> detector;  // used by the detector thread; may be null
  Tracker tracker;                           // owned by the tracker thread
  Mapper mapper;                             // owned by the mapper thread
  PlaceStage places;                         // owned by the places thread
  const FullAdjuster adjuster;
  std::vector<FrameRecord> records;  // owned by the sink thread

  Channel<TrackerInput> frames;
  Channel<TrackerInput> observed;  // every frame: what the detector has seen
  Channel<Look> to_detect;         // live: the newest for it to look at
  Latest<Detections> newest_detections;
  Gate first_detection;         // live: waited for once, so that no map starts with people in it
  Gate undetected;              // live: frames tracked since the one it has looked at last
  std::size_t num_tracked = 0;  // owned by the tracker thread
  Channel<MapperInput> proposals;
  Channel<PlaceInput> to_places;
  Channel<MapperInput> late_corrections;  // of the last keyframes, when no more proposals come
  Latest<PlaceHint> newest_hint;
  std::optional<FrameId> asked_for_hint;  // owned by the tracker thread
  Channel<Event> events;
  Latest<MapSnapshot> latest;
  Gate in_flight;  // proposals sent and not refined yet

  std::mutex failure_mutex;
  std::exception_ptr failure;

  std::thread detector_thread;
  std::thread tracker_thread;
  std::thread mapper_thread;
  std::thread places_thread;
  std::thread sink_thread;
};

template <typename T>
T Slam::ThreadedExecutor::Stages::WaitFor(std::future<T> answer) {
  try {
    return answer.get();
  } catch (const std::future_error&) {
    CloseAll();
    Join();
    RethrowFailure();
    throw;
  }
}

}  // namespace cslam
