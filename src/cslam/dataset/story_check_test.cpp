// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/story_check.h"

#include "cslam/dataset/test_story.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace cslam {
namespace {

using test::ExactStory;
using test::kChair;
using test::MemoryFrames;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(CheckStory, ProvesEachChangeOfATrueStory) {
  const StoryEvidence evidence = CheckStory(ExactStory().frames, ExactStory().truth, {});
  EXPECT_THAT(evidence.errors, IsEmpty());
  EXPECT_THAT(evidence.warnings, IsEmpty());
  ASSERT_EQ(evidence.changes.size(), 4U);
  for (const ChangeEvidence& e : evidence.changes) {
    EXPECT_FALSE(e.is_in_view_when_it_happens);
    EXPECT_GT(e.num_views_before, 5U) << NameOf(e.change.kind);
    EXPECT_GT(e.num_views_after, 5U) << NameOf(e.change.kind);
    ASSERT_TRUE(e.last_view_before_s && e.first_view_after_s);
    EXPECT_GT(*e.last_view_before_s, 1.5);
    EXPECT_LT(*e.last_view_before_s, 2.8);
    EXPECT_GT(*e.first_view_after_s, 3.3);
    EXPECT_LT(*e.first_view_after_s, 4.5);
  }
}

TEST(CheckStory, ComesToTheSameFromImagesAlone) {
  SequenceTruth truth = ExactStory().truth;
  truth.detections.reset();
  const StoryEvidence evidence = CheckStory(ExactStory().frames, truth, {});
  EXPECT_THAT(evidence.errors, IsEmpty());
  EXPECT_FALSE(evidence.people);
  for (const ChangeEvidence& e : evidence.changes)
    EXPECT_GT(e.num_views_before, 5U);
}

// The chair moves at another time than 3 s.
SequenceTruth ChairMovesAt(double time_s) {
  SequenceTruth truth = ExactStory().truth;
  truth.changes->changes = {truth.changes->changes[0]};
  truth.changes->changes[0].time_s = time_s;
  return truth;
}

TEST(CheckStory, SeesAChangeThatHappensInView) {
  const SequenceTruth truth = ChairMovesAt(1.0);
  const StoryEvidence evidence = CheckStory(ExactStory().frames, truth, {});
  EXPECT_TRUE(evidence.changes[0].is_in_view_when_it_happens);
  EXPECT_THAT(evidence.errors,
              ElementsAre(AllOf(HasSubstr("'chair'"), HasSubstr("sees it happen"))));
}

TEST(CheckStory, LetsThingsBeCarriedInView) {
  SequenceTruth truth = ChairMovesAt(1.0);
  truth.changes->changes[0].is_carried_in_view = true;
  EXPECT_THAT(CheckStory(ExactStory().frames, truth, {}).errors, IsEmpty());
}

TEST(CheckStory, DoesNotAskForMoreOfWhatIsSeenOnItsWay) {
  SequenceTruth truth = ChairMovesAt(0.0);
  truth.changes->changes[0].is_carried_in_view = true;
  const StoryEvidence evidence = CheckStory(ExactStory().frames, truth, {});
  EXPECT_EQ(evidence.changes[0].num_views_before, 0U);
  EXPECT_THAT(evidence.errors, IsEmpty());
}

TEST(CheckStory, MissesAnObjectThatIsNeverInViewBefore) {
  SequenceTruth truth = ChairMovesAt(3.0);
  for (std::size_t i = 0; i < 30; ++i) {
    std::erase_if(truth.detections->frames[i].detections,
                  [](const auto& d) { return d.instance == kChair; });
  }
  EXPECT_THAT(CheckStory(ExactStory().frames, truth, {}).errors,
              ElementsAre(HasSubstr("never in view before")));
}

TEST(CheckStory, TakesWhatStandsInThePlaceNowForProof) {
  // Where the bear was, a chair is painted over the wall and in front of it.
  MemoryFrames frames = ExactStory().frames.Copy();
  SequenceTruth truth = ExactStory().truth;
  truth.changes->changes = {truth.changes->changes[1]};
  const TrueObject& bear = truth.objects->objects[test::kBear - 1];
  for (std::size_t i = 30; i < frames.size(); ++i) {
    const Se3 T_camera_world = frames.poses[i]->Inverse();
    for (double x = -0.15; x <= 0.15; x += 0.01) {
      for (double z = 0.02; z <= 0.48; z += 0.01) {
        const Eigen::Vector3d p = T_camera_world * (bear.intervals[0].poses[0].T_world_object *
                                                    Eigen::Vector3d(x, -0.14, z));
        if (p.z() < 0.5) continue;
        const Eigen::Vector2d uv = Project(frames.camera(), p);
        if (uv.x() < 0 || uv.y() < 0 || uv.x() > 158 || uv.y() > 118) continue;
        const cv::Point pixel(static_cast<int>(std::lround(uv.x())),
                              static_cast<int>(std::lround(uv.y())));
        frames.depths_m[i].at<float>(pixel) = static_cast<float>(p.z());
        frames.instances[i].at<std::uint16_t>(pixel) = kChair;
      }
    }
  }
  EXPECT_THAT(CheckStory(frames, truth, {}).errors, IsEmpty());
  frames.instances.clear();
  EXPECT_THAT(CheckStory(frames, truth, {}).errors, ElementsAre(HasSubstr("empty place")));
}

TEST(CheckStory, TakesWhatCameToStandBeforeThePlaceForProof) {
  SequenceTruth truth = ExactStory().truth;
  TrueChange box_goes =
      test::Change(ChangeKind::kRemoved, test::kBox, kNoClass, Standing(-0.2, 2.5, 0.0), {});
  truth.changes->changes = {box_goes};
  EXPECT_EQ(CheckStory(ExactStory().frames, truth, {}).errors.size(), 1U);
  TrueChange umbrella_comes =
      test::Change(ChangeKind::kAdded, test::kUmbrella, 25, {}, Standing(0.0, 2.1, 0.0));
  truth.changes->changes = {box_goes, umbrella_comes};
  EXPECT_THAT(CheckStory(ExactStory().frames, truth, {}).errors, IsEmpty());
}

// A story whose end is not rendered: the camera never looks back.
struct CutStory {
  MemoryFrames frames = ExactStory().frames;
  SequenceTruth truth = ExactStory().truth;

