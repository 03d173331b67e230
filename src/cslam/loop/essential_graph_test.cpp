// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/essential_graph.h"

#include "cslam/map/test_room.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

Se3 SmallDrift() {
  return Exp((Vector6() << 0.001, 0.004, 0.0005, 0.0, 0.0, 0.0).finished());
}

class EssentialGraphTest : public testing::Test {
 protected:
  EssentialGraphTest()
      : mapper_(test::DriftingCircle(test::MakeRoom(700, 1), 30, 2, SmallDrift())) {}

  const Se3& PoseOf(std::uint32_t id) {
    return mapper_.map().FindKeyframe(KeyframeId(id))->T_world_camera;
  }
  LoopEdge TrueLoop(std::uint32_t match, std::uint32_t query) const {
    return {KeyframeId(match), KeyframeId(query),
            mapper_.truth()[match].Inverse() * mapper_.truth()[query]};
  }
  void Apply(const std::vector<KeyframeMove>& moves) {
    for (const KeyframeMove& move : moves)
      mapper_.map().SetPose(move.keyframe, move.T_new_old * PoseOf(move.keyframe.value()));
  }

  test::RoomMapper mapper_;
};

TEST_F(EssentialGraphTest, ClosesTheLoopNearlyAsMeasured) {
  const LoopEdge loop = TrueLoop(0, 30);
  Apply(SpreadLoop(mapper_.map(), loop, {}, {}));
  const PoseDifference left = Difference(PoseOf(0) * loop.T_match_query, PoseOf(30));
  EXPECT_LT(left.distance_m, 0.005);
  EXPECT_LT(left.angle_rad, 0.003);
}

TEST_F(EssentialGraphTest, TakesAwayMostOfTheDrift) {
  const double before = test::PositionError(mapper_.map(), mapper_.truth());
  Apply(SpreadLoop(mapper_.map(), TrueLoop(0, 30), {}, {}));
  EXPECT_GT(before, 0.05);
  EXPECT_LT(test::PositionError(mapper_.map(), mapper_.truth()), 0.2 * before);
}

TEST_F(EssentialGraphTest, LeavesTheFirstKeyframeWhereItIs) {
  const auto moves = SpreadLoop(mapper_.map(), TrueLoop(0, 30), {}, {});
  ASSERT_EQ(moves.size(), 32U);
  EXPECT_TRUE(moves[0].T_new_old.Matrix().isIdentity(1e-12));
}

TEST_F(EssentialGraphTest, KeepsAnEarlierLoopClosed) {
  const LoopEdge first = TrueLoop(0, 15);  // as if 15 had been tied to 0 in some other way
  Apply(SpreadLoop(mapper_.map(), first, {}, {}));
  const Se3 T_0_15 = PoseOf(0).Inverse() * PoseOf(15);
  const auto moves_with = SpreadLoop(mapper_.map(), TrueLoop(0, 30), {&first, 1}, {});
  const auto moves_without = SpreadLoop(mapper_.map(), TrueLoop(0, 30), {}, {});
  const auto change = [&](const std::vector<KeyframeMove>& moves) {
    return Difference(T_0_15, (moves[0].T_new_old * PoseOf(0)).Inverse() *
                                  (moves[15].T_new_old * PoseOf(15)))
        .distance_m;
  };
  EXPECT_LT(change(moves_with), 0.9 * change(moves_without));
}

TEST_F(EssentialGraphTest, IgnoresEarlierLoopsThatWereNeverClosed) {
  const std::vector<LoopEdge> earlier = {{KeyframeId(0), KeyframeId(99), Se3()},
                                         {KeyframeId(0), KeyframeId(15), Se3()}};
  const auto with = SpreadLoop(mapper_.map(), TrueLoop(0, 30), earlier, {});
  const auto without = SpreadLoop(mapper_.map(), TrueLoop(0, 30), {}, {});
  for (std::size_t i = 0; i < with.size(); ++i)
    EXPECT_EQ(with[i].T_new_old.Matrix(), without[i].T_new_old.Matrix());
}

TEST_F(EssentialGraphTest, MovesAMapAsOne) {
  const Se3 T_new_old = test::CirclePose(0.3);
  const auto moves = MoveRigidly(mapper_.map(), MapId(0), T_new_old);
  ASSERT_EQ(moves.size(), 32U);
  EXPECT_EQ(moves[7].T_new_old.Matrix(), T_new_old.Matrix());
  EXPECT_TRUE(MoveRigidly(mapper_.map(), MapId(1), T_new_old).empty());
}

}  // namespace
}  // namespace cslam
