// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/trajectory_plot.h"

#include "cslam/eval/plot_data.h"
#include "cslam/util/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace cslam {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A circle in the x-y plane with a little z, 20 poses a second.
Trajectory Circle(int num_poses, double radius_m = 1.0) {
  Trajectory trajectory;
  for (int i = 0; i < num_poses; ++i) {
    const double angle = 0.05 * i;
    trajectory.push_back(
        {Stamp{50'000'000LL * i},
         Se3(ExpSo3({0.0, 0.0, angle}), {radius_m * std::cos(angle), radius_m * std::sin(angle),
                                         0.1 * std::sin(3.0 * angle)})});
  }
  return trajectory;
}

TrajectoryPlot PlotOf(const Trajectory& reference, const Trajectory& estimate) {
  return {.title = "circle",
          .estimate = estimate,
          .reference = reference,
          .ate = EvaluateAte(reference, estimate)};
}

TEST(PreparePlot, TakesTheTwoWidestAxesWhenThereIsAReference) {
  Trajectory tilted;
  for (const auto& [stamp, T] : Circle(100)) {
    const Eigen::Vector3d p = T.translation;
    tilted.push_back({stamp, Se3(T.rotation, {p.x(), p.z(), p.y()})});
  }
  EXPECT_EQ(PreparePlot(PlotOf(Circle(100), Circle(100))).up_axis, "y [m]");
  const PlotData data = PreparePlot(PlotOf(tilted, tilted));
  EXPECT_EQ(data.right_axis, "x [m]");
  EXPECT_EQ(data.up_axis, "z [m]");
}

TEST(PreparePlot, AlignsTheEstimateAndKnowsItsErrors) {
  const Trajectory reference = Circle(100);
  const Se3 motion(ExpSo3({1.0, 0.2, -0.4}), {5.0, 6.0, 7.0});
  Trajectory estimate;
  for (const auto& [stamp, T] : reference)
    estimate.push_back({stamp, motion * T});
  const PlotData data = PreparePlot(PlotOf(reference, estimate));
  ASSERT_EQ(data.estimate.size(), 1u);
  ASSERT_EQ(data.estimate[0].size(), 100u);
  EXPECT_TRUE(data.has_error);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_LT((data.estimate[0][i].top_m - data.reference[i].top_m).norm(), 1e-9);
    EXPECT_LT(data.estimate[0][i].value_m, 1e-9);
  }
}

TEST(PreparePlot, BreaksThePathWhenPosesAreMissingForLong) {
  const Trajectory reference = Circle(100);
  Trajectory estimate = reference;
  estimate.erase(estimate.begin() + 40, estimate.begin() + 70);  // 1.5 s
  const PlotData data = PreparePlot(PlotOf(reference, estimate));
  ASSERT_EQ(data.estimate.size(), 2u);
  EXPECT_EQ(data.estimate[0].size(), 40u);
  EXPECT_EQ(data.estimate[1].size(), 30u);
}

TEST(PreparePlot, HasNoErrorAtAPoseWhenItIsUnmatched) {
  Trajectory reference = Circle(100);
  reference.resize(60);
  const PlotData data = PreparePlot(PlotOf(reference, Circle(100)));
  ASSERT_EQ(data.estimate.size(), 1u);
  EXPECT_TRUE(std::isfinite(data.estimate[0][59].value_m));
  EXPECT_TRUE(std::isnan(data.estimate[0][60].value_m));
}

TEST(PreparePlot, LooksFromAboveTheFirstCameraWhenThereIsNoReference) {
  // The first camera looks along world x; it then moves 1 m ahead and 0.2 m up (its -y).
  const Se3 first(ExpSo3({0.0, 1.5707963267948966, 0.0}), {3.0, 0.0, 0.0});
  Se3 second = first;
  second.translation += Eigen::Vector3d(1.0, -0.2, 0.0);
  TrajectoryPlot plot;
  plot.estimate = {{Stamp{0}, first}, {Stamp{50'000'000}, second}};
  const PlotData data = PreparePlot(plot);
  EXPECT_FALSE(data.has_error);
  EXPECT_TRUE(data.reference.empty());
  const PlotPoint& last = data.estimate.at(0).at(1);
  EXPECT_NEAR(last.top_m.x(), 0.0, 1e-12);
  EXPECT_NEAR(last.top_m.y(), 1.0, 1e-12);
  EXPECT_NEAR(last.value_m, 0.2, 1e-12);
}

TEST(PreparePlot, ThinsOutWhenThereAreMorePosesThanAScreenShows) {
  const PlotData data = PreparePlot(PlotOf(Circle(20'000), Circle(20'000)));
  EXPECT_LT(data.reference.size(), 5'000u);
  ASSERT_EQ(data.estimate.size(), 1u);
  EXPECT_LT(data.estimate[0].size(), 5'000u);
  EXPECT_NEAR(data.estimate[0].back().time_s, 0.05 * 19'999, 1e-9);
}

TEST(FormatTrajectorySvg, NamesTheSequenceAndTheErrorWhenMeasured) {
  Trajectory estimate = Circle(100);
  estimate[50].T_world_camera.translation.z() += 0.2;
  TrajectoryPlot plot = PlotOf(Circle(100), estimate);
  plot.title = "desk & <chair>";
  const std::string svg = FormatTrajectorySvg(plot);
  EXPECT_THAT(svg, HasSubstr("desk &amp; &lt;chair&gt;"));
  EXPECT_THAT(svg, HasSubstr("ATE RMSE"));
  EXPECT_THAT(svg, HasSubstr("ground truth"));
  EXPECT_THAT(svg, HasSubstr("error ["));
  EXPECT_EQ(svg, FormatTrajectorySvg(plot));
}

TEST(FormatTrajectorySvg, ShowsTheHeightWhenThereIsNoReference) {
  TrajectoryPlot plot;
  plot.title = "no truth";
  plot.estimate = Circle(100);
  const std::string svg = FormatTrajectorySvg(plot);
  EXPECT_THAT(svg, HasSubstr("height ["));
  EXPECT_THAT(svg, Not(HasSubstr("ground truth")));
}

TEST(FormatTrajectorySvg, HasOnlyFiniteCoordinatesWhenThereIsLittleToDraw) {
  Trajectory still = Circle(1);
  for (const Trajectory& estimate : {Trajectory{}, still, Circle(2)}) {
    TrajectoryPlot plot;
    plot.estimate = estimate;
    const std::string svg = FormatTrajectorySvg(plot);
    EXPECT_THAT(svg, HasSubstr("</svg>"));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
  }
}

TEST(WriteTrajectorySvg, WritesWhatIsFormatted) {
  const auto path = std::filesystem::path(testing::TempDir()) / "cslam_trajectory_plot.svg";
  const TrajectoryPlot plot = PlotOf(Circle(50), Circle(50));
  WriteTrajectorySvg(path, plot);
  std::ifstream file(path);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  std::filesystem::remove(path);
  EXPECT_EQ(text, FormatTrajectorySvg(plot));
  EXPECT_THROW(WriteTrajectorySvg("/no/such/folder/plot.svg", plot), Error);
}

}  // namespace
}  // namespace cslam
