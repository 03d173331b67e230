// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// What loop closing does to a recording with ground truth: runs it twice, without and with loops
// (inline, each followed by a full bundle adjustment), without object filters. Prints Markdown: a
// line for every candidate, and the trajectory's errors.
//
//   cslam_loop_report SEQUENCE [--every N] [--far] [--verbose]
//
// --every N takes every Nth frame. --far keeps the mapper from tying revisited places together by
// itself while drift is small, so that loops are left to close. Without --verbose refused
// candidates are only counted.
#include "cslam/eval/ate.h"
#include "cslam/io/dataset.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/loop/loop_closer.h"
#include "cslam/mapping/full_ba.h"
#include "cslam/mapping/mapper.h"
#include "cslam/tracking/tracker.h"
#include "cslam/util/check.h"
#include "cslam/util/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace cslam {
namespace {

struct Arguments {
  std::filesystem::path sequence;
  std::size_t every = 1;
  bool leaves_far = false;
  bool is_verbose = false;
};

// A tracked frame's pose, relative to a keyframe.
struct TrackedFrame {
  Stamp stamp;
  KeyframeId reference;
  Se3 T_reference_camera;
};

struct Report {
  int num_frames = 0;
  std::vector<TrackedFrame> frames;
  std::shared_ptr<const MapSnapshot> snapshot = std::make_shared<const MapSnapshot>();
  std::vector<LoopRecord> records;
  std::vector<double> loop_ms;  // per keyframe, CPU
  double correct_ms = 0.0;      // CPU, all corrections and refinements applied
  double full_ba_ms = 0.0;
  int num_closed = 0;
};

// The pipeline with a loop closer behind the mapper, one after the other.
class Driver {
 public:
  Driver(const Camera& camera, const MapperOptions& mapping, bool closes_loops)
      : camera_(camera),
        closes_loops_(closes_loops),
        tracker_(camera, tracking_),
        mapper_(camera, tracking_.orb, tracking_.depth, mapping),
        closer_(MakePlaceSensor(camera, tracking_.orb, tracking_.depth), {}) {}

  void Feed(const RgbdFrame& frame) {
    const TrackerOutput output = tracker_.Process(frame, snapshot_);
    ++report_.num_frames;
    if (output.result.T_world_camera) {
      report_.frames.push_back(
          {output.result.stamp, output.result.reference, output.result.T_reference_camera});
    }
    if (!output.proposal) return;
    if (mapper_.Insert(*output.proposal).step == MapUpdate::Step::kRefused) return;
    snapshot_ = mapper_.Refine().snapshot;
    if (closes_loops_) CloseLoops(output.proposal->id);
  }

  Report Finish() {
    for (const MapId map : Maps())
      Refine(map);
    if (snapshot_) report_.snapshot = snapshot_;
    return std::move(report_);
  }

 private:
  static TrackerOptions StaticOptions() {
    TrackerOptions options;
    options.objects.enabled = false;
    return options;
  }

  void CloseLoops(KeyframeId id) {
    const Stopwatch watch;
    LoopOutcome outcome = closer_.Process(id, snapshot_->map, index_);
    if (const Keyframe* keyframe = snapshot_->map.FindKeyframe(id)) {
      index_.Add(id, SelectDescriptors(keyframe->data->features,
                                       PlaceKeypoints(snapshot_->map, *keyframe)));
    }
    report_.loop_ms.push_back(watch.Elapsed().cpu_ms);
    report_.records.insert(report_.records.end(), outcome.records.begin(), outcome.records.end());
    if (!outcome.correction) return;
    ++report_.num_closed;
    Publish(mapper_.Apply(*outcome.correction));
    const KeyframeId end = outcome.correction->loop.match;
    Refine(snapshot_->map.FindKeyframe(end)->map);
  }

  void Refine(MapId map) {
    const Stopwatch watch;
    const MeasurementModel model(LevelScales(tracking_.orb), tracking_.depth.disparity_sigma_px);
    const auto refinement =
        AdjustFully(snapshot_->map, map, camera_, tracking_.depth, model, FullBaOptions{});
    report_.full_ba_ms += watch.Elapsed().cpu_ms;
    if (refinement) Publish(mapper_.Apply(*refinement));
  }

  void Publish(const MapUpdate& update) {
    CSLAM_CHECK(update.correction->is_applied(), "{}", update.correction->refusal);
    const std::string violation = mapper_.map().CheckInvariants();
    CSLAM_CHECK(violation.empty(), "{}", violation);
    snapshot_ = update.snapshot;
    for (const StageTime& time : update.times)
      report_.correct_ms += time.cpu_ms;
  }

  std::vector<MapId> Maps() const {
    std::vector<MapId> maps;
    if (!snapshot_) return maps;
    for (const KeyframeId id : snapshot_->map.Keyframes())
      maps.push_back(snapshot_->map.FindKeyframe(id)->map);
    std::sort(maps.begin(), maps.end());
    maps.erase(std::unique(maps.begin(), maps.end()), maps.end());
    return maps;
  }

