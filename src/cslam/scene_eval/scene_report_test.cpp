// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/scene_report.h"

#include "cslam/scene_eval/test_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cslam {
namespace {

using nlohmann::json;
using test::kLeft;
using test::kRight;
using testing::HasSubstr;

// A chair that is moved in view at 1 s, and a tv.
class SceneReport : public testing::Test {
 protected:
  SceneReport() {
    test::TestWorld world;
    world.duration_s = 3.0;
    world.stays = {{.instance = 1, .to_s = 1.0, .center = kLeft},
                   {.instance = 1, .from_s = 1.0, .center = kRight},
                   {.instance = 2, .class_id = test::kTv, .center = {0.0, 0.0, 3.5}}};
    TrueChange moved{.kind = ChangeKind::kMoved, .time_s = 1.0, .instance = 1, .class_id = 56};
    moved.from = test::At(kLeft);
    moved.to = test::At(kRight);
    world.changes = {moved};
    truth_ = test::TruthOf(world);
    run_ = test::RunOf(truth_);
    run_.objects = {test::Found(4, test::kChair, kRight), test::Found(5, test::kChair, kLeft)};
    run_.map_points = {kLeft, kRight, {2.0, 0.0, 4.5}, {1.5, 0.5, 4.5}};
    ReportedChange told{.kind = ChangeKind::kMoved, .object = 4, .class_id = test::kChair};
    told.from = kLeft;
    told.to = kRight;
    told.reported = test::StampAt(1.5);
    run_.changes = {told};
  }

  SceneTruth truth_;
  SceneRun run_;
};

TEST_F(SceneReport, TellsOfObjectsAndGhosts) {
  const ObjectReport report = MakeObjectReport(truth_, run_);
  const std::string text = FormatReport(report, truth_, run_);
  EXPECT_THAT(text, HasSubstr("missed: tv 'thing2' at 0.00 0.00 3.50"));
  EXPECT_THAT(text, HasSubstr("false: chair 5 at -0.80 0.00 3.00"));
  EXPECT_THAT(text, HasSubstr("ghosts: 1 of 4 active points (25.00 %), 1 former places"));
  const json values = json::parse(FormatJson(report, truth_, run_));
  EXPECT_EQ(values["metric"], "objects");
  EXPECT_EQ(values["classes"], (json{"chair", "tv"}));
  EXPECT_EQ(values["all"]["num_true"], 2);
  EXPECT_EQ(values["all"]["num_matched"], 1);
  EXPECT_EQ(values["per_class"]["tv"]["precision"], nullptr);
  EXPECT_EQ(values["ghosts"]["share"], 0.25);
  EXPECT_EQ(values["objects"].size(), 2U);
}

TEST_F(SceneReport, TellsOfChangesAndDelays) {
  const ChangeReport report = MakeChangeReport(truth_, run_);
  const std::string text = FormatReport(report, truth_, run_);
  EXPECT_THAT(text, HasSubstr("moved"));
  EXPECT_THAT(text, HasSubstr("delay: median 0.5 s, at most 0.5 s"));
  const json values = json::parse(FormatJson(report, truth_, run_));
  EXPECT_EQ(values["all"]["f1"], 1.0);
  EXPECT_EQ(values["per_kind"]["moved"]["num_matched"], 1);
  EXPECT_NEAR(values["changes"][0]["delay_s"].get<double>(), 0.5, 0.05);
  EXPECT_EQ(values["loops"], nullptr);
}

}  // namespace
}  // namespace cslam
