// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// How well keypoints of people are told from those of the room around them: runs SLAM inline on a
// rendered sequence and holds the label of every keypoint against the instance images. Prints
// Markdown. Exit code 3 if perfect boxes with the default rule miss a bar.
//
//   cslam_label_report SEQUENCE FRAMES DETECTOR[,KEY=VALUE]* ...
//
// FRAMES 0: all. DETECTOR: "perfect" (the sequence's detections.json) or a model's name. KEY: an
// option of the program below tracking.objects, like labels.rule. Keypoints less than 3 px from an
// instance's edge do not count, nor do those of other things than people, which are held back for
// their own reasons.
#include "cslam/io/instance_image.h"
#include "cslam/io/truth_files.h"
#include "cslam/run/run_sequence.h"
#include "cslam/semantics/make_detector.h"
#include "cslam/util/check.h"
#include "cslam/util/options.h"
#include "cslam/util/stamp.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace cslam {
namespace {

namespace fs = std::filesystem;

constexpr int kEdgePx = 3;
constexpr double kMinPeopleRemoved = 0.97;
constexpr double kMinBackgroundKept = 0.90;
constexpr int kExitMissedBar = 3;

// What the instance images say about pixels.
class LabelTruth {
 public:
  explicit LabelTruth(const fs::path& sequence) : sequence_(sequence) {
    for (const TrueObject& object : ReadTrueObjects(sequence / "objects.json").objects)
      classes_[object.instance] = object.class_id;
    for (RecordedFrame& frame : ReadDetections(sequence / "detections.json").frames) {
      std::erase_if(frame.detections,
                    [](const RecordedDetection& d) { return d.class_id != kPersonClass; });
      people_[frame.stamp] = std::move(frame.detections);
    }
  }

  cv::Mat Instances(Stamp stamp) const {
    return ReadInstanceImage(sequence_ / "instances" / (FormatStamp(stamp) + ".png"));
  }
  int ClassOf(int instance) const {
    const auto found = classes_.find(instance);
    return found == classes_.end() ? -1 : found->second;
  }
  bool IsInPersonBox(Stamp stamp, double u_px, double v_px) const {
    const auto boxes = people_.find(stamp);
    return boxes != people_.end() &&
           std::ranges::any_of(boxes->second, [&](const RecordedDetection& person) {
             return person.box.Contains(u_px, v_px);
           });
  }

 private:
  fs::path sequence_;
  std::map<int, int> classes_;                              // by instance
  std::map<Stamp, std::vector<RecordedDetection>> people_;  // exact boxes
};

// Non-zero where a pixel within kEdgePx shows another instance.
cv::Mat EdgesOf(const cv::Mat& instances) {
  const cv::Mat window = cv::Mat::ones(2 * kEdgePx + 1, 2 * kEdgePx + 1, CV_8UC1);
  cv::Mat highest;
  cv::Mat lowest;
  cv::dilate(instances, highest, window);
  cv::erode(instances, lowest, window);
  return highest != lowest;
}

struct Share {
  std::int64_t hits = 0;
  std::int64_t all = 0;
  void Count(bool is_hit) {
    ++all;
    hits += is_hit ? 1 : 0;
  }
  double value() const {
    return all == 0 ? 1.0 : static_cast<double>(hits) / static_cast<double>(all);
  }
};

class LabelCounter : public OutputSink {
 public:
  explicit LabelCounter(const LabelTruth& truth) : truth_(truth) {}

