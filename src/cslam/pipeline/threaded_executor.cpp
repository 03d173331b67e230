// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/pipeline/executor.h"
#include "cslam/util/channel.h"
#include "cslam/util/check.h"
#include "cslam/util/gate.h"
#include "cslam/util/latest.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <variant>

namespace cslam {
namespace {

// The promise is kept once tracker, mapper and places have forgotten everything, or have taken over
// the map. Nobody changes the map on its way; the mapper is the last to look at it, and takes it.
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

template <typename... Visitors>
struct Overload : Visitors... {
  using Visitors::operator()...;
};
template <typename... Visitors>
Overload(Visitors...) -> Overload<Visitors...>;

constexpr std::size_t kUnbounded = static_cast<std::size_t>(-1);

// On Linux priorities belong to threads. Failure changes nothing but speed.
void LowerPriorityOfThisThread(int nice) {
  const auto thread = static_cast<id_t>(::syscall(SYS_gettid));
  static_cast<void>(::setpriority(PRIO_PROCESS, thread, nice));
}

}  // namespace

struct Slam::ThreadedExecutor::Shared {
  Shared(const Camera& camera, const SlamOptions& options, Sinks all_sinks, FeedPolicy policy,
         std::unique_ptr<Detector> some_detector)
      : feed_policy(policy),
        max_proposals_ahead(static_cast<std::size_t>(options.pipeline.max_proposals_ahead)),
        mapper_nice(options.pipeline.mapper_nice),
        detection(options.detection),
        is_live(ScheduleOf(options.detection, false) == DetectionSchedule::kLive),
        sinks(std::move(all_sinks)),
        detector(std::move(some_detector)),
        tracker(camera, options.tracking),
        mapper(camera, options.tracking.orb, options.tracking.depth, options.mapping),
        places(camera, options.tracking.orb, options.tracking.depth, options.places),
        adjuster(camera, options),
        frames(static_cast<std::size_t>(options.pipeline.frame_queue),
               policy == FeedPolicy::kWait ? OnFull::kBlock : OnFull::kDropOldest),
        observed(1),
        to_detect(1, OnFull::kDropOldest),
        proposals(kUnbounded),  // bounded by the keyframe policy's max_in_flight
        to_places(kUnbounded),
        late_corrections(kUnbounded),
        events(kUnbounded) {
    if (detector) {
      detector_thread = std::thread(
          [this] { Guard([this] { is_live ? RunLiveDetector() : RunDetectorFirst(); }); });
    }
    tracker_thread = std::thread([this] { Guard([this] { RunTracker(); }); });
    mapper_thread = std::thread([this] { Guard([this] { RunMapper(); }); });
    places_thread = std::thread([this] { Guard([this] { RunPlaces(); }); });
    sink_thread = std::thread([this] { Guard([this] { RunSinks(); }); });
  }

