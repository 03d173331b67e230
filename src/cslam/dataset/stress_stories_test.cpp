// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/stress_stories.h"

#include "cslam/dataset/test_story_view.h"

#include <gtest/gtest.h>

#include <string>

namespace cslam {
namespace {

constexpr double kFrameS = 1.0 / 30.0;

using Maker = Story (*)(const Stage& stage, const StoryOptions& options);

Story Make(Maker make, bool is_short, std::uint64_t seed = 1) {
  const test::CoarseProps props;
  return make({props, nullptr}, {.seed = seed, .is_short = is_short, .texels_per_m = 30.0});
}

// Times of the frames that the camera jumps to.
std::vector<double> Jumps(const CameraMotion& motion) {
  std::vector<double> jumps_s;
  for (double t = 0.0; t + kFrameS < motion.duration_s; t += kFrameS) {
    const PoseDifference step =
        Difference(motion.T_world_camera(t), motion.T_world_camera(t + kFrameS));
    if (step.distance_m > 0.3) jumps_s.push_back(t + kFrameS);
  }
  return jumps_s;
}

struct StressCase {
  const char* name;
  Maker make;
  double duration_s;
  double short_duration_s;
};

class StressStory : public testing::TestWithParam<StressCase> {};

TEST_P(StressStory, LastsAsSaidMovesAsAHandAndStaysClearOfThings) {
  for (const bool is_short : {false, true}) {
    const Story story = Make(GetParam().make, is_short);
    EXPECT_DOUBLE_EQ(story.camera.duration_s,
                     is_short ? GetParam().short_duration_s : GetParam().duration_s);
    for (const test::Glimpse& glimpse : test::Survey(story, 1.0)) {
      EXPECT_GE(glimpse.nearest_m, 0.35);
      EXPECT_EQ(glimpse.empty_share, 0.0);
      EXPECT_EQ(glimpse.people_share, 0.0);
    }
    if (GetParam().make == MakeKidnapped) continue;
    const test::Fastest fastest = test::FastestOf(story.camera);
    EXPECT_LT(fastest.m_per_s, 0.9);
    EXPECT_LT(fastest.rad_per_s, 1.2);
  }
  EXPECT_LE(GetParam().short_duration_s, 40.0);
}

TEST_P(StressStory, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const Story one = Make(GetParam().make, true, 4);
  const Story same = Make(GetParam().make, true, 4);
  const Story other = Make(GetParam().make, true, 5);
  EXPECT_EQ(one.camera.T_world_camera(5.0).Matrix(), same.camera.T_world_camera(5.0).Matrix());
  EXPECT_NE(one.camera.T_world_camera(5.0).Matrix(), other.camera.T_world_camera(5.0).Matrix());
  ASSERT_EQ(one.world.scene.objects.size(), same.world.scene.objects.size());
  for (std::size_t i = 0; i < one.world.scene.objects.size(); ++i)
    EXPECT_EQ(one.world.scene.objects[i].mesh.uvs, same.world.scene.objects[i].mesh.uvs);
}

INSTANTIATE_TEST_SUITE_P(
    All, StressStory,
    testing::Values(StressCase{"kidnapped", MakeKidnapped, kKidnappedS, kShortKidnappedS},
                    StressCase{"dark", MakeDark, kDarkS, kShortDarkS},
                    StressCase{"plain_wall", MakePlainWall, kPlainWallS, kShortPlainWallS},
                    StressCase{"box_carried", MakeBoxCarried, kBoxCarriedS, kShortBoxCarriedS},
                    StressCase{"loop_corridor", MakeLoopCorridor, kLoopCorridorS,
                               kShortLoopCorridorS},
                    StressCase{"twins", MakeTwins, kTwinsS, kShortTwinsS}),
    [](const testing::TestParamInfo<StressCase>& one) { return std::string(one.param.name); });

TEST(MakeKidnapped, JumpsOnceInFullLightAndOnceInTheDarkToPlacesSeenBefore) {
  const Story story = Make(MakeKidnapped, false);
  const std::vector<double> jumps_s = Jumps(story.camera);
  ASSERT_EQ(jumps_s.size(), 2U);
  EXPECT_EQ(story.exposure(jumps_s[0]), 1.0);
  EXPECT_LT(story.exposure(jumps_s[1]), 0.01);
  EXPECT_LT(story.exposure(jumps_s[1] - 0.5), 0.01);
  for (const double jump_s : jumps_s) {
    double nearest_m = 10.0;
    for (double t = 0.0; t < 0.5 * story.camera.duration_s; t += 0.1) {
      const PoseDifference d =
          Difference(story.camera.T_world_camera(jump_s), story.camera.T_world_camera(t));
      if (d.angle_rad < 0.35) nearest_m = std::min(nearest_m, d.distance_m);
    }
    EXPECT_LT(nearest_m, 0.4);
  }
}

TEST(MakeDark, FadesAndIsSwitchedWithinOneFrame) {
  const Story story = Make(MakeDark, false);
  double darkest = 1.0;
  double largest_step = 0.0;
  for (double t = 0.0; t < story.camera.duration_s; t += kFrameS) {
    darkest = std::min(darkest, story.exposure(t));
    largest_step =
        std::max(largest_step, std::abs(story.exposure(t + kFrameS) - story.exposure(t)));
  }
  EXPECT_NEAR(darkest, 0.08, 1e-9);
  EXPECT_NEAR(largest_step, 0.92, 1e-6);
  EXPECT_EQ(story.exposure(0.0), 1.0);
  EXPECT_EQ(story.exposure(story.camera.duration_s), 1.0);
}

TEST(MakePlainWall, SeesLittleButWallAndFloorForHalfTheTime) {
  const Story story = Make(MakePlainWall, true);
  const std::vector<test::Glimpse> glimpses = test::Survey(story, 0.5);
  std::size_t plain = 0;
  for (const test::Glimpse& glimpse : glimpses) {
    double things = 0.0;
    for (const auto& [id, share] : glimpse.shares) {
      if (id != 0 && story.world.scene.objects[static_cast<std::size_t>(id)].name != "rug")
        things += share;
    }
    if (things < 0.1) ++plain;
  }
  EXPECT_GT(2 * plain, glimpses.size());
}

TEST(MakeBoxCarried, FillsMuchOfThePictureWithSomethingOfNoClass) {
  const Story story = Make(MakeBoxCarried, true);
  ASSERT_EQ(story.world.timelines.size(), 1U);
  EXPECT_TRUE(story.world.animations.empty());
  const int cart = story.world.timelines.begin()->first;
  EXPECT_EQ(story.world.scene.objects[static_cast<std::size_t>(cart)].class_id, kNoClass);
  const std::vector<test::Glimpse> glimpses = test::Survey(story, 0.5);
  double sum = 0.0;
  double peak = 0.0;
  for (const test::Glimpse& glimpse : glimpses) {
    const auto seen = glimpse.shares.find(cart);
    if (seen == glimpse.shares.end()) continue;
    sum += seen->second;
    peak = std::max(peak, seen->second);
  }
  EXPECT_GT(sum / static_cast<double>(glimpses.size()), 0.15);
  EXPECT_GT(peak, 0.4);
}

TEST(MakeLoopCorridor, ComesBackToItsFirstPlacesAfterFortyMetres) {
  const Story story = Make(MakeLoopCorridor, false);
  EXPECT_GT(test::FastestOf(story.camera).length_m, 40.0);
  const Se3 start = story.camera.T_world_camera(3.0);
  double nearest_m = 10.0;
  for (double t = 60.0; t < story.camera.duration_s; t += 0.1) {
    const PoseDifference d = Difference(start, story.camera.T_world_camera(t));
    if (d.angle_rad < 0.3) nearest_m = std::min(nearest_m, d.distance_m);
  }
  EXPECT_LT(nearest_m, 0.3);
}

TEST(MakeTwins, ShowsTheSameInBothRooms) {
  const Story story = Make(MakeTwins, false);
  const test::StoryView view(story, MakeSimulatedCamera(48, 36));
  const Se3 first = story.camera.T_world_camera(4.0);
  const double shift_m = 5.2;
  const Se3 second(first.rotation, first.translation + Eigen::Vector3d(shift_m, 0.0, 0.0));
  const test::Glimpse one = view.At(4.0, first);
  const test::Glimpse two = view.At(4.0, second);
  EXPECT_NEAR(one.nearest_m, two.nearest_m, 1e-4);
  ASSERT_EQ(one.shares.size(), two.shares.size());
  EXPECT_NEAR(one.shares.at(0), two.shares.at(0), 0.01);
  // The second half of the story is there.
  EXPECT_GT(story.camera.T_world_camera(0.9 * kTwinsS).translation.x(), shift_m);
}

}  // namespace
}  // namespace cslam
