// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cslam {
namespace {

using ::testing::HasSubstr;

Trajectory Square(double side_m) {
  const std::vector<Eigen::Vector3d> corners = {
      {0, 0, 0}, {side_m, 0, 0}, {side_m, side_m, 0}, {0, side_m, 0}};
  Trajectory trajectory;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    trajectory.push_back({Stamp{1'000'000'000LL * static_cast<std::int64_t>(i + 1)},
                          Se3(Eigen::Quaterniond::Identity(), corners[i])});
  }
  return trajectory;
}

const ReportNames kNames = {"ref.txt", "est.txt"};

TEST(FormatReport, SaysWhatWasDoneAndMatchedWhenAteIsAsked) {
  const std::string report = FormatReport(EvaluateAte(Square(1.0), Square(1.2)), kNames);
  EXPECT_THAT(report, HasSubstr("ATE, SE(3) Umeyama alignment without scale, nearest stamp within "
                                "0.02 s\n"));
  EXPECT_THAT(report, HasSubstr("matched    4 poses: 100.0 % of the estimate"));
  EXPECT_THAT(report, HasSubstr("rmse      0.141421\n"));  // corners off by (0.1, 0.1)
}

TEST(FormatReport, NamesTheLargestErrorWhenRpeIsAsked) {
  Trajectory estimate = Square(1.0);
  estimate[3].T_world_camera.translation.z() = 0.25;
  const std::string report = FormatReport(EvaluateRpe(Square(1.0), estimate), kNames);
  EXPECT_THAT(report, HasSubstr("RPE, delta 1 frame, consecutive pairs"));
  EXPECT_THAT(report, HasSubstr("largest translation error: 0.2500 m, 0.000 deg from 3.000000 to "
                                "4.000000 s"));
}

TEST(FormatJson, HoldsTheStatisticsAndEveryErrorWhenParsedBack) {
  const AteResult result = EvaluateAte(Square(1.0), Square(1.2));
  const auto json = nlohmann::json::parse(FormatJson(result, kNames));
  EXPECT_EQ(json.at("metric"), "ate");
  EXPECT_EQ(json.at("reference"), "ref.txt");
  EXPECT_EQ(json.at("association").at("num_matched"), 4);
  EXPECT_DOUBLE_EQ(json.at("statistics_m").at("rmse").get<double>(), result.statistics_m.rmse);
  EXPECT_EQ(json.at("errors").size(), 4u);
  EXPECT_EQ(json.at("errors").at(1).at("stamp"), "2.000000");
}

TEST(FormatJson, GivesRotationInDegreesWhenRpeIsAsked) {
  Trajectory estimate = Square(1.0);
  estimate[3].T_world_camera.rotation = ExpSo3({0.0, 0.0, 0.1});
  const auto json = nlohmann::json::parse(FormatJson(EvaluateRpe(Square(1.0), estimate), kNames));
  EXPECT_EQ(json.at("num_motions"), 3);
  EXPECT_NEAR(json.at("rotation_deg").at("max").get<double>(), 5.729578, 1e-6);
  EXPECT_NEAR(json.at("errors").at(2).at("rotation_deg").get<double>(), 5.729578, 1e-6);
}

TEST(ParseStatistic, KnowsTheNamesItPrints) {
  for (const Statistic s :
       {Statistic::kRmse, Statistic::kMean, Statistic::kMedian, Statistic::kMax}) {
    EXPECT_EQ(ParseStatistic(NameOf(s)), s);
  }
  EXPECT_EQ(ParseStatistic("rms"), std::nullopt);
}

}  // namespace
}  // namespace cslam
