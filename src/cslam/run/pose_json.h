// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/run/json_object.h"

#include <optional>

namespace cslam {

// A pose as the JSON files of a run have it: tx_m to tz_m, qx to qw; nothing for none.
std::optional<JsonObject> PoseToJson(const std::optional<Se3>& T);

}  // namespace cslam
