// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/doorway.h"

#include <numbers>

namespace cslam {

void AddDoorway(SceneBuilder& scene, const Eigen::Vector2d& middle_m, double width_m,
                bool leads_along_x, int material) {
  constexpr double kJambM = 0.07;
  constexpr double kProudM =
      0.03;  // how far the frame stands out of the walls, both sides together
  constexpr double kThresholdM = 0.01;
  const double depth_m = kWallThicknessM + kProudM;
  const double yaw_rad = leads_along_x ? 0.5 * std::numbers::pi : 0.0;
  scene.AddObject("doorway", kNoClass, Standing(middle_m.x(), middle_m.y(), 0.0, yaw_rad),
                  [&](MeshBuilder& mesh) {
                    const double outer_m = width_m + 2.0 * kJambM;
                    for (const double side : {-0.5, 0.5})
                      mesh.AddBox(Standing(side * (width_m + kJambM), 0.0, 0.0),
                                  {kJambM, depth_m, kDoorwayHeightM}, Uniform(material));
                    mesh.AddBox(Standing(0.0, 0.0, kDoorwayHeightM), {outer_m, depth_m, kJambM},
                                Uniform(material));
                    mesh.AddBox(Se3(), {width_m, depth_m, kThresholdM}, Uniform(material));
                  });
}

}  // namespace cslam