  ~Shared() {
    CloseAll();
    Join();
  }

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
  void SendCorrection(MapperInput correction);
  void RunSinks();
  void Publish(const MapUpdate& update);
  void Guard(const std::function<void()>& run);
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
  Channel<TrackerInput> observed;                       // every frame: what the detector has seen
  Channel<std::shared_ptr<const RgbdFrame>> to_detect;  // live: the newest for it to look at
  Latest<Detections> newest_detections;
  Gate first_detection;          // live: waited for once, so that no map starts with people in it
  std::int64_t num_tracked = 0;  // owned by the tracker thread
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

// Looks at the newest frame there is, again and again.
void Slam::ThreadedExecutor::Shared::RunLiveDetector() {
  LowerPriorityOfThisThread(detection.detector_nice);
  bool is_first = true;
  while (auto frame = to_detect.Pop()) {
    newest_detections.Publish(std::make_shared<const Detections>(detector->Detect(**frame)));
    if (is_first) first_detection.Leave();
    is_first = false;
  }
}

// Looks at every frame before the tracker gets it.
void Slam::ThreadedExecutor::Shared::RunDetectorFirst() {
  while (auto input = frames.Pop()) {
    if (input->frame) {
      input->detections = std::make_shared<const Detections>(detector->Detect(*input->frame));
    }
    observed.Push(std::move(*input));
  }
  observed.Close();
}

std::shared_ptr<const Detections> Slam::ThreadedExecutor::Shared::NewestDetections(
    const std::shared_ptr<const RgbdFrame>& frame) {
  if (num_tracked % detection.live_stride == 0) {
    if (num_tracked == 0) first_detection.Enter();
    to_detect.Push(frame);
    if (num_tracked == 0) first_detection.WaitUntilAtMost(0);
  }
  ++num_tracked;
  return newest_detections.Get();
}

void Slam::ThreadedExecutor::Shared::RunTracker() {
  Channel<TrackerInput>& source = detector && !is_live ? observed : frames;
  while (auto input = source.Pop()) {
    if (!input->frame) {
      ForgetAll(std::move(input->reset));
      continue;
    }
    tracker.SetMode(input->mode);
    if (detector && is_live) input->detections = NewestDetections(input->frame);
    const auto hint = newest_hint.Get();
    TrackerOutput output =
        tracker.Process(*input->frame, latest.Get(), input->detections.get(), hint.get());
    if (output.lost && (!asked_for_hint || (hint && hint->frame == *asked_for_hint))) {
      asked_for_hint = output.lost->data->frame;
      to_places.Push(std::move(*output.lost));
    }
    if (output.proposal) {
      in_flight.Enter();
      proposals.Push(std::make_unique<const KeyframeProposal>(std::move(*output.proposal)));
    }
    if (input->answer) input->answer->set_value(output.result);
    events.Push(std::move(output.result));
  }
  to_detect.Close();
  proposals.Close();
}

// Of the tracker; the request goes on to the mapper.
void Slam::ThreadedExecutor::Shared::ForgetAll(ResetRequest request) {
  newest_detections.Publish(nullptr);
  newest_hint.Publish(nullptr);
  asked_for_hint.reset();
  if (request.map) {
    tracker.Continue(*request.map);
  } else {
    tracker.Reset();
  }
  in_flight.Enter();
  events.Push(ResetRequest{});
  proposals.Push(std::move(request));
}

void Slam::ThreadedExecutor::Shared::RunMapper() {
  LowerPriorityOfThisThread(mapper_nice);
  while (auto input = proposals.Pop()) {
    if (auto* reset = std::get_if<ResetRequest>(&*input)) {
      ResetMapper(*reset);
      to_places.Push(std::move(*reset));
      in_flight.Leave();
    } else if (const auto* proposal = std::get_if<0>(&*input)) {
      MapKeyframe(**proposal);
      in_flight.Leave();
    } else {
      Correct(*input);
    }
  }
  to_places.Close();
  while (auto input = late_corrections.Pop())
    Correct(*input);
  events.Close();
}

void Slam::ThreadedExecutor::Shared::ResetMapper(ResetRequest& request) {
  if (!request.map) {
    mapper.Reset();
    latest.Publish(nullptr);
    return;
  }
  const MapUpdate continued = mapper.Continue(std::move(*request.map));
  request.snapshot = continued.snapshot;
  Publish(continued);
}

void Slam::ThreadedExecutor::Shared::MapKeyframe(const KeyframeProposal& proposal) {
  const MapUpdate inserted = mapper.Insert(proposal);
  Publish(inserted);
  if (inserted.step != MapUpdate::Step::kInserted) return;
  const MapUpdate refined = mapper.Refine([this] { return proposals.HasWaiting(); });
  Publish(refined);
  to_places.Push(RefinedKeyframe{refined.keyframe, refined.snapshot});
}

// A whole map is adjusted by the places thread, or here, once that takes nothing new any more.
void Slam::ThreadedExecutor::Shared::Correct(const MapperInput& input) {
  if (const auto* refinement = std::get_if<std::unique_ptr<const PoseRefinement>>(&input)) {
    Publish(mapper.Apply(**refinement));
    return;
  }
  const MapCorrection& correction = *std::get<std::unique_ptr<const MapCorrection>>(input);
  const MapUpdate corrected = mapper.Apply(correction);
  Publish(corrected);
  if (!corrected.correction->is_applied()) return;
  const MapId map = MapAfter(correction);
  if (to_places.PushFeedback(CorrectedMap{map, corrected.snapshot})) return;
  if (const auto refinement = adjuster.Adjust(*corrected.snapshot, map)) {
    Publish(mapper.Apply(*refinement));
  }
}

void Slam::ThreadedExecutor::Shared::RunPlaces() {
  LowerPriorityOfThisThread(mapper_nice);
  while (auto input = to_places.Pop()) {
    if (const auto* refined = std::get_if<RefinedKeyframe>(&*input)) {
      RecognisePlaces(*refined);
    } else if (const auto* corrected = std::get_if<CorrectedMap>(&*input)) {
      auto refinement = adjuster.Adjust(*corrected->snapshot, corrected->map);
      if (refinement) {
        SendCorrection(std::make_unique<const PoseRefinement>(std::move(*refinement)));
      }
    } else if (const auto* lost = std::get_if<LostFrame>(&*input)) {
      const auto snapshot = latest.Get();
      newest_hint.Publish(std::make_shared<const PlaceHint>(
          places.Find(*lost, snapshot ? *snapshot : MapSnapshot{})));
    } else {
      const auto& reset = std::get<ResetRequest>(*input);
      if (reset.snapshot) {
        places.Continue(*reset.snapshot);
      } else {
        places.Reset();
      }
      newest_hint.Publish(nullptr);
      reset.done->set_value();
    }
  }
  late_corrections.Close();
}

void Slam::ThreadedExecutor::Shared::RecognisePlaces(const RefinedKeyframe& refined) {
  LoopOutcome outcome = places.OnKeyframe(refined.keyframe, *refined.snapshot);
  for (LoopRecord& record : outcome.records)
    events.Push(std::move(record));
  if (outcome.correction) {
    SendCorrection(std::make_unique<const MapCorrection>(std::move(*outcome.correction)));
  }
}

// To the mapper, or past its queue once no more proposals come and that is closed.
void Slam::ThreadedExecutor::Shared::SendCorrection(MapperInput correction) {
  if (!proposals.TryPushFeedback(correction)) late_corrections.Push(std::move(correction));
}

void Slam::ThreadedExecutor::Shared::Publish(const MapUpdate& update) {
  latest.Publish(update.snapshot);
  events.Push(update);
}

void Slam::ThreadedExecutor::Shared::RunSinks() {
  while (auto event = events.Pop()) {
    std::visit(Overload{[this](const TrackingResult& result) {
                          records.push_back(MakeRecord(result));
                          for (const auto& sink : sinks)
                            sink->OnFrame(result);
                        },
                        [this](const MapUpdate& update) {
                          for (const auto& sink : sinks)
                            sink->OnMap(update);
                        },
                        [this](const LoopRecord& record) {
                          for (const auto& sink : sinks)
                            sink->OnLoop(record);
                        },
                        [this](const ResetRequest&) { records.clear(); }},
               *event);
  }
}

// The first exception of any stage is kept for the caller; everything then winds down.
void Slam::ThreadedExecutor::Shared::Guard(const std::function<void()>& run) {
  try {
    run();
  } catch (...) {
    {
      const std::scoped_lock lock(failure_mutex);
      if (!failure) failure = std::current_exception();
    }
    CloseAll();
    // Whoever waits for an answer to one of these learns that there will be none.
    frames.Discard();
    observed.Discard();
    proposals.Discard();
    to_places.Discard();
  }
}

// Rethrows the failure of a stage that ended without an answer.
template <typename T>
T Slam::ThreadedExecutor::Shared::WaitFor(std::future<T> answer) {
  try {
    return answer.get();
  } catch (const std::future_error&) {
    CloseAll();
    Join();
    RethrowFailure();
    throw;
  }
}

void Slam::ThreadedExecutor::Shared::RethrowFailure() {
  const std::scoped_lock lock(failure_mutex);
  if (failure) std::rethrow_exception(failure);
}

void Slam::ThreadedExecutor::Shared::CloseAll() {
  frames.Close();
  observed.Close();
  to_detect.Close();
  proposals.Close();
  to_places.Close();
  late_corrections.Close();
  events.Close();
  in_flight.Open();
  first_detection.Open();
}

void Slam::ThreadedExecutor::Shared::Join() {
  for (std::thread* thread :
       {&detector_thread, &tracker_thread, &mapper_thread, &places_thread, &sink_thread}) {
    if (thread->joinable()) thread->join();
  }
}

Slam::ThreadedExecutor::ThreadedExecutor(const Camera& camera, const SlamOptions& options,
                                         Sinks sinks, FeedPolicy feed_policy,
                                         std::unique_ptr<Detector> detector)
    : shared_(std::make_unique<Shared>(camera, options, std::move(sinks), feed_policy,
                                       std::move(detector))) {}

Slam::ThreadedExecutor::~ThreadedExecutor() = default;

TrackingResult Slam::ThreadedExecutor::Track(std::shared_ptr<const RgbdFrame> frame) {
  auto promise = std::make_shared<std::promise<TrackingResult>>();
  auto answer = promise->get_future();
  shared_->frames.Push({.frame = std::move(frame),
                        .detections = nullptr,
                        .answer = std::move(promise),
                        .mode = mode_,
                        .reset = {}});
  return shared_->WaitFor(std::move(answer));
}

void Slam::ThreadedExecutor::Feed(std::shared_ptr<const RgbdFrame> frame) {
  if (shared_->feed_policy == FeedPolicy::kWait) {
    shared_->in_flight.WaitUntilAtMost(shared_->max_proposals_ahead);
  }
  shared_->frames.Push({.frame = std::move(frame),
                        .detections = nullptr,
                        .answer = nullptr,
                        .mode = mode_,
                        .reset = {}});
  shared_->RethrowFailure();
}

// Waits, so that no frame that comes later can push the request out of a queue that drops.
void Slam::ThreadedExecutor::ResetOrContinue(std::shared_ptr<Map> map) {
  auto promise = std::make_shared<std::promise<void>>();
  auto done = promise->get_future();
  shared_->frames.PushFeedback(
      {.frame = nullptr,
       .detections = nullptr,
       .answer = nullptr,
       .mode = mode_,
       .reset = {.done = std::move(promise), .map = std::move(map), .snapshot = nullptr}});
  shared_->WaitFor(std::move(done));
}

RunResult Slam::ThreadedExecutor::Finish() {
  // Closing the first channel drains the line: each stage closes the next when it is done.
  shared_->frames.Close();
  shared_->Join();
  shared_->RethrowFailure();
  RunResult result;
  result.frames = std::move(shared_->records);
  result.snapshot = shared_->latest.Get();
  if (!result.snapshot) result.snapshot = std::make_shared<const MapSnapshot>();
  result.frames_dropped = shared_->frames.stats().dropped;
  for (const auto& sink : shared_->sinks)
    sink->OnFinish(result);
  return result;
}

std::shared_ptr<const MapSnapshot> Slam::ThreadedExecutor::map() const {
  return shared_->latest.Get();
}

}  // namespace cslam
