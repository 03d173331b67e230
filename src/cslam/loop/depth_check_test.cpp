// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/depth_check.h"

#include "cslam/map/test_room.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

class DepthCheckTest : public testing::Test {
 protected:
  PlacedDepth ViewAt(const Se3& T_world_camera) const {
    return {test::RoomDepth(room_, camera_, T_world_camera), T_world_camera};
  }
  DepthComparison Compare(const PlacedDepth& a, const PlacedDepth& b) const {
    return CompareDepth({a}, {b}, camera_, {});
  }

  test::TestRoom room_;
  Camera camera_ = test::RoomCamera();
};

TEST_F(DepthCheckTest, FindsNothingWrongWhereTwoViewsShowOneRoom) {
  const DepthComparison depth =
      Compare(ViewAt(test::CirclePose(0.0)), ViewAt(test::CirclePose(0.06)));
  EXPECT_GT(depth.num_compared(), 4000);
  EXPECT_LT(depth.contradicted(), 0.001);
}

TEST_F(DepthCheckTest, ContradictsAPoseThatPutsAWallInFreeSpace) {
  const PlacedDepth first = ViewAt(test::CirclePose(0.0));
  PlacedDepth second = first;
  second.T_world_camera.translation.z() -= 0.5;
  EXPECT_GT(Compare(first, second).contradicted(), 0.4);
  second.T_world_camera.translation.z() += 1.0;
  EXPECT_GT(Compare(first, second).contradicted(), 0.4) << "whichever side is nearer";
}

TEST_F(DepthCheckTest, CountsAThingThatCameByItsShareOnly) {
  const PlacedDepth before = ViewAt(test::CirclePose(0.0));
  room_.things.push_back({{-0.3, 0.3, 2.0}, {0.3, 1.3, 2.5}});  // a chair
  const PlacedDepth after = ViewAt(test::CirclePose(0.02));
  const DepthComparison depth = Compare(before, after);
  EXPECT_GT(depth.num_contradicting, 20);
  EXPECT_LT(depth.contradicted(), 0.15);
}

TEST_F(DepthCheckTest, ComparesNothingWhereNothingWasMeasured) {
  PlacedDepth blind = ViewAt(test::CirclePose(0.0));
  blind.depth_small_mm = 0;
  EXPECT_EQ(Compare(ViewAt(test::CirclePose(0.0)), blind).num_compared(), 0);
  blind.depth_small_mm = cv::Mat();
  EXPECT_EQ(Compare(ViewAt(test::CirclePose(0.0)), blind).num_compared(), 0);
  EXPECT_EQ(CompareDepth({}, {}, camera_, {}).contradicted(), 0.0);
}

TEST_F(DepthCheckTest, ComparesNothingBetweenViewsThatDoNotOverlap) {
  EXPECT_EQ(Compare(ViewAt(test::CirclePose(0.0)), ViewAt(test::CirclePose(0.5))).num_compared(),
            0);
}

}  // namespace
}  // namespace cslam
