// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/paint_tools.h"
#include "cslam/sim/picture_paint.h"
#include "cslam/sim/surface_paint.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <functional>
#include <string>
#include <vector>

namespace cslam {
namespace {

struct Painter {
  std::string name;
  std::function<cv::Mat(cv::Size, Rng)> paint;
};

const std::vector<Painter>& AllPainters() {
  static const std::vector<Painter> painters{
      {"plaster",
       [](cv::Size s, Rng r) {
         return PaintPlaster(s, 300.0, {180, 190, 200}, r);
       }},
      {"wallpaper",
       [](cv::Size s, Rng r) {
         return PaintWallpaper(s, 300.0, {180, 190, 200}, r);
       }},
      {"bricks", [](cv::Size s, Rng r) { return PaintBricks(s, 300.0, r); }},
      {"planks", [](cv::Size s, Rng r) { return PaintPlanks(s, 300.0, r); }},
      {"wood",
       [](cv::Size s, Rng r) {
         return PaintWood(s, 300.0, {80, 120, 160}, r);
       }},
      {"fabric",
       [](cv::Size s, Rng r) {
         return PaintFabric(s, 300.0, {80, 120, 160}, r);
       }},
      {"rug", [](cv::Size s, Rng r) { return PaintRug(s, 300.0, r); }},
      {"ceiling", [](cv::Size s, Rng r) { return PaintCeiling(s, 300.0, r); }},
      {"cardboard", [](cv::Size s, Rng r) { return PaintCardboard(s, 300.0, r); }},
      {"plain",
       [](cv::Size s, Rng r) {
         return PaintPlain(s, {80, 120, 160}, r);
       }},
      {"poster", PaintPoster},
      {"photo", PaintPhoto},
      {"page", PaintPage},
      {"screen", PaintScreen},
      {"keyboard", PaintKeyboard},
      {"spine", PaintBookSpine},
      {"notes", PaintNotesBoard},
      {"whiteboard", PaintWhiteboard},
      {"door", [](cv::Size s, Rng r) { return PaintDoor(s, 300.0, r); }},
      {"drawers", [](cv::Size s, Rng r) { return PaintDrawers(s, 3, 300.0, r); }},
      {"package", PaintPackage}};
  return painters;
}

TEST(Painters, GiveTheSizeAskedForAndDependOnTheGeneratorAlone) {
  for (const Painter& painter : AllPainters()) {
    const cv::Size size(120, 90);
    const cv::Mat one = painter.paint(size, Rng(1));
    ASSERT_EQ(one.size(), size) << painter.name;
    ASSERT_EQ(one.type(), CV_8UC3) << painter.name;
    EXPECT_EQ(cv::norm(one, painter.paint(size, Rng(1)), cv::NORM_L1), 0.0) << painter.name;
    EXPECT_GT(cv::norm(one, painter.paint(size, Rng(2)), cv::NORM_L1), 0.0) << painter.name;
  }
}

TEST(Painters, CopeWithTinyAndOblongImages) {
  for (const Painter& painter : AllPainters()) {
    for (const cv::Size size : {cv::Size(4, 4), cv::Size(5, 80), cv::Size(80, 5)})
      EXPECT_EQ(painter.paint(size, Rng(1)).size(), size) << painter.name;
  }
}

TEST(TexelSize, RoundsAndNeverGoesBelowFour) {
  EXPECT_EQ(TexelSize(0.5, 0.25, 100.0), cv::Size(50, 25));
  EXPECT_EQ(TexelSize(0.001, 1.0, 100.0), cv::Size(4, 100));
}

}  // namespace
}  // namespace cslam
