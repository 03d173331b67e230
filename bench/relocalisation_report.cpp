// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// How well frames are found again on their own: maps the first half of a recording with ground
// truth, then asks for frames of the second half one by one, knowing nothing of the others.
// Prints Markdown: one line per frame with --verbose, and a summary.
//
//   cslam_relocalisation_report SEQUENCE [STEP] [--verbose]
//
// STEP 1 asks for 200 frames spread over the second half, 5 for every fifth of them. A frame counts
// as mapped if at least 30 % of its valid depth pixels lie within 5 cm of the depth of some
// keyframe, by true poses. Exit code 1 if a bar of issue 5 is missed.
#include "cslam/run/relocalisation_report.h"

#include "cslam/eval/ate.h"
#include "cslam/io/dataset.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/pipeline/frame_localiser.h"
#include "cslam/pipeline/slam.h"
#include "cslam/run/map_truth.h"
#include "cslam/util/check.h"
#include "cslam/util/quantile.h"
#include "cslam/vision/depth_thumbnail.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace cslam {
namespace {

constexpr std::size_t kFrames = 200;
constexpr double kMinMappedShare = 0.3;
constexpr double kSameSurfaceM = 0.05;
constexpr double kMinFoundShare = 0.9;
constexpr double kMaxMedianM = 0.03;
constexpr double kMaxMedianDeg = 1.5;
constexpr double kMaxErrorM = 0.20;

struct Arguments {
  std::filesystem::path sequence;
  std::size_t step = 1;
  bool is_verbose = false;
};

struct TrueView {
  Se3 T_world_camera;  // by ground truth
  cv::Mat depth_mm;    // thumbnail
};

struct MappedHalf {
  RunResult run;
  std::vector<TrueView> keyframes;
};

double Median(std::vector<double> values) {
  return values.empty() ? 0.0 : MedianOf(std::move(values));
}

// Without object filters: the recordings asked about are of places in which nothing moves.
SlamOptions StaticOptions() {
  SlamOptions options;
  options.tracking.objects.enabled = false;
  return options;
}

MappedHalf MapFirstHalf(const DatasetReader& dataset, const Trajectory& truth) {
  MappedHalf half;
  Slam slam(dataset.camera().camera, StaticOptions(), Execution::kInline);
  for (std::size_t i = 0; i < dataset.size() / 2; ++i) {
    LoadResult loaded = dataset.Load(i);
    if (loaded.frame) slam.Track(std::make_shared<const RgbdFrame>(*std::move(loaded.frame)));
  }
  half.run = slam.Finish();
  const MapView& map = half.run.snapshot->map;
  for (const KeyframeId id : map.Keyframes()) {
    const KeyframeData& data = *map.FindKeyframe(id)->data;
    const auto pose = PoseAt(truth, data.stamp);
    if (pose) half.keyframes.push_back({*pose, data.depth_small_mm});
  }
  return half;
}

// Share of a view's valid depth pixels whose point is where one of the others measured a surface.
double MappedShare(const Camera& camera, const TrueView& view,
                   const std::vector<TrueView>& others) {
  const int step = DepthThumbnailStep(camera.width);
  int num_valid = 0;
  int num_mapped = 0;
  for (int v = 0; v < view.depth_mm.rows; v += 2) {
    for (int u = 0; u < view.depth_mm.cols; u += 2) {
      const double z = 1e-3 * view.depth_mm.at<std::uint16_t>(v, u);
      if (z <= 0.0) continue;
      ++num_valid;
      const Eigen::Vector2d raw(u * step + step / 2, v * step + step / 2);
      const Eigen::Vector3d p_world =
          view.T_world_camera * Unproject(camera, Undistort(camera, raw), z);
      const auto sees_it = [&](const TrueView& other) {
        const Eigen::Vector3d p = other.T_world_camera.Inverse() * p_world;
        if (p.z() < 0.1) return false;
        const Eigen::Vector2d px = Project(camera, p);
        if (px.x() < 0.0 || px.x() >= camera.width || px.y() < 0.0 || px.y() >= camera.height) {
          return false;
        }
        const Eigen::Vector2d there = Distort(camera, px) / step;
        const int x = static_cast<int>(there.x());
        const int y = static_cast<int>(there.y());
        if (x < 0 || y < 0 || x >= other.depth_mm.cols || y >= other.depth_mm.rows) return false;
        const double measured = 1e-3 * other.depth_mm.at<std::uint16_t>(y, x);
        return measured > 0.0 && std::abs(measured - p.z()) < kSameSurfaceM;
      };
      if (std::any_of(others.begin(), others.end(), sees_it)) ++num_mapped;
    }
  }
  return num_valid > 0 ? static_cast<double>(num_mapped) / num_valid : 0.0;
}

// Frames of the second half, and which of them show what the map shows.
struct Answers {
  RelocalisationReport report;
  std::vector<std::uint8_t> is_mapped;  // one for each frame
};

class Questioner {
 public:
  Questioner(const DatasetReader& dataset, const Trajectory& truth, const MappedHalf& half)
      : dataset_(dataset),
        truth_(truth),
        half_(half),
        map_truth_(half.run.snapshot->map, truth, truth),
        localiser_(half.run.snapshot, dataset.camera().camera, StaticOptions(), nullptr) {
    answers_.report.keyframe_rmse_m = map_truth_.KeyframeRmse();
  }

