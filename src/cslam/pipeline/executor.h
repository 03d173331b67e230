// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/loop/place_stage.h"
#include "cslam/mapping/full_ba.h"
#include "cslam/mapping/mapper.h"
#include "cslam/pipeline/slam.h"
#include "cslam/tracking/tracker.h"

namespace cslam {

// Runs the stages. Both executors run the same Tracker and Mapper on the same messages.
class Slam::Executor {
 public:
  virtual ~Executor() = default;
  virtual TrackingResult Track(std::shared_ptr<const RgbdFrame> frame) = 0;
  virtual void Feed(std::shared_ptr<const RgbdFrame> frame) = 0;
  virtual void Reset() = 0;
  virtual void Continue(Map map) = 0;
  virtual void SetMode(TrackingMode mode) = 0;
  virtual RunResult Finish() = 0;
  virtual std::shared_ptr<const MapSnapshot> map() const = 0;
};

using Sinks = std::vector<std::shared_ptr<OutputSink>>;

// Adjusts a whole map of a snapshot, as after a loop.
class FullAdjuster {
 public:
  FullAdjuster(const Camera& camera, const SlamOptions& options)
      : camera_(camera),
        depth_(options.tracking.depth),
        model_(LevelScales(options.tracking.orb), options.tracking.depth.disparity_sigma_px),
        options_(options.full_ba) {}

  std::optional<PoseRefinement> Adjust(const MapSnapshot& snapshot, MapId map,
                                       const std::function<bool()>& should_stop = {}) const {
    return AdjustFully(snapshot.map, map, camera_, depth_, model_, options_, should_stop);
  }

 private:
  Camera camera_;
  DepthOptions depth_;
  MeasurementModel model_;
  FullBaOptions options_;
};

// The map that a correction leaves its keyframes in.
inline MapId MapAfter(const MapCorrection& correction) {
  return correction.merge_into.valid() ? correction.merge_into : correction.map;
}

class Slam::InlineExecutor : public Slam::Executor {
 public:
  InlineExecutor(const Camera& camera, const SlamOptions& options, Sinks sinks,
                 std::unique_ptr<Detector> detector);
  TrackingResult Track(std::shared_ptr<const RgbdFrame> frame) override;
  void Feed(std::shared_ptr<const RgbdFrame> frame) override { Track(std::move(frame)); }
  void Reset() override;
  void Continue(Map map) override;
  void SetMode(TrackingMode mode) override { tracker_.SetMode(mode); }
  RunResult Finish() override;
  std::shared_ptr<const MapSnapshot> map() const override { return snapshot_; }

 private:
  void RecognisePlaces(KeyframeId keyframe);
  void AdjustFully(MapId map);
  void Publish(const MapUpdate& update);

  std::unique_ptr<Detector> detector_;
  InlineDetection detection_;
  Tracker tracker_;
  Mapper mapper_;
  PlaceStage places_;
  FullAdjuster adjuster_;
  Sinks sinks_;
  std::shared_ptr<const MapSnapshot> snapshot_;
  std::optional<PlaceHint> hint_;  // about the last lost frame
  std::vector<FrameRecord> records_;
};

// All threads of SLAM:
//
//   caller --frames--> tracker --proposals--> mapper --keyframes--> places
//                      ^  |  ^                ^ |                     | |
//    detector--Latest<>+  |  +---- Latest<> --|-+                     | |
//       ^---some frames---+-------events------|-+---------------------|-+--> sinks
//                         |                   +-----corrections-------+
//                         +<--Latest<>-- lost frames and their places --+
//
// With a detector that looks at every frame, it stands between caller and tracker instead.
//
// Blocking edges go forward only; snapshots and hints come back through slots that never block,
// corrections through a queue that never blocks.
class Slam::ThreadedExecutor : public Slam::Executor {
 public:
  ThreadedExecutor(const Camera& camera, const SlamOptions& options, Sinks sinks,
                   FeedPolicy feed_policy, std::unique_ptr<Detector> detector);
  ~ThreadedExecutor() override;
  TrackingResult Track(std::shared_ptr<const RgbdFrame> frame) override;
  void Feed(std::shared_ptr<const RgbdFrame> frame) override;
  void Reset() override { ResetOrContinue(nullptr); }
  void Continue(Map map) override { ResetOrContinue(std::make_shared<Map>(std::move(map))); }
  void SetMode(TrackingMode mode) override { mode_ = mode; }
  RunResult Finish() override;
  std::shared_ptr<const MapSnapshot> map() const override;

 private:
  void ResetOrContinue(std::shared_ptr<Map> map);  // null: nothing to go on in

  struct Stages;
  std::unique_ptr<Stages> stages_;
  TrackingMode mode_ = TrackingMode::kMapping;  // of the frames to come
};

}  // namespace cslam
