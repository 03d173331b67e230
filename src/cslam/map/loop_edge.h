// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/util/id.h"

namespace cslam {

// The same place seen twice, with a long way between.
struct LoopEdge {
  KeyframeId match;
  KeyframeId query;
  Se3 T_match_query;
};

}  // namespace cslam
