// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/run_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cslam {
namespace {

RunReport MakeExample() {
  RunReport report;
  report.identity = {.version = "0.1.0",
                     .commit = "abc",
                     .arguments = {"run", "a \"b\""},
                     .sequence = "a \"b\"",
                     .folder = "out",
                     .settings = {.execution = Execution::kInline, .rate = PlayRate::kMax}};
  report.camera.name = "tum_fr1";
  report.camera.source = "folder name";
  report.frames.input = 10;
  report.frames.processed = 8;
  report.frames.in_trajectory = 5;
  report.cost = {.wall_s = 2.0, .cpu_s = 4.0, .peak_memory_bytes = 1000};
  report.recording_s = 3.0;
  report.stages.push_back({.name = "tracking", .count = 8, .wall = {.median_ms = 7.5}, .cpu = {}});
  return report;
}

TEST(FormatRunJson, IsJsonWithEverythingInItsPlace) {
  const auto json = nlohmann::json::parse(FormatRunJson(MakeExample()));
  EXPECT_EQ(json.at("version"), "0.1.0");
  EXPECT_EQ(json.at("arguments").at(1), "a \"b\"");
  EXPECT_EQ(json.at("is_deterministic"), true);
  EXPECT_EQ(json.at("camera").at("chosen_by"), "folder name");
  EXPECT_EQ(json.at("frames").at("tracked_percent"), 50.0);
  EXPECT_EQ(json.at("cost").at("real_time_factor"), 1.5);
  EXPECT_EQ(json.at("cost").at("cpu_ms_per_frame"), 500.0);
  EXPECT_EQ(json.at("stages").at("tracking").at("wall").at("median_ms"), 7.5);
  EXPECT_TRUE(json.at("accuracy").is_null());
  EXPECT_TRUE(json.at("cost").at("first_pose_ms").is_null());
}

TEST(FormatRunJson, GivesErrorsOfBothTrajectoriesWhenMeasured) {
  RunReport report = MakeExample();
  report.accuracy.ate_reference = "groundtruth.txt";
  report.accuracy.final_poses.ate.emplace().statistics_m.rmse = 0.25;
  report.accuracy.live_poses.ate.emplace().statistics_m.rmse = 0.5;
  report.accuracy.problems = {"RPE cannot be measured"};
  const auto json = nlohmann::json::parse(FormatRunJson(report)).at("accuracy");
  EXPECT_EQ(json.at("trajectory").at("ate_m").at("rmse"), 0.25);
  EXPECT_EQ(json.at("trajectory_live").at("ate_m").at("rmse"), 0.5);
  EXPECT_FALSE(json.at("trajectory").contains("rpe_m"));
  EXPECT_EQ(json.at("problems").size(), 1U);
}

}  // namespace
}  // namespace cslam
