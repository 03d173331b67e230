// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"

#include <functional>

namespace cslam {

// Where the camera is while a story runs, as any motion generator gives it.
struct CameraMotion {
  double duration_s = 0.0;
  std::function<Se3(double time_s)> T_world_camera;  // pure; defined for all times
};

}  // namespace cslam
