// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Objects in Map, and what they mean for their points.
#include "cslam/map/map.h"
#include "cslam/map/test_map.h"
#include "cslam/util/check.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace cslam {
namespace {

using test::MakeKeyframe;

// Keyframes 0 and 1 in a row, and a further map that begins with keyframe 2.
class MapObjectsTest : public testing::Test {
 protected:
  MapObjectsTest() : map_(test::kLevelScales) {
    map_.AddKeyframe(MakeKeyframe(0, 10, 0.0));
    map_.AddKeyframe(MakeKeyframe(1, 10, 1.0, k0_));
    map_.AddKeyframe(MakeKeyframe(2, 10, 5.0, {}, MapId(1)));
  }
  ~MapObjectsTest() override { EXPECT_EQ(map_.CheckInvariants(), ""); }

  ObjectId AddObject(KeyframeId reference, MapId map = MapId(0)) {
    MapObject object;
    object.map = map;
    object.class_id = 56;
    object.reference = reference;
    object.centroid = {0.0, 0.0, 2.0};
    object.surface = std::make_shared<const ObjectSurface>();
    object.history.push_back({Stamp{1}, 0.5F, BeliefCause::kCreated});
    return map_.AddObject(std::move(object));
  }
  PointId AddPoint(ObjectId object, int keypoint) {
    const PointId point = map_.AddPoint({0.0, 0.0, 2.0}, k0_);
    EXPECT_TRUE(map_.AddObservation(point, k0_, keypoint));
    EXPECT_TRUE(map_.AddObservation(point, k1_, keypoint));
    if (object.valid()) map_.AssignPoint(point, object);
    return point;
  }
  void SetActive(ObjectId id, bool is_active) {
    MapObject object = *map_.FindObject(id);
    object.is_active = is_active;
    map_.SetObject(std::move(object));
  }
  bool IsUsable(PointId id) const { return cslam::IsUsable(*map_.FindPoint(id)); }

