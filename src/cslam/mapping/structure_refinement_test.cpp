// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Points that are held back: out of bundle adjustment, but carried along and refined before use.
#include "cslam/mapping/structure_refinement.h"

#include "cslam/map/test_room.h"
#include "cslam/mapping/ba_problem.h"
#include "cslam/mapping/local_ba.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cslam {
namespace {

// Five keyframes of a room in a row; every fourth point is an object's.
class HeldBackPointsTest : public testing::Test {
 protected:
  HeldBackPointsTest() : mapper_(test::MakeRoom(800, 4)), map_(mapper_.map()) {
    for (int i = 0; i < 5; ++i) {
      const Se3 pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.1 * i, 0.0, 0.0));
      mapper_.Add(pose, pose, i == 0 ? KeyframeId() : KeyframeId(0));
    }
    MapObject object;
    object.map = MapId(0);
    object.reference = KeyframeId(2);
    chair_ = map_.AddObject(object);
    for (std::uint32_t i = 0; i < map_.num_point_ids(); i += 4) {
      if (map_.FindPoint(PointId(i)) != nullptr) map_.AssignPoint(PointId(i), chair_);
    }
    held_back_ = map_.PointsOfObject(chair_);
  }
  ~HeldBackPointsTest() override { EXPECT_EQ(map_.CheckInvariants(), ""); }

  int Refine() { return RefineStructure(map_, held_back_, mapper_.camera(), depth_, model_, {}); }
  // Mean distance of the held-back points from those of the room.
  double Error() const {
    double sum = 0.0;
    for (const PointId id : held_back_) {
      double nearest = 1e9;
      for (const test::RoomPoint& p : mapper_.room().points)
        nearest = std::min(nearest, (p.p_world - map_.FindPoint(id)->p_world).norm());
      sum += nearest;
    }
    return sum / static_cast<double>(held_back_.size());
  }
  std::vector<Eigen::Vector3d> InReferences() const {
    std::vector<Eigen::Vector3d> points;
    for (const PointId id : held_back_) {
      const MapPoint& point = *map_.FindPoint(id);
      points.push_back(map_.FindKeyframe(point.reference)->T_world_camera.Inverse() *
                       point.p_world);
    }
    return points;
  }

  test::RoomMapper mapper_;
  Map& map_;
  const DepthOptions depth_;
  const MeasurementModel model_{test::kRoomScales, 1.0};
  ObjectId chair_;
  std::vector<PointId> held_back_;
};

TEST_F(HeldBackPointsTest, AreBroughtWhereTheirObservationsSayBeforeTheyAreUsed) {
  Rng rng(2);
  for (const PointId id : held_back_) {
    const Eigen::Vector3d& p = map_.FindPoint(id)->p_world;
    map_.SetPosition(id,
                     p + 0.02 * Eigen::Vector3d(rng.Gaussian(), rng.Gaussian(), rng.Gaussian()));
  }
  const double before = Error();
  const Se3 pose = map_.FindKeyframe(KeyframeId(2))->T_world_camera;
  Refine();
  EXPECT_LT(Error(), 0.5 * before);
  const Se3 moved = pose.Inverse() * map_.FindKeyframe(KeyframeId(2))->T_world_camera;
  EXPECT_EQ(moved.translation, Eigen::Vector3d::Zero()) << "poses hold still";
}

TEST_F(HeldBackPointsTest, LoseObservationsThatDisagree) {
  const auto seen_often = std::find_if(held_back_.begin(), held_back_.end(), [&](PointId id) {
    return map_.FindPoint(id)->observations.size() >= 4;
  });
  ASSERT_NE(seen_often, held_back_.end());
  const PointObservation last = map_.FindPoint(*seen_often)->observations.back();
  map_.RemoveObservation(*seen_often, last.keyframe);
  const Keyframe& keyframe = *map_.FindKeyframe(last.keyframe);
  const auto wrong = std::find_if(keyframe.points.begin(), keyframe.points.end(), [&](PointId id) {
    return id.valid() && map_.FindPoint(id)->observations.size() >= 4 && id != *seen_often;
  });
  ASSERT_NE(wrong, keyframe.points.end());
  const auto keypoint = static_cast<int>(wrong - keyframe.points.begin());
  map_.RemoveObservation(*wrong, last.keyframe);
  ASSERT_TRUE(map_.AddObservation(*seen_often, last.keyframe, keypoint));
  EXPECT_GE(Refine(), 1);
  const auto& left = map_.FindPoint(*seen_often)->observations;
  EXPECT_TRUE(std::none_of(left.begin(), left.end(),
                           [&](const PointObservation& o) { return o.keyframe == last.keyframe; }));
}

TEST_F(HeldBackPointsTest, NeedNothingWhenThereAreNone) {
  EXPECT_EQ(RefineStructure(map_, {}, mapper_.camera(), depth_, model_, {}), 0);
}

TEST_F(HeldBackPointsTest, TakeNoPartInBundleAdjustment) {
  const std::vector<PointId> seen = PointsSeenBy(map_, map_.Keyframes());
  ASSERT_FALSE(seen.empty());
  for (const PointId id : seen)
    EXPECT_FALSE(map_.FindPoint(id)->is_held_back);
}

TEST_F(HeldBackPointsTest, DoNotDragPosesButMoveWithTheirKeyframe) {
  for (const PointId id : held_back_)  // a chair that was moved by 0.3 m
    map_.SetPosition(id, map_.FindPoint(id)->p_world + Eigen::Vector3d(0.3, 0.0, 0.0));
  const Se3 off(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.02, 0.0));
  for (std::uint32_t i = 1; i < 5; ++i)
    map_.SetPose(KeyframeId(i), map_.FindKeyframe(KeyframeId(i))->T_world_camera * off);
  const std::vector<Eigen::Vector3d> before = InReferences();
  AdjustLocally(map_, KeyframeId(2), mapper_.camera(), depth_, model_, 15, {}, {});
  EXPECT_LT(test::PositionError(map_, mapper_.truth()), 0.01);
  const std::vector<Eigen::Vector3d> after = InReferences();
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_LT((after[i] - before[i]).norm(), 1e-6);
}

}  // namespace
}  // namespace cslam
