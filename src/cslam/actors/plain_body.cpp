// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/plain_body.h"

#include "cslam/actors/tube_mesh.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace cslam {
namespace {

enum Picture { kShirt, kTrousers, kSkin, kFace, kShoe };

constexpr double kTexelsPerMeter = 700.0;
constexpr double kReferenceHeight_m = 1.75;  // all lengths below are for this height

// Builds the parts of one body; lengths of the reference height are scaled to the look's.
class PlainBuilder {
 public:
  explicit PlainBuilder(const PersonLook& look)
      : scale_(look.height_m / kReferenceHeight_m), build_(look.build) {
    body_.skeleton = PlainSkeleton(look.height_m);
    body_.pictures = {PaintShirt(look, {700, 700}, kTexelsPerMeter),
                      PaintTrousers(look, {700, 700}, kTexelsPerMeter), PaintSkin(look, {128, 128}),
                      PaintHead(look, {512, 512}), PaintShoe(look, {128, 128})};
  }

  SkinnedBody Build() {
    Trunk();
    Head();
    for (const Side side : kSides) {
      Arm(side);
      Leg(side);
      Foot(side);
    }
    body_.mesh.normals = SmoothNormals(body_.mesh);
    CheckBody(body_);
    return std::move(body_);
  }

 private:
  Eigen::Vector3d At(Joint joint) const { return body_.skeleton.T_body_joint[joint].translation; }

  Ring MakeRing(const Eigen::Vector3d& center, double front_m, double side_m, Joint joint,
                Joint other = kPelvis, double share = 0.0) const {
    return {center, scale_ * build_ * front_m, scale_ * build_ * side_m, joint, other, share};
  }

  // At a height of the reference body, in its middle.
  Eigen::Vector3d Middle(double x_m, double z_m) const { return {scale_ * x_m, 0.0, scale_ * z_m}; }

  void Trunk() {
    const TubeLook cloth{
        .picture = kShirt, .picture_width_m = 1.0, .picture_height_m = 1.0, .boxiness = 2.4};
    const std::array<Ring, 11> shirt{
        {MakeRing(Middle(-0.005, 1.475), 0.062, 0.085, kChest, kNeck, 0.3),
         MakeRing(Middle(-0.01, 1.455), 0.078, 0.145, kChest),
         MakeRing(Middle(-0.01, 1.425), 0.094, 0.185, kChest),
         MakeRing(Middle(0.0, 1.37), 0.108, 0.188, kChest),
         MakeRing(Middle(0.005, 1.28), 0.118, 0.172, kChest),
         MakeRing(Middle(0.005, 1.19), 0.112, 0.16, kChest, kWaist, 0.4),
         MakeRing(Middle(0.005, 1.10), 0.106, 0.15, kWaist),
         MakeRing(Middle(0.005, 1.03), 0.110, 0.155, kWaist, kPelvis, 0.5),
         MakeRing(Middle(0.0, 0.97), 0.120, 0.170, kPelvis),
         MakeRing(Middle(0.0, 0.90), 0.126, 0.180, kPelvis),
         MakeRing(Middle(0.0, 0.86), 0.127, 0.182, kPelvis)}};
    AddTube(shirt, cloth, body_);
    TubeLook jeans = cloth;
    jeans.picture = kTrousers;
    const std::array<Ring, 4> hips{{MakeRing(Middle(0.0, 0.95), 0.112, 0.165, kPelvis),
                                    MakeRing(Middle(-0.004, 0.88), 0.120, 0.174, kPelvis),
                                    MakeRing(Middle(-0.004, 0.82), 0.112, 0.170, kPelvis),
                                    MakeRing(Middle(0.0, 0.78), 0.07, 0.12, kPelvis)}};
    AddTube(hips, jeans, body_);
  }