  CutStory() {
    frames.stamps.resize(33);
    truth.detections->frames.resize(33);
    truth.objects->duration_s = 3.3;
  }
};

TEST(CheckStory, MissesWhatIsNeverInViewAfterwardsUnlessTheStoryIsCut) {
  const CutStory cut;
  const StoryEvidence whole = CheckStory(cut.frames, cut.truth, {});
  EXPECT_EQ(whole.errors.size(), 4U);
  EXPECT_THAT(whole.errors, Contains(AllOf(HasSubstr("'bear'"), HasSubstr("empty place"))));
  const StoryEvidence evidence = CheckStory(cut.frames, cut.truth, {.is_whole = false});
  EXPECT_THAT(evidence.errors, IsEmpty());
  EXPECT_EQ(evidence.warnings.size(), 4U);
}

TEST(CheckStory, DoesNotTakeAnObjectThatIsStillThereForRemoved) {
  SequenceTruth truth = ExactStory().truth;
  // The box never goes, whatever is said.
  truth.changes->changes = {
      test::Change(ChangeKind::kRemoved, test::kBox, kNoClass, Standing(-0.2, 2.5, 0.0), {})};
  const StoryEvidence evidence = CheckStory(ExactStory().frames, truth, {});
  EXPECT_EQ(evidence.changes[0].num_views_after, 0U);
  EXPECT_THAT(evidence.errors, ElementsAre(HasSubstr("empty place is never in view")));
}

TEST(CheckStory, MeasuresPeople) {
  const StoryEvidence evidence = CheckStory(ExactStory().frames, ExactStory().truth, {});
  ASSERT_TRUE(evidence.people);
  EXPECT_GT(evidence.people->peak_share, 0.1);
  EXPECT_LT(evidence.people->peak_share, 0.5);
  EXPECT_GT(evidence.people->mean_share, 0.01);
  EXPECT_LT(evidence.people->mean_share, evidence.people->peak_share);
  EXPECT_TRUE(evidence.people->leave_view);
}

TEST(CheckStory, HoldsPeopleToTheClaim) {
  StoryCheckOptions options;
  options.people = {.min_mean_share = 0.9, .min_peak_share = 0.95, .leave_view = true};
  EXPECT_THAT(CheckStory(ExactStory().frames, ExactStory().truth, options).errors,
              ElementsAre(HasSubstr("on average"), HasSubstr("at most")));
  options.is_whole = false;
  const StoryEvidence cut = CheckStory(ExactStory().frames, ExactStory().truth, options);
  EXPECT_THAT(cut.errors, IsEmpty());
  EXPECT_EQ(cut.warnings.size(), 2U);
}

TEST(CheckStory, HoldsPeopleToLeaving) {
  SequenceTruth truth = ExactStory().truth;
  truth.detections->frames.resize(8);
  truth.detections->frames.erase(truth.detections->frames.begin(),
                                 truth.detections->frames.begin() + 2);
  StoryCheckOptions options;
  options.people.leave_view = true;
  EXPECT_THAT(CheckStory(ExactStory().frames, truth, options).errors,
              Contains(HasSubstr("never leave")));
}

}  // namespace
}  // namespace cslam
