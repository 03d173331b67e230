// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_parting.h"

#include "cslam/map/map.h"
#include "cslam/mapping/object_geometry.h"
#include "cslam/mapping/test_objects.h"
#include "cslam/semantics/coco.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::BoxAt;
using test::ThingRoom;
using test::ThingView;

constexpr int kBearClass = 77;
const Eigen::Vector3d kPlace(0.0, 0.0, 2.0);
const Eigen::Vector3d kChairSize(0.8, 0.8, 0.8);

// A chair before the camera whose front holds a bear that nobody detects just now.
class PartingTest : public testing::Test {
 protected:
  PartingTest() : map_(test::kRoomScales) {
    Keyframe keyframe;
    keyframe.id = KeyframeId(0);
    keyframe.map = MapId(0);
    keyframe.data = std::make_shared<KeyframeData>();
    map_.AddKeyframe(std::move(keyframe));
  }

  ThingView Look(const Eigen::Vector3d& size) const {
    ThingRoom room;
    room.things = {{BoxAt(kPlace, size), kChairClass, TrackId(1)}};
    return test::LookAtThings(room, camera_, Se3(), Stamp{1});
  }
  // A thing with its front in the chair's.
  ObjectId KnowBear(double size_m, ObjectState state = ObjectState::kPresent,
                    int num_sightings = 3) {
    const ThingView seen = Look({size_m, size_m, kChairSize.z()});
    const DepthRegion& region = seen.sightings.at(0).region;
    const auto points = PointsOfRegion(seen.view, region, 300);
    MapObject bear;
    bear.map = MapId(0);
    bear.reference = KeyframeId(0);
    bear.class_id = kBearClass;
    bear.state = state;
    bear.num_sightings = num_sightings;
    bear.surface = std::make_shared<const ObjectSurface>(
        WithView(ObjectSurface{}, points, Se3(), seen.view, region, 0.04));
    bear.box = BoxAround(points, -Eigen::Vector3d::UnitY());
    bear.centroid = region.centre_camera;
    return map_.AddObject(std::move(bear));
  }
  // Share of the chair's sighting that is left as its own.
  double ShareLeft(int class_id = kChairClass) const {
    ThingView seen = Look(kChairSize);
    seen.sightings[0].class_id = class_id;
    const auto placed = PlaceSightings(seen.sightings, seen.view, Se3(), classes_, options_);
    const PlacedSighting parted =
        PartFromOthers(map_, MapId(0), placed.at(0), nullptr, seen.view, Se3(), classes_, options_);
    EXPECT_EQ(parted.region.num_pixels, cv::countNonZero(parted.region.mask));
    return static_cast<double>(parted.region.num_pixels) / placed[0].region.num_pixels;
  }

  const Camera camera_ = test::RoomCamera();
  const MapObjectOptions options_;
  const ObjectClasses classes_{ObjectClassOptions{}};
  Map map_;
};

TEST_F(PartingTest, LeavesOutTheBearThatSitsInTheChair) {
  EXPECT_DOUBLE_EQ(ShareLeft(), 1.0) << "as long as nobody knows of it";
  KnowBear(0.4);
  EXPECT_NEAR(ShareLeft(), 0.75, 0.08);
}

TEST_F(PartingTest, LeavesOutNothingThatIsGoneOrHardlyKnown) {
  KnowBear(0.4, ObjectState::kAbsent);
  KnowBear(0.4, ObjectState::kCandidate, 1);
  EXPECT_DOUBLE_EQ(ShareLeft(), 1.0);
}

TEST_F(PartingTest, LeavesOutNothingAsLargeAsTheThingOrOfItsKind) {
  KnowBear(0.7);
  EXPECT_DOUBLE_EQ(ShareLeft(), 1.0) << "it may be the very same thing";
  KnowBear(0.4);
  EXPECT_DOUBLE_EQ(ShareLeft(kBearClass), 1.0);
}

}  // namespace
}  // namespace cslam
