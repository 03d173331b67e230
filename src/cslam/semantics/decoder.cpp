// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/decoder.h"

#include "cslam/semantics/output_grid.h"
#include "cslam/util/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace cslam {
namespace {

constexpr std::size_t kNumSides = 4;  // left, top, right, bottom
constexpr std::size_t kObjectness = 4;

double Sigmoid(double logit) {
  return 1.0 / (1.0 + std::exp(-logit));
}

// The value a class must reach in the network's own unit.
std::array<float, kNumCocoClasses> RawThresholds(const ModelDescription& model) {
  std::array<float, kNumCocoClasses> raw{};
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const double score = model.thresholds[i];
    if (score > 1.0) {
      raw[i] = std::numeric_limits<float>::infinity();
    } else {
      raw[i] = static_cast<float>(model.is_logits ? std::log(score / (1.0 - score)) : score);
    }
  }
  return raw;
}

double ScoreOf(const ModelDescription& model, float value) {
  return model.is_logits ? Sigmoid(static_cast<double>(value)) : static_cast<double>(value);
}

// A broken network says infinity; a score is at most 1.
bool IsScore(double score) {
  return score >= 0.0 && score <= 1.0;
}

bool IsFinite(const Box& box) {
  return std::isfinite(box.x_min) && std::isfinite(box.y_min) && std::isfinite(box.x_max) &&
         std::isfinite(box.y_max);
}

Box BoxAround(double x, double y, double width, double height) {
  return {x - 0.5 * width, y - 0.5 * height, x + 0.5 * width, y + 0.5 * height};
}

void AddDetection(std::vector<Detection>& detections, int class_id, double score, const Box& box) {
  if (!IsScore(score) || !IsFinite(box) || box.empty()) return;
  detections.push_back({.class_id = class_id, .score = score, .box = box, .mask = {}});
}

// Mean of the distribution whose logits stand in num_bins channels; in bins. NaN if one is.
double MeanBin(const OutputLevel& level, std::size_t cell, std::size_t first_channel,
               std::size_t num_bins) {
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < num_bins; ++i)
    largest = std::max(largest, static_cast<double>(level.Value(first_channel + i, cell)));
  double sum = 0.0;
  double weighted = 0.0;
  for (std::size_t i = 0; i < num_bins; ++i) {
    const double weight =
        std::exp(static_cast<double>(level.Value(first_channel + i, cell)) - largest);
    sum += weight;
    weighted += weight * static_cast<double>(i);
  }
  return weighted / sum;
}

Box NanoDetBox(const ModelDescription& model, const OutputLevel& level, std::size_t cell) {
  const auto num_bins = static_cast<std::size_t>(model.num_bins);
  const double stride = level.stride_px();
  std::array<double, kNumSides> distance_px{};
  for (std::size_t side = 0; side < kNumSides; ++side) {
    distance_px[side] = stride * MeanBin(level, cell, kNumCocoClasses + side * num_bins, num_bins);
  }
  const double x = (level.ColumnOf(cell) + model.cell_offset) * stride;
  const double y = (level.RowOf(cell) + model.cell_offset) * stride;
  return {x - distance_px[0], y - distance_px[1], x + distance_px[2], y + distance_px[3]};
}

std::vector<Detection> DecodeNanoDet(const ModelDescription& model,
                                     std::span<const TensorView> outputs) {
  const int num_channels = kNumCocoClasses + static_cast<int>(kNumSides) * model.num_bins;
  const auto thresholds = RawThresholds(model);
  std::vector<Detection> detections;
  for (const OutputLevel& level : SplitLevels(model, outputs, num_channels)) {
    for (const Candidate& candidate : FindCandidates(level, 0, thresholds)) {
      AddDetection(detections, candidate.class_id, ScoreOf(model, candidate.value),
                   NanoDetBox(model, level, candidate.cell));
    }
  }
  return detections;
}

Box CenteredBox(const OutputLevel& level, std::size_t cell) {
  const auto value = [&](std::size_t channel) {
    return static_cast<double>(level.Value(channel, cell));
  };
  return BoxAround(value(0), value(1), value(2), value(3));
}

Box YoloxBox(const ModelDescription& model, const OutputLevel& level, std::size_t cell) {
  if (model.is_decoded) return CenteredBox(level, cell);
  const double stride = level.stride_px();
  const auto value = [&](std::size_t channel) {
    return static_cast<double>(level.Value(channel, cell));
  };
  return BoxAround((value(0) + level.ColumnOf(cell)) * stride,
                   (value(1) + level.RowOf(cell)) * stride, std::exp(value(2)) * stride,
                   std::exp(value(3)) * stride);
}

std::vector<Detection> DecodeYolox(const ModelDescription& model,
                                   std::span<const TensorView> outputs) {
  constexpr int kNumChannels = static_cast<int>(kObjectness) + 1 + kNumCocoClasses;
  const auto thresholds = RawThresholds(model);  // objectness only lowers a score
  std::vector<Detection> detections;
  for (const OutputLevel& level : SplitLevels(model, outputs, kNumChannels)) {
    for (const Candidate& candidate : FindCandidates(level, kObjectness + 1, thresholds)) {
      const double score = ScoreOf(model, candidate.value) *
                           ScoreOf(model, level.Value(kObjectness, candidate.cell));
      const auto id = static_cast<std::size_t>(candidate.class_id);
      if (!(score >= model.thresholds[id])) continue;
      AddDetection(detections, candidate.class_id, score, YoloxBox(model, level, candidate.cell));
    }
  }
  return detections;
}

std::vector<Detection> DecodeYolov8(const ModelDescription& model,
                                    std::span<const TensorView> outputs) {
  constexpr int kNumChannels = static_cast<int>(kNumSides) + kNumCocoClasses;
  const auto thresholds = RawThresholds(model);
  std::vector<Detection> detections;
  for (const OutputLevel& level : SplitLevels(model, outputs, kNumChannels)) {
    for (const Candidate& candidate : FindCandidates(level, kNumSides, thresholds)) {
      AddDetection(detections, candidate.class_id, ScoreOf(model, candidate.value),
                   CenteredBox(level, candidate.cell));
    }
  }
  return detections;
}

}  // namespace

std::string ShapeText(const std::vector<int>& shape) {
  return fmt::format("[{}]", fmt::join(shape, ", "));
}

std::vector<Detection> DecodeOutputs(const ModelDescription& model,
                                     std::span<const TensorView> outputs) {
  switch (model.decoder) {
    case DecoderKind::kNanoDet:
    case DecoderKind::kNanoDetPlus:
      return DecodeNanoDet(model, outputs);
    case DecoderKind::kYolox:
      return DecodeYolox(model, outputs);
    case DecoderKind::kYolov8:
      return DecodeYolov8(model, outputs);
  }
  CSLAM_CHECK(false);
}

}  // namespace cslam
