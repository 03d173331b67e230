// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_association.h"

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
const Eigen::Vector3d kSize(0.5, 0.5, 0.5);

// One keyframe at the origin; objects as a first view of a thing leaves them.
class AssociationTest : public testing::Test {
 protected:
  AssociationTest() : map_(test::kRoomScales) {
    Keyframe keyframe;
    keyframe.id = KeyframeId(0);
    keyframe.map = MapId(0);
    keyframe.data = std::make_shared<KeyframeData>();
    map_.AddKeyframe(std::move(keyframe));
  }

  static ThingRoom RoomWith(const Eigen::Vector3d& at, int class_id = kChairClass) {
    ThingRoom room;
    room.things = {{BoxAt(at, kSize), class_id, TrackId(1)}};
    return room;
  }
  ThingView Look(const ThingRoom& room, const Se3& T_world_camera = {}) const {
    return test::LookAtThings(room, camera_, T_world_camera, Stamp{1});
  }
  ObjectId Know(const Eigen::Vector3d& at, ObjectState state = ObjectState::kPresent) {
    const ThingView seen = Look(RoomWith(at));
    const DepthRegion& region = seen.sightings.at(0).region;
    const auto points = PointsOfRegion(seen.view, region, 300);
    MapObject object;
    object.map = MapId(0);
    object.reference = KeyframeId(0);
    object.class_id = kChairClass;
    object.state = state;
    object.surface = std::make_shared<const ObjectSurface>(
        WithView(ObjectSurface{}, points, Se3(), seen.view, region, 0.04));
    object.box = BoxAround(points, -Eigen::Vector3d::UnitY());
    object.centroid = region.centre_camera;
    return map_.AddObject(std::move(object));
  }
  std::vector<std::optional<ObjectId>> Associate(const ThingView& seen, MapId map = MapId(0),
                                                 const Se3& T_world_camera = {}) const {
    const auto placed =
        PlaceSightings(seen.sightings, seen.view, T_world_camera, classes_, options_);
    return AssociateSightings(map_, map, placed, seen.view, T_world_camera, seen_before_, classes_,
                              options_);
  }
  std::optional<ObjectId> FindDouble(ObjectId id) const {
    return cslam::FindDouble(map_, *map_.FindObject(id), classes_, options_);
  }

  using Found = std::vector<std::optional<ObjectId>>;
  const Camera camera_ = test::RoomCamera();
  const MapObjectOptions options_;
  const ObjectClasses classes_{ObjectClassOptions{}};
  Map map_;
  SeenBefore seen_before_;  // nothing: all was in sight just now
};

TEST_F(AssociationTest, PlacesWhatHasANameAndASurface) {
  ThingView seen = Look(RoomWith(kPlace));
  seen.sightings.push_back(seen.sightings[0]);
  seen.sightings.back().class_id = 0;  // a person
  seen.sightings.push_back(seen.sightings[0]);
  seen.sightings.back().region.mask = cv::Mat(120, 160, CV_8UC1, cv::Scalar(0));
  const auto placed = PlaceSightings(seen.sightings, seen.view, Se3(), classes_, options_);
  ASSERT_EQ(placed.size(), 1U);
  EXPECT_EQ(placed[0].sighting, seen.sightings.data());
  EXPECT_LE(placed[0].points_camera.size(), 300U);
  EXPECT_NEAR(placed[0].centroid_world.z(), 1.75, 0.02);
}

TEST_F(AssociationTest, KeepsTheSurestOfTooManySightings) {
  ThingView seen = Look(RoomWith(kPlace));
  seen.sightings.resize(1000, seen.sightings[0]);
  seen.sightings[777].score = 0.99;
  const auto placed = PlaceSightings(seen.sightings, seen.view, Se3(), classes_, options_);
  EXPECT_LE(placed.size(), 100U);
  EXPECT_EQ(placed[0].sighting, &seen.sightings[777]);
}

TEST_F(AssociationTest, FindsTheObjectOnWhoseSurfaceASightingLies) {
  const ObjectId chair = Know(kPlace);
  EXPECT_EQ(Associate(Look(RoomWith(kPlace))), Found{chair});
}

TEST_F(AssociationTest, FindsNothingInAnotherMapOrBeyondTheClassDistance) {
  Know(kPlace);
  EXPECT_EQ(Associate(Look(RoomWith(kPlace)), MapId(1)), Found{std::nullopt});
  EXPECT_EQ(Associate(Look(RoomWith({1.2, 0.0, 2.4}))), Found{std::nullopt});
}

