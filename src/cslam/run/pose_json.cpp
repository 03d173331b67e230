// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/pose_json.h"

namespace cslam {

std::optional<JsonObject> PoseToJson(const std::optional<Se3>& T) {
  if (!T) return std::nullopt;
  JsonObject json;
  json.Add("tx_m", T->translation.x());
  json.Add("ty_m", T->translation.y());
  json.Add("tz_m", T->translation.z());
  json.Add("qx", T->rotation.x());
  json.Add("qy", T->rotation.y());
  json.Add("qz", T->rotation.z());
  json.Add("qw", T->rotation.w());
  return json;
}

}  // namespace cslam
