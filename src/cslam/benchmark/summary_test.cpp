// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/benchmark/summary.h"

#include "cslam/benchmark/test_result.h"
#include "cslam/util/test_folder.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

TEST(SpreadOf, LeavesOutWhatWasNotMeasured) {
  const std::vector<std::optional<double>> values{3.0, std::nullopt, 1.0, 8.0, 5.0};
  const Spread spread = SpreadOf(values).value();
  EXPECT_EQ(spread.count, 4);
  EXPECT_DOUBLE_EQ(spread.median, 4.0);
  EXPECT_DOUBLE_EQ(spread.min, 1.0);
  EXPECT_DOUBLE_EQ(spread.max, 8.0);
  EXPECT_FALSE(SpreadOf(std::vector<std::optional<double>>{std::nullopt}).has_value());
}

TEST(BenchmarkResult, ComparesMediansOfBothLayers) {
  const BenchmarkResult result = test::TwoSeeds();
  const FigureInfo& ate = FigureOf("ate_m");
  EXPECT_NEAR(result.Of("onechair", ObjectLayer::kOn, ate)->median, 0.012, 1e-12);
  EXPECT_NEAR(result.Ratio("onechair", ate).value(), 0.2, 1e-9);
  EXPECT_NEAR(result.MeanOfMedians(ObjectLayer::kOff, ate).value(), 0.06, 1e-12);
  EXPECT_FALSE(result.Of("onechair", ObjectLayer::kOn, FigureOf("object_f1")).has_value());
}

TEST(BenchmarkResult, AddsUpWhatAllRunsOfASequenceGotRight) {
  BenchmarkResult result = test::TwoSeeds();
  for (const std::size_t on : {0U, 2U}) {
    RunFigures& figures = *result.runs[on].figures;
    figures.changes_true = 2.0;
    figures.changes_reported = 3.0;
    figures.changes_matched = on == 0 ? 2.0 : 1.0;
  }
  const PooledScores pooled = result.Pooled("onechair", ObjectLayer::kOn);
  EXPECT_EQ(pooled.changes.num_true, 4);
  EXPECT_EQ(pooled.changes.num_reported, 6);
  EXPECT_NEAR(pooled.changes.F1().value(), 0.6, 1e-12);
  EXPECT_EQ(pooled.objects.num_true, 0);
  EXPECT_EQ(result.Pooled("", ObjectLayer::kOn).changes.num_matched, 3);
  EXPECT_EQ(result.Pooled("static", ObjectLayer::kOn).changes.num_true, 0);
  EXPECT_EQ(result.Pooled("onechair", ObjectLayer::kOff).changes.num_true, 0);
}

TEST(BenchmarkResult, DoesNotCountRunsThatFailed) {
  BenchmarkResult result = test::TwoSeeds();
  result.runs[0].figures.reset();
  EXPECT_EQ(result.num_failed(), 1);
  EXPECT_EQ(result.Of("onechair", ObjectLayer::kOn, FigureOf("ate_m"))->count, 1);
  EXPECT_EQ(result.Typical("onechair", ObjectLayer::kOn), &result.runs[2]);
  EXPECT_EQ(result.Typical("static", ObjectLayer::kOn), nullptr);
}

TEST(WriteFigures, CanBeReadBackByWhatMadeThem) {
  const TestFolder folder;
  RunFigures figures;
  figures.ate_m = 0.0123;
  figures.delay_s = 1.5;
  WriteFigures(folder / "figures.json", figures, "c1 [39]");
  const auto read = ReadFigures(folder / "figures.json", "c1 [39]");
  ASSERT_TRUE(read.has_value());
  EXPECT_DOUBLE_EQ(read->ate_m.value(), 0.0123);
  EXPECT_DOUBLE_EQ(read->delay_s.value(), 1.5);
  EXPECT_FALSE(read->object_f1.has_value());
  EXPECT_FALSE(ReadFigures(folder / "figures.json", "c2 [39]").has_value());
  EXPECT_FALSE(ReadFigures(folder / "none.json", "c1 [39]").has_value());
}

}  // namespace
}  // namespace cslam
