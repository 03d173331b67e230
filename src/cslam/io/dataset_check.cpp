// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/dataset_check.h"

#include "cslam/io/dataset_info.h"
#include "cslam/util/check.h"
#include "cslam/util/quantile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace cslam {
namespace {

constexpr std::size_t kMaxListed = 5;           // of one kind of finding
constexpr double kLargePairDifferenceS = 0.02;  // colour and depth would not be associated
constexpr double kMinPlausibleDepthM = 0.2;     // medians beyond these two speak of a
constexpr double kMaxPlausibleDepthM = 10.0;    // wrong depth scale
constexpr double kPauseIntervals = 1.5;         // times the usual interval
constexpr double kShortTruthShare = 0.999;      // of frames with ground truth

// Appends the first few of a series and how many there are besides.
void AppendSeries(std::vector<std::string>& to, const std::vector<std::string>& series,
                  const char* what) {
  const std::size_t count = std::min(series.size(), kMaxListed);
  to.insert(to.end(), series.begin(), series.begin() + static_cast<std::ptrdiff_t>(count));
  if (series.size() > count)
    to.push_back(fmt::format("... and {} more {}", series.size() - count, what));
}

// A slow camera's usual interval is no pause.
double LongGapS(const std::vector<TumPair>& pairs) {
  if (pairs.size() < 2) return kLongGapS;
  std::vector<double> intervals_s;
  for (std::size_t i = 1; i < pairs.size(); ++i)
    intervals_s.push_back(SecondsBetween(pairs[i].color_stamp, pairs[i - 1].color_stamp));
  return std::max(kLongGapS, kPauseIntervals * QuantileOf(std::move(intervals_s), 0.5));
}

void CheckTimes(DatasetCheck& check, const TumIndex& index) {
  std::vector<std::string> gaps;
  for (const FrameGap& gap : FindGaps(index.pairs, LongGapS(index.pairs))) {
    gaps.push_back(fmt::format("{:.3f} s without a frame after frame {}", gap.length_s, gap.frame));
  }
  AppendSeries(check.warnings, gaps, "pauses");
  std::vector<std::string> differences;
  std::vector<std::string> disorder;
  for (std::size_t i = 0; i < index.pairs.size(); ++i) {
    const TumPair& pair = index.pairs[i];
    const double difference_s = SecondsBetween(pair.depth_stamp, pair.color_stamp);
    if (std::abs(difference_s) > kLargePairDifferenceS) {
      differences.push_back(fmt::format("frame {}: depth is {:.3f} s {} colour", i,
                                        std::abs(difference_s),
                                        difference_s > 0.0 ? "after" : "before"));
    }
    if (i == 0) continue;
    const Stamp previous = index.pairs[i - 1].depth_stamp;
    if (pair.depth_stamp <= previous) {
      disorder.push_back(fmt::format("frame {}: its depth image {} that of the frame before", i,
                                     pair.depth_stamp == previous ? "is also" : "is older than"));
    }
  }
  AppendSeries(check.warnings, differences, "pairs far apart in time");
  AppendSeries(check.warnings, disorder, "depth images out of order");
}

void CheckCounts(DatasetCheck& check, const TumIndex& index) {
  if (index.num_unmatched_color + index.num_unmatched_depth > 0) {
    check.warnings.push_back(
        fmt::format("{} colour and {} depth images have no partner within 0.02 s",
                    index.num_unmatched_color, index.num_unmatched_depth));
  }
  if (index.num_ignored_files > 0) {
    check.warnings.push_back(
        fmt::format("{} images whose name is no timestamp are not used", index.num_ignored_files));
  }
}

void CheckGroundTruth(DatasetCheck& check, const TumIndex& index) {
  for (const auto& path : {index.ground_truth, index.ground_truth_camera}) {
    if (!path) continue;
    const GroundTruthInfo info = InspectGroundTruth(*path, index.pairs);
    if (!info.problem.empty()) {
      check.errors.push_back(info.problem);
    } else if (static_cast<double>(info.num_covered_frames) <
               kShortTruthShare * static_cast<double>(index.pairs.size())) {
      check.warnings.push_back(fmt::format("{} has a pose within 0.02 s for {} of {} frames",
                                           path->filename().string(), info.num_covered_frames,
                                           index.pairs.size()));
    }
  }
}

// The lines of a series of frames, by what is wrong with them.
struct FrameProblems {
  std::vector<std::string> missing;
  std::vector<std::string> unreadable;
  std::vector<std::string> wrong_size;
  std::vector<std::string> without_depth;

