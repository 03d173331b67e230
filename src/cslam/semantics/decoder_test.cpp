// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/decoder.h"

#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace cslam {
namespace {

using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kUnlikely = -9.0F;  // as a logit

// Values of [1, channels, cells], or of its transpose.
struct Output {
  int channels;
  int cells;
  bool is_transposed = false;
  std::vector<float> values;

  Output(int num_channels, int num_cells, float fill, bool transposed = false)
      : channels(num_channels),
        cells(num_cells),
        is_transposed(transposed),
        values(static_cast<std::size_t>(num_channels * num_cells), fill) {}

  float& At(int channel, int cell) {
    return values[static_cast<std::size_t>(is_transposed ? cell * channels + channel
                                                         : channel * cells + cell)];
  }
  TensorView View() const {
    const std::vector<int> shape =
        is_transposed ? std::vector<int>{1, cells, channels} : std::vector<int>{1, channels, cells};
    return {shape, values};
  }
};

// 64 x 32 px: grids of 8x4, 4x2, 2x1 and, for NanoDet-Plus, 1x1 cells.
ModelDescription SmallModel(DecoderKind decoder) {
  ModelDescription model = DefaultDescription(decoder);
  model.width_px = 64;
  model.height_px = 32;
  return model;
}
constexpr int kNumCells = 32 + 8 + 2;
constexpr int kNumPlusCells = kNumCells + 1;

std::vector<Detection> Decode(const ModelDescription& model, const Output& output) {
  const TensorView view = output.View();
  return DecodeOutputs(model, {&view, 1});
}

// Makes the softmax of a side all but certain of one bin.
void SetBin(Output& output, int num_bins, int side, int bin, int cell) {
  for (int i = 0; i < num_bins; ++i)
    output.At(80 + side * num_bins + i, cell) = i == bin ? 40.0F : 0.0F;
}

void ExpectBox(const Box& box, const Box& expected) {
  EXPECT_NEAR(box.x_min, expected.x_min, 1e-5);
  EXPECT_NEAR(box.y_min, expected.y_min, 1e-5);
  EXPECT_NEAR(box.x_max, expected.x_max, 1e-5);
  EXPECT_NEAR(box.y_max, expected.y_max, 1e-5);
}

// A chair at column 2, row 1 of the stride-16 level, with distances 1, 0, 2 and 1 cells.
Output NanoDetOutput(int num_bins, int num_cells, bool is_transposed) {
  Output output(80 + 4 * num_bins, num_cells, kUnlikely, is_transposed);
  const int cell = 32 + 1 * 4 + 2;
  output.At(56, cell) = 1.0F;
  const std::array<int, 4> bins{1, 0, 2, 1};
  for (int side = 0; side < 4; ++side)
    SetBin(output, num_bins, side, bins[static_cast<std::size_t>(side)], cell);
  return output;
}

TEST(DecodeNanoDetPlus, CountsCellsFromTheirCornersWithoutOffset) {
  for (const bool is_transposed : {false, true}) {
    const auto found = Decode(SmallModel(DecoderKind::kNanoDetPlus),
                              NanoDetOutput(8, kNumPlusCells, is_transposed));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].class_id, 56);
    EXPECT_NEAR(found[0].score, 1.0 / (1.0 + std::exp(-1.0)), 1e-7);
    ExpectBox(found[0].box, {16, 16, 64, 32});
  }
}

TEST(DecodeNanoDet, AddsHalfACell) {
  const auto found = Decode(SmallModel(DecoderKind::kNanoDet), NanoDetOutput(11, kNumCells, false));
  ASSERT_EQ(found.size(), 1U);
  ExpectBox(found[0].box, {24, 24, 72, 40});
}

TEST(DecodeNanoDet, TakesAnOutputForEachLevelInAnyOrder) {
  const Output joined = NanoDetOutput(11, kNumCells, false);
  std::vector<std::vector<float>> levels(3);
  const std::array<int, 3> num_cells{32, 8, 2};
  int first = 0;
  for (std::size_t level = 0; level < 3; ++level) {
    for (int channel = 0; channel < 124; ++channel) {
      const auto begin = joined.values.begin() + channel * kNumCells + first;
      levels[level].insert(levels[level].end(), begin, begin + num_cells[level]);
    }
    first += num_cells[level];
  }
  const std::vector<TensorView> views = {
      {{1, 124, 1, 2}, levels[2]}, {{1, 124, 4, 8}, levels[0]}, {{1, 124, 2, 4}, levels[1]}};
  const auto found = DecodeOutputs(SmallModel(DecoderKind::kNanoDet), views);
  ASSERT_EQ(found.size(), 1U);
  ExpectBox(found[0].box, {24, 24, 72, 40});
}

TEST(DecodeNanoDetPlus, TakesProbabilitiesAsTheyAre) {
  ModelDescription model = SmallModel(DecoderKind::kNanoDetPlus);
  model.is_logits = false;
  Output output = NanoDetOutput(8, kNumPlusCells, false);
  output.At(56, 38) = 0.75F;
  const auto found = Decode(model, output);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_DOUBLE_EQ(found[0].score, 0.75);
}

TEST(DecodeNanoDetPlus, TakesTheMeanOfADistribution) {
  Output output = NanoDetOutput(8, kNumPlusCells, false);
  for (int bin = 0; bin < 8; ++bin)
    output.At(80 + bin, 38) = 0.0F;  // all bins alike: 3.5
  const auto found = Decode(SmallModel(DecoderKind::kNanoDetPlus), output);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].box.x_min, 32.0 - 3.5 * 16.0, 1e-5);
}

