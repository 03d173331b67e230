// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/output_grid.h"

#include "cslam/util/check.h"

#include <fmt/format.h>

#include <algorithm>

namespace cslam {
namespace {

struct GridSize {
  int width = 0;
  int height = 0;

  int num_cells() const { return width * height; }
};

int DivideUp(int a, int b) {
  return (a + b - 1) / b;
}

GridSize GridOf(const ModelDescription& model, int stride_px) {
  return {DivideUp(model.width_px, stride_px), DivideUp(model.height_px, stride_px)};
}

int NumCells(const ModelDescription& model) {
  int num_cells = 0;
  for (const int stride_px : model.strides)
    num_cells += GridOf(model, stride_px).num_cells();
  return num_cells;
}

[[noreturn]] void ThrowMisfit(const ModelDescription& model, std::span<const TensorView> outputs,
                              int num_channels) {
  std::vector<std::string> shapes;
  for (const TensorView& output : outputs)
    shapes.push_back(ShapeText(output.shape));
  throw Error("model '{}': its output {} does not fit decoder {} at {} x {}, which takes {}{}",
              model.name, fmt::join(shapes, " "), NameOf(model.decoder), model.width_px,
              model.height_px, ShapeText({1, num_channels, NumCells(model)}),
              model.onnx_file.empty() ? "" : "; see " + model.onnx_file.string());
}

bool IsConsistent(const TensorView& output) {
  std::size_t size = 1;
  for (const int extent : output.shape)
    size *= static_cast<std::size_t>(std::max(0, extent));
  return size == output.values.size();
}

// One output for all levels: [1, C, N] or [1, N, C].
std::vector<OutputLevel> SplitJoined(const ModelDescription& model, const TensorView& output,
                                     int num_channels) {
  const int num_cells = NumCells(model);
  const bool is_channels_first = output.shape == std::vector<int>{1, num_channels, num_cells};
  if (!is_channels_first && output.shape != std::vector<int>{1, num_cells, num_channels})
    ThrowMisfit(model, {&output, 1}, num_channels);
  const auto channel_step = static_cast<std::size_t>(is_channels_first ? num_cells : 1);
  const auto cell_step = static_cast<std::size_t>(is_channels_first ? 1 : num_channels);
  std::vector<OutputLevel> levels;
  std::size_t first_cell = 0;
  for (const int stride_px : model.strides) {
    const GridSize grid = GridOf(model, stride_px);
    levels.emplace_back(output.values.subspan(first_cell * cell_step), channel_step, cell_step,
                        grid.width, grid.height, stride_px);
    first_cell += static_cast<std::size_t>(grid.num_cells());
  }
  return levels;
}

}  // namespace

OutputLevel::OutputLevel(std::span<const float> values, std::size_t channel_step,
                         std::size_t cell_step, int grid_width, int grid_height, int stride_px)
    : values_(values),
      channel_step_(channel_step),
      cell_step_(cell_step),
      grid_width_(static_cast<std::size_t>(grid_width)),
      num_cells_(grid_width_ * static_cast<std::size_t>(grid_height)),
      stride_px_(stride_px) {}

double OutputLevel::ColumnOf(std::size_t cell) const {
  return static_cast<double>(cell % grid_width_);
}

double OutputLevel::RowOf(std::size_t cell) const {
  return static_cast<double>(cell / grid_width_);
}

std::vector<OutputLevel> SplitLevels(const ModelDescription& model,
                                     std::span<const TensorView> outputs, int num_channels) {
  if (!std::ranges::all_of(outputs, IsConsistent)) ThrowMisfit(model, outputs, num_channels);
  if (outputs.size() == 1 && outputs[0].shape.size() == 3)
    return SplitJoined(model, outputs[0], num_channels);
  std::vector<OutputLevel> levels;
  for (const int stride_px : model.strides) {
    const GridSize grid = GridOf(model, stride_px);
    const std::vector<int> shape{1, num_channels, grid.height, grid.width};
    const auto output = std::ranges::find(outputs, shape, &TensorView::shape);
    if (output == outputs.end() || outputs.size() != model.strides.size())
      ThrowMisfit(model, outputs, num_channels);
    levels.emplace_back(output->values, static_cast<std::size_t>(grid.num_cells()), 1U, grid.width,
                        grid.height, stride_px);
  }
  return levels;
}

std::vector<Candidate> FindCandidates(const OutputLevel& level, std::size_t first_class_channel,
                                      const std::array<float, kNumCocoClasses>& thresholds) {
  constexpr int kNone = -1;
  std::vector<Candidate> best(level.num_cells(), Candidate{0, kNone, 0.0F});
  for (std::size_t id = 0; id < thresholds.size(); ++id) {
    for (std::size_t cell = 0; cell < best.size(); ++cell) {
      const float value = level.Value(first_class_channel + id, cell);
      if (!(value >= thresholds[id])) continue;  // NaN as well
      if (best[cell].class_id == kNone || value > best[cell].value)
        best[cell] = {cell, static_cast<int>(id), value};
    }
  }
  std::erase_if(best, [](const Candidate& candidate) { return candidate.class_id == kNone; });
  return best;
}

}  // namespace cslam