  void Ask(std::size_t i, bool is_verbose) {
    const auto T_truth_camera = PoseAt(truth_, dataset_.stamp(i));
    const LoadResult loaded = dataset_.Load(i);
    if (!T_truth_camera || !loaded.frame) return;
    const TrueView view{*T_truth_camera, MakeDepthThumbnail(loaded.frame->depth_m)};
    const double share = MappedShare(dataset_.camera().camera, view, half_.keyframes);
    const LocalisedFrame found = localiser_.Find(*loaded.frame);
    RelocalisationReport::Frame frame{found, std::nullopt};
    if (found.T_world_camera) {
      frame.error = map_truth_.ErrorOf(found.map, found.stamp, *found.T_world_camera);
    }
    if (is_verbose) {
      fmt::print("| {} | {:.2f} | {} | {:.3f} | {} |\n", i, share, frame.error ? "found" : "-",
                 frame.error ? frame.error->distance_m : 0.0, found.reason);
    }
    answers_.report.frames.push_back(std::move(frame));
    answers_.is_mapped.push_back(share >= kMinMappedShare ? 1 : 0);
  }

  const Answers& answers() const { return answers_; }

 private:
  const DatasetReader& dataset_;
  const Trajectory& truth_;
  const MappedHalf& half_;
  const MapTruth map_truth_;
  FrameLocaliser localiser_;
  Answers answers_;
};

// Prints the table; false if a bar is missed.
bool Summarise(const Answers& answers) {
  const std::vector<RelocalisationReport::Frame>& frames = answers.report.frames;
  int num_mapped = 0;
  int num_mapped_found = 0;
  std::vector<double> find_ms;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const bool is_found = frames[i].result.T_world_camera.has_value();
    num_mapped += answers.is_mapped[i];
    num_mapped_found += is_found ? answers.is_mapped[i] : 0;
    find_ms.push_back(frames[i].result.find_ms);
  }
  const double share = num_mapped > 0 ? static_cast<double>(num_mapped_found) / num_mapped : 1.0;
  const RelocalisationErrors errors = SummariseErrors(frames);
  fmt::print("| frames | mapped | of these found | found in all | median | worst | search |\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  fmt::print("| {} | {} | {} ({:.1f} %) | {} | {:.1f} mm, {:.2f} deg | {:.1f} mm | {:.1f} ms |\n",
             frames.size(), num_mapped, num_mapped_found, 100.0 * share, CountFound(answers.report),
             1e3 * errors.median_m, errors.median_deg, 1e3 * errors.max_m, Median(find_ms));
  return share >= kMinFoundShare && errors.median_m < kMaxMedianM &&
         errors.median_deg < kMaxMedianDeg && errors.max_m <= kMaxErrorM;
}

// What the map itself is worth: of the frames it was made from, against the truth.
double MedianRotationErrorDeg(const AteResult& ate) {
  std::vector<double> errors_deg;
  for (const PosePair& pair : ate.association.pairs) {
    const PoseDifference error = Difference(pair.reference, Align(ate.alignment, pair.estimate));
    errors_deg.push_back(error.angle_rad * 180.0 / std::numbers::pi);
  }
  return Median(errors_deg);
}

int Run(const Arguments& arguments) {
  const auto dataset = OpenDataset(arguments.sequence);
  const auto truth_file = dataset->ground_truth();
  if (!truth_file) throw Error("{}: no ground truth", arguments.sequence.string());
  const Trajectory truth = ReadTrajectory(*truth_file);
  const MappedHalf half = MapFirstHalf(*dataset, truth);
  const Trajectory frames = FinalTrajectory(half.run);
  const AteResult ate = EvaluateAte(truth, frames);
  Questioner questioner(*dataset, truth, half);
  fmt::print("mapped from {} of {} frames, ATE {:.1f} mm, median rotation error {:.2f} deg; ",
             frames.size(), half.run.frames.size(), 1e3 * ate.statistics_m.rmse,
             MedianRotationErrorDeg(ate));
  fmt::print("{} keyframes, {} points, keyframes aligned to {:.1f} mm\n\n",
             half.run.snapshot->map.num_keyframes(), half.run.snapshot->map.num_points(),
             1e3 * questioner.answers().report.keyframe_rmse_m.value_or(0.0));
  const std::size_t begin = dataset->size() / 2;
  const std::size_t count = std::min(kFrames, dataset->size() - begin);
  for (std::size_t k = 0; k < count; k += arguments.step) {
    const std::size_t i = begin + k * (dataset->size() - begin) / count;
    questioner.Ask(i, arguments.is_verbose);
  }
  return Summarise(questioner.answers()) ? EXIT_SUCCESS : EXIT_FAILURE;
}

Arguments ParseArguments(const std::vector<std::string>& words) {
  Arguments arguments;
  for (const std::string& word : words) {
    if (word == "--verbose") {
      arguments.is_verbose = true;
    } else if (arguments.sequence.empty()) {
      arguments.sequence = word;
    } else {
      arguments.step = std::max<std::size_t>(1, std::strtoul(word.c_str(), nullptr, 10));
    }
  }
  if (arguments.sequence.empty()) {
    throw Error("usage: cslam_relocalisation_report SEQUENCE [STEP] [--verbose]");
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
