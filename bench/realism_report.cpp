// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// How real rendered sequences look to those that read them. Prints two Markdown tables:
//
//   features: ORB features per frame, without a cap, against those of recordings
//   recall:   share of the objects of a class that a detector finds, with detections.json as truth
//
//   cslam_realism_report --recordings FOLDER... --rendered FOLDER... [--model MODEL] [--sample N]
//
// Exit code 1 if a bar is missed.
#include "cslam/io/dataset.h"
#include "cslam/io/dataset_info.h"
#include "cslam/io/truth_files.h"
#include "cslam/semantics/dnn_detector.h"
#include "cslam/semantics/model_store.h"
#include "cslam/util/check.h"
#include "cslam/vision/orb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cslam {
namespace {

constexpr std::size_t kDefaultSample = 100;  // frames of each folder
constexpr int kNoCap = 50'000;               // features: more than an image can have
constexpr double kMinFeatureRatio = 0.6;     // of the recordings' mean
constexpr double kMaxFeatureRatio = 1.5;
constexpr double kMinPictureShare = 0.02;  // of an object that counts
constexpr double kMinIou = 0.5;            // of a box that counts as found

struct Bar {
  int class_id;
  const char* name;
  double min_recall;
};
constexpr std::array kBars{Bar{0, "person", 0.85}, Bar{56, "chair", 0.80},
                           Bar{77, "teddy bear", 0.80}, Bar{62, "tv", 0.70}};

struct Arguments {
  std::vector<std::filesystem::path> recordings;
  std::vector<std::filesystem::path> rendered;
  std::string model;
  std::size_t num_samples = kDefaultSample;
};

Arguments ParseArguments(const std::vector<std::string>& words) {
  Arguments arguments;
  std::string option;
  for (const std::string& word : words) {
    if (word.starts_with("--")) {
      option = word;
    } else if (option == "--recordings") {
      arguments.recordings.emplace_back(word);
    } else if (option == "--rendered") {
      arguments.rendered.emplace_back(word);
    } else if (option == "--model") {
      arguments.model = word;
    } else if (option == "--sample") {
      const auto [end, error] =
          std::from_chars(word.data(), word.data() + word.size(), arguments.num_samples);
      if (error != std::errc() || *end != '\0' || arguments.num_samples == 0)
        throw Error("--sample needs a number of frames, not '{}'", word);
    } else {
      throw Error("'{}' follows no option; see the top of bench/realism_report.cpp", word);
    }
  }
  return arguments;
}

// Features per frame of a folder.
struct FeatureCount {
  std::string folder;
  double mean = 0.0;         // without a cap
  double p10 = 0.0;          // of the frames have fewer
  double p90 = 0.0;          // of the frames have at most so many
  double mean_capped = 0.0;  // at the usual settings
};

FeatureCount CountFeatures(const std::filesystem::path& folder, std::size_t num_samples) {
  const auto dataset = OpenDataset(folder);
  OrbExtractor all({.num_features = kNoCap});
  OrbExtractor usual{OrbOptions{}};
  std::vector<double> counts;
  FeatureCount result{.folder = folder.filename().string()};
  for (const std::size_t i : EvenSample(dataset->size(), num_samples)) {
    const LoadResult loaded = dataset->Load(i);
    if (!loaded.frame) continue;
    counts.push_back(static_cast<double>(all.Extract(loaded.frame->gray).corners.size()));
    result.mean_capped += static_cast<double>(usual.Extract(loaded.frame->gray).corners.size());
  }
  if (counts.empty()) throw Error("'{}' has no readable frame", folder.string());
  const auto n = static_cast<double>(counts.size());
  for (const double count : counts)
    result.mean += count / n;
  result.mean_capped /= n;
  std::sort(counts.begin(), counts.end());
  result.p10 = counts[counts.size() / 10];
  result.p90 = counts[counts.size() * 9 / 10];
  return result;
}

bool ReportFeatures(const Arguments& arguments) {
  double reference = 0.0;
  bool is_met = true;
  fmt::print("| folder | features | 10 % | 90 % | at the usual 1000 | of recordings |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  const auto print = [](const FeatureCount& c, const std::string& ratio) {
    fmt::print("| {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {} |\n", c.folder, c.mean, c.p10, c.p90,
               c.mean_capped, ratio);
  };
  for (const auto& folder : arguments.recordings) {
    const FeatureCount count = CountFeatures(folder, arguments.num_samples);
    reference += count.mean / static_cast<double>(arguments.recordings.size());
    print(count, "recording");
  }
  for (const auto& folder : arguments.rendered) {
    const FeatureCount count = CountFeatures(folder, arguments.num_samples);
    if (reference == 0.0) {
      print(count, "?");
      continue;
    }
    const double ratio = count.mean / reference;
    const bool is_inside = ratio >= kMinFeatureRatio && ratio <= kMaxFeatureRatio;
    is_met &= is_inside;
    print(count, fmt::format("{:.2f}{}", ratio, is_inside ? "" : " (missed)"));
  }
  return is_met;
}

struct Recall {
  std::size_t num_objects = 0;
  std::size_t num_found = 0;

