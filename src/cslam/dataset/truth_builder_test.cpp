// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/truth_builder.h"

#include "cslam/sim/scene_builder.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace cslam {
namespace {

constexpr double kEver = std::numeric_limits<double>::infinity();

// A room and boxes of 0.4 m; what they do is set by each test.
class TruthTest : public testing::Test {
 protected:
  TruthTest() {
    SceneBuilder scene(1, 1.0);
    const int paint = scene.AddPicture(cv::Mat(4, 4, CV_8UC3, cv::Scalar(0, 0, 200)));
    scene.AddObject("room", kNoClass, Se3(), [&](MeshBuilder& mesh) {
      mesh.AddRectangle({-5, 3, 5}, {10, 0, 0}, {0, 0, -10}, paint);
    });
    for (const auto& [name, class_id] :
         {std::pair{"chair", 56}, {"bear", 77}, {"umbrella", 25}, {"carton", kNoClass}})
      scene.AddBox(name, class_id, Standing(0, 2, 0), {0.4, 0.4, 0.4}, Uniform(paint));
    world.scene = scene.Take(Lighting{});
    observer.camera = {.width = 64, .height = 48, .fx = 60, .fy = 60, .cx = 31.5, .cy = 23.5};
    for (double t = 0.0; t < 20.0; t += 0.1)
      observer.views.push_back({t, Se3()});  // looks up: at z > 0, none of the places here
  }

  std::string Changes(double duration_s = 20.0) const {
    std::string text;
    for (const TrueChange& c : BuildTrueChanges(world, observer, duration_s)) {
      text += std::string(NameOf(c.kind)) + " " + std::to_string(c.instance);
      if (c.new_instance != 0) text += "->" + std::to_string(c.new_instance);
      text += " at " + std::to_string(std::lround(10 * c.time_s)) +
              (c.is_carried_in_view ? " carried" : "") + "; ";
    }
    return text;
  }

  // Looks at the places from behind y = 0, between two times.
  void LookFrom(double from_s, double to_s) {
    const Se3 looks_ahead(
        Eigen::Quaterniond(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Eigen::Vector3d::UnitX())),
        {0, 0, 0.3});
    for (View& view : observer.views) {
      if (view.time_s >= from_s && view.time_s < to_s) view.T_world_camera = looks_ahead;
    }
  }

  static constexpr int kChair = 1, kBear = 2, kUmbrella = 3, kCarton = 4;
  const Se3 here_ = Standing(0, 2, 0);
  const Se3 near_ = Standing(0.3, 2, 0);
  const Se3 there_ = Standing(2, 2, 0);
  World world;
  Observer observer;
};

using TrueChangesTest = TruthTest;
using TrueObjectsTest = TruthTest;

TEST_F(TrueChangesTest, AreNoneWhereNothingHappens) {
  world.timelines[kChair].stays = {{.T_world_object = here_}};
  world.timelines[kBear].stays = {{-kEver, 5, here_}, {5, kEver, here_}};
  EXPECT_EQ(Changes(), "");
}

TEST_F(TrueChangesTest, AreMovesAdditionsAndRemovalsInOrderOfTime) {
  world.timelines[kChair].stays = {{-kEver, 9, here_}, {9, kEver, there_}};
  world.timelines[kBear].stays = {{-kEver, 4, here_}};
  world.timelines[kCarton].stays = {{6, kEver, there_}};
  EXPECT_EQ(Changes(), "removed 2 at 40; added 4 at 60; moved 1 at 90; ");
  const auto changes = BuildTrueChanges(world, observer, 20.0);
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_EQ(changes[0].class_id, 77);
  EXPECT_FALSE(changes[0].to);
  EXPECT_FALSE(changes[1].from);
  EXPECT_EQ(changes[2].from->translation, here_.translation);
  EXPECT_EQ(changes[2].to->translation, there_.translation);
}

TEST_F(TrueChangesTest, KnowATurnOnTheSpotFromNothing) {
  world.timelines[kChair].stays = {{-kEver, 9, here_}, {9, kEver, Standing(0, 2, 0, 0.3)}};
  EXPECT_EQ(Changes(), "moved 1 at 90; ");
}

TEST_F(TrueChangesTest, AreRemovalAndAdditionIfAThingIsAwayInBetween) {
  world.timelines[kChair].stays = {{-kEver, 4, here_}, {6, kEver, there_}};
  EXPECT_EQ(Changes(), "removed 1 at 40; added 1 at 60; ");
}