  void Head() {
    const std::array<Ring, 3> neck{{MakeRing(Middle(0.0, 1.58), 0.056, 0.054, kHead, kNeck, 0.5),
                                    MakeRing(Middle(-0.005, 1.51), 0.057, 0.058, kNeck),
                                    MakeRing(Middle(-0.01, 1.44), 0.065, 0.075, kChest)}};
    AddTube(neck, {.picture = kSkin}, body_);
    // Crown to chin: height, middle, half depth, half width.
    constexpr std::array<std::array<double, 4>, 13> kProfile{{{1.752, 0.005, 0.020, 0.018},
                                                              {1.747, 0.004, 0.048, 0.040},
                                                              {1.735, 0.003, 0.072, 0.058},
                                                              {1.715, 0.002, 0.089, 0.070},
                                                              {1.690, 0.002, 0.098, 0.077},
                                                              {1.665, 0.003, 0.100, 0.079},
                                                              {1.645, 0.006, 0.099, 0.078},
                                                              {1.625, 0.014, 0.100, 0.075},
                                                              {1.605, 0.020, 0.094, 0.070},
                                                              {1.585, 0.024, 0.084, 0.064},
                                                              {1.565, 0.030, 0.070, 0.056},
                                                              {1.548, 0.037, 0.054, 0.046},
                                                              {1.538, 0.042, 0.036, 0.032}}};
    std::vector<Ring> rings;
    for (const auto& [z_m, x_m, front_m, side_m] : kProfile) {
      Ring ring = MakeRing(Middle(x_m, z_m), front_m, side_m, kHead);
      ring.front_m /= build_;  // heads do not grow with the body
      ring.side_m /= build_;
      rings.push_back(ring);
    }
    AddTube(rings, {.picture = kFace}, body_);
    const std::array<Ring, 4> nose{{MakeRing(Middle(0.100, 1.655), 0.005, 0.008, kHead),
                                    MakeRing(Middle(0.108, 1.632), 0.012, 0.012, kHead),
                                    MakeRing(Middle(0.110, 1.617), 0.019, 0.018, kHead),
                                    MakeRing(Middle(0.106, 1.608), 0.012, 0.013, kHead)}};
    AddTube(nose, {.picture = kSkin}, body_);
  }

  void Arm(Side side) {
    const LimbJoints arm = ArmOf(side);
    const Eigen::Vector3d shoulder = At(arm.root);
    const Eigen::Vector3d elbow = At(arm.middle);
    const Eigen::Vector3d wrist = At(arm.end);
    const auto on = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double share) {
      return Eigen::Vector3d(a + share * (b - a));
    };
    const Eigen::Vector3d up(0.0, 0.0, scale_ * 0.035);
    const std::array<Ring, 7> sleeve{
        {MakeRing(shoulder + up, 0.035, 0.03, kChest, arm.root, 0.5),
         MakeRing(shoulder + 0.5 * up, 0.058, 0.052, kChest, arm.root, 0.6),
         MakeRing(on(shoulder, elbow, 0.1), 0.062, 0.056, arm.root, kChest, 0.2),
         MakeRing(on(shoulder, elbow, 0.5), 0.053, 0.05, arm.root),
         MakeRing(on(shoulder, elbow, 0.86), 0.046, 0.043, arm.root, arm.middle, 0.15),
         MakeRing(elbow, 0.044, 0.041, arm.root, arm.middle, 0.5),
         MakeRing(on(elbow, wrist, 0.16), 0.046, 0.043, arm.middle)}};
    AddTube(sleeve, {.picture = kShirt, .picture_width_m = 1.0, .picture_height_m = 1.0}, body_);
    const std::array<Ring, 5> forearm{
        {MakeRing(elbow, 0.036, 0.034, arm.root, arm.middle, 0.5),
         MakeRing(on(elbow, wrist, 0.2), 0.041, 0.037, arm.middle),
         MakeRing(on(elbow, wrist, 0.6), 0.034, 0.03, arm.middle),
         MakeRing(on(elbow, wrist, 0.95), 0.027, 0.021, arm.middle, arm.end, 0.3),
         MakeRing(on(elbow, wrist, 1.05), 0.029, 0.018, arm.end)}};
    AddTube(forearm, {.picture = kSkin}, body_);
    const auto below = [&](double z_m, double x_m = 0.0) {
      return Eigen::Vector3d(wrist + scale_ * Eigen::Vector3d(x_m, 0.0, -z_m));
    };
    const std::array<Ring, 6> hand{{MakeRing(below(-0.01), 0.027, 0.018, arm.end),
                                    MakeRing(below(0.03), 0.040, 0.017, arm.end),
                                    MakeRing(below(0.08), 0.044, 0.016, arm.end),
                                    MakeRing(below(0.12, 0.006), 0.037, 0.015, arm.end),
                                    MakeRing(below(0.16, 0.012), 0.028, 0.014, arm.end),
                                    MakeRing(below(0.18, 0.016), 0.015, 0.009, arm.end)}};
    AddTube(hand, {.picture = kSkin, .boxiness = 2.6}, body_);
    const std::array<Ring, 3> thumb{{MakeRing(below(0.02, 0.03), 0.014, 0.013, arm.end),
                                     MakeRing(below(0.06, 0.052), 0.013, 0.012, arm.end),
                                     MakeRing(below(0.095, 0.06), 0.008, 0.008, arm.end)}};
    AddTube(thumb, {.picture = kSkin}, body_);
  }

