// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/people_cast.h"

#include "cslam/util/check.h"

#include <cmath>
#include <numbers>

namespace cslam {

int PeopleCast::Add(const std::string& name, std::shared_ptr<const PersonMotion> motion) {
  // Neighbouring variants differ most, so each person takes the next one.
  const int variant = static_cast<int>(seed_ % 1000) * 3 + static_cast<int>(animations_.size());
  const std::shared_ptr<const PersonModel> model = MakePersonModel(assets_, variant);
  const int id = AddPerson(scene_, *model, name);
  animations_[id] = Animate(model, std::move(motion));
  return id;
}

std::vector<FloorPoint> CutCycle(const std::vector<FloorPoint>& cycle, double from_s, double to_s) {
  CSLAM_CHECK(cycle.size() >= 2 && cycle.front().position_m == cycle.back().position_m);
  const double period_s = cycle.back().time_s - cycle.front().time_s;
  std::vector<FloorPoint> points;
  double lap_s = std::floor(from_s / period_s) * period_s - period_s;
  while (points.size() < 2 || points.back().time_s < to_s - from_s) {
    for (std::size_t i = 0; i + 1 < cycle.size(); ++i) {
      FloorPoint point = cycle[i];
      point.time_s += lap_s - from_s;
      if (!points.empty() && points.back().time_s >= to_s - from_s) break;
      // Only the last point before the start is kept.
      if (point.time_s <= 0.0) points.clear();
      points.push_back(point);
    }
    lap_s += period_s;
  }
  return points;
}

std::vector<FloorPoint> Mirrored(std::vector<FloorPoint> points, double x_m) {
  for (FloorPoint& point : points) {
    point.position_m.x() = 2.0 * x_m - point.position_m.x();
    if (point.facing_rad) point.facing_rad = std::numbers::pi - *point.facing_rad;
  }
  return points;
}

}  // namespace cslam