TEST_F(TrueChangesTest, AreCarriedInViewWhereTheStorySaysSo) {
  Timeline& moved = world.timelines[kChair];
  moved.stays = {{-kEver, 4, here_}, {6, kEver, there_}};
  moved.carries = {{{4, here_}, {5, near_}}, {{5, near_}, {6, there_}}};
  Timeline& taken_away = world.timelines[kBear];
  taken_away.stays = {{-kEver, 7, here_}};
  taken_away.carries = {{{7, here_}, {8, there_}}};
  Timeline& brought = world.timelines[kCarton];
  brought.stays = {{10, kEver, there_}};
  brought.carries = {{{9, here_}, {10, there_}}};
  EXPECT_EQ(Changes(), "moved 1 at 60 carried; removed 2 at 80 carried; added 4 at 100 carried; ");
}

TEST_F(TrueChangesTest, ForgetWhatIsNotDoneWhenTimeIsUp) {
  world.timelines[kChair].stays = {{-kEver, 4, here_}, {6, kEver, there_}};
  world.timelines[kBear].stays = {{-kEver, 9, here_}, {9, kEver, there_}};
  world.timelines[kCarton].stays = {{-kEver, 3, here_}, {5.5, kEver, there_}};
  world.timelines[kCarton].carries = {{{3, here_}, {5.5, there_}}};
  EXPECT_EQ(Changes(5.0), "removed 1 at 40; ");
}

TEST_F(TrueChangesTest, DoNotCountWhatNeverRests) {
  world.timelines[kCarton].carries = {{{3, here_}, {5.5, there_}}};
  world.animations[kUmbrella] = [](double) { return std::nullopt; };
  EXPECT_EQ(Changes(), "");
}

TEST_F(TrueChangesTest, AreReplacementsIfAnotherClassComesNearby) {
  world.timelines[kChair].stays = {{-kEver, 5, here_}};
  world.timelines[kUmbrella].stays = {{7, kEver, near_}};
  EXPECT_EQ(Changes(), "replaced 1->3 at 70; ");
  const TrueChange change = BuildTrueChanges(world, observer, 20.0).at(0);
  EXPECT_EQ(change.new_class_id, 25);
  EXPECT_EQ(change.from->translation, here_.translation);
  EXPECT_EQ(change.to->translation, near_.translation);
}

TEST_F(TrueChangesTest, AreNoReplacementFarAwayOrOfTheSameClass) {
  world.timelines[kChair].stays = {{-kEver, 5, here_}};
  world.timelines[kUmbrella].stays = {{7, kEver, there_}};
  EXPECT_EQ(Changes(), "removed 1 at 50; added 3 at 70; ");
  world.timelines[kUmbrella].stays = {{7, kEver, near_}};
  world.scene.objects[kUmbrella].class_id = 56;
  EXPECT_EQ(Changes(), "removed 1 at 50; added 3 at 70; ");
}

TEST_F(TrueChangesTest, AreNoReplacementIfTheEmptyPlaceIsSeenInBetween) {
  world.timelines[kChair].stays = {{-kEver, 5, here_}};
  world.timelines[kUmbrella].stays = {{7, kEver, near_}};
  LookFrom(4.0, 5.0);
  LookFrom(7.0, 9.0);
  EXPECT_EQ(Changes(), "replaced 1->3 at 70; ");
  LookFrom(5.5, 5.7);
  EXPECT_EQ(Changes(), "removed 1 at 50; added 3 at 70; ");
}

TEST_F(TrueChangesTest, PairTheNearestIfTwoThingsGoAtOnce) {
  world.timelines[kChair].stays = {{-kEver, 5, here_}};
  world.timelines[kBear].stays = {{-kEver, 5, Standing(0, 2, 0.45)}};
  world.timelines[kUmbrella].stays = {{5, kEver, here_}};
  EXPECT_EQ(Changes(), "replaced 1->3 at 50; removed 2 at 50; ");
}

TEST_F(TrueObjectsTest, GiveBoxesAndPlacesOfAllButTheRoom) {
  const std::vector<TrueObject> objects = BuildTrueObjects(world, 20.0);
  ASSERT_EQ(objects.size(), 4U);
  const TrueObject& bear = objects[1];
  EXPECT_EQ(bear.instance, 2);
  EXPECT_EQ(bear.name, "bear");
  EXPECT_EQ(bear.class_id, 77);
  EXPECT_LT((bear.box_size_m - Eigen::Vector3d(0.4, 0.4, 0.4)).norm(), 1e-6);
  EXPECT_LT((bear.box_center - Eigen::Vector3d(0, 0, 0.2)).norm(), 1e-6);
  ASSERT_EQ(bear.intervals.size(), 1U);
  EXPECT_EQ(bear.intervals[0].from_s, 0.0);
  EXPECT_EQ(bear.intervals[0].to_s, 20.0);
  EXPECT_FALSE(bear.intervals[0].is_moving);
}