TEST(DecodeOutputs, GivesTheBestOfTheClassesThatPassTheirOwnThreshold) {
  ModelDescription model = SmallModel(DecoderKind::kNanoDetPlus);
  model.is_logits = false;
  model.thresholds[56] = 0.8;
  model.thresholds[0] = 0.2;
  Output output = NanoDetOutput(8, kNumPlusCells, false);
  output.At(56, 38) = 0.7F;
  output.At(0, 38) = 0.3F;
  auto found = Decode(model, output);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].class_id, 0);
  model.thresholds[56] = 0.7F;  // reached, not passed
  found = Decode(model, output);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].class_id, 56);
  model.thresholds.fill(1.5);
  EXPECT_TRUE(Decode(model, output).empty());
}

TEST(DecodeOutputs, LeavesOutWhatIsNotFinite) {
  ModelDescription model = SmallModel(DecoderKind::kNanoDetPlus);
  Output output = NanoDetOutput(8, kNumPlusCells, false);
  output.At(56, 38) = kNan;
  EXPECT_TRUE(Decode(model, output).empty());
  output = NanoDetOutput(8, kNumPlusCells, false);
  output.At(80 + 3, 38) = kNan;
  EXPECT_TRUE(Decode(model, output).empty());
  output = NanoDetOutput(8, kNumPlusCells, false);
  output.At(80 + 3, 38) = kInfinity;
  EXPECT_TRUE(Decode(model, output).empty());
  model.is_logits = false;
  output = NanoDetOutput(8, kNumPlusCells, false);
  output.At(56, 38) = kInfinity;
  EXPECT_TRUE(Decode(model, output).empty());
  EXPECT_TRUE(Decode(model, Output(112, kNumPlusCells, kNan)).empty());
}

TEST(DecodeYolox, PlacesBoxesInCellsAndMultipliesObjectness) {
  for (const bool is_transposed : {false, true}) {
    Output output(85, kNumCells, 0.0F, is_transposed);
    const int cell = 32 + 8 + 1;  // column 1, row 0 at stride 32
    output.At(0, cell) = 0.5F;
    output.At(1, cell) = 0.25F;
    output.At(2, cell) = 0.0F;            // width 1 cell
    output.At(3, cell) = std::log(0.5F);  // height half a cell
    output.At(4, cell) = 0.9F;
    output.At(5 + 62, cell) = 0.8F;
    const auto found = Decode(SmallModel(DecoderKind::kYolox), output);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].class_id, 62);
    EXPECT_NEAR(found[0].score, 0.72, 1e-6);
    ExpectBox(found[0].box, {32, 0, 64, 16});
  }
}

TEST(DecodeYolox, ComparesTheProductWithTheThreshold) {
  Output output(85, kNumCells, 0.0F);
  output.At(4, 0) = 0.5F;
  output.At(5, 0) = 0.7F;
  ModelDescription model = SmallModel(DecoderKind::kYolox);
  EXPECT_TRUE(Decode(model, output).empty());  // 0.35 < 0.4
  model.thresholds[0] = 0.3;
  EXPECT_EQ(Decode(model, output).size(), 1U);
}

TEST(DecodeYolox, TakesDecodedBoxes) {
  ModelDescription model = SmallModel(DecoderKind::kYolox);
  model.is_decoded = true;
  Output output(85, kNumCells, 0.0F);
  const std::array<float, 5> values{30.0F, 20.0F, 10.0F, 8.0F, 1.0F};
  for (int i = 0; i < 5; ++i)
    output.At(i, 7) = values[static_cast<std::size_t>(i)];
  output.At(5, 7) = 0.9F;
  const auto found = Decode(model, output);
  ASSERT_EQ(found.size(), 1U);
  ExpectBox(found[0].box, {25, 16, 35, 24});
}

TEST(DecodeYolov8, ReadsCentreAndSizeInBothLayouts) {
  for (const bool is_transposed : {false, true}) {
    Output output(84, kNumCells, 0.0F, is_transposed);
    const std::array<float, 4> values{30.0F, 20.0F, 10.0F, 8.0F};
    for (int i = 0; i < 4; ++i)
      output.At(i, 7) = values[static_cast<std::size_t>(i)];
    output.At(4 + 0, 7) = 0.9F;
    const auto found = Decode(SmallModel(DecoderKind::kYolov8), output);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].class_id, 0);
    EXPECT_NEAR(found[0].score, 0.9, 1e-6);
    ExpectBox(found[0].box, {25, 16, 35, 24});
  }
}

TEST(DecodeOutputs, NamesBothShapesWhenTheyDoNotFit) {
  ModelDescription model = SmallModel(DecoderKind::kNanoDetPlus);
  model.name = "mine";
  EXPECT_EQ(MessageOf([&] { Decode(model, Output(85, kNumCells, 0.0F)); }),
            "model 'mine': its output [1, 85, 42] does not fit decoder nanodet-plus at 64 x 32, "
            "which takes [1, 112, 43]");
  EXPECT_THAT(MessageOf([&] { DecodeOutputs(model, {}); }), HasSubstr("does not fit"));
  const TensorView lying{{1, 112, 43}, {}};
  EXPECT_THAT(MessageOf([&] { DecodeOutputs(model, {&lying, 1}); }), HasSubstr("does not fit"));
}

}  // namespace
}  // namespace cslam
