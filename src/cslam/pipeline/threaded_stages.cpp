// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/pipeline/threaded_stages.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace cslam {
namespace {

constexpr std::size_t kUnbounded = static_cast<std::size_t>(-1);

template <typename... Visitors>
struct Overload : Visitors... {
  using Visitors::operator()...;
};
template <typename... Visitors>
Overload(Visitors...) -> Overload<Visitors...>;

// On Linux priorities belong to threads. Failure changes nothing but speed.
void LowerPriorityOfThisThread(int nice) {
  const auto thread = static_cast<id_t>(::syscall(SYS_gettid));
  static_cast<void>(::setpriority(PRIO_PROCESS, thread, nice));
}

}  // namespace

Slam::ThreadedExecutor::Stages::Stages(const Camera& camera, const SlamOptions& options,
                                       Sinks all_sinks, FeedPolicy policy,
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

Slam::ThreadedExecutor::Stages::~Stages() {
  CloseAll();
  Join();
}

// Of a recording no frame is lost, and none is hurried past those who look at some of them.
void Slam::ThreadedExecutor::Stages::WaitForStagesBehind() {
  if (feed_policy != FeedPolicy::kWait) return;
  in_flight.WaitUntilAtMost(max_proposals_ahead);
  undetected.WaitUntilAtMost(
      static_cast<std::size_t>(detection.live_stride + detection.live_max_ahead));
}

// Looks at the newest frame there is, again and again.
void Slam::ThreadedExecutor::Stages::RunLiveDetector() {
  LowerPriorityOfThisThread(detection.detector_nice);
  std::size_t num_left_behind = 0;
  while (const auto look = to_detect.Pop()) {
    newest_detections.Publish(std::make_shared<const Detections>(detector->Detect(*look->frame)));
    if (num_left_behind == 0) first_detection.Leave();
    undetected.Leave(look->number - num_left_behind);
    num_left_behind = look->number;
  }
}

// Looks at every frame before the tracker gets it.
void Slam::ThreadedExecutor::Stages::RunDetectorFirst() {
  while (auto input = frames.Pop()) {
    if (input->frame) {
      input->detections = std::make_shared<const Detections>(detector->Detect(*input->frame));
    }
    observed.Push(std::move(*input));
  }
  observed.Close();
}

std::shared_ptr<const Detections> Slam::ThreadedExecutor::Stages::NewestDetections(
    const std::shared_ptr<const RgbdFrame>& frame) {
  undetected.Enter();
  const std::size_t index = num_tracked++;
  if (index % static_cast<std::size_t>(detection.live_stride) == 0) {
    if (index == 0) first_detection.Enter();
    to_detect.Push({frame, num_tracked});
    if (index == 0) first_detection.WaitUntilAtMost(0);
  }
  return newest_detections.Get();
}

void Slam::ThreadedExecutor::Stages::RunTracker() {
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
void Slam::ThreadedExecutor::Stages::ForgetAll(ResetRequest request) {
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

void Slam::ThreadedExecutor::Stages::RunMapper() {
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

void Slam::ThreadedExecutor::Stages::ResetMapper(ResetRequest& request) {
  if (!request.map) {
    mapper.Reset();
    latest.Publish(nullptr);
    return;
  }
  const MapUpdate continued = mapper.Continue(std::move(*request.map));
  request.snapshot = continued.snapshot;
  Publish(continued);
}

void Slam::ThreadedExecutor::Stages::MapKeyframe(const KeyframeProposal& proposal) {
  const MapUpdate inserted = mapper.Insert(proposal);
  Publish(inserted);
  if (inserted.step != MapUpdate::Step::kInserted) return;
  const MapUpdate refined = mapper.Refine([this] { return proposals.HasWaiting(); });
  Publish(refined);
  to_places.Push(RefinedKeyframe{refined.keyframe, refined.snapshot});
}

// A whole map is adjusted by the places thread, or here, once that takes nothing new any more.
void Slam::ThreadedExecutor::Stages::Correct(const MapperInput& input) {
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

void Slam::ThreadedExecutor::Stages::RunPlaces() {
  LowerPriorityOfThisThread(mapper_nice);
  while (auto input = to_places.Pop()) {
    if (const auto* refined = std::get_if<RefinedKeyframe>(&*input)) {
      RecognisePlaces(*refined);
    } else if (const auto* corrected = std::get_if<CorrectedMap>(&*input)) {
      SendRefinement(*corrected->snapshot, corrected->map);
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

void Slam::ThreadedExecutor::Stages::RecognisePlaces(const RefinedKeyframe& refined) {
  PlaceOutcome outcome = places.OnKeyframe(refined.keyframe, *refined.snapshot);
  for (LoopRecord& record : outcome.loop.records)
    events.Push(std::move(record));
  if (outcome.loop.correction) {
    SendCorrection(std::make_unique<const MapCorrection>(std::move(*outcome.loop.correction)));
  }
  if (outcome.closes_circuit)
    SendRefinement(*refined.snapshot, refined.snapshot->map.FindKeyframe(refined.keyframe)->map);
}

void Slam::ThreadedExecutor::Stages::SendRefinement(const MapSnapshot& snapshot, MapId map) {
  if (auto refinement = adjuster.Adjust(snapshot, map))
    SendCorrection(std::make_unique<const PoseRefinement>(std::move(*refinement)));
}

// To the mapper, or past its queue once no more proposals come and that is closed.
void Slam::ThreadedExecutor::Stages::SendCorrection(MapperInput correction) {
  if (!proposals.TryPushFeedback(correction)) late_corrections.Push(std::move(correction));
}

void Slam::ThreadedExecutor::Stages::Publish(const MapUpdate& update) {
  latest.Publish(update.snapshot);
  events.Push(update);
}

void Slam::ThreadedExecutor::Stages::RunSinks() {
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
void Slam::ThreadedExecutor::Stages::Guard(const std::function<void()>& run) {
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

void Slam::ThreadedExecutor::Stages::RethrowFailure() {
  const std::scoped_lock lock(failure_mutex);
  if (failure) std::rethrow_exception(failure);
}

void Slam::ThreadedExecutor::Stages::CloseAll() {
  frames.Close();
  observed.Close();
  to_detect.Close();
  proposals.Close();
  to_places.Close();
  late_corrections.Close();
  events.Close();
  in_flight.Open();
  first_detection.Open();
  undetected.Open();
}

void Slam::ThreadedExecutor::Stages::Join() {
  for (std::thread* thread :
       {&detector_thread, &tracker_thread, &mapper_thread, &places_thread, &sink_thread}) {
    if (thread->joinable()) thread->join();
  }
}

}  // namespace cslam