  void Add(const Recall& other) {
    num_objects += other.num_objects;
    num_found += other.num_found;
  }
  double share() const {
    return num_objects == 0 ? 1.0
                            : static_cast<double>(num_found) / static_cast<double>(num_objects);
  }
};

using RecallByClass = std::map<int, Recall>;

bool IsFound(const RecordedDetection& object, const Detections& found) {
  return std::any_of(found.objects.begin(), found.objects.end(), [&](const Detection& d) {
    return d.class_id == object.class_id && Iou(d.box, object.box) >= kMinIou;
  });
}

RecallByClass MeasureRecall(const std::filesystem::path& folder, Detector& detector,
                            std::size_t num_samples) {
  const DetectionRecord truth = ReadDetections(folder / "detections.json");
  const double min_px = kMinPictureShare * truth.width_px * truth.height_px;
  const auto is_large = [&](const RecordedDetection& d) { return d.visible_px >= min_px; };
  const auto dataset = OpenDataset(folder);
  if (truth.frames.size() != dataset->size())
    throw Error("'{}' has {} frames, but its detections.json {}", folder.string(), dataset->size(),
                truth.frames.size());
  RecallByClass recall;
  for (const std::size_t i : EvenSample(dataset->size(), num_samples)) {
    const auto& objects = truth.frames[i].detections;
    if (std::none_of(objects.begin(), objects.end(), is_large)) continue;
    const LoadResult loaded = dataset->Load(i);
    if (!loaded.frame) continue;
    const Detections found = detector.Detect(*loaded.frame);
    for (const RecordedDetection& object : objects) {
      if (!is_large(object)) continue;
      Recall& of_class = recall[object.class_id];
      ++of_class.num_objects;
      if (IsFound(object, found)) ++of_class.num_found;
    }
  }
  return recall;
}

std::string RecallText(const RecallByClass& recall, int class_id) {
  const auto found = recall.find(class_id);
  if (found == recall.end()) return "-";
  return fmt::format("{:.0f} % of {}", 100.0 * found->second.share(), found->second.num_objects);
}

bool ReportRecall(const Arguments& arguments) {
  DnnDetector detector(FindModel(arguments.model, ModelFolders()));
  fmt::print("\n| folder |");
  for (const Bar& bar : kBars)
    fmt::print(" {} |", bar.name);
  fmt::print("\n|---|---|---|---|---|\n");
  const auto print = [](const std::string& name, const RecallByClass& recall) {
    fmt::print("| {} |", name);
    for (const Bar& bar : kBars)
      fmt::print(" {} |", RecallText(recall, bar.class_id));
    fmt::print("\n");
  };
  RecallByClass total;
  for (const auto& folder : arguments.rendered) {
    const RecallByClass recall = MeasureRecall(folder, detector, arguments.num_samples);
    print(folder.filename().string(), recall);
    for (const auto& [class_id, of_class] : recall)
      total[class_id].Add(of_class);
  }
  print("all", total);
  fmt::print("| bar |");
  bool is_met = true;
  for (const Bar& bar : kBars) {
    fmt::print(" {:.0f} % |", 100.0 * bar.min_recall);
    is_met &= total[bar.class_id].share() >= bar.min_recall;
  }
  fmt::print("\n");
  return is_met;
}

int Run(const std::vector<std::string>& words) {
  const Arguments arguments = ParseArguments(words);
  if (arguments.rendered.empty() && arguments.recordings.empty())
    throw Error("nothing to report on; see the top of bench/realism_report.cpp");
  bool is_met = ReportFeatures(arguments);
  if (!arguments.model.empty()) is_met &= ReportRecall(arguments);
  return is_met ? 0 : 1;
}

}  // namespace
}  // namespace cslam

int main(int argc, char** argv) {
  try {
    return cslam::Run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "cslam_realism_report: error: {}\n", error.what());
    return 2;
  }
}
