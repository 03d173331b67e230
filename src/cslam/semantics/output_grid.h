// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/semantics/decoder.h"
#include "cslam/semantics/detection.h"
#include "cslam/semantics/model_description.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace cslam {

// One level of a network's output: a row-major grid of cells with the same channels each.
class OutputLevel {
 public:
  // values[channel * channel_step + cell * cell_step] is what Value() reads.
  OutputLevel(std::span<const float> values, std::size_t channel_step, std::size_t cell_step,
              int grid_width, int grid_height, int stride_px);

  float Value(std::size_t channel, std::size_t cell) const {
    return values_[channel * channel_step_ + cell * cell_step_];
  }
  std::size_t num_cells() const { return num_cells_; }
  int stride_px() const { return stride_px_; }
  double ColumnOf(std::size_t cell) const;
  double RowOf(std::size_t cell) const;

 private:
  std::span<const float> values_;
  std::size_t channel_step_;
  std::size_t cell_step_;
  std::size_t grid_width_;
  std::size_t num_cells_;
  int stride_px_;
};

// Cuts a network's outputs, in either of the layouts of decoder.h, into levels. Throws Error if
// they do not have that many channels and cells.
std::vector<OutputLevel> SplitLevels(const ModelDescription& model,
                                     std::span<const TensorView> outputs, int num_channels);

// A cell and the best of the classes that passed their thresholds there.
struct Candidate {
  std::size_t cell = 0;
  int class_id = 0;
  float value = 0.0F;  // as the network gave it
};

// Cells where a class value reaches its threshold (in the network's own unit), in their order.
std::vector<Candidate> FindCandidates(const OutputLevel& level, std::size_t first_class_channel,
                                      const std::array<float, kNumCocoClasses>& thresholds);

}  // namespace cslam
