// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/dynamic_stories.h"

#include "cslam/dataset/test_story_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace cslam {
namespace {

constexpr double kStepS = 0.5;

struct DynamicCase {
  const char* name;
  Story (*make)(const Stage& stage, const StoryOptions& options);
  double duration_s;
};

class DynamicStory : public testing::TestWithParam<DynamicCase> {
 protected:
  Story Make(std::uint64_t seed, bool is_short) const {
    const test::CoarseProps props;
    return GetParam().make({props, nullptr}, {.seed = seed, .is_short = is_short});
  }
};

// The claims, over the first `count` glimpses.
void ExpectPeople(const std::vector<test::Glimpse>& glimpses, std::size_t count,
                  const PeopleClaim& claim) {
  double sum = 0.0;
  double peak = 0.0;
  bool was_seen = false;
  bool was_left = false;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = glimpses[i].people_share;
    sum += share;
    peak = std::max(peak, share);
    was_seen = was_seen || share > 0.0;
    was_left = was_left || (was_seen && share == 0.0);
  }
  EXPECT_GE(sum / static_cast<double>(count), claim.min_mean_share);
  EXPECT_GE(peak, claim.min_peak_share);
  EXPECT_TRUE(was_left || !claim.leave_view);
}

TEST_P(DynamicStory, ShowsAsManyPeopleAsItClaimsWholeAndShort) {
  const Story story = Make(1, false);
  EXPECT_DOUBLE_EQ(story.camera.duration_s, GetParam().duration_s);
  const std::vector<test::Glimpse> glimpses = test::Survey(story, kStepS);
  ExpectPeople(glimpses, glimpses.size(), story.people);
  ExpectPeople(glimpses, static_cast<std::size_t>(kShortDynamicS / kStepS), story.people);
  for (const test::Glimpse& glimpse : glimpses) {
    EXPECT_GE(glimpse.nearest_m, 0.35);
    EXPECT_EQ(glimpse.empty_share, 0.0);
  }
}

TEST_P(DynamicStory, KeepsPeopleClearOfEachOtherOfThingsAndOfTheCamera) {
  const test::Clearance clearance = test::ClearanceOf(Make(2, false), kStepS);
  EXPECT_GE(clearance.people_m, 0.55);
  EXPECT_GE(clearance.things_m, 0.2);
  EXPECT_GE(clearance.camera_m, 0.55);
}

TEST_P(DynamicStory, IsInItsShortFormTheBeginningOfTheWhole) {
  const Story whole = Make(3, false);
  const Story part = Make(3, true);
  EXPECT_DOUBLE_EQ(part.camera.duration_s, kShortDynamicS);
  for (const double t : {1.0, 9.0, 15.0}) {
    EXPECT_TRUE(part.camera.T_world_camera(t).Matrix().isApprox(
        whole.camera.T_world_camera(t).Matrix(), 1e-9));
    for (const auto& [id, animation] : part.world.animations) {
      const Eigen::Vector3d difference = animation(t)->T_world_body.translation -
                                         whole.world.animations.at(id)(t)->T_world_body.translation;
      EXPECT_LT(difference.norm(), 0.01) << "at " << t;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    AfterTum, DynamicStory,
    testing::Values(DynamicCase{"sitting_xyz", MakeSittingXyz, kSittingXyzS},
                    DynamicCase{"walking_static", MakeWalkingStatic, kWalkingStaticS},
                    DynamicCase{"walking_xyz", MakeWalkingXyz, kWalkingXyzS},
                    DynamicCase{"walking_rpy", MakeWalkingRpy, kWalkingRpyS},
                    DynamicCase{"walking_halfsphere", MakeWalkingHalfsphere, kWalkingHalfsphereS}),
    [](const testing::TestParamInfo<DynamicCase>& one) { return std::string(one.param.name); });

TEST(MakeWalkingXyz, IsTheSameForTheSameSeed) {
  const test::CoarseProps props;
  const StoryOptions options{.seed = 4, .is_short = true};
  const Story one = MakeWalkingXyz({props, nullptr}, options);
  const Story two = MakeWalkingXyz({props, nullptr}, options);
  ASSERT_EQ(one.world.scene.objects.size(), two.world.scene.objects.size());
  for (std::size_t i = 0; i < one.world.scene.objects.size(); ++i) {
    EXPECT_EQ(one.world.scene.objects[i].mesh.positions, two.world.scene.objects[i].mesh.positions);
    EXPECT_EQ(one.world.scene.objects[i].T_world_object.Matrix(),
              two.world.scene.objects[i].T_world_object.Matrix());
  }
  for (const auto& [id, animation] : one.world.animations)
    EXPECT_EQ(animation(5.0)->positions, two.world.animations.at(id)(5.0)->positions);
  EXPECT_EQ(one.camera.T_world_camera(5.0).Matrix(), two.camera.T_world_camera(5.0).Matrix());
}

}  // namespace
}  // namespace cslam
