// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/full_ba.h"

#include "cslam/map/test_room.h"
#include "cslam/mapping/correction.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

class FullBaTest : public testing::Test {
 protected:
  // Points stay where the first sighting put them, so that later keyframes are off against them.
  FullBaTest()
      : mapper_(test::DriftingCircle(test::MakeRoom(600, 1), 24, 0,
                                     Exp((Vector6() << 0, 0.004, 0, 0.006, 0, 0).finished()))) {}
  std::optional<PoseRefinement> Adjust(const MapView& map,
                                       const std::function<bool()>& should_stop = {}) const {
    return AdjustFully(map, MapId(0), mapper_.camera(), DepthOptions{}, model_, {}, should_stop);
  }
  double Error() { return test::PositionError(mapper_.map(), mapper_.truth()); }

  test::RoomMapper mapper_;
  MeasurementModel model_{test::kRoomScales, 1.0};
};

TEST_F(FullBaTest, MovesKeyframesToWhatTheyMeasured) {
  const double before = Error();
  const auto refinement = Adjust(mapper_.map().Snapshot());
  ASSERT_TRUE(refinement.has_value());
  EXPECT_GT(refinement->iterations, 1);
  EXPECT_TRUE(ApplyRefinement(mapper_.map(), *refinement).is_applied());
  EXPECT_EQ(mapper_.map().CheckInvariants(), "");
  EXPECT_GT(before, 0.02);
  EXPECT_LT(Error(), 0.4 * before);
}

TEST_F(FullBaTest, HoldsTheFirstKeyframe) {
  const auto refinement = Adjust(mapper_.map().Snapshot());
  ASSERT_TRUE(refinement.has_value());
  EXPECT_EQ(refinement->poses[0].keyframe, KeyframeId(0));
  EXPECT_EQ(refinement->poses[0].T_world_camera_old.Matrix(),
            refinement->poses[0].T_world_camera_new.Matrix());
  EXPECT_NE(refinement->poses[5].T_world_camera_old.Matrix(),
            refinement->poses[5].T_world_camera_new.Matrix());
}

TEST_F(FullBaTest, SaysNothingWhenStoppedOrWithoutAMap) {
  EXPECT_FALSE(Adjust(mapper_.map().Snapshot(), [] { return true; }).has_value());
  EXPECT_FALSE(AdjustFully(mapper_.map(), MapId(9), mapper_.camera(), DepthOptions{}, model_, {})
                   .has_value());
}

TEST_F(FullBaTest, GivesTheSameTwice) {
  const auto a = Adjust(mapper_.map().Snapshot());
  const auto b = Adjust(mapper_.map().Snapshot());
  ASSERT_TRUE(a && b);
  for (std::size_t i = 0; i < a->poses.size(); ++i) {
    EXPECT_EQ(a->poses[i].T_world_camera_new.Matrix(), b->poses[i].T_world_camera_new.Matrix());
  }
}

}  // namespace
}  // namespace cslam
