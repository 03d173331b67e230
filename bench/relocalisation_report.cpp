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
#include "cslam/eval/ate.h"
#include "cslam/io/dataset.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/loop/relocaliser.h"
#include "cslam/pipeline/slam.h"
#include "cslam/util/check.h"
#include "cslam/util/stopwatch.h"
#include "cslam/vision/depth_thumbnail.h"
#include "cslam/vision/orb.h"

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
  Alignment alignment;  // of the map's world (b) onto that of the truth (a)
  std::vector<TrueView> keyframes;
};

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The true pose at a time: interpolated, where the truth has no gap there.
std::optional<Se3> PoseAt(const Trajectory& truth, Stamp stamp) {
  const PoseAssociationOptions options{.mode = PoseAssociationMode::kInterpolate};
  const PoseAssociation association = AssociatePoses(truth, {{stamp, Se3()}}, options);
  if (association.pairs.empty()) return std::nullopt;
  return association.pairs.front().reference;
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
  half.alignment = EvaluateAte(truth, KeyframeTrajectory(half.run)).alignment;
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

struct FrameReport {
  bool is_mapped = false;
  bool is_found = false;
  double error_m = 0.0;
  double error_deg = 0.0;
  double query_ms = 0.0;
  double find_ms = 0.0;  // query included
};

class Questioner {
 public:
  Questioner(const DatasetReader& dataset, const Trajectory& truth, const MappedHalf& half)
      : dataset_(dataset),
        truth_(truth),
        half_(half),
        camera_(dataset.camera().camera),
        extractor_(options_.tracking.orb),
        relocaliser_(MakePlaceSensor(camera_, options_.tracking.orb, options_.tracking.depth), {}) {
    const MapView& map = half.run.snapshot->map;
    for (const KeyframeId id : map.Keyframes()) {
      const Keyframe& keyframe = *map.FindKeyframe(id);
      index_.Add(id, SelectDescriptors(keyframe.data->features, PlaceKeypoints(map, keyframe)));
    }
  }

  std::optional<FrameReport> Ask(std::size_t i, bool is_verbose) {
    const auto T_truth_camera = PoseAt(truth_, dataset_.stamp(i));
    const LoadResult loaded = dataset_.Load(i);
    if (!T_truth_camera || !loaded.frame) return std::nullopt;
    FrameReport report;
    const double share = MappedShare(
        camera_, {*T_truth_camera, MakeDepthThumbnail(loaded.frame->depth_m)}, half_.keyframes);
    report.is_mapped = share >= kMinMappedShare;
    const FrameFeatures features =
        MeasureFeatures(extractor_.Extract(loaded.frame->gray), *loaded.frame, camera_,
                        UndistortedBounds(camera_), options_.tracking.depth);
    const Stopwatch watch;
    index_.Query(features.descriptors, {}, 40);
    report.query_ms = watch.Elapsed().cpu_ms;
    const RelocalisationResult result =
        relocaliser_.Find(features, half_.run.snapshot->map, index_);
    report.find_ms = watch.Elapsed().cpu_ms - report.query_ms;
    if (result.found) {
      report.is_found = true;
      const PoseDifference difference =
          Difference(*T_truth_camera, Align(half_.alignment, result.found->T_world_camera));
      report.error_m = difference.distance_m;
      report.error_deg = difference.angle_rad * 180.0 / std::numbers::pi;
    }
    if (is_verbose) Print(i, share, report, result);
    return report;
  }

 private:
  static void Print(std::size_t i, double share, const FrameReport& report,
                    const RelocalisationResult& result) {
    fmt::print("| {} | {:.2f} | {} | {:.3f} | {:.2f} | {} |", i, share,
               report.is_found ? "found" : "-", report.error_m, report.error_deg, result.reason);
    for (const PlaceVerification& a : result.attempts) {
      fmt::print(" [{}: {}/{} in {}, {}({})/{} cells {} {:.2f} px]", a.candidate.value(),
                 a.num_ransac_inliers, a.num_matches, a.ransac_iterations, a.num_inliers,
                 a.num_strict_inliers, a.num_expected, a.num_cells, a.median_error_px);
    }
    fmt::print("\n");
  }

  const DatasetReader& dataset_;
  const Trajectory& truth_;
  const MappedHalf& half_;
  const SlamOptions options_;
  const Camera camera_;
  OrbExtractor extractor_;
  PlaceIndex index_;
  Relocaliser relocaliser_;
};

// Prints the table; false if a bar is missed.
bool Summarise(const std::vector<FrameReport>& reports) {
  int num_mapped = 0;
  int num_mapped_found = 0;
  int num_found = 0;
  std::vector<double> errors_m, errors_deg, query_ms, find_ms;
  for (const FrameReport& r : reports) {
    num_mapped += r.is_mapped ? 1 : 0;
    num_mapped_found += r.is_mapped && r.is_found ? 1 : 0;
    num_found += r.is_found ? 1 : 0;
    query_ms.push_back(r.query_ms);
    find_ms.push_back(r.find_ms);
    if (!r.is_found) continue;
    errors_m.push_back(r.error_m);
    errors_deg.push_back(r.error_deg);
  }
  const double share = num_mapped > 0 ? static_cast<double>(num_mapped_found) / num_mapped : 1.0;
  const double worst = errors_m.empty() ? 0.0 : *std::max_element(errors_m.begin(), errors_m.end());
  fmt::print(
      "| frames | mapped | of these found | found in all | median | worst | query | all |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  fmt::print(
      "| {} | {} | {} ({:.1f} %) | {} | {:.1f} mm, {:.2f} deg | {:.1f} mm | {:.2f} ms | "
      "{:.1f} ms |\n",
      reports.size(), num_mapped, num_mapped_found, 100.0 * share, num_found,
      1e3 * Median(errors_m), Median(errors_deg), 1e3 * worst, Median(query_ms), Median(find_ms));
  return share >= kMinFoundShare && Median(errors_m) < kMaxMedianM &&
         Median(errors_deg) < kMaxMedianDeg && worst <= kMaxErrorM;
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
  fmt::print("mapped from {} of {} frames, ATE {:.1f} mm, median rotation error {:.2f} deg; ",
             frames.size(), half.run.frames.size(), 1e3 * ate.statistics_m.rmse,
             MedianRotationErrorDeg(ate));
  fmt::print("{} keyframes, {} points, keyframes aligned to {:.1f} mm\n\n",
             half.run.snapshot->map.num_keyframes(), half.run.snapshot->map.num_points(),
             1e3 * half.alignment.rmse_m);
  Questioner questioner(*dataset, truth, half);
  const std::size_t begin = dataset->size() / 2;
  const std::size_t count = std::min(kFrames, dataset->size() - begin);
  std::vector<FrameReport> reports;
  for (std::size_t k = 0; k < count; k += arguments.step) {
    const std::size_t i = begin + k * (dataset->size() - begin) / count;
    const auto report = questioner.Ask(i, arguments.is_verbose);
    if (report) reports.push_back(*report);
  }
  return Summarise(reports) ? EXIT_SUCCESS : EXIT_FAILURE;
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