TEST_F(TrueObjectsTest, CutStaysAndCarriesToTheTimeRendered) {
  Timeline& timeline = world.timelines[kChair];
  timeline.stays = {{-kEver, 4, here_}, {8, kEver, there_}};
  timeline.carries = {{{4, here_}, {5, near_}, {8, there_}}};
  const auto intervals = BuildTrueObjects(world, 6.5).at(0).intervals;
  ASSERT_EQ(intervals.size(), 2U);
  EXPECT_EQ(intervals[0].to_s, 4.0);
  const TrueInterval& carry = intervals[1];
  EXPECT_TRUE(carry.is_moving);
  EXPECT_EQ(carry.to_s, 6.5);
  ASSERT_EQ(carry.poses.size(), 3U);
  EXPECT_EQ(carry.poses[1].time_s, 5.0);
  EXPECT_EQ(carry.poses[2].time_s, 6.5);
  EXPECT_NEAR(carry.poses[2].T_world_object.translation.x(), 1.15, 1e-9);
  const auto whole = BuildTrueObjects(world, 20.0).at(0).intervals;
  ASSERT_EQ(whole.size(), 3U);
  EXPECT_EQ(whole[1].poses.back().T_world_object.translation, there_.translation);
}

// A point that walks along x at 1 m/s with an arm that swings, there from 1.25 to 3.55 s.
std::optional<BodyShape> Walker(double time_s) {
  if (time_s < 1.25 || time_s >= 3.55) return std::nullopt;
  BodyShape shape;
  shape.T_world_body = Standing(time_s, 0, 0, std::numbers::pi / 2);
  const double reach_m = 0.3 * std::sin(5.0 * time_s);
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(reach_m, 0.2, 1.7)})
    shape.positions.push_back((shape.T_world_body * p).cast<float>());
  return shape;
}

TEST_F(TrueObjectsTest, FollowBodiesWhileTheyAreThere) {
  world.animations[kUmbrella] = Walker;
  const TrueObject body = BuildTrueObjects(world, 20.0).at(2);
  EXPECT_TRUE(body.is_deformable);
  ASSERT_EQ(body.intervals.size(), 1U);
  const TrueInterval& there = body.intervals[0];
  EXPECT_NEAR(there.from_s, 1.25, 2e-6);
  EXPECT_NEAR(there.to_s, 3.55, 2e-6);
  EXPECT_GE(there.from_s, 1.25);
  EXPECT_GE(there.to_s, 3.55);
  EXPECT_EQ(there.poses.front().time_s, there.from_s);
  EXPECT_LT(there.poses.back().time_s, 3.55);
  ASSERT_EQ(there.poses.size(), 25U);  // both ends and each tenth of a second from 1.3 to 3.5
  EXPECT_NEAR(there.poses[1].T_world_object.translation.x(), 1.3, 1e-9);
  EXPECT_NEAR(body.box_size_m.z(), 1.7, 1e-5);
  EXPECT_NEAR(body.box_size_m.y(), 0.2, 1e-5);
  EXPECT_NEAR(body.box_size_m.x(), 0.6, 0.02);
}

TEST_F(TrueObjectsTest, CutBodiesToTheTimeRendered) {
  world.animations[kUmbrella] = Walker;
  const auto intervals = BuildTrueObjects(world, 2.0).at(2).intervals;
  ASSERT_EQ(intervals.size(), 1U);
  EXPECT_EQ(intervals[0].to_s, 2.0);
  EXPECT_EQ(intervals[0].poses.back().time_s, 2.0);
  EXPECT_TRUE(BuildTrueObjects(world, 1.0).at(2).intervals.empty());
}

TEST_F(TruthTest, DetectionsAreExactBoxesOfKnownClasses) {
  cv::Mat instances = cv::Mat::zeros(48, 64, CV_16UC1);
  instances(cv::Rect(10, 20, 5, 6)) = kUmbrella;
  instances(cv::Rect(12, 18, 1, 1)) = kUmbrella;
  instances(cv::Rect(63, 47, 1, 1)) = kChair;
  instances(cv::Rect(30, 30, 5, 5)) = kCarton;
  const std::vector<RecordedDetection> detections = BuildDetections(instances, world.scene);
  ASSERT_EQ(detections.size(), 2U);
  EXPECT_EQ(detections[0].instance, kChair);
  EXPECT_EQ(detections[0].box, (Box{63, 47, 64, 48}));
  EXPECT_EQ(detections[0].visible_px, 1);
  EXPECT_EQ(detections[0].score, 1.0);
  EXPECT_EQ(detections[1].class_id, 25);
  EXPECT_EQ(detections[1].box, (Box{10, 18, 15, 26}));
  EXPECT_EQ(detections[1].visible_px, 31);
}

}  // namespace
}  // namespace cslam
