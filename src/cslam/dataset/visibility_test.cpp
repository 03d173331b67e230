// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/visibility.h"

#include "cslam/sim/camera_path.h"
#include "cslam/sim/scene_builder.h"
#include "cslam/sim/simulated_sequence.h"

#include <gtest/gtest.h>

#include <numbers>

namespace cslam {
namespace {

// At the origin, 0.5 m high, looking along +x.
const Se3 kLooksAlongX = PoseAt({{0.0, 0.0, 0.5}, 0.0, 0.0});

PlacedBox CubeAt(double x, double y, double size_m) {
  return {Standing(x, y, 0.5), Eigen::Vector3d::Constant(size_m)};
}

Camera SmallCamera() {
  return MakeD435iCamera(160, 120);
}

TEST(DistanceTo, IsZeroInsideAndTheStraightWayOutside) {
  const PlacedBox turned{Standing(1.0, 0.0, 0.0, 0.25 * std::numbers::pi), {1.0, 1.0, 1.0}};
  EXPECT_DOUBLE_EQ(DistanceTo(turned, {1.0, 0.1, 0.2}), 0.0);
  EXPECT_NEAR(DistanceTo(turned, {0.0, 0.0, 0.0}), 1.0 - std::sqrt(0.5), 1e-9);
}

TEST(MayBeInView, IsFalseBehindBesideAndAboveThePicture) {
  const Camera camera = SmallCamera();
  EXPECT_TRUE(MayBeInView(CubeAt(2.0, 0.0, 0.5), camera, kLooksAlongX, 0.0));
  EXPECT_FALSE(MayBeInView(CubeAt(-2.0, 0.0, 0.5), camera, kLooksAlongX, 0.0));
  EXPECT_FALSE(MayBeInView(CubeAt(2.0, 2.0, 0.5), camera, kLooksAlongX, 0.0));
  PlacedBox above = CubeAt(2.0, 0.0, 0.5);
  above.T_world_box.translation.z() = 2.0;
  EXPECT_FALSE(MayBeInView(above, camera, kLooksAlongX, 0.0));
}

TEST(MayBeInView, IsTrueForABoxAroundTheCameraAndForABoxAcrossThePicture) {
  EXPECT_TRUE(MayBeInView(CubeAt(0.0, 0.0, 1.0), SmallCamera(), kLooksAlongX, 0.0));
  const PlacedBox beam{Standing(2.0, 0.0, 0.5), {0.1, 20.0, 0.1}};
  EXPECT_TRUE(MayBeInView(beam, SmallCamera(), kLooksAlongX, 0.0));
}

TEST(MayBeInView, CountsWhatIsWithinTheMargin) {
  const PlacedBox box = CubeAt(2.0, 1.4, 0.4);  // ends 4 px left of the picture
  EXPECT_FALSE(MayBeInView(box, SmallCamera(), kLooksAlongX, 1.0));
  EXPECT_TRUE(MayBeInView(box, SmallCamera(), kLooksAlongX, 10.0));
}

TEST(ViewOf, MeasuresABoxInTheMiddle) {
  const Camera camera = SmallCamera();
  const BoxView view = ViewOf(CubeAt(2.0, 0.0, 0.4), camera, kLooksAlongX, {});
  const double side_px = camera.fx * 0.4 / 1.8;
  EXPECT_NEAR(view.picture_share, side_px * side_px / (160 * 120), 1e-3);
  EXPECT_DOUBLE_EQ(view.inside_share, 1.0);
  EXPECT_DOUBLE_EQ(view.clear_share, 1.0);
}

TEST(ViewOf, SeesLessBehindAnotherBoxAndAtTheEdge) {
  const PlacedBox cube = CubeAt(2.0, 0.0, 0.4);
  const PlacedBox screen{Standing(1.0, 0.25, 0.5), {0.1, 0.5, 0.5}};  // hides the left half
  const BoxView hidden = ViewOf(cube, SmallCamera(), kLooksAlongX, {&screen, 1});
  EXPECT_DOUBLE_EQ(hidden.inside_share, 1.0);
  EXPECT_NEAR(hidden.clear_share, 0.5, 0.01);
  const BoxView cut = ViewOf(CubeAt(2.0, 1.04, 0.4), SmallCamera(), kLooksAlongX, {});
  EXPECT_GT(cut.inside_share, 0.2);
  EXPECT_LT(cut.inside_share, 0.8);
}

TEST(ViewOf, LooksIntoABoxThatHoldsTheThing) {
  const PlacedBox around = CubeAt(2.0, 0.0, 0.8);
  EXPECT_DOUBLE_EQ(
      ViewOf(CubeAt(2.0, 0.0, 0.4), SmallCamera(), kLooksAlongX, {&around, 1}).clear_share, 1.0);
}

// A cube that is 2 m ahead until 10 s, then 2 m to the left; the camera looks ahead until 4 s,
// backwards until 16 s, and then to the left.
struct TurningWorld {
  World world;
  CameraMotion motion;
};

TurningWorld MakeTurningWorld() {
  SceneBuilder scene(1, 10.0);
  const int paint = scene.AddPicture(cv::Mat(2, 2, CV_8UC3, cv::Scalar::all(99)));
  const auto add = [&](const char* name, const Se3& T) {
    return scene.AddBox(name, kNoClass, T, Eigen::Vector3d::Constant(0.6), Uniform(paint));
  };
  add("room", Standing(50.0, 0.0, 0.0));
  const int cube = add("cube", Standing(2.0, 0.0, 0.2));
  TurningWorld made;
  made.world.scene = scene.Take({});
  made.world.timelines[cube].stays = {{.to_s = 10.0, .T_world_object = Standing(2.0, 0.0, 0.2)},
                                      {.from_s = 10.0, .T_world_object = Standing(0.0, 2.0, 0.2)}};
  made.motion.duration_s = 20.0;
  made.motion.T_world_camera = [](double t) {
    const double quarters = t < 4.0 ? 0.0 : (t < 16.0 ? 2.0 : 1.0);
    return PoseAt({{0.0, 0.0, 0.5}, quarters * 0.5 * std::numbers::pi, 0.0});
  };
  return made;
}

TEST(SilentChanges, FindsMovesComingsAndGoings) {
  World world = MakeTurningWorld().world;
  world.timelines[1].stays.back().to_s = 15.0;
  world.timelines[1].stays.push_back({.from_s = 18.0, .T_world_object = Se3()});
  const std::vector<SilentChange> changes = SilentChanges(world);
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_TRUE(changes[0].from && changes[0].to);
  EXPECT_TRUE(changes[1].from && !changes[1].to);
  EXPECT_TRUE(!changes[2].from && changes[2].to);
  EXPECT_DOUBLE_EQ(changes[1].since_s, 10.0);
  EXPECT_DOUBLE_EQ(changes[1].until_s, 18.0);
}

TEST(ViewsAround, TellsWhenThePlacesOfAChangeAreSeen) {
  const TurningWorld made = MakeTurningWorld();
  const WorldBoxes boxes(made.world);
  const std::vector<SilentChange> changes = SilentChanges(made.world);
  ASSERT_EQ(changes.size(), 1U);
  const ChangeViews views = ViewsAround(boxes, made.motion, SmallCamera(), changes[0], {});
  EXPECT_NEAR(views.unseen_before_s, 6.0, 0.15);
  EXPECT_NEAR(views.unseen_after_s, 6.0, 0.15);
  EXPECT_NEAR(views.before_s, 4.0, 0.15);
  EXPECT_NEAR(views.old_after_s, 0.0, 0.15);
  EXPECT_NEAR(views.new_after_s, 4.0, 0.15);
}

}  // namespace
}  // namespace cslam
