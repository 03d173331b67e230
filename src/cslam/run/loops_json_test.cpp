// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/loops_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cslam {
namespace {

TEST(FormatLoopsJson, TellsEveryCandidateWithItsReason) {
  std::vector<LoopRecord> records(2);
  records[0].reason = "12 inliers < 40";
  records[0].query_map = records[0].match_map = MapId(0);
  records[1].query_map = records[1].match_map = MapId(1);
  records[1].verdict = LoopVerdict::kClosed;
  records[1].T_match_query = Se3{Eigen::Quaterniond::Identity(), {1.0, 2.0, 3.0}};
  records[1].evidence.num_inliers = 77;
  const auto json = nlohmann::json::parse(FormatLoopsJson(records));
  ASSERT_EQ(json["candidates"].size(), 2U);
  EXPECT_EQ(json["candidates"][0]["reason"], "12 inliers < 40");
  EXPECT_TRUE(json["candidates"][0]["T_match_query"].is_null());
  EXPECT_EQ(json["candidates"][1]["evidence"]["inliers"], 77);
  EXPECT_EQ(json["candidates"][1]["T_match_query"]["ty_m"], 2.0);
}

TEST(FormatLoopsJson, IsValidWithoutCandidates) {
  EXPECT_TRUE(nlohmann::json::parse(FormatLoopsJson({}))["candidates"].empty());
}

}  // namespace
}  // namespace cslam
