// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/floor_path.h"
#include "cslam/actors/footsteps.h"
#include "cslam/actors/person.h"
#include "cslam/actors/person_pose.h"
#include "cslam/actors/smooth_noise.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cslam {
namespace {

constexpr double kFullSpread_m = 0.8;      // between the feet, at a brisk walk
constexpr double kArmSwing_rad = 0.5;      // at full spread
constexpr double kPelvisTwist_rad = 0.10;  // at full spread
constexpr double kChestTwist_rad = 0.12;   // against the pelvis's
constexpr double kBob_m = 0.03;            // lower at full spread
constexpr double kSway_m = 0.02;           // towards the foot that carries
constexpr double kStandStill_m_s = 0.3;    // below, standing gestures come in
constexpr double kGaze_s = 0.6;            // the head turns so long before the body

class Walker final : public PersonMotion {
 public:
  Walker(std::vector<FloorPoint> points, Rng rng)
      : path_(std::move(points)),
        steps_(path_),
        shift_(9.0, rng),
        look_(6.0, rng),
        nod_(4.0, rng),
        gesture_(7.0, rng),
        wave_(1.3, rng),
        elbow_rad_(rng.Uniform(0.15, 0.35)) {}

  std::shared_ptr<const PersonPose> At(double time_s) const override {
    if (time_s < path_.from_s() || time_s > path_.to_s()) return nullptr;
    const FloorState body = path_.At(time_s);
    PersonPose pose;
    pose.T_world_body = Standing(body.position_m.x(), body.position_m.y(), 0.0, body.yaw_rad);
    for (const Side side : kSides)
      pose.feet[static_cast<std::size_t>(side)] = steps_.At(side, time_s);
    const double ease = 1.0 - SmoothStep(0.0, kStandStill_m_s, body.speed_m_s);
    MoveTrunk(time_s, ease, body, pose);
    MoveArms(time_s, ease, pose);
    return std::make_shared<const PersonPose>(pose);
  }

 private:
  // How far the left foot is ahead of the right one, in full spreads.
  static double Spread(const PersonPose& pose) {
    const Se3 T_body_world = pose.T_world_body.Inverse();
    const auto ahead = [&](const FootGoal& foot) {
      return (T_body_world * foot.T_world_sole.translation).x();
    };
    return std::clamp((ahead(pose.feet[0]) - ahead(pose.feet[1])) / kFullSpread_m, -1.2, 1.2);
  }

  void MoveTrunk(double time_s, double ease, const FloorState& body, PersonPose& pose) const {
    const double spread = Spread(pose);
    const double lift =
        steps_.Lift(Side::kRight, time_s) - steps_.Lift(Side::kLeft, time_s);  // > 0: on the left
    const double shift = shift_(time_s) * ease;
    pose.pelvis_shift_m = {0.0, kSway_m * (lift + shift),
                           -0.004 - kBob_m * spread * spread - 0.008 * std::abs(shift)};
    // The hip of the foot that swings drops a little, the chest stays upright.
    pose.pelvis_turn_rad = {-0.04 * (lift - 0.7 * shift), 0.03, -kPelvisTwist_rad * spread};
    const double lean = 0.03 * std::min(body.speed_m_s, 1.5);
    pose.chest_turn_rad = {0.01 * lift, lean, kChestTwist_rad * spread + 0.06 * shift};
    const double ahead_rad = path_.At(time_s + kGaze_s).yaw_rad - body.yaw_rad;
    pose.head_turn_rad = {
        0.0, 0.05 + 0.08 * nod_(time_s),
        0.6 * std::clamp(ahead_rad, -0.9, 0.9) + (0.15 + 0.4 * ease) * look_(time_s)};
  }

  void MoveArms(double time_s, double ease, PersonPose& pose) const {
    const double spread = Spread(pose);
    const double talk = ease * SmoothStep(0.15, 0.6, gesture_(time_s));
    for (const Side side : kSides) {
      ArmGoal& arm = pose.arms[static_cast<std::size_t>(side)];
      const double forward = -SignOf(side) * spread;  // against the leg of its side
      arm.swing_rad = kArmSwing_rad * forward + (forward > 0.0 ? 0.0 : 0.15 * -forward);
      arm.spread_rad = 0.12;
      arm.elbow_rad = elbow_rad_ + 0.35 * SmoothStep(-0.8, 1.2, forward);
      const double hand = side == Side::kRight ? 1.0 : 0.55;
      arm.reach = 0.9 * hand * talk;
      arm.palm_down_rad = 0.5 * arm.reach;
      arm.hand_m = {0.36 + 0.04 * wave_(time_s + SignOf(side)), SignOf(side) * 0.2,
                    1.12 + 0.09 * wave_(1.4 * time_s - SignOf(side))};
    }
  }

  FloorPath path_;
  Footsteps steps_;
  SmoothNoise shift_;
  SmoothNoise look_;
  SmoothNoise nod_;
  SmoothNoise gesture_;
  SmoothNoise wave_;
  double elbow_rad_;
};

}  // namespace

std::shared_ptr<const PersonMotion> Walk(std::vector<FloorPoint> points, std::uint64_t seed) {
  constexpr std::uint64_t kWalkPurpose = 0x77616C6B;
  return std::make_shared<Walker>(std::move(points), Rng(seed, 0, kWalkPurpose));
}

}  // namespace cslam
