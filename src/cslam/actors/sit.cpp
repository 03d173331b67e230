// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/person.h"
#include "cslam/actors/person_pose.h"
#include "cslam/actors/skeleton.h"
#include "cslam/actors/smooth_noise.h"

#include <numbers>
#include <utility>
#include <vector>

namespace cslam {
namespace {

constexpr double kBehindCenter_m = 0.06;  // of the pelvis on the seat, towards the back
constexpr double kFeetAhead_m = 0.36;     // of the ankles, from the pelvis
constexpr double kHalfTrack_m = 0.13;
constexpr double kToeOut_rad = 0.15;

class Sitter final : public PersonMotion {
 public:
  Sitter(const Sitting& sitting, Rng rng)
      : sitting_(sitting),
        T_world_body_(sitting.T_world_seat * Standing(0.0, 0.0, 0.0, -0.5 * std::numbers::pi)),
        lean_(7.0, rng),
        twist_(8.0, rng),
        look_(4.5, rng),
        nod_(2.2, rng),
        foot_m_(rng.Uniform(-0.04, 0.04)) {
    for (int i = 0; i < 2; ++i) {
      hands_.push_back({SmoothNoise(6.0, rng), SmoothNoise(1.9, rng), SmoothNoise(1.5, rng),
                        SmoothNoise(1.7, rng)});
    }
  }

  std::shared_ptr<const PersonPose> At(double time_s) const override {
    if (time_s < sitting_.from_s || time_s > sitting_.to_s) return nullptr;
    PersonPose pose;
    pose.T_world_body = T_world_body_;
    pose.seat_height_m = sitting_.seat_height_m;
    const double live = sitting_.liveliness;
    pose.pelvis_shift_m = {-kBehindCenter_m, 0.0, 0.0};
    const double lean = 0.07 * live * lean_(time_s);
    const double twist = 0.25 * live * twist_(time_s);
    pose.pelvis_turn_rad = {0.0, -0.1, 0.0};
    pose.chest_turn_rad = {0.04 * live * twist_(time_s + 3.0), lean, twist};
    pose.head_turn_rad = {0.05 * live * twist_(time_s + 1.0), 0.08 + 0.12 * live * nod_(time_s),
                          twist + 0.55 * live * look_(time_s)};
    for (const Side side : kSides) {
      const auto i = static_cast<std::size_t>(side);
      const double sign = SignOf(side);
      pose.feet[i].T_world_sole =
          T_world_body_ * Standing(kFeetAhead_m - kBehindCenter_m + sign * foot_m_,
                                   sign * kHalfTrack_m, 0.0, sign * kToeOut_rad);
      pose.arms[i] = MoveHand(side, time_s);
    }
    return std::make_shared<const PersonPose>(pose);
  }

 private:
  struct Hand {
    SmoothNoise talk;
    SmoothNoise x;
    SmoothNoise y;
    SmoothNoise z;
  };

  ArmGoal MoveHand(Side side, double time_s) const {
    const double sign = SignOf(side);
    const Hand& hand = hands_[static_cast<std::size_t>(side)];
    const double live = sitting_.liveliness;
    const double talk = live * SmoothStep(-0.15, 0.35, hand.talk(time_s));
    const double seat_m = sitting_.seat_height_m;
    const Eigen::Vector3d on_thigh(0.27 - kBehindCenter_m, sign * 0.15, seat_m + 0.19);
    const Eigen::Vector3d in_air(0.30 + 0.09 * hand.x(time_s), sign * (0.2 + 0.1 * hand.y(time_s)),
                                 seat_m + 0.46 + 0.16 * hand.z(time_s));
    ArmGoal arm;
    arm.reach = 1.0;
    arm.hand_m = on_thigh + talk * (in_air - on_thigh);
    arm.palm_down_rad = 1.2 - 0.8 * talk;
    arm.elbow_pole = {-0.7, 0.45, -0.6};
    return arm;
  }

  Sitting sitting_;
  Se3 T_world_body_;
  SmoothNoise lean_;
  SmoothNoise twist_;
  SmoothNoise look_;
  SmoothNoise nod_;
  double foot_m_;
  std::vector<Hand> hands_;
};

}  // namespace

std::shared_ptr<const PersonMotion> Sit(const Sitting& sitting, std::uint64_t seed) {
  constexpr std::uint64_t kSitPurpose = 0x736974;
  return std::make_shared<Sitter>(sitting, Rng(seed, 0, kSitPurpose));
}

}  // namespace cslam
