// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/office_day_story.h"

#include "cslam/dataset/test_story_view.h"
#include "cslam/dataset/visibility.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

Story Make(bool is_short, std::uint64_t seed = 1) {
  const test::CoarseProps props;
  return MakeOfficeDay({props, nullptr}, {.seed = seed, .is_short = is_short});
}

class OfficeDayForm : public testing::TestWithParam<bool> {};

TEST_P(OfficeDayForm, ChangesUnseenWhateverNobodyCarriesAndShowsItBeforeAndAfter) {
  for (const std::uint64_t seed : {1U, 2U}) {
    const Story story = Make(GetParam(), seed);
    const WorldBoxes boxes(story.world);
    const std::vector<SilentChange> changes = SilentChanges(story.world);
    EXPECT_EQ(changes.size(), GetParam() ? 1U : 3U);
    for (const SilentChange& change : changes) {
      const ChangeViews views =
          ViewsAround(boxes, story.camera, MakeSimulatedCamera(640, 480), change, {});
      const auto& name = story.world.scene.objects[static_cast<std::size_t>(change.instance)].name;
      EXPECT_GT(views.unseen_before_s, 0.3) << name;
      EXPECT_GT(views.unseen_after_s, 0.3) << name;
      EXPECT_GT(views.before_s, 1.0) << name;
      if (change.from) {
        EXPECT_GT(views.old_after_s, 1.0) << name;
      }
      if (change.to) {
        EXPECT_GT(views.new_after_s, 1.0) << name;
      }
    }
  }
}

TEST_P(OfficeDayForm, ShowsWhatIsCarriedWhileItIsCarried) {
  const Story story = Make(GetParam());
  const test::StoryView view(story, MakeSimulatedCamera(80, 60));
  int carries = 0;
  for (const auto& [id, timeline] : story.world.timelines) {
    for (const Carry& carry : timeline.carries) {
      ++carries;
      int glimpses = 0;
      for (double t = carry.front().time_s; t < carry.back().time_s; t += 0.25) {
        const test::Glimpse glimpse = view.At(t, story.camera.T_world_camera(t));
        const auto seen = glimpse.shares.find(id);
        if (seen != glimpse.shares.end() && seen->second > 0.003) ++glimpses;
      }
      EXPECT_GE(glimpses, 4) << story.world.scene.objects[static_cast<std::size_t>(id)].name;
      EXPECT_LT(Difference(StateAt(timeline, carry.back().time_s - 1e-6).T_world_object,
                           StateAt(timeline, carry.back().time_s).T_world_object)
                    .distance_m,
                1e-3);
      EXPECT_LT(Difference(StateAt(timeline, carry.front().time_s - 1e-6).T_world_object,
                           StateAt(timeline, carry.front().time_s).T_world_object)
                    .distance_m,
                1e-3);
    }
  }
  EXPECT_EQ(carries, GetParam() ? 1 : 2);
}

TEST_P(OfficeDayForm, KeepsClaimsAndClearances) {
  const Story story = Make(GetParam());
  EXPECT_DOUBLE_EQ(story.camera.duration_s, GetParam() ? kShortOfficeDayS : kOfficeDayS);
  double sum = 0.0;
  double peak = 0.0;
  const std::vector<test::Glimpse> glimpses = test::Survey(story, 1.0);
  for (const test::Glimpse& glimpse : glimpses) {
    sum += glimpse.people_share;
    peak = std::max(peak, glimpse.people_share);
    EXPECT_GE(glimpse.nearest_m, 0.35);
    EXPECT_EQ(glimpse.empty_share, 0.0);
  }
  EXPECT_GE(sum / static_cast<double>(glimpses.size()), story.people.min_mean_share);
  EXPECT_GE(peak, story.people.min_peak_share);
  const test::Clearance clearance = test::ClearanceOf(story, 0.5);
  EXPECT_GE(clearance.people_m, 0.55);
  EXPECT_GE(clearance.things_m, 0.15);
  EXPECT_GE(clearance.camera_m, 0.6);
  const test::Fastest fastest = test::FastestOf(story.camera);
  EXPECT_LT(fastest.m_per_s, 1.0);
  EXPECT_LT(fastest.rad_per_s, 1.6);
}

INSTANTIATE_TEST_SUITE_P(WholeAndShort, OfficeDayForm, testing::Bool());

}  // namespace
}  // namespace cslam
