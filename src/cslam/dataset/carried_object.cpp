// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/carried_object.h"

#include "cslam/util/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cslam {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr double kSampleS = 1.0 / 30.0;

double SmoothStep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

Carry CarryOf(const PersonMotion& holder, const Errand& errand) {
  const double length_s = errand.put_s - errand.take_s;
  CSLAM_CHECK(length_s > 2.0 * kLiftS);
  const auto samples = static_cast<int>(std::ceil(length_s / kSampleS));
  Carry carry;
  for (int i = 0; i <= samples; ++i) {
    const double time_s = errand.take_s + length_s * i / samples;
    const Se3 T_world_held = T_world_Carried(holder, time_s);
    const double lifted = SmoothStep((time_s - errand.take_s) / kLiftS);
    const double lowered = SmoothStep((time_s - errand.put_s) / kLiftS + 1.0);
    const Se3 T_world_taken = Interpolate(errand.T_world_from, T_world_held, lifted);
    carry.push_back({time_s, Interpolate(T_world_taken, errand.T_world_to, lowered)});
  }
  return carry;
}

Timeline TakenOnce(const PersonMotion& holder, const Errand& errand) {
  Timeline timeline;
  timeline.stays = {{-kForever, errand.take_s, errand.T_world_from},
                    {errand.put_s, kForever, errand.T_world_to}};
  timeline.carries = {CarryOf(holder, errand)};
  // No rounding between the last sample and the stay.
  timeline.carries[0].front().time_s = errand.take_s;
  timeline.carries[0].back().time_s = errand.put_s;
  return timeline;
}

Timeline MovedAt(double time_s, const Se3& T_world_from, const Se3& T_world_to) {
  Timeline timeline;
  timeline.stays = {{-kForever, time_s, T_world_from}, {time_s, kForever, T_world_to}};
  return timeline;
}

Timeline RemovedAt(double time_s, const Se3& T_world_object) {
  Timeline timeline;
  timeline.stays = {{-kForever, time_s, T_world_object}};
  return timeline;
}

Timeline AddedAt(double time_s, const Se3& T_world_object) {
  Timeline timeline;
  timeline.stays = {{time_s, kForever, T_world_object}};
  return timeline;
}

}  // namespace cslam
