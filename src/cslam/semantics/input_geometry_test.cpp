// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/input_geometry.h"

#include <gtest/gtest.h>

#include <limits>

namespace cslam {
namespace {

TEST(FitImage, StretchesToTheWholeInput) {
  const InputGeometry geometry = FitImage(ResizeMode::kStretch, 640, 480, 416, 320);
  EXPECT_EQ(geometry.content_width_px, 416);
  EXPECT_EQ(geometry.content_height_px, 320);
  EXPECT_DOUBLE_EQ(geometry.scale_x, 0.65);
  EXPECT_DOUBLE_EQ(geometry.scale_y, 2.0 / 3.0);
  EXPECT_EQ(ToImage(geometry, {0, 0, 416, 320}), (Box{0, 0, 640, 480}));
}

TEST(FitImage, LetterboxKeepsTheAspectAtTheTopLeft) {
  const InputGeometry geometry = FitImage(ResizeMode::kLetterboxTopLeft, 640, 480, 416, 416);
  EXPECT_EQ(geometry.content_width_px, 416);
  EXPECT_EQ(geometry.content_height_px, 312);
  EXPECT_EQ(geometry.offset_y_px, 0);
  EXPECT_EQ(ToImage(geometry, {0, 0, 416, 312}), (Box{0, 0, 640, 480}));
}

TEST(FitImage, LetterboxCentresTallAndWideImages) {
  const InputGeometry wide = FitImage(ResizeMode::kLetterboxCentered, 640, 480, 416, 416);
  EXPECT_EQ(wide.offset_x_px, 0);
  EXPECT_EQ(wide.offset_y_px, 52);
  EXPECT_EQ(ToImage(wide, {208, 52, 416, 208}), (Box{320, 0, 640, 240}));
  const InputGeometry tall = FitImage(ResizeMode::kLetterboxCentered, 480, 640, 416, 416);
  EXPECT_EQ(tall.offset_x_px, 52);
  EXPECT_EQ(tall.offset_y_px, 0);
}

TEST(FitImage, KeepsAPixelOfVeryLongImages) {
  const InputGeometry geometry = FitImage(ResizeMode::kLetterboxCentered, 5000, 2, 416, 416);
  EXPECT_EQ(geometry.content_height_px, 1);
}

TEST(ToImage, CutsBoxesToTheImage) {
  const InputGeometry geometry = FitImage(ResizeMode::kStretch, 640, 480, 320, 240);
  EXPECT_EQ(ToImage(geometry, {-10, 20, 60, 500}), (Box{0, 40, 120, 480}));
  EXPECT_TRUE(ToImage(geometry, {330, 20, 400, 60}).empty());
}

TEST(ToImage, LeavesNothingOfABoxWithNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const InputGeometry geometry = FitImage(ResizeMode::kStretch, 640, 480, 320, 240);
  const Box all_nan = ToImage(geometry, {nan, nan, nan, nan});
  EXPECT_TRUE(all_nan.empty() || all_nan.area() <= 640.0 * 480.0);
}

}  // namespace
}  // namespace cslam
