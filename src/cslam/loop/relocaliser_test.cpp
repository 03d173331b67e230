// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/relocaliser.h"

#include "cslam/map/test_room.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

constexpr std::uint32_t kFrame = 1000;  // seeds the noise of frames that are not in the map

PlaceSensor RoomSensor() {
  const Camera camera = test::RoomCamera();
  return {camera, UndistortedBounds(camera), test::kRoomBaselineM,
          MeasurementModel(test::kRoomScales, 1.0)};
}

PlaceIndex IndexOf(const MapView& map) {
  PlaceIndex index;
  for (const KeyframeId id : map.Keyframes()) {
    const Keyframe& keyframe = *map.FindKeyframe(id);
    index.Add(id, SelectDescriptors(keyframe.data->features, PlaceKeypoints(map, keyframe)));
  }
  return index;
}

// Two maps of one room: map 0 of its first quarter, map 1, which lies elsewhere, of its third.
const Se3 kTOtherWorld(ExpSo3({0.0, 0.7, 0.0}), {5.0, 0.0, 2.0});

test::RoomMapper TwoMaps() {
  test::RoomMapper mapper(test::MakeRoom(1500, 3));
  KeyframeId last;
  for (int i = 0; i < 6; ++i)
    last = mapper.Add(test::CirclePose(0.05 * i), test::CirclePose(0.05 * i), last);
  last = KeyframeId();
  for (int i = 10; i < 16; ++i) {
    const Se3 T_true = test::CirclePose(0.05 * i);
    last = mapper.Add(T_true, kTOtherWorld * T_true, last, MapId(1));
  }
  return mapper;
}

class RelocaliserTest : public testing::Test {
 protected:
  FrameFeatures Look(double turn) {
    return test::LookAtRoom(mapper_.room(), mapper_.camera(), test::CirclePose(turn), kFrame)
        .data->features;
  }
  RelocalisationResult Find(const FrameFeatures& features, const MapFilter& may_search = {}) {
    return relocaliser_.Find(features, mapper_.map(), index_, may_search);
  }

  test::RoomMapper mapper_ = TwoMaps();
  PlaceIndex index_ = IndexOf(mapper_.map());
  const Relocaliser relocaliser_{RoomSensor(), RelocaliserOptions{}};
};

TEST_F(RelocaliserTest, FindsAFrameInWhicheverMapKnowsItsPlace) {
  for (const bool in_second : {false, true}) {
    const double turn = in_second ? 0.62 : 0.12;
    const RelocalisationResult result = Find(Look(turn));
    ASSERT_TRUE(result.found) << result.reason;
    EXPECT_EQ(result.found->map, MapId(in_second ? 1 : 0));
    const Se3 truth = (in_second ? kTOtherWorld : Se3()) * test::CirclePose(turn);
    EXPECT_LT(Difference(truth, result.found->T_world_camera).distance_m, 0.01);
  }
}

TEST_F(RelocaliserTest, StatesThePoseRelativeToAKeyframeOfThatMap) {
  const RelocalisationResult result = Find(Look(0.62));
  ASSERT_TRUE(result.found);
  const Keyframe& reference = *mapper_.map().FindKeyframe(result.found->reference);
  EXPECT_EQ(reference.map, MapId(1));
  EXPECT_LT(Difference(reference.T_world_camera * result.found->T_reference_camera,
                       result.found->T_world_camera)
                .distance_m,
            1e-9);
}

TEST_F(RelocaliserTest, SearchesOnlyTheMapsItMay) {
  const auto only_first = [](MapId map) { return map == MapId(0); };
  EXPECT_FALSE(Find(Look(0.62), only_first).found);
  EXPECT_TRUE(Find(Look(0.12), only_first).found);
}

TEST_F(RelocaliserTest, SaysWhyAnUnknownPlaceIsNotFound) {
  const RelocalisationResult result = Find(Look(0.9));
  EXPECT_FALSE(result.found);
  EXPECT_FALSE(result.reason.empty());
}

