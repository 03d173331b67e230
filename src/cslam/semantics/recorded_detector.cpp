// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/recorded_detector.h"

#include "cslam/util/check.h"
#include "cslam/util/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace cslam {
namespace {

constexpr std::int64_t kStampTolerance_ns = 500'000;  // files give 4 to 9 decimals of a second
constexpr double kMinFalseBox = 0.05;                 // side, as a share of the image's
constexpr double kMaxFalseBox = 0.5;
constexpr std::array kFalseScores{0.3, 0.6};  // a real detector is seldom sure of nothing
constexpr int kMaxFalseBoxes = 1000;

enum Purpose : std::uint64_t { kDrop, kJitter, kFalseBoxes };

Rng RngFor(const DegradeOptions& options, Stamp stamp, Purpose purpose) {
  return Rng(static_cast<std::uint64_t>(options.seed), static_cast<std::uint64_t>(stamp.ns),
             purpose);
}

Box ImageBox(const DetectionRecord& record) {
  return {0.0, 0.0, static_cast<double>(record.width_px), static_cast<double>(record.height_px)};
}

Box Jittered(const Box& box, double jitter, Rng& rng) {
  const double width = jitter * box.width();
  const double height = jitter * box.height();
  Box moved = box;
  moved.x_min += width * rng.Gaussian();
  moved.y_min += height * rng.Gaussian();
  moved.x_max += width * rng.Gaussian();
  moved.y_max += height * rng.Gaussian();
  return moved;
}

// A Poisson number (Knuth's method).
int DrawCount(double mean, Rng& rng) {
  const double limit = std::exp(-mean);
  double product = rng.Uniform();
  int count = 0;
  while (product > limit && count < kMaxFalseBoxes) {
    product *= rng.Uniform();
    ++count;
  }
  return count;
}

std::vector<int> ClassesOf(const DetectionRecord& record) {
  std::set<int> classes;
  for (const RecordedFrame& frame : record.frames) {
    for (const RecordedDetection& detection : frame.detections)
      classes.insert(detection.class_id);
  }
  if (classes.empty()) classes.insert(kPersonClass);
  return {classes.begin(), classes.end()};
}

Detection FalseBox(const Box& image, const std::vector<int>& classes, Rng& rng) {
  const double width = image.width() * rng.Uniform(kMinFalseBox, kMaxFalseBox);
  const double height = image.height() * rng.Uniform(kMinFalseBox, kMaxFalseBox);
  const double x = rng.Uniform(0.0, image.width() - width);
  const double y = rng.Uniform(0.0, image.height() - height);
  return {.class_id = classes[rng.Index(classes.size())],
          .score = rng.Uniform(kFalseScores[0], kFalseScores[1]),
          .box = {x, y, x + width, y + height},
          .mask = {}};
}

}  // namespace

std::vector<Detection> Degrade(const RecordedFrame& frame, const DetectionRecord& record,
                               const DegradeOptions& options) {
  Rng drop = RngFor(options, frame.stamp, kDrop);
  Rng jitter = RngFor(options, frame.stamp, kJitter);
  Rng invent = RngFor(options, frame.stamp, kFalseBoxes);
  const Box image = ImageBox(record);
  std::vector<Detection> objects;
  for (const RecordedDetection& detection : frame.detections) {
    // Each is drawn for, dropped or not, so that one option does not change what another does.
    const bool is_missed = drop.Uniform() < options.drop_probability;
    const Box moved = Intersect(Jittered(detection.box, options.jitter, jitter), image);
    if (is_missed || moved.empty()) continue;
    objects.push_back(
        {.class_id = detection.class_id, .score = detection.score, .box = moved, .mask = {}});
  }
  if (options.false_boxes_per_frame > 0.0) {
    const std::vector<int> classes = ClassesOf(record);
    const int count = DrawCount(options.false_boxes_per_frame, invent);
    for (int i = 0; i < count; ++i)
      objects.push_back(FalseBox(image, classes, invent));
  }
  std::ranges::stable_sort(objects, std::ranges::greater{}, &Detection::score);
  return objects;
}

RecordedDetector::RecordedDetector(DetectionRecord record, std::string source,
                                   const DegradeOptions& degrade)
    : record_(std::move(record)), source_(std::move(source)), degrade_(degrade) {
  if (record_.frames.empty()) throw Error("'{}' has no frame in it", source_);
  CSLAM_CHECK(std::ranges::is_sorted(record_.frames, {}, &RecordedFrame::stamp));
}

const RecordedFrame& RecordedDetector::EntryOf(Stamp stamp) const {
  const auto entry = std::ranges::lower_bound(record_.frames, stamp + -kStampTolerance_ns, {},
                                              &RecordedFrame::stamp);
  if (entry != record_.frames.end() && entry->stamp <= stamp + kStampTolerance_ns) return *entry;
  throw Error(
      "'{}' has no entry for the frame at {} s: its {} frames of '{}' lie between {} and {} s; are "
      "these the detections of this sequence?",
      source_, FormatStamp(stamp), record_.frames.size(), record_.sequence,
      FormatStamp(record_.frames.front().stamp), FormatStamp(record_.frames.back().stamp));
}

void RecordedDetector::CheckSize(const RgbdFrame& frame) const {
  const cv::Mat& image = frame.gray.empty() ? frame.bgr : frame.gray;
  if (image.cols == record_.width_px && image.rows == record_.height_px) return;
  throw Error("'{}' is for images of {} x {} px, but these are of {} x {}", source_,
              record_.width_px, record_.height_px, image.cols, image.rows);
}

Detections RecordedDetector::Detect(const RgbdFrame& frame) {
  CheckSize(frame);
  EntryOf(frame.stamp);  // of another sequence: said at once, whatever the delay
  waiting_.push_back({frame.id, frame.stamp});
  if (waiting_.size() <= static_cast<std::size_t>(degrade_.delay_frames))
    return {frame.id, frame.stamp, {}};
  const Seen due = waiting_.front();
  waiting_.pop_front();
  return {due.frame, due.stamp, Degrade(EntryOf(due.stamp), record_, degrade_)};
}

DetectorInfo RecordedDetector::info() const {
  return {.kind = "recorded", .name = record_.sequence, .source = source_};
}

}  // namespace cslam