  void Add(std::size_t frame, const LoadResult& result) {
    std::string line = fmt::format("frame {}: {}", frame, result.problem);
    switch (result.fault) {
      case FrameFault::kMissing:
        missing.push_back(std::move(line));
        break;
      case FrameFault::kUnreadable:
        unreadable.push_back(std::move(line));
        break;
      case FrameFault::kWrongSize:
        wrong_size.push_back(std::move(line));
        break;
      case FrameFault::kNone:
        break;
    }
  }
};

// Missing files are looked for everywhere, even where only a sample is decoded.
void FindMissing(FrameProblems& problems, const TumIndex& index,
                 const std::vector<std::size_t>& decoded) {
  for (std::size_t i = 0; i < index.pairs.size(); ++i) {
    if (std::binary_search(decoded.begin(), decoded.end(), i)) continue;
    for (const auto* path : {&index.pairs[i].color, &index.pairs[i].depth}) {
      std::error_code ignored;
      if (std::filesystem::exists(*path, ignored)) continue;
      problems.missing.push_back(
          fmt::format("frame {}: image '{}' does not exist", i, path->string()));
      break;
    }
  }
}

void CheckFrames(DatasetCheck& check, const TumIndex& index, const CameraConfig& camera,
                 std::optional<std::size_t> num_samples) {
  FrameProblems problems;
  DepthStatistics depth;
  const std::size_t total = index.pairs.size();
  const std::vector<std::size_t> sample = EvenSample(total, num_samples.value_or(total));
  for (const std::size_t i : sample) {
    const LoadResult result =
        LoadTumPair(index.pairs[i], FrameId(static_cast<std::uint32_t>(i)), camera);
    problems.Add(i, result);
    if (!result.frame) continue;
    depth.Add(result.frame->depth_m);
    if (depth.is_last_empty()) {
      problems.without_depth.push_back(fmt::format("frame {}: depth has no reading at all", i));
    }
  }
  FindMissing(problems, index, sample);
  check.num_checked = sample.size();
  check.num_missing = problems.missing.size();
  check.num_unreadable = problems.unreadable.size();
  check.num_wrong_size = problems.wrong_size.size();
  check.num_without_depth = problems.without_depth.size();
  check.depth_valid_share = depth.valid_share();
  check.median_depth_m = depth.median_m();
  AppendSeries(check.errors, problems.missing, "frames with a missing image");
  AppendSeries(check.errors, problems.unreadable, "frames with an unreadable image");
  AppendSeries(check.errors, problems.wrong_size, "frames with an image of the wrong size");
  AppendSeries(check.warnings, problems.without_depth, "frames without depth");
}

void CheckDepthScale(DatasetCheck& check, const CameraConfig& camera) {
  if (check.median_depth_m == 0.0) return;
  if (check.median_depth_m >= kMinPlausibleDepthM && check.median_depth_m <= kMaxPlausibleDepthM) {
    return;
  }
  check.warnings.push_back(
      fmt::format("the median depth is {:.3g} m with {} units per metre: is the depth scale right?",
                  check.median_depth_m, camera.depth_units_per_m));
}

}  // namespace

DatasetCheck CheckDataset(const std::filesystem::path& folder, const CameraChoice& choice,
                          std::optional<std::size_t> num_samples) {
  CheckIsDataset(folder);
  DatasetCheck check;
  try {
    const TumIndex index = ReadTumIndex(folder);
    check.num_frames = index.pairs.size();
    CheckCounts(check, index);
    CheckTimes(check, index);
    CheckGroundTruth(check, index);
    const InspectionCamera camera = FindInspectionCamera(index, choice);
    if (!camera.is_known) check.warnings.push_back(camera.problem);
    CheckFrames(check, index, camera.config, num_samples);
    CheckDepthScale(check, camera.config);
  } catch (const Error& error) {
    check.errors.emplace_back(error.what());
  }
  return check;
}

}  // namespace cslam
