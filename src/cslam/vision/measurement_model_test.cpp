// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/measurement_model.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

MeasurementModel MakeModel() {
  return {{1.0, 1.2, 1.44, 1.728}, 2.0};
}

TEST(MeasurementModel, InformationFallsWithTheSquareOfTheScale) {
  EXPECT_DOUBLE_EQ(MakeModel().information_px(0), 1.0);
  EXPECT_DOUBLE_EQ(MakeModel().information_px(2), 1.0 / (1.44 * 1.44));
  EXPECT_DOUBLE_EQ(MakeModel().information_disparity(0), 0.25);
  EXPECT_DOUBLE_EQ(MakeModel().information_disparity(1), 0.25 / (1.2 * 1.2));
}

TEST(MeasurementModel, PredictsTheFirstLevelThatReachesTheRatio) {
  EXPECT_EQ(MakeModel().PredictOctave(1.3), 2);
  EXPECT_EQ(MakeModel().PredictOctave(1.2), 1) << "exactly at a level";
  EXPECT_EQ(MakeModel().PredictOctave(1.2 * (1.0 + 1e-12)), 1) << "but for rounding";
}

TEST(MeasurementModel, PredictsLevelsOfThePyramidOnly) {
  EXPECT_EQ(MakeModel().PredictOctave(0.1), 0);
  EXPECT_EQ(MakeModel().PredictOctave(9.0), 3);
}

}  // namespace
}  // namespace cslam
