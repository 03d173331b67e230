// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/loops_json.h"

#include "cslam/run/json_object.h"

#include <fmt/format.h>

#include <numbers>

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

JsonObject ToJson(const Se3& T) {
  JsonObject json;
  json.Add("tx_m", T.translation.x());
  json.Add("ty_m", T.translation.y());
  json.Add("tz_m", T.translation.z());
  json.Add("qx", T.rotation.x());
  json.Add("qy", T.rotation.y());
  json.Add("qz", T.rotation.z());
  json.Add("qw", T.rotation.w());
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
  if (record.T_match_query) {
    json.Add("T_match_query", ToJson(*record.T_match_query));
  } else {
    json.AddNull("T_match_query");
  }
  json.Add("evidence", ToJson(record.evidence));
  return json;
}

}  // namespace

std::string FormatLoopsJson(std::span<const LoopRecord> records) {
  std::string candidates;
  for (const LoopRecord& record : records) {
    if (!candidates.empty()) candidates += ",\n";
    candidates += ToJson(record).Text();
  }
  return fmt::format("{{\"format\": \"loops\", \"version\": 1, \"candidates\": [\n{}\n]}}\n",
                     candidates);
}

}  // namespace cslam
