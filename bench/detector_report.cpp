// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Measures detectors on a recording and prints what docs/models.md says of them: time per frame and
// how many objects of a class each finds at which score, against a reference model's boxes.
//
//   cslam_detector_report SEQUENCE CLASS FROM FRAMES STEP REFERENCE.yaml [MODEL.yaml ...]
#include "cslam/io/dataset.h"
#include "cslam/semantics/coco.h"
#include "cslam/semantics/dnn_detector.h"
#include "cslam/util/check.h"
#include "cslam/util/stopwatch.h"
#include "cslam/util/text_table.h"

#include <fmt/format.h>
#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace cslam {
namespace {

constexpr std::array kScores{0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.6};
constexpr double kLowestScore = 0.2;
constexpr double kReferenceScore = 0.45;
constexpr double kMatchIou = 0.5;

using Frames = std::vector<RgbdFrame>;
using Boxes = std::vector<std::vector<Detection>>;  // of each frame

Frames LoadFrames(const std::filesystem::path& folder, std::size_t from, std::size_t count,
                  std::size_t step) {
  DatasetOptions options;
  options.from = from;
  options.frames = count;
  const auto dataset = OpenDataset(folder, options);
  Frames frames;
  for (std::size_t i = 0; i < dataset->size(); i += step) {
    LoadResult loaded = dataset->Load(i);
    if (!loaded.frame) continue;
    loaded.frame->depth_m.release();
    frames.push_back(*std::move(loaded.frame));
  }
  return frames;
}

struct Measured {
  std::string name;
  Boxes boxes;
  double median_ms = 0.0;
};

Measured Measure(const std::filesystem::path& file, const Frames& frames, int class_id) {
  ModelDescription model = ReadModelDescription(file);
  model.thresholds.fill(kLowestScore);
  DnnDetector detector(model);
  Measured measured{.name = file.stem().string(), .boxes = {}, .median_ms = 0.0};
  std::vector<double> times_ms;
  for (const RgbdFrame& frame : frames) {
    const Stopwatch watch;
    std::vector<Detection> objects = detector.Detect(frame).objects;
    times_ms.push_back(watch.Elapsed().cpu_ms);
    std::erase_if(objects, [&](const Detection& d) { return d.class_id != class_id; });
    measured.boxes.push_back(std::move(objects));
  }
  std::ranges::nth_element(times_ms, times_ms.begin() + static_cast<int>(times_ms.size() / 2));
  measured.median_ms = times_ms[times_ms.size() / 2];
  return measured;
}

struct Counts {
  int found = 0;         // boxes at or above the score
  int matched = 0;       // reference boxes that one of them overlaps
  int unmatched = 0;     // boxes that overlap no reference box of any score
  int empty_frames = 0;  // without any box where the reference has one
};

bool OverlapsOneOf(const Box& box, const std::vector<Detection>& others, double score) {
  return std::ranges::any_of(others, [&](const Detection& other) {
    return other.score >= score && Iou(other.box, box) >= kMatchIou;
  });
}

Counts Count(const Boxes& boxes, const Boxes& reference, double score) {
  Counts counts;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    int found = 0;
    for (const Detection& box : boxes[i]) {
      if (box.score < score) continue;
      ++found;
      if (!OverlapsOneOf(box.box, reference[i], 0.0)) ++counts.unmatched;
    }
    int expected = 0;
    for (const Detection& truth : reference[i]) {
      if (truth.score < kReferenceScore) continue;
      ++expected;
      if (OverlapsOneOf(truth.box, boxes[i], score)) ++counts.matched;
    }
    counts.found += found;
    if (found == 0 && expected > 0) ++counts.empty_frames;
  }
  return counts;
}

void PrintTable(const std::vector<Measured>& all, std::size_t num_frames) {
  const Measured& reference = all.front();
  int num_reference = 0;
  for (const auto& boxes : reference.boxes) {
    num_reference += static_cast<int>(std::ranges::count_if(
        boxes, [](const Detection& box) { return box.score >= kReferenceScore; }));
  }
  fmt::print("{} frames; reference {} at {}: {} boxes\n", num_frames, reference.name,
             kReferenceScore, num_reference);
  TextTable table({{"model"},
                   {"CPU ms", TextAlign::kRight},
                   {"score", TextAlign::kRight},
                   {"per frame", TextAlign::kRight},
                   {"of reference %", TextAlign::kRight},
                   {"unknown to it per frame", TextAlign::kRight},
                   {"frames with none %", TextAlign::kRight}});
  const double frames = static_cast<double>(num_frames);
  for (const Measured& measured : all) {
    for (const double score : kScores) {
      const Counts counts = Count(measured.boxes, reference.boxes, score);
      table.AddRow({measured.name, fmt::format("{:.1f}", measured.median_ms),
                    fmt::format("{:.2f}", score), fmt::format("{:.2f}", counts.found / frames),
                    fmt::format("{:.1f}", 100.0 * counts.matched / std::max(1, num_reference)),
                    fmt::format("{:.3f}", counts.unmatched / frames),
                    fmt::format("{:.1f}", 100.0 * counts.empty_frames / frames)});
    }
    table.AddRule();
  }
  fmt::print("{}", table.Text());
}

void Run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 6)
    throw Error("usage: cslam_detector_report SEQUENCE CLASS FROM FRAMES STEP REFERENCE [MODEL..]");
  const auto class_id = FindCocoClass(arguments[1]);
  if (!class_id) throw Error("no COCO class '{}'", arguments[1]);
  const Frames frames = LoadFrames(arguments[0], std::stoul(arguments[2]), std::stoul(arguments[3]),
                                   std::stoul(arguments[4]));
  cv::setNumThreads(1);
  std::vector<Measured> all;
  for (std::size_t i = 5; i < arguments.size(); ++i)
    all.push_back(Measure(arguments[i], frames, *class_id));
  PrintTable(all, frames.size());
}

}  // namespace
}  // namespace cslam

int main(int argc, char** argv) {
  try {
    cslam::Run({argv + 1, argv + argc});
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    fmt::print(stderr, "cslam_detector_report: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
