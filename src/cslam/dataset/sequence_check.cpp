// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/sequence_check.h"

#include "cslam/dataset/check_folder.h"
#include "cslam/dataset/render_record.h"
#include "cslam/dataset/truth_lookup.h"
#include "cslam/io/dataset_info.h"
#include "cslam/io/tum_dataset.h"
#include "cslam/util/check.h"

#include <fmt/format.h>

#include <algorithm>

namespace cslam {
namespace {

constexpr std::size_t kAnchors = 40;         // frames whose depth is compared with others'
constexpr double kMaxPiercedShare = 0.01;    // of a rendered sequence's points
constexpr double kMaxPairPierced = 0.05;     // of one pair
constexpr double kMaxRelativeMedian = 0.02;  // of a recording's depth; true ones stay below 0.01
constexpr double kMaxOccluded = 0.5;         // share of hidden or pierced points of a recording

// What 95 % of the readings of a sensor keep to; the noise of two frames adds up in a comparison.
DepthTolerance ToleranceOf(SensorNoise noise) {
  switch (noise) {
    case SensorNoise::kOff:
      return {.floor_m = 0.001, .per_square = 0.0};
    case SensorNoise::kKinect:
      return {.floor_m = 0.001, .per_square = 0.006};
    case SensorNoise::kD435i:
      return {.floor_m = 0.001, .per_square = 0.010};
  }
  return {};
}

// For recordings: what a Kinect does, and poses of a motion capture system besides.
constexpr DepthTolerance kRecordingTolerance{.floor_m = 0.02, .per_square = 0.01};

// Whether the frames go to the story's end, but for less than two frames.
bool IsWhole(const RenderRecord& record) {
  return record.num_frames + 2.0 > record.fps * record.story_duration_s;
}

class SequenceChecker {
 public:
  SequenceChecker(const std::filesystem::path& folder, const SequenceCheckOptions& options)
      : folder_(folder), options_(options) {}

  SequenceCheck Run() {
    check_.files = CheckDataset(folder_, options_.camera, options_.num_samples);
    check_.errors = check_.files.errors;
    check_.warnings = check_.files.warnings;
    try {
      ReadTruth();
      TumIndex index = ReadTumIndex(folder_);
      const InspectionCamera camera = FindInspectionCamera(index, options_.camera);
      const FolderFrames frames(std::move(index), camera.config);
      if (frames.pose_file()) check_.pose_file = frames.pose_file()->filename().string();
      CheckDepth(frames, camera.is_known);
      CheckTruthFiles(frames);
      CheckTheStory(frames);
    } catch (const Error& error) {
      AddOnce(error.what());
    }
    return std::move(check_);
  }

 private:
  bool Has(const char* name) const {
    std::error_code ignored;
    return std::filesystem::exists(folder_ / name, ignored);
  }

  // Both the file check and this one read the lists; what they complain about is told once.
  void AddOnce(const std::string& error) {
    if (std::find(check_.errors.begin(), check_.errors.end(), error) == check_.errors.end())
      check_.errors.push_back(error);
  }

  void Skip(std::string what) { check_.skipped.push_back(std::move(what)); }

  template <typename Value, typename Reader>
  std::optional<Value> ReadIfThere(const char* name, const Reader& read) {
    if (!Has(name)) return std::nullopt;
    try {
      return read(folder_ / name);
    } catch (const Error& error) {
      AddOnce(error.what());
      has_broken_truth_ = true;
      return std::nullopt;
    }
  }

  void ReadTruth() {
    truth_.detections = ReadIfThere<DetectionRecord>("detections.json", ReadDetections);
    truth_.objects = ReadIfThere<TrueObjects>("objects.json", ReadTrueObjects);
    truth_.changes = ReadIfThere<TrueChanges>("changes.json", ReadTrueChanges);
    render_ = ReadIfThere<RenderRecord>("render.json", ReadRenderRecord);
    if (render_) check_.tolerance = ToleranceOf(render_->noise);
  }

  void CheckDepth(const FolderFrames& frames, bool is_camera_known) {
    if (!is_camera_known) {
      Skip("no camera known: depth not held against poses");
      return;
    }
    if (!frames.pose_file()) {
      Skip("no groundtruth.txt: depth not held against poses");
      return;
    }
    const bool is_exact = render_ && render_->noise == SensorNoise::kOff;
    ReprojectionOptions options;
    options.num_anchors = std::min(kAnchors, options_.num_samples.value_or(kAnchors));
    options.tolerance = check_.tolerance.value_or(kRecordingTolerance);
    options.window_px = is_exact ? 1 : 2;
    const TrueObjects* objects = truth_.objects ? &*truth_.objects : nullptr;
    check_.reprojection = CheckReprojection(frames, objects, options);
    if (check_.reprojection->pairs.empty()) {
      Skip("no two frames with poses see the same: depth not held against poses");
    } else if (render_) {
      JudgeRendered(check_.reprojection->all);
    } else {
      JudgeRecording(check_.reprojection->all);
    }
  }

