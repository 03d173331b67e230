// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/model_description.h"

#include "cslam/io/config.h"
#include "cslam/util/check.h"
#include "cslam/util/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>

namespace cslam {
namespace {

namespace fs = std::filesystem;

constexpr std::array kDecoders{DecoderKind::kNanoDet, DecoderKind::kNanoDetPlus,
                               DecoderKind::kYolox, DecoderKind::kYolov8};
constexpr std::array kResizeModes{ResizeMode::kStretch, ResizeMode::kLetterboxTopLeft,
                                  ResizeMode::kLetterboxCentered};
constexpr double kDefaultThreshold = 0.4;
constexpr double kMaxThreshold = 2.0;
constexpr Range kThresholdRange{0.0, kMaxThreshold};
constexpr int kSizeStep_px = 32;  // the coarsest stride every network of these kinds has
constexpr int kMaxSize_px = 2048;
constexpr int kMaxBins = 64;

// The file's own form: plain values under the keys of docs/models.md.
struct Fields {
  std::string name;
  std::string model;
  std::string source;
  std::string licence;
  std::string decoder;
  int width = 0;
  int height = 0;
  std::string resize;
  double pad_value = 0.0;
  std::string channels;
  std::array<double, 3> mean{};
  std::array<double, 3> deviation{};
  std::string strides;
  std::string scores;
  bool decoded = false;
  int bins = 0;
  double cell_offset = 0.0;
  double nms_iou = 0.0;
  double default_threshold = kDefaultThreshold;
  ClassThresholds thresholds{};  // 0: the default
};

struct Channels {
  std::array<double, 3>& values;
  const char* doc;
};

void Describe(OptionList& list, Channels& channels) {
  const Range range{-1000.0, 1000.0};
  list.Add("first", channels.values[0], range, "", channels.doc);
  list.Add("second", channels.values[1], range, "", channels.doc);
  list.Add("third", channels.values[2], range, "", channels.doc);
}

struct Thresholds {
  double& preset;
  ClassThresholds& classes;
};

void Describe(OptionList& list, Thresholds& thresholds) {
  list.Add("default", thresholds.preset, kThresholdRange, "", "For classes not named here.");
  for (int id = 0; id < kNumCocoClasses; ++id) {
    list.Add(CocoClassKey(id), thresholds.classes[static_cast<std::size_t>(id)], kThresholdRange,
             "", "For this class.");
  }
}

OptionList ListOf(Fields& fields, Channels& mean, Channels& deviation, Thresholds& thresholds) {
  OptionList list;
  list.Add("name", fields.name, "What 'model list' shows.");
  list.Add("model", fields.model, "The network's file, beside this one.");
  list.Add("source", fields.source, "Where the weights come from.");
  list.Add("licence", fields.licence, "Of the weights.");
  list.Add("decoder", fields.decoder, "nanodet, nanodet-plus, yolox or yolov8.");
  list.Add("width", fields.width, {kSizeStep_px, kMaxSize_px}, "px", "Of the input.");
  list.Add("height", fields.height, {kSizeStep_px, kMaxSize_px}, "px", "Of the input.");
  list.Add("resize", fields.resize, "stretch, letterbox-top-left or letterbox-centered.");
  list.Add("pad_value", fields.pad_value, {0.0, 255.0}, "", "Grey level of a letterbox.");
  list.Add("channels", fields.channels, "bgr or rgb.");
  list.Group("mean", mean);
  list.Group("deviation", deviation);
  list.Add("strides", fields.strides, "Cell size of each level in px, like \"8 16 32\".");
  list.Add("scores", fields.scores, "logits or probabilities.");
  list.Add("decoded", fields.decoded, "YOLOX: boxes are in px already.");
  list.Add("bins", fields.bins, {2, kMaxBins}, "", "NanoDet: of each distance distribution.");
  list.Add("cell_offset", fields.cell_offset, {0.0, 1.0}, "cells", "NanoDet: of the centre.");
  list.Add("nms_iou", fields.nms_iou, {0.0, 1.0}, "", "Overlap of two boxes of a class.");
  list.Group("thresholds", thresholds);
  return list;
}

std::string StridesText(const std::vector<int>& strides) {
  return fmt::format("{}", fmt::join(strides, " "));
}

Fields FieldsOf(const ModelDescription& description) {
  Fields fields;
  fields.decoder = NameOf(description.decoder);
  fields.resize = NameOf(description.resize);
  fields.pad_value = description.pad_value;
  fields.channels = description.is_rgb ? "rgb" : "bgr";
  fields.mean = description.mean;
  fields.deviation = description.deviation;
  fields.strides = StridesText(description.strides);
  fields.scores = description.is_logits ? "logits" : "probabilities";
  fields.decoded = description.is_decoded;
  fields.bins = description.num_bins;
  fields.cell_offset = description.cell_offset;
  fields.nms_iou = description.nms_iou;
  return fields;
}

void Load(const fs::path& file, Fields& fields) {
  Channels mean{fields.mean, "Subtracted from this channel."};
  Channels deviation{fields.deviation, "This channel is divided by it."};
  Thresholds thresholds{fields.default_threshold, fields.thresholds};
  OptionList list = ListOf(fields, mean, deviation, thresholds);
  LoadYaml(file, list);
}

// The enumerator of that name; Error naming all of them otherwise.
template <typename Enum, std::size_t kSize>
Enum Choose(const fs::path& file, std::string_view key, std::string_view value,
            const std::array<Enum, kSize>& choices) {
  std::vector<std::string_view> names;
  for (const Enum choice : choices) {
    if (value == NameOf(choice)) return choice;
    names.push_back(NameOf(choice));
  }
  throw Error("{}: {} '{}' is none of {}", file.string(), key, value, fmt::join(names, ", "));
}

// Whether value is yes rather than no; Error for anything else.
bool IsFirst(const fs::path& file, std::string_view key, std::string_view value,
             std::string_view yes, std::string_view no) {
  if (value != yes && value != no)
    throw Error("{}: {} '{}' is neither {} nor {}", file.string(), key, value, yes, no);
  return value == yes;
}

std::vector<int> ParseStrides(const fs::path& file, const std::string& text) {
  std::vector<int> strides;
  const char* next = text.data();
  const char* const end = next + text.size();
  while (true) {
    while (next != end && (*next == ' ' || *next == ','))
      ++next;
    if (next == end) break;
    int stride = 0;
    const auto [rest, error] = std::from_chars(next, end, stride);
    if (error != std::errc{} || stride < 1 || stride > kMaxSize_px) {
      strides.clear();
      break;
    }
    strides.push_back(stride);
    next = rest;
  }
  if (strides.empty())
    throw Error("{}: strides '{}' are not numbers of px like \"8 16 32\"", file.string(), text);
  return strides;
}

void CheckFields(const fs::path& file, const Fields& fields) {
  for (const auto& [key, size] :
       {std::pair("width", fields.width), std::pair("height", fields.height)}) {
    if (size == 0) throw Error("{}: '{}' of the network's input is missing", file.string(), key);
    if (size % kSizeStep_px != 0) {
      throw Error("{}: {} {} is not a multiple of {} px", file.string(), key, size, kSizeStep_px);
    }
  }
  if (std::ranges::find(fields.deviation, 0.0) != fields.deviation.end())
    throw Error("{}: a deviation of 0 cannot be divided by", file.string());
}

// Values of all keys, those the file leaves out being the decoder's.
Fields ReadFields(const fs::path& file) {
  Fields probe;
  Load(file, probe);
  if (probe.decoder.empty()) {
    throw Error("{}: 'decoder' is missing: nanodet, nanodet-plus, yolox or yolov8", file.string());
  }
  Fields fields = FieldsOf(DefaultDescription(Choose(file, "decoder", probe.decoder, kDecoders)));
  Load(file, fields);
  CheckFields(file, fields);
  return fields;
}

ModelDescription FromFields(const fs::path& file, const Fields& fields) {
  ModelDescription description;
  description.name = fields.name.empty() ? file.stem().string() : fields.name;
  description.description_file = file;
  description.onnx_file = fields.model.empty() ? fs::path(file).replace_extension(".onnx")
                                               : file.parent_path() / fields.model;
  description.source = fields.source;
  description.licence = fields.licence;
  description.decoder = Choose(file, "decoder", fields.decoder, kDecoders);
  description.width_px = fields.width;
  description.height_px = fields.height;
  description.resize = Choose(file, "resize", fields.resize, kResizeModes);
  description.pad_value = fields.pad_value;
  description.is_rgb = IsFirst(file, "channels", fields.channels, "rgb", "bgr");
  description.mean = fields.mean;
  description.deviation = fields.deviation;
  description.strides = ParseStrides(file, fields.strides);
  description.is_logits = IsFirst(file, "scores", fields.scores, "logits", "probabilities");
  description.is_decoded = fields.decoded;
  description.num_bins = fields.bins;
  description.cell_offset = fields.cell_offset;
  description.nms_iou = fields.nms_iou;
  for (std::size_t i = 0; i < fields.thresholds.size(); ++i) {
    description.thresholds[i] =
        fields.thresholds[i] == 0.0 ? fields.default_threshold : fields.thresholds[i];
  }
  return description;
}

}  // namespace

std::string_view NameOf(DecoderKind kind) {
  switch (kind) {
    case DecoderKind::kNanoDet:
      return "nanodet";
    case DecoderKind::kNanoDetPlus:
      return "nanodet-plus";
    case DecoderKind::kYolox:
      return "yolox";
    case DecoderKind::kYolov8:
      return "yolov8";
  }
  CSLAM_CHECK(false);
}

std::string_view NameOf(ResizeMode mode) {
  switch (mode) {
    case ResizeMode::kStretch:
      return "stretch";
    case ResizeMode::kLetterboxTopLeft:
      return "letterbox-top-left";
    case ResizeMode::kLetterboxCentered:
      return "letterbox-centered";
  }
  CSLAM_CHECK(false);
}

ModelDescription DefaultDescription(DecoderKind decoder) {
  ModelDescription d;
  d.name = NameOf(decoder);
  d.decoder = decoder;
  d.thresholds.fill(kDefaultThreshold);
  switch (decoder) {
    case DecoderKind::kNanoDet:
    case DecoderKind::kNanoDetPlus:
      d.mean = {103.53, 116.28, 123.675};
      d.deviation = {57.375, 57.12, 58.395};
      break;
    case DecoderKind::kYolox:
      d.resize = ResizeMode::kLetterboxTopLeft;
      d.is_logits = false;
      break;
    case DecoderKind::kYolov8:
      d.resize = ResizeMode::kLetterboxCentered;
      d.is_rgb = true;
      d.deviation = {255.0, 255.0, 255.0};
      d.is_logits = false;
      break;
  }
  if (decoder == DecoderKind::kNanoDet) {
    d.num_bins = 11;
    d.cell_offset = 0.5;
  }
  if (decoder == DecoderKind::kNanoDetPlus) d.strides = {8, 16, 32, 64};
  return d;
}

ModelDescription ReadModelDescription(const fs::path& file) {
  const fs::path description = fs::path(file).replace_extension(".yaml");
  std::error_code ignored;
  if (!fs::exists(description, ignored)) {
    throw Error(
        "there is no '{}', which says how to use the model; make it with 'changing-slam model "
        "install --from {}' or by hand (docs/models.md)",
        description.string(), file.string());
  }
  return FromFields(description, ReadFields(description));
}

void SetThresholds(ClassThresholds& thresholds, std::string_view text) {
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view item = text.substr(0, comma);
    text.remove_prefix(std::min(comma + 1, text.size()));
    const std::size_t equals = std::min(item.find('='), item.size());
    const std::string_view name = item.substr(0, equals);
    const std::string_view number = item.substr(std::min(equals + 1, item.size()));
    double value = 0.0;
    const auto [rest, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc{} || rest != number.data() + number.size() ||
        !(value >= 0.0 && value <= kMaxThreshold)) {
      throw Error("threshold '{}' is not of the form class=0.4", item);
    }
    const std::optional<int> id = FindCocoClass(name);
    if (!id && name != "default") throw Error("threshold '{}': no COCO class '{}'", item, name);
    if (id) {
      thresholds[static_cast<std::size_t>(*id)] = value;
    } else {
      thresholds.fill(value);
    }
  }
}

}  // namespace cslam