  const KeyframeId k0_{0};
  const KeyframeId k1_{1};
  const KeyframeId k2_{2};
  Map map_;
};

TEST_F(MapObjectsTest, HoldsBackThePointsOfWhatIsNotBelievedIn) {
  const ObjectId chair = AddObject(k0_);
  const PointId on_chair = AddPoint(chair, 0);
  const PointId on_wall = AddPoint({}, 1);
  EXPECT_FALSE(IsUsable(on_chair));
  EXPECT_TRUE(IsUsable(on_wall));
  EXPECT_TRUE(map_.FindPoint(on_chair)->IsActive()) << "it is kept, and goes on being observed";
}

TEST_F(MapObjectsTest, LetsPointsBeUsedFromActivationOnAndNoLonger) {
  const ObjectId chair = AddObject(k0_);
  const PointId before = AddPoint(chair, 0);
  SetActive(chair, true);
  EXPECT_TRUE(IsUsable(before));
  const PointId after = AddPoint(chair, 1);
  EXPECT_TRUE(IsUsable(after)) << "points that come to an active object are active";
  SetActive(chair, false);
  EXPECT_FALSE(IsUsable(before));
  EXPECT_FALSE(IsUsable(after));
}

TEST_F(MapObjectsTest, LeavesOtherObjectsPointsAloneWhenOneIsActivated) {
  const ObjectId chair = AddObject(k0_);
  const ObjectId bear = AddObject(k0_);
  const PointId on_bear = AddPoint(bear, 0);
  SetActive(chair, true);
  EXPECT_FALSE(IsUsable(on_bear));
}

TEST_F(MapObjectsTest, SetObjectRefusesWhatIsNoObject) {
  const ObjectId chair = AddObject(k0_);
  MapObject broken = *map_.FindObject(chair);
  broken.log_odds = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(map_.SetObject(broken), InternalError);
  broken = *map_.FindObject(chair);
  broken.centroid.x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(map_.SetObject(broken), InternalError);
  map_.EraseObject(chair, Map::PointsOfErased::kKeep);
  broken.centroid.x() = 0.0;
  EXPECT_THROW(map_.SetObject(broken), InternalError) << "erased ones do not come back";
}

TEST_F(MapObjectsTest, MergedObjectsHaveOneNameAndAllPoints) {
  const ObjectId keep = AddObject(k0_);
  const ObjectId drop = AddObject(k0_);
  const ObjectId third = AddObject(k0_);
  SetActive(keep, true);
  const PointId of_keep = AddPoint(keep, 0);
  const PointId of_drop = AddPoint(drop, 1);
  map_.MergeObjects(drop, third);
  map_.MergeObjects(keep, drop);
  EXPECT_EQ(map_.FindObject(drop), nullptr);
  EXPECT_EQ(map_.Resolve(third), keep) << "merges are followed";
  EXPECT_EQ(map_.PointsOfObject(keep), (std::vector<PointId>{of_keep, of_drop}));
  EXPECT_TRUE(IsUsable(of_drop)) << "as is right for the one it belongs to now";
  EXPECT_EQ(map_.Objects(), std::vector<ObjectId>{keep});
}

TEST_F(MapObjectsTest, MergingIntoAnInactiveObjectHoldsPointsBack) {
  const ObjectId keep = AddObject(k0_);
  const ObjectId drop = AddObject(k0_);
  SetActive(drop, true);
  const PointId point = AddPoint(drop, 0);
  map_.MergeObjects(keep, drop);
  EXPECT_FALSE(IsUsable(point));
}

TEST_F(MapObjectsTest, EraseObjectGivesPointsBackToTheRoomOrErasesThem) {
  const ObjectId first = AddObject(k0_);
  const ObjectId second = AddObject(k0_);
  const PointId kept = AddPoint(first, 0);
  const PointId erased = AddPoint(second, 1);
  map_.EraseObject(first, Map::PointsOfErased::kKeep);
  map_.EraseObject(second, Map::PointsOfErased::kErase);
  ASSERT_NE(map_.FindPoint(kept), nullptr);
  EXPECT_TRUE(IsUsable(kept));
  EXPECT_FALSE(map_.FindPoint(kept)->object.valid());
  EXPECT_EQ(map_.FindPoint(erased), nullptr);
  EXPECT_EQ(map_.num_points(), 1U);
  EXPECT_EQ(map_.Resolve(first), std::nullopt);
  EXPECT_NE(AddObject(k0_), first) << "ids stay taken";
}

TEST_F(MapObjectsTest, FusedPointsBelongToTheObjectThatEitherBelongedTo) {
  const ObjectId chair = AddObject(k0_);
  const PointId keep = map_.AddPoint({0.0, 0.0, 2.0}, k0_);
  map_.AddObservation(keep, k0_, 0);
  const PointId drop = map_.AddPoint({0.0, 0.0, 2.0}, k1_);
  map_.AddObservation(drop, k1_, 0);
  map_.AssignPoint(drop, chair);
  map_.FusePoints(keep, drop);
  EXPECT_EQ(map_.FindPoint(keep)->object, chair);
  EXPECT_FALSE(IsUsable(keep));
  EXPECT_EQ(map_.PointsOfObject(chair), std::vector<PointId>{keep});
}

TEST_F(MapObjectsTest, ObjectsMoveWithTheirKeyframe) {
  const ObjectId chair = AddObject(k1_);
  const Se3 turned(ExpSo3({0.0, std::numbers::pi / 2.0, 0.0}), Eigen::Vector3d(1.0, 0.0, 1.0));
  map_.SetPose(k1_, turned);
  const Eigen::Vector3d centroid = map_.CentroidOf(*map_.FindObject(chair));
  EXPECT_LT((centroid - turned * Eigen::Vector3d(0.0, 0.0, 2.0)).norm(), 1e-9);
}

TEST_F(MapObjectsTest, ObjectsStayWhereTheyAreWhenTheirKeyframeIsCulled) {
  const ObjectId chair = AddObject(k1_);
  const Eigen::Vector3d before = map_.CentroidOf(*map_.FindObject(chair));
  map_.CullKeyframe(k1_);
  EXPECT_LT((map_.CentroidOf(*map_.FindObject(chair)) - before).norm(), 1e-9);
}

TEST_F(MapObjectsTest, MergeMapsTakesObjectsAlong) {
  const ObjectId theirs = AddObject(k2_, MapId(1));
  map_.MergeMaps(MapId(0), MapId(1), k1_, k2_);
  EXPECT_EQ(map_.FindObject(theirs)->map, MapId(0));
}

TEST_F(MapObjectsTest, SnapshotsKeepWhatTheyShowedWhenObjectsChange) {
  const ObjectId chair = AddObject(k0_);
  const PointId point = AddPoint(chair, 0);
  map_.SetChanges({MapChange{}});
  const MapView before = map_.Snapshot();
  SetActive(chair, true);
  map_.SetChanges({});
  EXPECT_FALSE(before.FindObject(chair)->is_active);
  EXPECT_TRUE(before.FindPoint(point)->is_held_back);
  EXPECT_EQ(before.changes().size(), 1U);
  EXPECT_TRUE(map_.changes().empty());
}

TEST_F(MapObjectsTest, ClearForgetsObjectsAndChangesButNotTheirIds) {
  const ObjectId chair = AddObject(k0_);
  map_.SetChanges({MapChange{}});
  map_.Clear();
  EXPECT_TRUE(map_.Objects().empty());
  EXPECT_TRUE(map_.changes().empty());
  EXPECT_EQ(map_.num_object_ids(), 1U);
  EXPECT_EQ(map_.Resolve(chair), std::nullopt);
}

}  // namespace
}  // namespace cslam
