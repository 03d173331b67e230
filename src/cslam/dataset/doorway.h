// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/scene_builder.h"

#include <Eigen/Core>

namespace cslam {

// Rooms of one building lie this far apart; a doorway's frame fills the gap.
constexpr double kWallThicknessM = 0.15;
constexpr double kDoorwayHeightM = 2.05;

// The frame of an open doorway: a lining of jambs, lintel and threshold around a clear width.
// material: of all of it.
void AddDoorway(SceneBuilder& scene, const Eigen::Vector2d& middle_m, double width_m,
                bool leads_along_x, int material);

}  // namespace cslam