  const TrackerOptions tracking_ = StaticOptions();
  const Camera camera_;
  const bool closes_loops_;
  Tracker tracker_;
  Mapper mapper_;
  LoopCloser closer_;
  PlaceIndex index_;
  std::shared_ptr<const MapSnapshot> snapshot_;
  Report report_;
};

Report RunSequence(const DatasetReader& dataset, const Arguments& arguments, bool closes_loops) {
  MapperOptions mapping;
  if (arguments.leaves_far) mapping.fusion.nearby_keyframes = 0;
  Driver driver(dataset.camera().camera, mapping, closes_loops);
  for (std::size_t i = 0; i < dataset.size(); i += arguments.every) {
    const LoadResult loaded = dataset.Load(i);
    if (loaded.frame) driver.Feed(*loaded.frame);
  }
  return driver.Finish();
}

// True relative position of a record's keyframes against the verified one, in metres; negative
// without truth.
double ErrorOf(const LoopRecord& record, const Trajectory& truth) {
  const PoseAssociationOptions options{.mode = PoseAssociationMode::kInterpolate};
  const auto ends =
      AssociatePoses(truth, {{record.match_stamp, Se3()}, {record.query_stamp, Se3()}}, options);
  if (ends.pairs.size() != 2) return -1.0;
  return Difference(ends.pairs[0].reference.Inverse() * ends.pairs[1].reference,
                    *record.T_match_query)
      .distance_m;
}

void PrintRecord(const LoopRecord& r, const Trajectory& truth) {
  const LoopEvidence& e = r.evidence;
  fmt::print(
      "| {} ({}) | {} ({}) | {} | {}/{}/{} | {:.0f} % | {} | {:.3f} m, {:.2f} deg of {:.1f} m "
      "| {:.1f} % of {} | {:.3f} | {} |\n",
      r.query.value(), FormatStamp(r.query_stamp, 1), r.match.value(),
      FormatStamp(r.match_stamp, 1), ToString(r.verdict), e.num_matches, e.num_ransac_inliers,
      e.num_inliers, 100.0 * e.inlier_spread, e.num_confirmations, e.drift_m,
      e.drift_rad * 180.0 / std::numbers::pi, e.path_m, 100.0 * e.depth_contradicted,
      e.depth_compared, r.T_match_query ? ErrorOf(r, truth) : -1.0, r.reason);
}

// The final poses of the frames of the map that holds most of them.
Trajectory FinalPoses(const Report& report) {
  const MapView& map = report.snapshot->map;
  std::map<MapId, Trajectory> trajectories;
  for (const TrackedFrame& frame : report.frames) {
    const auto anchor = map.Resolve(frame.reference);
    if (!anchor) continue;
    const Keyframe& keyframe = *map.FindKeyframe(anchor->keyframe);
    trajectories[keyframe.map].push_back(
        {frame.stamp,
         keyframe.T_world_camera * anchor->T_keyframe_self * frame.T_reference_camera});
  }
  Trajectory longest;
  for (const auto& [id, trajectory] : trajectories) {
    if (trajectory.size() > longest.size()) longest = trajectory;
  }
  return longest;
}

void PrintAccuracy(const char* name, const Report& report, const Trajectory& truth) {
  const Trajectory poses = FinalPoses(report);
  const MapView& map = report.snapshot->map;
  fmt::print(
      "{}: ATE RMSE {:.1f} mm over {} of {} frames; {} keyframes, {} points, {} corrections; "
      "full BA {:.0f} ms, applying {:.0f} ms in all",
      name, 1e3 * EvaluateAte(truth, poses).statistics_m.rmse, poses.size(), report.num_frames,
      map.num_keyframes(), map.num_points(), report.num_closed, report.full_ba_ms,
      report.correct_ms);
  if (!report.loop_ms.empty()) {
    std::vector<double> ms = report.loop_ms;
    std::sort(ms.begin(), ms.end());
    fmt::print("; loop search per keyframe: median {:.1f} ms, worst {:.1f} ms", ms[ms.size() / 2],
               ms.back());
  }
  fmt::print("\n");
}

int Run(const Arguments& arguments) {
  const auto dataset = OpenDataset(arguments.sequence);
  const auto truth_file = dataset->ground_truth();
  if (!truth_file) throw Error("{}: no ground truth", arguments.sequence.string());
  const Trajectory truth = ReadTrajectory(*truth_file);
  const Report without = RunSequence(*dataset, arguments, false);
  const Report with = RunSequence(*dataset, arguments, true);
  fmt::print(
      "| query | match | verdict | matches/agree/inliers | spread | confirmed | drift | depth "
      "contradicts | error (m) | reason |\n|---|---|---|---|---|---|---|---|---|---|\n");
  int num_refused = 0;
  for (const LoopRecord& record : with.records) {
    num_refused += record.verdict == LoopVerdict::kRefused ? 1 : 0;
    if (arguments.is_verbose || record.T_match_query) PrintRecord(record, truth);
  }
  fmt::print("\n{} candidates, {} refused\n", with.records.size(), num_refused);
  PrintAccuracy("without loops", without, truth);
  PrintAccuracy("with loops", with, truth);
  return EXIT_SUCCESS;
}

Arguments ParseArguments(const std::vector<std::string>& words) {
  Arguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--verbose") {
      arguments.is_verbose = true;
    } else if (words[i] == "--far") {
      arguments.leaves_far = true;
    } else if (words[i] == "--every" && i + 1 < words.size()) {
      arguments.every = std::max<std::size_t>(1, std::strtoul(words[++i].c_str(), nullptr, 10));
    } else {
      arguments.sequence = words[i];
    }
  }
  if (arguments.sequence.empty()) {
    throw Error("usage: cslam_loop_report SEQUENCE [--every N] [--far] [--verbose]");
  }
  return arguments;
}

}  // namespace
}  // namespace cslam

int main(int argc, char** argv) {
  try {
    return cslam::Run(cslam::ParseArguments({argv + 1, argv + argc}));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return EXIT_FAILURE;
  }
}
