// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/person.h"

#include "cslam/actors/person_model.h"
#include "cslam/actors/pose_solver.h"
#include "cslam/util/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cslam {
namespace {

constexpr double kTick_s = 0.02;

// Walks 3 m, waits, turns round and comes back.
std::shared_ptr<const PersonMotion> ThereAndBack() {
  return Walk({{0.0, {0.0, 0.0}}, {3.0, {3.0, 0.0}}, {5.0, {3.0, 0.0}}, {8.0, {0.0, 0.0}}}, 3);
}

// Corners of all kinds, a reversal without a pause among them, in 8 s.
std::shared_ptr<const PersonMotion> Zigzag() {
  return Walk({{0.0, {0.0, 0.0}},
               {1.5, {1.5, 0.0}},
               {3.0, {1.5, 1.6}},
               {4.5, {0.5, 0.4}},
               {6.0, {1.7, 1.4}},
               {6.3, {1.7, 1.4}},
               {8.0, {0.2, 1.5}}},
              7);
}

JointFrames FramesAt(const PersonModel& model, const PersonMotion& motion, double time_s) {
  return SolvePose(model.body.skeleton, *motion.At(time_s));
}

double Lowest(const BodyShape& shape) {
  double lowest_m = 1e9;
  for (const Eigen::Vector3f& p : shape.positions)
    lowest_m = std::min(lowest_m, static_cast<double>(p.z()));
  return lowest_m;
}

TEST(Walk, IsThereOnlyBetweenItsPoints) {
  const auto motion = ThereAndBack();
  EXPECT_EQ(motion->At(-0.01), nullptr);
  EXPECT_EQ(motion->At(8.01), nullptr);
  EXPECT_NE(motion->At(0.0), nullptr);
  EXPECT_NE(motion->At(8.0), nullptr);
}

TEST(Walk, FollowsItsPoints) {
  const auto motion = ThereAndBack();
  EXPECT_LT((motion->At(0.0)->T_world_body.translation - Eigen::Vector3d(0, 0, 0)).norm(), 0.01);
  EXPECT_LT((motion->At(1.5)->T_world_body.translation - Eigen::Vector3d(1.5, 0, 0)).norm(), 0.02);
  EXPECT_LT((motion->At(4.0)->T_world_body.translation - Eigen::Vector3d(3, 0, 0)).norm(), 0.01);
  const double speed_m_s =
      (motion->At(1.6)->T_world_body.translation - motion->At(1.4)->T_world_body.translation)
          .norm() /
      0.2;
  EXPECT_NEAR(speed_m_s, 1.0, 0.02);
}

TEST(Walk, FacesTheWayItGoes) {
  const auto motion = ThereAndBack();
  const auto forward = [&](double time_s) {
    return Eigen::Vector3d(motion->At(time_s)->T_world_body.rotation * Eigen::Vector3d::UnitX());
  };
  EXPECT_GT(forward(1.0).x(), 0.99);
  EXPECT_LT(forward(7.0).x(), -0.99);
}

TEST(Walk, LooksWhereItIsToldWhileStanding) {
  const auto motion =
      Walk({{0.0, {0.0, 0.0}}, {2.0, {2.0, 0.0}, 1.5}, {7.0, {2.0, 0.0}}, {9.0, {4.0, 0.0}}}, 1);
  const Se3 T_world_body = motion->At(4.5)->T_world_body;
  const Eigen::Vector3d forward = T_world_body.rotation * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(std::atan2(forward.y(), forward.x()), 1.5, 0.05);
}

// Speed of the slowest of the places a foot stands on: something must rest on the floor.
double SlowestSole(const Skeleton& skeleton, const JointFrames& now, const JointFrames& next) {
  double slowest_m_s = 1e9;
  for (const Side side : kSides) {
    const Joint foot = LegOf(side).end;
    const double sole_m = -skeleton.T_body_joint[foot].translation.z();
    const Eigen::Vector3d ball(skeleton.OffsetOf(ToesOf(side)).x(), 0.0, sole_m);
    const Eigen::Vector3d heel(-skeleton.heel_m, 0.0, sole_m);
    for (const Eigen::Vector3d& point : {ball, heel}) {
      const double speed_m_s = (next[foot] * point - now[foot] * point).norm() / kTick_s;
      slowest_m_s = std::min(slowest_m_s, speed_m_s);
    }
  }
  return slowest_m_s;
}

TEST(Walk, PlantsItsFeet) {
  const auto model = MakePersonModel(nullptr, 2);
  for (const auto& motion : {ThereAndBack(), Zigzag()}) {
    int num_slips = 0;
    int num_planted = 0;
    for (double t = 0.0; t + kTick_s <= 8.0; t += kTick_s) {
      const double speed_m_s = SlowestSole(model->body.skeleton, FramesAt(*model, *motion, t),
                                           FramesAt(*model, *motion, t + kTick_s));
      if (speed_m_s > 0.1) ++num_slips;
      if (speed_m_s < 0.005) ++num_planted;
    }
    EXPECT_LE(num_slips, 4);  // of 400: ticks in which one foot lands and the other leaves
    EXPECT_GT(num_planted, 320);
  }
}

TEST(Walk, KeepsFeetAboveTheFloorAndNearIt) {
  const auto model = MakePersonModel(nullptr, 0);
  for (const auto& motion : {ThereAndBack(), Zigzag()}) {
    const Animation person = Animate(model, motion);
    for (double t = 0.0; t <= 8.0; t += 0.05) {
      const double lowest_m = Lowest(*person(t));
      EXPECT_GT(lowest_m, -0.025) << t;
      EXPECT_LT(lowest_m, 0.025) << t;
    }
  }
}

TEST(Walk, KeepsTheHeadOnTopAndMovesSmoothly) {
  const auto model = MakePersonModel(nullptr, 1);
  for (const auto& motion : {ThereAndBack(), Zigzag()}) {
    const double rest_m = model->body.skeleton.T_body_joint[kHead].translation.z();
    for (double t = 0.0; t + kTick_s <= 8.0; t += kTick_s) {
      const JointFrames now = FramesAt(*model, *motion, t);
      const JointFrames next = FramesAt(*model, *motion, t + kTick_s);
      EXPECT_NEAR(now[kHead].translation.z(), rest_m, 0.1) << t;
      for (std::size_t j = 0; j < kNumJoints; ++j) {
        EXPECT_LT((next[j].translation - now[j].translation).norm() / kTick_s, 5.5)
            << "joint " << j << " at " << t;
      }
    }
  }
}

TEST(Walk, BendsKneesForwardOnly) {
  const auto model = MakePersonModel(nullptr, 1);
  const auto motion = ThereAndBack();
  for (double t = 0.0; t <= 8.0; t += kTick_s) {
    const JointFrames frames = FramesAt(*model, *motion, t);
    for (const Side side : kSides) {
      const LimbJoints leg = LegOf(side);
      const Eigen::Quaterniond bend =
          frames[leg.root].rotation.conjugate() * frames[leg.middle].rotation;
      const double angle_rad = LogSo3(bend).y();
      EXPECT_GT(angle_rad, 0.0) << t;
      EXPECT_LT(angle_rad, 1.9) << t;
    }
  }
}

TEST(Sit, PutsThePelvisOnTheSeat) {
  const auto model = MakePersonModel(nullptr, 4);
  Sitting sitting;
  sitting.T_world_seat = Standing(1.0, 2.0, 0.0, 0.7);
  sitting.seat_height_m = 0.47;
  sitting.to_s = 20.0;
  const auto motion = Sit(sitting, 9);
  const Animation person = Animate(model, motion);
  for (double t = 0.0; t <= 20.0; t += 0.5) {
    const JointFrames frames = FramesAt(*model, *motion, t);
    const Eigen::Vector3d pelvis = frames[kPelvis].translation;
    EXPECT_NEAR(pelvis.z(), 0.47 + model->body.skeleton.buttock_m, 0.01);
    EXPECT_LT((pelvis - Eigen::Vector3d(1.0, 2.0, pelvis.z())).norm(), 0.12);
    const Eigen::Vector3d knee = sitting.T_world_seat.Inverse() * frames[kShinL].translation;
    EXPECT_LT(knee.y(), -0.25);  // before the seat
    EXPECT_GT(Lowest(*person(t)), -0.02);
  }
  EXPECT_FALSE(person(-0.1).has_value());
  EXPECT_FALSE(person(20.1).has_value());
}

TEST(Sit, MovesItsHandsOnlyWhenLively) {
  const auto model = MakePersonModel(nullptr, 0);
  const auto travel_m = [&](double liveliness) {
    Sitting sitting;
    sitting.liveliness = liveliness;
    const auto motion = Sit(sitting, 5);
    double sum_m = 0.0;
    Eigen::Vector3d last = FramesAt(*model, *motion, 0.0)[kHandR].translation;
    for (double t = 0.1; t <= 20.0; t += 0.1) {
      const Eigen::Vector3d hand = FramesAt(*model, *motion, t)[kHandR].translation;
      sum_m += (hand - last).norm();
      last = hand;
    }
    return sum_m;
  };
  EXPECT_LT(travel_m(0.0), 0.01);
  EXPECT_GT(travel_m(1.0), 2.0);
}

TEST(Carrying, HoldsTheThingBetweenTheHands) {
  const auto model = MakePersonModel(nullptr, 3);
  const Load load{.width_m = 0.36, .depth_m = 0.3, .bottom_m = 0.95};
  const auto motion = Carrying(ThereAndBack(), 1.0, 7.0, load);
  for (double t = 1.0; t <= 7.0; t += 0.1) {
    const JointFrames frames = FramesAt(*model, *motion, t);
    const Se3 T_load_world = T_world_Carried(*motion, t).Inverse();
    for (const Side side : kSides) {
      const Eigen::Vector3d hand = T_load_world * frames[ArmOf(side).end].translation;
      EXPECT_NEAR(std::abs(hand.x()), 0.5 * load.width_m, 0.04) << t;  // x: across
      EXPECT_LT(std::abs(hand.y()), 0.5 * load.depth_m);
      EXPECT_GT(hand.z(), 0.0);
      EXPECT_LT(hand.z(), 0.3);
      EXPECT_GT(hand.x() * SignOf(side), 0.0);
    }
  }
  // Before and after it is the plain walk.
  const auto plain = ThereAndBack();
  EXPECT_EQ(FramesAt(*model, *motion, 0.2)[kHandL].translation,
            FramesAt(*model, *plain, 0.2)[kHandL].translation);
}

TEST(Carrying, TurnsTheFrontOfTheThingForward) {
  const auto motion = Carrying(ThereAndBack(), 0.0, 8.0);
  const Eigen::Vector3d front = T_world_Carried(*motion, 1.5).rotation * -Eigen::Vector3d::UnitY();
  EXPECT_GT(front.x(), 0.99);
}

TEST(T_world_Carried, IsABugWhenNobodyIsThere) {
  EXPECT_THROW(T_world_Carried(*ThereAndBack(), 9.0), InternalError);
}

TEST(Animate, IsAPureFunctionOfTime) {
  const Animation a = Animate(MakePersonModel(nullptr, 1), ThereAndBack());
  const Animation b = Animate(MakePersonModel(nullptr, 1), ThereAndBack());
  const BodyShape first = *a(3.3);
  a(7.0);
  const BodyShape again = *a(3.3);
  const BodyShape other = *b(3.3);
  EXPECT_EQ(first.positions, again.positions);
  EXPECT_EQ(first.normals, again.normals);
  EXPECT_EQ(first.positions, other.positions);
}

TEST(AddPerson, AddsAMeshThatFitsItsAnimation) {
  SceneBuilder builder(1, 0.1);
  builder.AddBox("floor", kNoClass, Se3(), {1, 1, 0.1},
                 Uniform(builder.AddPicture(cv::Mat(4, 4, CV_8UC3, cv::Scalar(9, 9, 9)))));
  const auto model = MakePersonModel(nullptr, 6);
  const int id = AddPerson(builder, *model, "person");
  const Scene scene = builder.Take({});
  CheckScene(scene);
  const SceneObject& person = scene.objects[static_cast<std::size_t>(id)];
  EXPECT_EQ(person.class_id, 0);
  const BodyShape shape = *Animate(model, ThereAndBack())(2.0);
  EXPECT_EQ(shape.positions.size(), person.mesh.positions.size());
  EXPECT_EQ(shape.normals.size(), person.mesh.normals.size());
}

TEST(MakePersonModel, MakesPeopleOfDifferentSizesWithinHumanBounds) {
  double shortest_m = 9.0;
  double tallest_m = 0.0;
  for (int variant = -1; variant < 8; ++variant) {
    const auto model = MakePersonModel(nullptr, variant);
    const BodyShape shape = ShapeOf(*model, StandingPose());
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& p : shape.positions)
      box.extend(p);
    const double height_m = static_cast<double>(box.sizes().z());
    EXPECT_GT(height_m, 1.55);
    EXPECT_LT(height_m, 1.95);
    EXPECT_GT(box.sizes().y(), 0.4F);
    EXPECT_LT(box.sizes().y(), 0.8F);
    shortest_m = std::min(shortest_m, height_m);
    tallest_m = std::max(tallest_m, height_m);
  }
  EXPECT_GT(tallest_m - shortest_m, 0.1);
}

}  // namespace
}  // namespace cslam