TEST_F(RelocaliserTest, RefusesAPlaceThatMeasuredDepthContradicts) {
  const test::RoomView frame =
      test::LookAtRoom(mapper_.room(), mapper_.camera(), test::CirclePose(0.12), kFrame);
  const FrameFeatures& features = frame.data->features;
  const cv::Mat seen = frame.data->depth_small_mm;
  EXPECT_TRUE(relocaliser_.Find(features, mapper_.map(), index_, {}, seen).found);
  const cv::Mat wall(seen.size(), CV_16UC1, cv::Scalar(600));  // right before the camera
  const RelocalisationResult result = relocaliser_.Find(features, mapper_.map(), index_, {}, wall);
  EXPECT_FALSE(result.found);
  EXPECT_NE(result.reason.find("depth contradicts"), std::string::npos) << result.reason;
}

TEST_F(RelocaliserTest, FindsNothingInAnEmptyMap) {
  const RelocalisationResult result = relocaliser_.Find(Look(0.12), MapView(), PlaceIndex(), {});
  EXPECT_FALSE(result.found);
  EXPECT_EQ(result.reason, "nothing in the map looks like it");
}

TEST_F(RelocaliserTest, FindsNothingWithoutFeatures) {
  EXPECT_FALSE(Find(FrameFeatures{}).found);
}

TEST_F(RelocaliserTest, PassesOverKeyframesThatTheMapNoLongerHas) {
  mapper_.map().CullKeyframe(KeyframeId(2));
  const RelocalisationResult result = Find(Look(0.12));
  ASSERT_TRUE(result.found) << result.reason;
  for (const PlaceCandidate& candidate : result.candidates)
    EXPECT_NE(candidate.keyframe, KeyframeId(2));
}

// Two corners of a room that look alike: nobody can tell them apart.
TEST(Relocaliser, RefusesToChooseBetweenTwoPlacesThatLookAlike) {
  test::RoomMapper mapper(test::MakeRoom(1500, 3));
  KeyframeId last;
  for (int i = 0; i < 6; ++i)
    last = mapper.Add(test::CirclePose(0.05 * i), test::CirclePose(0.05 * i), last);
  const Se3 T_twin(Eigen::Quaterniond::Identity(), {20.0, 0.0, 0.0});
  for (int i = 20; i < 26; ++i) {
    const Se3 T_true = test::CirclePose(0.05 * i);  // one turn on: the same view
    if (i == 20) {  // far from the last two keyframes, so that points are made anew
      for (const double turn : {0.45, 0.5, 0.55})
        last = mapper.Add(test::CirclePose(turn), T_twin * test::CirclePose(turn), last);
    }
    last = mapper.Add(T_true, T_twin * T_true, last);
  }
  const PlaceIndex index = IndexOf(mapper.map());
  const FrameFeatures features =
      test::LookAtRoom(mapper.room(), mapper.camera(), test::CirclePose(0.12), kFrame)
          .data->features;
  RelocaliserOptions options;
  options.sure_inliers = 10'000;
  const RelocalisationResult result =
      Relocaliser(RoomSensor(), options).Find(features, mapper.map(), index);
  EXPECT_FALSE(result.found);
  EXPECT_NE(result.reason.find("elsewhere"), std::string::npos) << result.reason;
}

TEST(RankPlaces, ListsEveryPlaceBeforeASecondViewOfOne) {
  test::RoomMapper mapper = TwoMaps();
  std::vector<PlaceCandidate> candidates;
  for (const std::uint32_t id : {0U, 1U, 2U, 8U})
    candidates.push_back({KeyframeId(id), 10.0 - id, 50});
  const auto ranked = RankPlaces(mapper.map(), candidates);
  ASSERT_EQ(ranked.size(), 4U);
  EXPECT_LE(ranked[0].keyframe.value(), 2U);  // three views speak for it
  EXPECT_EQ(ranked[1].keyframe, KeyframeId(8));
}

}  // namespace
}  // namespace cslam
