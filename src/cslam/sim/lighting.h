// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/ray_scene.h"
#include "cslam/sim/scene.h"

#include <vector>

namespace cslam {

// Light stored per vertex of every object, as the factor on the texture's display values
// (irradiance to the power of 1 / 2.2): gains[object][vertex].
using VertexGains = std::vector<std::vector<float>>;

// Casts shadow rays to the lights and ambient rays around each vertex. The same scene gives the
// same light, whatever the number of threads around.
VertexGains BakeLighting(const Scene& scene, const RayScene& rays);

}  // namespace cslam