  void OnFrame(const TrackingResult& result) override {
    const cv::Mat instances = truth_.Instances(result.stamp);
    const cv::Mat edges = EdgesOf(instances);
    const std::int64_t removed_before = people_removed.hits;
    const std::int64_t people_before = people_removed.all;
    for (const LabelledKeypoint& keypoint : result.keypoints) {
      const cv::Point at(cvRound(keypoint.raw_px.x()), cvRound(keypoint.raw_px.y()));
      if (edges.at<std::uint8_t>(at) != 0) continue;
      const int instance = instances.at<std::uint16_t>(at);
      const bool is_removed = keypoint.label == KeypointLabel::kDynamic;
      if (truth_.ClassOf(instance) == kPersonClass) {
        people_removed.Count(is_removed);
      } else if (truth_.ClassOf(instance) < 0) {
        const bool is_in_box = truth_.IsInPersonBox(result.stamp, at.x, at.y);
        (is_in_box ? background_kept : outside_kept).Count(!is_removed);
      }
    }
    NoteWorst(result.stamp,
              people_removed.all - people_before - people_removed.hits + removed_before);
  }

  Share people_removed;   // keypoints on people
  Share background_kept;  // of the room, in a person's true box
  Share outside_kept;     // of the room, elsewhere
  std::int64_t worst_missed = 0;
  Stamp worst;  // the frame that kept most keypoints on people

 private:
  void NoteWorst(Stamp stamp, std::int64_t missed) {
    if (missed <= worst_missed) return;
    worst_missed = missed;
    worst = stamp;
  }

  const LabelTruth& truth_;
};

// "DETECTOR,KEY=VALUE,..."
SlamOptions OptionsOf(const std::string& configuration, const fs::path& sequence) {
  SlamOptions options;
  options.tracking.report_keypoints = true;
  std::istringstream parts(configuration);
  std::string detector;
  std::getline(parts, detector, ',');
  OptionList list;
  Describe(list, options.tracking.objects);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos) throw Error("'{}' is not KEY=VALUE", part);
    list.Set(part.substr(0, equals), part.substr(equals + 1));
  }
  if (detector == "perfect") {
    options.detector.kind = "recorded";
    options.detector.detections = (sequence / "detections.json").string();
  } else {
    options.detector.model = detector;
  }
  return options;
}

void PrintRow(const std::string& name, const LabelCounter& counter) {
  const auto percent = [](const Share& share) {
    return share.all == 0 ? "-" : fmt::format("{:.1f}", 100.0 * share.value());
  };
  fmt::print("| {} | {} | {} | {} | {} | {} | {} |\n", name, counter.people_removed.all,
             percent(counter.people_removed), counter.background_kept.all,
             percent(counter.background_kept), percent(counter.outside_kept),
             counter.worst_missed == 0
                 ? "-"
                 : fmt::format("{} at {}", counter.worst_missed, FormatStamp(counter.worst)));
  std::fflush(stdout);
}

int Run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 3)
    throw Error("usage: cslam_label_report SEQUENCE FRAMES DETECTOR[,KEY=VALUE]* ...");
  const fs::path sequence = arguments[0];
  DatasetOptions dataset_options;
  if (const std::size_t frames = std::stoul(arguments[1]); frames > 0)
    dataset_options.frames = frames;
  const auto dataset = OpenDataset(sequence, dataset_options);
  const LabelTruth truth(sequence);
  fmt::print(
      "| detector | keypoints on people | removed % | of the room in their boxes | kept % | "
      "elsewhere kept % | most kept on people in a frame |\n|---|---|---|---|---|---|---|\n");
  bool is_missed = false;
  for (std::size_t i = 2; i < arguments.size(); ++i) {
    const SlamOptions options = OptionsOf(arguments[i], sequence);
    const auto counter = std::make_shared<LabelCounter>(truth);
    RunSequence(*dataset, options, {.execution = Execution::kInline},
                {.detector = MakeDetector(options.detector).detector, .listeners = {counter}},
                [] { return false; });
    PrintRow(arguments[i], *counter);
    is_missed = is_missed || (arguments[i] == "perfect" &&
                              (counter->people_removed.value() < kMinPeopleRemoved ||
                               counter->background_kept.value() < kMinBackgroundKept));
  }
  return is_missed ? kExitMissedBar : EXIT_SUCCESS;
}

}  // namespace
}  // namespace cslam

int main(int argc, char** argv) {
  try {
    return cslam::Run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "cslam_label_report: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
