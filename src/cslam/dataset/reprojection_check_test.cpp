// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/reprojection_check.h"

#include "cslam/dataset/test_story.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace cslam {
namespace {

using test::ExactStory;
using test::MemoryFrames;

constexpr std::size_t kAnchors = 15;  // of 60 frames

ReprojectionResult Check(const MemoryFrames& frames) {
  return CheckReprojection(frames, &*ExactStory().truth.objects, {.num_anchors = kAnchors});
}

TEST(CheckReprojection, AgreesWithinAMillimetreWhereDepthIsExact) {
  const ReprojectionResult result = Check(ExactStory().frames);
  EXPECT_GT(result.pairs.size(), 20U);
  EXPECT_GT(result.all.num_points, 50'000U);
  EXPECT_LT(result.all.p95_m, 0.001);
  EXPECT_LT(result.all.p95_per_tolerance, 1.0);
  EXPECT_LT(result.all.pierced_share, 0.001);
  for (const PairFigures& pair : result.pairs)
    EXPECT_LT(pair.figures.p95_m, 0.001) << pair.pair.a << " and " << pair.pair.b;
}

TEST(CheckReprojection, SeesADepthScaleThatIsOneInAHundredOff) {
  MemoryFrames frames = ExactStory().frames.Copy();
  for (cv::Mat& depth_m : frames.depths_m)
    depth_m *= 1.01;
  EXPECT_GT(Check(frames).all.p95_per_tolerance, 2.0);
}

TEST(CheckReprojection, SeesTwoSwappedPosesInTheirPairs) {
  MemoryFrames frames = ExactStory().frames.Copy();
  std::swap(frames.poses[6], frames.poses[15]);
  const ReprojectionResult result =
      CheckReprojection(frames, &*ExactStory().truth.objects, {.num_anchors = 40});
  const auto bad = std::count_if(result.pairs.begin(), result.pairs.end(), [](const auto& pair) {
    return pair.figures.median_m > 0.001 || pair.figures.pierced_share > 0.05;
  });
  EXPECT_GE(bad, 2);
  EXPECT_LE(bad, 8) << "only pairs with one of the two frames";
}

TEST(CheckReprojection, SeesMovedObjectsUnlessToldOfThem) {
  // Frame 10 is before the change, frame 50 looks at the same wall after it.
  MemoryFrames frames = ExactStory().frames.Copy();
  const ReprojectionResult told = Check(frames);
  frames.instances.clear();
  const ReprojectionResult untold = CheckReprojection(frames, nullptr, {.num_anchors = kAnchors});
  EXPECT_GT(untold.all.pierced_share, 10.0 * told.all.pierced_share + 0.005);
}

TEST(CheckReprojection, ComparesOnlyTheRoomWithoutObjects) {
  const ReprojectionResult room =
      CheckReprojection(ExactStory().frames, nullptr, {.num_anchors = kAnchors});
  EXPECT_LT(room.all.p95_m, 0.001);
  EXPECT_LT(room.all.num_points, Check(ExactStory().frames).all.num_points);
}

TEST(CheckReprojection, KnowsTheKinectsNoise) {
  const test::RenderedStory story = test::RenderStory(SensorNoise::kKinect);
  const ReprojectionResult result =
      CheckReprojection(story.frames, &*story.truth.objects,
                        {.num_anchors = kAnchors,
                         .tolerance = {.floor_m = 0.001, .per_square = 0.006},
                         .window_px = 2});
  EXPECT_GT(result.all.num_points, 10'000U);
  EXPECT_LT(result.all.p95_per_tolerance, 1.0);
  EXPECT_GT(result.all.p95_per_tolerance, 0.2) << "the tolerance is far too wide";
}

TEST(CheckReprojection, SkipsFramesWithoutPoseOrDepth) {
  MemoryFrames frames = ExactStory().frames.Copy();
  for (std::size_t i = 20; i < 60; ++i)
    frames.poses[i].reset();
  frames.depths_m[3].release();
  const ReprojectionResult result = Check(frames);
  EXPECT_GT(result.pairs.size(), 3U);
  for (const PairFigures& pair : result.pairs) {
    EXPECT_LT(pair.pair.a, 20U);
    EXPECT_LT(pair.pair.b, 20U);
    EXPECT_NE(pair.pair.a, 3U);
  }
}

TEST(ChoosePairs, TakesNeighboursAndReturnsToAView) {
  const std::vector<FramePair> pairs = ChoosePairs(ExactStory().frames, 40);
  const auto far = std::count_if(pairs.begin(), pairs.end(), [](const FramePair& pair) {
    return pair.b > pair.a + 20 || pair.a > pair.b + 20;
  });
  EXPECT_GT(far, 15);
  EXPECT_GT(static_cast<std::ptrdiff_t>(pairs.size()) - far, 30);
}

TEST(CheckReprojection, GivesNothingForASingleFrame) {
  MemoryFrames frames = ExactStory().frames;
  frames.stamps.resize(1);
  const ReprojectionResult result = Check(frames);
  EXPECT_TRUE(result.pairs.empty());
  EXPECT_EQ(result.all.num_points, 0U);
}

}  // namespace
}  // namespace cslam