TEST_F(AssociationTest, TakesAThingBesideAPlaceThatIsLookedThroughForAnother) {
  Know(kPlace);
  EXPECT_EQ(Associate(Look(RoomWith({0.6, 0.0, 2.0}))), Found{std::nullopt});
}

TEST_F(AssociationTest, LetsAbsentThingsComeBackOnTheirOwnSurfaceOnly) {
  const ObjectId chair = Know(kPlace, ObjectState::kAbsent);
  EXPECT_EQ(Associate(Look(RoomWith(kPlace))), Found{chair});
  EXPECT_EQ(Associate(Look(RoomWith({0.0, 0.0, 1.6}))), Found{std::nullopt});
}

TEST_F(AssociationTest, TakesTwoNamesOfTheSameSurfaceForOneThing) {
  const ObjectId chair = Know(kPlace);
  EXPECT_EQ(Associate(Look(RoomWith(kPlace, kBearClass))), Found{chair});
}

TEST_F(AssociationTest, TakesTwoPiecesOfASurfaceForOneThing) {
  const ObjectId chair = Know(kPlace);
  ThingView seen = Look(RoomWith(kPlace));
  cv::Mat left = seen.sightings[0].region.mask.clone();
  cv::Mat right = left.clone();
  left.colRange(80, 160).setTo(0);
  right.colRange(0, 80).setTo(0);
  seen.sightings.push_back(seen.sightings[0]);
  seen.sightings[0].region = test::RegionOf(seen.view, left);
  seen.sightings[1].region = test::RegionOf(seen.view, right);
  EXPECT_EQ(Associate(seen), (Found{chair, chair}));
}

TEST_F(AssociationTest, FindsDoublesOnOneSurfaceUnlessOneIsGone) {
  const ObjectId chair = Know(kPlace);
  const ObjectId twin = Know(kPlace + Eigen::Vector3d(0.05, 0.0, 0.0));
  const ObjectId far = Know({1.2, 0.0, 2.4});
  EXPECT_EQ(FindDouble(chair), twin);
  EXPECT_EQ(FindDouble(twin), chair);
  EXPECT_EQ(FindDouble(far), std::nullopt);
  MapObject gone = *map_.FindObject(twin);
  gone.state = ObjectState::kAbsent;
  map_.SetObject(gone);
  EXPECT_EQ(FindDouble(chair), std::nullopt);
  EXPECT_EQ(FindDouble(twin), std::nullopt);
}

TEST_F(AssociationTest, AsksForTheColoursOfWhatWasOutOfSight) {
  const ObjectId chair = Know(kPlace);
  MapObject object = *map_.FindObject(chair);
  object.colours = test::ColoursWithHue(2.0F);
  map_.SetObject(std::move(object));
  ThingView seen = Look(RoomWith(kPlace));
  ObjectSighting& sighting = seen.sightings.at(0);
  sighting.detected = Stamp{20'000'000'000};
  sighting.colours = test::ColoursWithHue(6.0F);
  seen_before_[chair] = Stamp{19'500'000'000};
  EXPECT_EQ(Associate(seen), Found{chair}) << "it was there half a second ago";
  seen_before_[chair] = Stamp{10'000'000'000};
  EXPECT_EQ(Associate(seen), Found{std::nullopt});
  sighting.colours = test::ColoursWithHue(2.0F);
  EXPECT_EQ(Associate(seen), Found{chair});
}

TEST_F(AssociationTest, DoesNotMergeWhatTookThePlaceOfAnotherColour) {
  const auto know = [&](float hue, std::uint32_t first, std::uint32_t last) {
    const ObjectId id = Know(kPlace);
    MapObject object = *map_.FindObject(id);
    object.colours = test::ColoursWithHue(hue);
    object.first_keyframe = KeyframeId(first);
    object.last_keyframe = KeyframeId(last);
    map_.SetObject(std::move(object));
    return id;
  };
  know(2.0F, 0, 5);
  const ObjectId later = know(6.0F, 8, 9);
  EXPECT_EQ(FindDouble(later), std::nullopt);
  const ObjectId at_once = know(6.0F, 5, 9);
  EXPECT_TRUE(FindDouble(at_once).has_value());
}

}  // namespace
}  // namespace cslam