  void JudgeRendered(const ReprojectionFigures& all) {
    if (all.p95_per_tolerance > 1.0) {
      check_.errors.push_back(
          fmt::format("depth and poses disagree: {:.1f} mm at the 95th percentile, {:.1f} times "
                      "what the noise allows",
                      1e3 * all.p95_m, all.p95_per_tolerance));
    }
    if (all.pierced_share > kMaxPiercedShare) {
      check_.errors.push_back(
          fmt::format("depth and poses disagree: {:.1f} % of the points are looked through by "
                      "another frame",
                      100.0 * all.pierced_share));
    }
    Findings pairs;
    for (const PairFigures& p : check_.reprojection->pairs) {
      const bool is_far_off =
          p.figures.median_m > Allowed(p.figures) || p.figures.pierced_share > kMaxPairPierced;
      if (!is_far_off) continue;
      pairs.push_back(fmt::format(
          "frames {} and {} disagree about depth: median {:.1f} mm, {:.1f} % looked through",
          p.pair.a, p.pair.b, 1e3 * p.figures.median_m, 100.0 * p.figures.pierced_share));
    }
    AppendShortened(check_.errors, pairs, "pairs of frames that disagree");
  }

  // A median beyond what 95 % should keep to speaks of a wrong pose, not of noise.
  double Allowed(const ReprojectionFigures& figures) const {
    const double z_m =
        figures.median_relative > 0.0 ? figures.median_m / figures.median_relative : 0.0;
    return check_.tolerance->At(z_m);
  }

  void JudgeRecording(const ReprojectionFigures& all) {
    const double occluded_share = all.hidden_share + all.pierced_share;
    if (all.median_relative <= kMaxRelativeMedian && occluded_share <= kMaxOccluded) return;
    check_.warnings.push_back(fmt::format(
        "depth and the poses of {} disagree by {:.1f} % of the depth (median), {:.0f} % of the "
        "points are hidden or looked through: is the depth scale right, and are the poses those "
        "of the camera?",
        check_.pose_file, 100.0 * all.median_relative, 100.0 * occluded_share));
  }

  void CheckTruthFiles(const FolderFrames& frames) {
    if (!frames.has_instances() && !truth_.detections && !truth_.objects) {
      if (!has_broken_truth_)
        Skip("no instances/, detections.json or objects.json: truth not checked");
      return;
    }
    if (!frames.has_instances())
      Skip("no instances/: detections.json and objects.json not held against images");
    if (!truth_.detections && !Has("detections.json"))
      Skip("no detections.json: boxes not checked");
    if (!truth_.objects && !Has("objects.json"))
      Skip("no objects.json: presence, poses and classes not checked");
    TruthCheckOptions options;
    options.num_samples = options_.num_samples;
    options.tolerance = check_.tolerance.value_or(kRecordingTolerance);
    if (!render_ || render_->noise != SensorNoise::kOff) options.max_outside_share = 0.05;
    check_.truth = CheckTruth(frames, truth_, options);
    Append(check_.errors, check_.truth->errors);
    if (truth_.objects && truth_.changes)
      Append(check_.errors, CheckChanges(*truth_.objects, *truth_.changes));
  }

  void CheckTheStory(const FolderFrames& frames) {
    if (!truth_.objects || !truth_.changes) {
      const char* missing = !truth_.objects ? "objects.json" : "changes.json";
      Skip(fmt::format("{} {}: story not checked", Has(missing) ? "broken" : "no", missing));
      return;
    }
    StoryCheckOptions options;
    options.tolerance = check_.tolerance.value_or(kRecordingTolerance);
    if (render_) {
      options.people = render_->people;
      options.is_whole = IsWhole(*render_);
      if (!options.is_whole) Skip("the story is cut: what should follow its end is not missed");
    }
    check_.story = CheckStory(frames, truth_, options);
    Append(check_.errors, check_.story->errors);
    Append(check_.warnings, check_.story->warnings);
    if (!check_.story->people) Skip("no detections.json: people not measured");
  }

  static void Append(Findings& to, const Findings& findings) {
    to.insert(to.end(), findings.begin(), findings.end());
  }

  std::filesystem::path folder_;
  const SequenceCheckOptions& options_;
  SequenceTruth truth_;
  std::optional<RenderRecord> render_;
  bool has_broken_truth_ = false;
  SequenceCheck check_;
};

}  // namespace

SequenceCheck CheckSequence(const std::filesystem::path& folder,
                            const SequenceCheckOptions& options) {
  return SequenceChecker(folder, options).Run();
}

}  // namespace cslam