  void Leg(Side side) {
    const LimbJoints leg = LegOf(side);
    const Eigen::Vector3d hip = At(leg.root);
    const Eigen::Vector3d knee = At(leg.middle);
    const Eigen::Vector3d ankle = At(leg.end);
    const auto on = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double share) {
      return Eigen::Vector3d(a + share * (b - a));
    };
    const std::array<Ring, 10> trouser{
        {MakeRing(on(hip, knee, -0.08), 0.085, 0.070, kPelvis, leg.root, 0.3),
         MakeRing(on(hip, knee, 0.05), 0.096, 0.083, kPelvis, leg.root, 0.6),
         MakeRing(on(hip, knee, 0.22), 0.092, 0.082, leg.root),
         MakeRing(on(hip, knee, 0.55), 0.078, 0.072, leg.root),
         MakeRing(on(hip, knee, 0.86), 0.066, 0.062, leg.root, leg.middle, 0.15),
         MakeRing(knee, 0.064, 0.060, leg.root, leg.middle, 0.5),
         MakeRing(on(knee, ankle, 0.16), 0.064, 0.060, leg.middle, leg.root, 0.1),
         MakeRing(on(knee, ankle, 0.4), 0.063, 0.058, leg.middle),
         MakeRing(on(knee, ankle, 0.8), 0.057, 0.054, leg.middle),
         MakeRing(on(knee, ankle, 1.04), 0.060, 0.056, leg.middle, leg.end, 0.2)}};
    AddTube(trouser, {.picture = kTrousers, .picture_width_m = 1.0, .picture_height_m = 1.0},
            body_);
  }

  void Foot(Side side) {
    const Joint foot = LegOf(side).end;
    const Joint toes = ToesOf(side);
    const Eigen::Vector3d ankle = At(foot);
    const auto at = [&](double x_m, double z_m) {
      return Eigen::Vector3d(ankle.x() + scale_ * x_m, ankle.y(), scale_ * z_m);
    };
    // From heel to toes: the first axis is up, the second to the right, so that it closes outwards.
    const std::array<Ring, 8> shoe{{MakeRing(at(-0.068, 0.035), 0.022, 0.02, foot),
                                    MakeRing(at(-0.06, 0.042), 0.042, 0.032, foot),
                                    MakeRing(at(-0.02, 0.055), 0.055, 0.037, foot),
                                    MakeRing(at(0.04, 0.048), 0.048, 0.039, foot),
                                    MakeRing(at(0.09, 0.037), 0.037, 0.044, foot),
                                    MakeRing(at(0.135, 0.030), 0.030, 0.047, foot, toes, 0.5),
                                    MakeRing(at(0.175, 0.026), 0.026, 0.042, toes),
                                    MakeRing(at(0.20, 0.022), 0.016, 0.026, toes)}};
    std::vector<Ring> rings(shoe.begin(), shoe.end());
    for (Ring& ring : rings) {
      const double half_m = ring.front_m / build_;  // keep the sole on the floor
      ring.front_m = half_m;
    }
    AddTube(rings,
            {.first_axis = Eigen::Vector3d::UnitZ(),
             .second_axis = Eigen::Vector3d::UnitY(),
             .picture = kShoe,
             .boxiness = 3.0},
            body_);
  }

  SkinnedBody body_;
  double scale_;
  double build_;
};

}  // namespace

Skeleton PlainSkeleton(double height_m) {
  const double scale = height_m / kReferenceHeight_m;
  Skeleton skeleton;
  const auto place = [&](Joint joint, double x_m, double y_m, double z_m) {
    skeleton.T_body_joint[joint].translation = scale * Eigen::Vector3d(x_m, y_m, z_m);
  };
  place(kPelvis, 0.0, 0.0, 0.915);
  place(kWaist, 0.0, 0.0, 1.03);
  place(kChest, 0.0, 0.0, 1.19);
  place(kNeck, -0.01, 0.0, 1.48);
  place(kHead, 0.0, 0.0, 1.565);
  for (const Side side : kSides) {
    const double sign = SignOf(side);
    const LimbJoints arm = ArmOf(side);
    const LimbJoints leg = LegOf(side);
    place(arm.root, -0.01, 0.185 * sign, 1.415);
    place(arm.middle, -0.01, 0.185 * sign, 1.115);
    place(arm.end, -0.01, 0.185 * sign, 0.86);
    place(leg.root, 0.0, 0.09 * sign, 0.915);
    place(leg.middle, 0.0, 0.09 * sign, 0.49);
    place(leg.end, 0.0, 0.09 * sign, 0.075);
    place(ToesOf(side), 0.135, 0.09 * sign, 0.02);
  }
  skeleton.buttock_m = 0.105 * scale;
  skeleton.heel_m = 0.055 * scale;
  return skeleton;
}

SkinnedBody MakePlainBody(const PersonLook& look) {
  return PlainBuilder(look).Build();
}

}  // namespace cslam
