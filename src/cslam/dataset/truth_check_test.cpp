// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/truth_check.h"

#include "cslam/dataset/test_story.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>

namespace cslam {
namespace {

using test::ExactStory;
using test::kBear;
using test::kBox;
using test::kChair;
using test::kUmbrella;
using test::MemoryFrames;
using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Findings Check(const MemoryFrames& frames, const SequenceTruth& truth) {
  return CheckTruth(frames, truth, {}).errors;
}

RecordedDetection& DetectionOf(SequenceTruth& truth, std::size_t frame, int instance) {
  for (RecordedDetection& d : truth.detections->frames[frame].detections) {
    if (d.instance == instance) return d;
  }
  throw std::logic_error("no such detection");
}

TrueObject& ObjectOf(SequenceTruth& truth, int instance) {
  return truth.objects->objects[static_cast<std::size_t>(instance - 1)];
}

TEST(VisibleRegions, BoxesAndCountsEachInstance) {
  cv::Mat image(6, 8, CV_16UC1, cv::Scalar(0));
  image.at<std::uint16_t>(2, 3) = 5;
  image.at<std::uint16_t>(4, 1) = 5;
  image.at<std::uint16_t>(5, 7) = 300;
  const auto regions = VisibleRegions(image);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions.at(5).box, (Box{1, 2, 4, 5}));
  EXPECT_EQ(regions.at(5).num_px, 2);
  EXPECT_EQ(regions.at(300).box, (Box{7, 5, 8, 6}));
}

TEST(CheckTruth, FindsNothingInATrueStory) {
  const TruthCheckResult result = CheckTruth(ExactStory().frames, ExactStory().truth, {});
  EXPECT_THAT(result.errors, IsEmpty());
  EXPECT_EQ(result.num_frames, 60U);
  EXPECT_GT(result.num_posed, 100U);
  EXPECT_EQ(result.max_outside_share, 0.0);
}

TEST(CheckTruth, LooksAtAsManyFramesAsToldTo) {
  EXPECT_EQ(CheckTruth(ExactStory().frames, ExactStory().truth, {.num_samples = 7}).num_frames, 7U);
}

TEST(CheckTruth, SeesABoxThatIsOnePixelOff) {
  SequenceTruth truth = ExactStory().truth;
  DetectionOf(truth, 10, kChair).box.x_max += 1.0;
  EXPECT_THAT(Check(ExactStory().frames, truth),
              ElementsAre(AllOf(HasSubstr("frame 10"), HasSubstr("instance 1"))));
}

TEST(CheckTruth, SeesAWrongCountAMissingAndAnInventedDetection) {
  SequenceTruth truth = ExactStory().truth;
  ++DetectionOf(truth, 1, kChair).visible_px;
  std::erase_if(truth.detections->frames[2].detections,
                [](const auto& d) { return d.instance == kBear; });
  truth.detections->frames[3].detections.emplace_back().instance = kUmbrella;
  truth.detections->frames[3].detections.back().class_id = 25;
  EXPECT_THAT(Check(ExactStory().frames, truth),
              ElementsAre(HasSubstr("frame 1: "),
                          AllOf(HasSubstr("frame 2"), HasSubstr("not in detections")),
                          AllOf(HasSubstr("frame 3"), HasSubstr("not in the image"))));
}

TEST(CheckTruth, SeesClassesThatDisagreeOnce) {
  SequenceTruth truth = ExactStory().truth;
  ObjectOf(truth, kBear).class_id = 56;
  EXPECT_THAT(Check(ExactStory().frames, truth),
              ElementsAre(AllOf(HasSubstr("class 77"), HasSubstr("56 in objects.json"))));
}

TEST(CheckTruth, SeesObjectsThatAreThereWhileAway) {
  SequenceTruth truth = ExactStory().truth;
  ObjectOf(truth, kBear).intervals[0].to_s = 0.95;
  const Findings errors = Check(ExactStory().frames, truth);
  ASSERT_FALSE(errors.empty());
  EXPECT_THAT(errors.front(), AllOf(HasSubstr("'bear'"), HasSubstr("away")));
  EXPECT_THAT(errors.back(), HasSubstr("more instances seen while away"));
}

TEST(CheckTruth, SeesUnknownInstances) {
  SequenceTruth truth = ExactStory().truth;
  std::erase_if(truth.objects->objects, [](const auto& o) { return o.instance == kBox; });
  EXPECT_THAT(Check(ExactStory().frames, truth),
              Each(AnyOf(HasSubstr("instance 3"), HasSubstr("more unknown"))));
}

TEST(CheckTruth, SeesAnObjectThatStandsTwoCentimetresFromItsBox) {
  SequenceTruth truth = ExactStory().truth;
  ObjectOf(truth, kBox).intervals[0].poses[0].T_world_object.translation.x() += 0.02;
  const Findings errors = Check(ExactStory().frames, truth);
  ASSERT_FALSE(errors.empty());
  EXPECT_THAT(errors.front(), AllOf(HasSubstr("'box'"), HasSubstr("outside its box")));
}

TEST(CheckTruth, SeesMissingAndOddInstanceImages) {
  MemoryFrames frames = ExactStory().frames.Copy();
  frames.instances[4].release();
  frames.instances[7] = frames.instances[7](cv::Rect(0, 0, 80, 60)).clone();
  EXPECT_THAT(Check(frames, ExactStory().truth),
              ElementsAre(AllOf(HasSubstr("frame 4"), HasSubstr("missing")),
                          AllOf(HasSubstr("frame 7"), HasSubstr("80x60"))));
}

TEST(CheckTruth, SeesDetectionsOfOtherFrames) {
  SequenceTruth truth = ExactStory().truth;
  truth.detections->frames.erase(truth.detections->frames.begin());
  const Findings errors = Check(ExactStory().frames, truth);
  ASSERT_GE(errors.size(), 2U);
  EXPECT_THAT(errors[0], HasSubstr("has 59 frames, but the sequence 60"));
  EXPECT_THAT(errors[1], HasSubstr("stamp"));
}

TEST(CheckTruth, LeavesOutWhatIsNotThere) {
  MemoryFrames frames = ExactStory().frames;
  EXPECT_THAT(Check(frames, {}), IsEmpty());
  SequenceTruth truth = ExactStory().truth;
  truth.objects.reset();
  EXPECT_THAT(Check(frames, truth), IsEmpty());
  frames.instances.clear();
  EXPECT_THAT(Check(frames, ExactStory().truth), IsEmpty());
}

TEST(CheckTruth, KnowsTheNoise) {
  const test::RenderedStory story = test::RenderStory(SensorNoise::kKinect);
  TruthCheckOptions options{.num_samples = 12,
                            .tolerance = {.floor_m = 0.001, .per_square = 0.006},
                            .max_outside_share = 0.05};
  EXPECT_THAT(CheckTruth(story.frames, story.truth, options).errors, IsEmpty());
}

// changes.json ------------------------------------------------------------------------------------

Findings CheckStoryChanges(const TrueChanges& changes) {
  return CheckChanges(*ExactStory().truth.objects, changes);
}

TEST(CheckChanges, FindsNothingInATrueStory) {
  EXPECT_THAT(CheckStoryChanges(test::StoryChanges()), IsEmpty());
}

TEST(CheckChanges, MissesAChangeThatTheObjectsShow) {
  TrueChanges changes = test::StoryChanges();
  changes.changes.erase(changes.changes.begin());
  EXPECT_THAT(CheckStoryChanges(changes),
              ElementsAre(AllOf(HasSubstr("'chair'"), HasSubstr("moves at 3.000 s"))));
}

TEST(CheckChanges, SeesAChangeThatTheObjectsDoNotShow) {
  TrueChanges changes = test::StoryChanges();
  changes.changes.push_back(
      test::Change(ChangeKind::kRemoved, kBox, -1, Standing(-0.2, 2.5, 0), {}));
  EXPECT_THAT(CheckStoryChanges(changes),
              ElementsAre(AllOf(HasSubstr("instance 3"), HasSubstr("do not show it"))));
}

TEST(CheckChanges, SeesWrongTimesPosesAndClasses) {
  TrueChanges changes = test::StoryChanges();
  changes.changes[0].to->translation.x() += 0.1;
  changes.changes[1].time_s += 0.5;
  changes.changes[2].class_id = 26;
  const Findings findings = CheckStoryChanges(changes);
  EXPECT_THAT(findings, testing::Contains(
                            AllOf(HasSubstr("moved of instance 1"), HasSubstr("do not show it"))));
  EXPECT_THAT(findings, testing::Contains(AllOf(HasSubstr("removed of instance 2"),
                                                HasSubstr("do not show it"))));
  EXPECT_THAT(findings, testing::Contains(AllOf(HasSubstr("instance 4 has class 26"))));
}

TEST(CheckChanges, HoldsReplacementsToDistanceAndClass) {
  TrueChanges changes = test::StoryChanges();
  changes.changes[3].to->translation.y() += 1.0;
  EXPECT_THAT(CheckStoryChanges(changes), testing::Contains(HasSubstr("over 0.5 m")));
  changes = test::StoryChanges();
  changes.changes[3].new_class_id = 28;
  EXPECT_THAT(CheckStoryChanges(changes), Not(IsEmpty()));
  changes = test::StoryChanges();
  changes.changes[3].to.reset();
  EXPECT_THAT(CheckStoryChanges(changes), testing::Contains(HasSubstr("two poses")));
}

TEST(CheckChanges, SeesDisorderAndTimesBeyondTheEnd) {
  TrueChanges changes = test::StoryChanges();
  changes.changes[3].time_s = 7.0;
  EXPECT_THAT(CheckStoryChanges(changes), testing::Contains(HasSubstr("outside the sequence")));
  changes = test::StoryChanges();
  changes.changes[0].time_s = 3.5;
  EXPECT_THAT(CheckStoryChanges(changes), testing::Contains(HasSubstr("out of order")));
}

}  // namespace
}  // namespace cslam
