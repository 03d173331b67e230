// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/person.h"
#include "cslam/actors/person_pose.h"
#include "cslam/actors/smooth_noise.h"
#include "cslam/util/check.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace cslam {
namespace {

constexpr double kReach_s = 0.5;         // hands to the thing, and away
constexpr double kChest_m = 0.17;        // how far before the body's middle its near side is
constexpr double kWristInside_m = 0.02;  // the wrist is this far beside the thing: palms touch it
constexpr double kGripHeight_m = 0.10;   // of the wrists above the thing's bottom
constexpr double kGripDepth = 0.35;      // of its depth, from the near side

class Carrier final : public PersonMotion {
 public:
  Carrier(std::shared_ptr<const PersonMotion> walk, double from_s, double to_s, const Load& load)
      : walk_(std::move(walk)), from_s_(from_s), to_s_(to_s), load_(load) {
    CSLAM_CHECK(walk_ != nullptr);
  }

  std::shared_ptr<const PersonPose> At(double time_s) const override {
    const std::shared_ptr<const PersonPose> walking = walk_->At(time_s);
    const double held = SmoothStep(from_s_ - kReach_s, from_s_, time_s) *
                        (1.0 - SmoothStep(to_s_, to_s_ + kReach_s, time_s));
    if (!walking || held <= 0.0) return walking;
    PersonPose pose = *walking;
    pose.chest_turn_rad.y() -= 0.05 * held;
    for (const Side side : kSides) {
      ArmGoal& arm = pose.arms[static_cast<std::size_t>(side)];
      const Eigen::Vector3d grip(kChest_m + kGripDepth * load_.depth_m,
                                 SignOf(side) * (0.5 * load_.width_m + kWristInside_m),
                                 load_.bottom_m + kGripHeight_m);
      arm.hand_m = arm.hand_m * (1.0 - held) + grip * held;
      arm.reach = std::lerp(arm.reach, 1.0, held);
      arm.palm_down_rad *= 1.0 - held;
      arm.elbow_pole = {-0.5, 0.35, -0.8};
    }
    return std::make_shared<const PersonPose>(pose);
  }

  const Load& load() const { return load_; }

 private:
  std::shared_ptr<const PersonMotion> walk_;
  double from_s_;
  double to_s_;
  Load load_;
};

}  // namespace

std::shared_ptr<const PersonMotion> Carrying(std::shared_ptr<const PersonMotion> walk,
                                             double from_s, double to_s, const Load& load) {
  return std::make_shared<Carrier>(std::move(walk), from_s, to_s, load);
}

Se3 T_world_Carried(const PersonMotion& motion, double time_s) {
  const std::shared_ptr<const PersonPose> pose = motion.At(time_s);
  CSLAM_CHECK(pose != nullptr, "nobody is there at {} s", time_s);
  const auto* carrier = dynamic_cast<const Carrier*>(&motion);
  const Load load = carrier != nullptr ? carrier->load() : Load{};
  return pose->T_world_body *
         Standing(kChest_m + 0.5 * load.depth_m, 0.0, load.bottom_m, 0.5 * std::numbers::pi);
}

}  // namespace cslam
