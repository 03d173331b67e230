// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/loops_json.h"

#include "cslam/run/pose_json.h"

#include <fmt/format.h>

#include <numbers>
#include <vector>

namespace cslam {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

JsonObject ToJson(const LoopEvidence& evidence) {
  JsonObject json;
  json.Add("score", evidence.score);
  json.Add("matches", evidence.num_matches);
  json.Add("ransac_inliers", evidence.num_ransac_inliers);
  json.Add("inliers", evidence.num_inliers);
  json.Add("expected", evidence.num_expected);
  json.Add("inlier_spread", evidence.inlier_spread);
  json.Add("median_error_px", evidence.median_error_px);
  json.Add("confirmations", evidence.num_confirmations);
  json.Add("path_m", evidence.path_m);
  json.Add("drift_m", evidence.drift_m);
  json.Add("drift_deg", evidence.drift_rad * kDegPerRad);
  json.Add("depth_compared", evidence.depth_compared);
  json.Add("depth_contradicted", evidence.depth_contradicted);
  return json;
}

JsonObject ToJson(const LoopRecord& record) {
  JsonObject json;
  json.Add("query_stamp", FormatStamp(record.query_stamp));
  json.Add("match_stamp", FormatStamp(record.match_stamp));
  json.Add("query_map", record.query_map.value());
  json.Add("match_map", record.match_map.value());
  json.Add("verdict", ToString(record.verdict));
  json.Add("reason", record.reason);
  json.Add("T_match_query", PoseToJson(record.T_match_query));
  json.Add("evidence", ToJson(record.evidence));
  return json;
}

}  // namespace

std::string FormatLoopsJson(std::span<const LoopRecord> records) {
  std::vector<JsonObject> candidates;
  for (const LoopRecord& record : records)
    candidates.push_back(ToJson(record));
  return fmt::format("{{\"format\": \"loops\", \"version\": 1, \"candidates\": [\n{}\n]}}\n",
                     JsonItems(candidates));
}

}  // namespace cslam
