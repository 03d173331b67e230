// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/story_check.h"

#include "cslam/dataset/test_story.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(CheckStory, MissesAnObjectThatIsNeverInViewBefore) {
  SequenceTruth truth = ChairMovesAt(3.0);
  for (std::size_t i = 0; i < 30; ++i) {
    std::erase_if(truth.detections->frames[i].detections,
                  [](const auto& d) { return d.instance == kChair; });
  }
  EXPECT_THAT(CheckStory(ExactStory().frames, truth, {}).errors,
              ElementsAre(HasSubstr("never in view before")));
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
