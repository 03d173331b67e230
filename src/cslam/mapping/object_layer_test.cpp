// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// The life of objects in the map: what keyframes tell of them, and what the map makes of it.
#include "cslam/mapping/object_layer.h"

#include "cslam/mapping/test_objects.h"
#include "cslam/semantics/coco.h"

#include <gtest/gtest.h>

#include <limits>

namespace cslam {
namespace {

using test::BoxAt;
using test::PoseLookingAt;
using test::Thing;
using test::ThingRoom;

constexpr int kCouchClass = 57;
constexpr int kTableClass = 60;
constexpr int kBearClass = 77;
const Eigen::Vector3d kPlace(0.0, 0.2, 2.0);
const Eigen::Vector3d kChairSize(0.5, 0.8, 0.5);

class ObjectLayerTest : public testing::Test {
 protected:
  ObjectLayerTest() { MakeLayer({}); }
  ~ObjectLayerTest() override { EXPECT_EQ(map_.CheckInvariants(), ""); }

  void MakeLayer(const MapObjectOptions& objects) {
    MapperOptions options;
    options.objects = objects;
    layer_.emplace(camera_, DepthOptions{}, options, MeasurementModel(test::kRoomScales, 1.0));
  }
  static Thing Chair(const Eigen::Vector3d& at, std::uint32_t track = 1) {
    return {BoxAt(at, kChairSize), kChairClass, TrackId(track), 2.0F};
  }

  // A keyframe that sees the room, one second after the last unless said otherwise.
  ObjectLayerReport Insert(const Se3& T_world_camera, std::vector<ObjectEvidence> evidence = {}) {
    test::ThingView seen = test::LookAtThings(room_, camera_, T_world_camera, now_);
    KeyframeProposal proposal;
    proposal.objects = {seen.view, std::move(seen.sightings), std::move(evidence)};
    return Insert(T_world_camera, std::move(proposal));
  }
  ObjectLayerReport Insert(const Se3& T_world_camera, KeyframeProposal proposal) {
    const auto id = static_cast<std::uint32_t>(map_.num_keyframe_ids());
    proposal.id = KeyframeId(id);
    proposal.map = MapId(0);
    auto data = std::make_shared<KeyframeData>();
    data->stamp = now_;
    data->depth_small_mm = proposal.objects.view.depth_mm;
    data->features = test::MakeFeatures(
        {{.u = 320.0F, .v = 240.0F, .depth_m = 1.75F}, {.u = 10.0F, .v = 10.0F, .depth_m = 3.0F}});
    data->features.semantics[0].track = keypoint_track_;
    data->features.semantics[0].class_id = keypoint_track_.valid() ? kChairClass : -1;
    proposal.data = data;
    Keyframe keyframe;
    keyframe.id = proposal.id;
    keyframe.map = MapId(0);
    keyframe.T_world_camera = T_world_camera;
    if (id > 0) keyframe.parent = KeyframeId(0);
    keyframe.data = data;
    map_.AddKeyframe(std::move(keyframe));
    for (int i = 0; i < (has_points_ ? 2 : 0); ++i) {
      const Keypoint& k = data->features.keypoints[static_cast<std::size_t>(i)];
      const PointId point = map_.AddPoint(
          T_world_camera * Unproject(camera_, k.uv_px.cast<double>(), k.depth_m), proposal.id);
      map_.AddObservation(point, proposal.id, i);
      map_.RefreshAppearance(point);
    }
    now_ = now_ + 1'000'000'000LL;
    return layer_->Update(map_, proposal);
  }

  ObjectEvidence Seen(ObjectId id, int views = 3) const {
    ObjectEvidence evidence;
    evidence.object = id;
    evidence.num_seen = views;
    evidence.last_seen = now_;
    evidence.log_ratio = views * SeenLogRatio(0.1, 0.7, belief_);
    return evidence;
  }
  ObjectEvidence Through(ObjectId id, int views = 3) const {
    ObjectEvidence evidence;
    evidence.object = id;
    evidence.num_through = views;
    evidence.first_through = now_;
    evidence.log_ratio = views * LookedThroughLogRatio(belief_);
    return evidence;
  }
  // The room's things, seen until they are believed in; returns the objects of the map.
  std::vector<ObjectId> Settle(const Se3& T_world_camera) {
    Insert(T_world_camera);
    std::vector<ObjectEvidence> evidence;
    for (const ObjectId id : map_.Objects()) {
      if (map_.FindObject(id)->last_keyframe.index() + 1 == map_.num_keyframe_ids()) {
        evidence.push_back(Seen(id));
      }
    }
    Insert(T_world_camera, std::move(evidence));
    return map_.Objects();
  }
  const MapObject& Object(std::uint32_t id) const { return *map_.FindObject(ObjectId(id)); }

  const Camera camera_ = test::RoomCamera();
  const PersistenceOptions belief_;
  const Se3 front_ = PoseLookingAt({0.0, 0.2, 0.0}, kPlace);
  ThingRoom room_;
  Map map_{test::kRoomScales};
  std::optional<ObjectLayer> layer_;
  Stamp now_{1'000'000'000LL};
  bool has_points_ = false;
  TrackId keypoint_track_;
};

TEST_F(ObjectLayerTest, MeasuresWhatItSees) {
  room_.things = {Chair(kPlace)};
  EXPECT_EQ(Insert(front_).num_new, 1);
  ASSERT_EQ(map_.Objects().size(), 1U);
  const MapObject& chair = Object(0);
  EXPECT_EQ(chair.state, ObjectState::kCandidate);
  EXPECT_FALSE(chair.is_active);
  EXPECT_EQ(chair.class_id, kChairClass);
  EXPECT_NEAR(map_.CentroidOf(chair).z(), 1.75, 0.05) << "its front is all that shows";
  EXPECT_EQ(chair.num_sightings, 1);
  EXPECT_EQ(chair.history.size(), 1U);
}

TEST_F(ObjectLayerTest, IsOneObjectWhenAChairIsSeenFromAllSides) {
  room_.things = {Chair({0.0, 0.2, 0.0})};
  const std::vector<Eigen::Vector3d> places{
      {0.0, 0.0, -1.8}, {0.0, 0.0, 1.8}, {1.8, 0.0, 0.0}, {-1.8, 0.0, 0.0}};
  for (const Eigen::Vector3d& from : places) {
    room_.things[0].track = TrackId(static_cast<std::uint32_t>(map_.num_keyframe_ids()));
    Insert(PoseLookingAt(from, {0.0, 0.2, 0.0}));
  }
  ASSERT_EQ(map_.Objects().size(), 1U);
  EXPECT_EQ(Object(0).num_sightings, 4);
  EXPECT_LT((map_.CentroidOf(Object(0)) - Eigen::Vector3d(0.0, 0.2, 0.0)).norm(), 0.1);
  EXPECT_NEAR(Object(0).box.size_m.maxCoeff(), 0.8, 0.1);
  EXPECT_NEAR(Object(0).box.size_m.minCoeff(), 0.5, 0.1);
}

TEST_F(ObjectLayerTest, KeepsTwoChairsSideBySideApart) {
  room_.things = {Chair({-0.35, 0.2, 2.0}, 1), Chair({0.35, 0.2, 2.0}, 2)};
  for (int i = 0; i < 4; ++i)
    Insert(PoseLookingAt({-0.6 + 0.4 * i, 0.0, 0.0}, kPlace));
  ASSERT_EQ(map_.Objects().size(), 2U);
  EXPECT_EQ(Object(0).num_sightings, 4);
  EXPECT_EQ(Object(1).num_sightings, 4);
}

TEST_F(ObjectLayerTest, KeepsTwoChairsApartThatAreDetectedInTurn) {
  room_.things = {Chair({-0.35, 0.2, 2.0}, 1), Chair({0.35, 0.2, 2.0}, 2)};
  room_.things[1].is_detected = false;
  Insert(front_);
  room_.things[0].is_detected = false;
  room_.things[1].is_detected = true;
  Insert(front_);
  EXPECT_EQ(map_.Objects().size(), 2U) << "the first one stands elsewhere in the same picture";
}

TEST_F(ObjectLayerTest, KeepsABearOnAChairItsOwnThing) {
  const Thing bear{BoxAt({0.0, -0.1, 1.7}, {0.3, 0.35, 0.25}), kBearClass, TrackId(2), 5.0F};
  room_.things = {Chair(kPlace), bear};
  for (int i = 0; i < 4; ++i)
    Insert(PoseLookingAt({-0.6 + 0.4 * i, 0.0, 0.0}, kPlace));
  ASSERT_EQ(map_.Objects().size(), 2U);
  EXPECT_EQ(Object(0).class_id, kChairClass);
  EXPECT_EQ(Object(1).class_id, kBearClass);
  EXPECT_EQ(Object(1).num_sightings, 4);
}

TEST_F(ObjectLayerTest, IsOneObjectWhenNamesFlicker) {
  room_.things = {Chair(kPlace)};
  const std::vector<int> names{kChairClass, kCouchClass, kChairClass, kTableClass, kChairClass};
  for (std::size_t i = 0; i < names.size(); ++i) {
    room_.things[0].class_id = names[i];
    room_.things[0].track = TrackId(static_cast<std::uint32_t>(i));
    Insert(front_);
  }
  ASSERT_EQ(map_.Objects().size(), 1U);
  EXPECT_EQ(Object(0).class_id, kChairClass) << "the name it has most often";
  EXPECT_EQ(Object(0).votes.size(), 3U);
  EXPECT_EQ(Object(0).num_sightings, 5);
}

TEST_F(ObjectLayerTest, BelievesInWhatIsSeenAgain) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  EXPECT_EQ(Object(0).state, ObjectState::kPresent);
  EXPECT_TRUE(Object(0).is_active);
  EXPECT_GE(BeliefOf(Object(0)), belief_.activate_at);
  EXPECT_TRUE(map_.changes().empty()) << "nobody had looked there before";
}

TEST_F(ObjectLayerTest, TellsARemovalWhenAChairWasLookedThrough) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  const Stamp last_seen = Object(0).last_seen;
  room_.things.clear();
  const Stamp gone = now_;
  Insert(front_, std::vector{Through(ObjectId(0), 1)});
  EXPECT_EQ(Object(0).state, ObjectState::kPresent) << "one view may err";
  Insert(front_, std::vector{Through(ObjectId(0), 3)});
  EXPECT_EQ(Object(0).state, ObjectState::kAbsent);
  EXPECT_FALSE(Object(0).is_active);
  ASSERT_EQ(map_.changes().size(), 1U);
  const MapChange& change = map_.changes()[0];
  EXPECT_EQ(change.kind, MapChangeKind::kRemoved);
  EXPECT_EQ(change.object, ObjectId(0));
  EXPECT_EQ(change.last_seen_there, last_seen);
  ASSERT_TRUE(change.first_seen_absent);
  EXPECT_GE(*change.first_seen_absent, gone);
  EXPECT_GT(change.confidence, 0.5);
  EXPECT_FALSE(change.is_between_sessions);
}

TEST_F(ObjectLayerTest, StaysPresentWhenNothingIsSeenOfIt) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  const double belief = BeliefOf(Object(0));
  for (int i = 0; i < 10; ++i)
    Insert(PoseLookingAt({0.0, 0.2, 0.0}, {0.0, 0.2, -2.0}));
  EXPECT_EQ(Object(0).state, ObjectState::kPresent);
  EXPECT_EQ(BeliefOf(Object(0)), belief);
  EXPECT_TRUE(map_.changes().empty());
}

TEST_F(ObjectLayerTest, TellsAMoveWithTheNewId) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  room_.things = {Chair({2.0, 0.2, 0.0}, 7)};
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  Settle(PoseLookingAt({0.0, 0.2, 0.0}, {2.0, 0.2, 0.0}));
  ASSERT_EQ(map_.Objects().size(), 2U);
  ASSERT_EQ(map_.changes().size(), 1U) << "a removal and an arrival are one move";
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kMoved);
  EXPECT_EQ(map_.changes()[0].object, ObjectId(0));
  EXPECT_EQ(map_.changes()[0].new_object, ObjectId(1));
}

TEST_F(ObjectLayerTest, TellsAMoveWhenTheNewPlaceIsSeenFirst) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  const Se3 right = PoseLookingAt({0.0, 0.2, 0.0}, {2.0, 0.2, 0.0});
  room_.things.clear();
  Insert(right);
  Insert(right);  // it was empty there
  room_.things = {Chair({2.0, 0.2, 0.0}, 7)};
  Settle(right);
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kAdded);
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kMoved);
  EXPECT_EQ(map_.changes()[0].new_object, ObjectId(1));
}

TEST_F(ObjectLayerTest, TellsAReplacementWhenAnotherThingStandsThere) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  room_.things = {{BoxAt({0.0, 0.4, 2.0}, {0.3, 0.4, 0.3}), kBearClass, TrackId(9), 5.0F}};
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  Settle(front_);
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kReplaced);
  EXPECT_EQ(map_.changes()[0].object, ObjectId(0));
  EXPECT_EQ(map_.changes()[0].new_object, ObjectId(1));
}

TEST_F(ObjectLayerTest, TellsAnAdditionWhereThePlaceWasSeenEmpty) {
  Insert(front_);
  Insert(front_);
  room_.things = {Chair(kPlace)};
  Settle(front_);
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kAdded);
  EXPECT_EQ(map_.changes()[0].object, ObjectId(0));
}

TEST_F(ObjectLayerTest, ContinuesTheHistoryOfWhatComesBack) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  room_.things.clear();
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  ASSERT_EQ(Object(0).state, ObjectState::kAbsent);
  room_.things = {Chair(kPlace, 5)};
  Insert(front_, std::vector{Seen(ObjectId(0), 5)});
  ASSERT_EQ(map_.Objects().size(), 1U) << "it has its old id";
  EXPECT_EQ(Object(0).state, ObjectState::kPresent);
  EXPECT_FALSE(Object(0).absent_since);
  EXPECT_GT(Object(0).history.size(), 2U);
  ASSERT_EQ(map_.changes().size(), 2U);
  EXPECT_EQ(map_.changes()[1].kind, MapChangeKind::kAdded);
}

TEST_F(ObjectLayerTest, ForgetsCandidatesThatWereNeverThere) {
  room_.things = {Chair(kPlace)};
  has_points_ = true;
  keypoint_track_ = TrackId(1);
  Insert(front_);
  EXPECT_EQ(map_.PointsOfObject(ObjectId(0)).size(), 1U);
  room_.things.clear();
  keypoint_track_ = {};
  Insert(front_, std::vector{Through(ObjectId(0), 3)});
  EXPECT_TRUE(map_.Objects().empty());
  EXPECT_TRUE(map_.changes().empty());
  EXPECT_EQ(map_.FindPoint(PointId(0)), nullptr) << "what stood on it is gone as well";
}

TEST_F(ObjectLayerTest, ActivatesPointsWithTheirObjectAndHoldsThemBackWhenItGoes) {
  room_.things = {Chair(kPlace)};
  has_points_ = true;
  keypoint_track_ = TrackId(1);
  Insert(front_);
  ASSERT_EQ(map_.PointsOfObject(ObjectId(0)), std::vector<PointId>{PointId(0)});
  EXPECT_FALSE(IsUsable(*map_.FindPoint(PointId(0))));
  EXPECT_TRUE(IsUsable(*map_.FindPoint(PointId(1)))) << "it is on the wall";
  Insert(front_, std::vector{Seen(ObjectId(0))});
  EXPECT_TRUE(IsUsable(*map_.FindPoint(PointId(0))));
  room_.things.clear();
  keypoint_track_ = {};
  has_points_ = false;
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  EXPECT_FALSE(IsUsable(*map_.FindPoint(PointId(0))));
}

TEST_F(ObjectLayerTest, SweepsUnnamedPointsFromAPlaceThatIsLookedThrough) {
  room_.things = {Chair(kPlace)};
  has_points_ = true;  // but keypoints have no name
  Settle(front_);
  ASSERT_TRUE(map_.PointsOfObject(ObjectId(0)).empty());
  room_.things.clear();
  has_points_ = false;
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  EXPECT_FALSE(IsUsable(*map_.FindPoint(PointId(0))));
  EXPECT_TRUE(IsUsable(*map_.FindPoint(PointId(1))));
}

TEST_F(ObjectLayerTest, GoesOnSweepingThePlaceOfWhatHasGone) {
  has_points_ = true;
  room_.things = {Chair(kPlace)};
  Settle(front_);
  room_.things = {};
  const Se3 aside = PoseLookingAt({0.0, 0.2, 0.0}, {3.0, 0.2, 0.0});  // it is behind the camera
  Insert(aside, std::vector{Through(ObjectId(0), 4)});
  ASSERT_EQ(Object(0).state, ObjectState::kAbsent);
  ASSERT_FALSE(map_.FindPoint(PointId(0))->object.valid()) << "nobody has looked there since";
  Insert(front_);
  EXPECT_EQ(map_.FindPoint(PointId(0))->object, ObjectId(0));
}

TEST_F(ObjectLayerTest, DisplacesWhatALaterThingStandsOn) {
  const Thing bear{BoxAt(kPlace, {0.3, 0.3, 0.3}), kBearClass, TrackId(1), 5.0F};
  room_.things = {bear};
  Settle(front_);
  room_.things = {Chair(kPlace, 2)};  // nobody looks through: it stands all around
  for (const double x : {-1.5, 0.0, 1.5})
    Settle(PoseLookingAt({x, 0.2, 0.3}, kPlace));
  EXPECT_EQ(Object(0).state, ObjectState::kAbsent);
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kReplaced);
  EXPECT_EQ(map_.changes()[0].new_object, ObjectId(1));
}

TEST_F(ObjectLayerTest, DisplacesNothingThatIsStillSeen) {
  room_.things = {{BoxAt(kPlace + Eigen::Vector3d(0.0, 0.0, -0.22), {0.3, 0.3, 0.3}), kBearClass,
                   TrackId(1), 5.0F}};
  Settle(front_);
  room_.things.push_back(Chair(kPlace, 2));  // the bear's front sticks out of it
  room_.things[0].is_detected = false;
  for (const double x : {-1.5, 0.0, 1.5})
    Settle(PoseLookingAt({x, 0.2, 0.3}, kPlace));
  EXPECT_EQ(Object(0).state, ObjectState::kPresent);
}

TEST_F(ObjectLayerTest, MakesNoObjectOfAPiece) {
  room_.things = {{BoxAt(kPlace, {0.15, 0.15, 0.15}), kChairClass, TrackId(1), 2.0F}};
  EXPECT_EQ(Insert(front_).num_new, 0) << "a chair shows more of itself, or hides";
  room_.things[0].class_id = 41;
  EXPECT_EQ(Insert(front_).num_new, 1) << "a cup does not";
}

TEST_F(ObjectLayerTest, MakesANewObjectOfATrackThatStaysOffTheFirst) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  room_.things = {Chair(kPlace), Chair(kPlace + Eigen::Vector3d(0.9, 0.0, 0.6))};
  room_.things[0].is_detected = false;  // the track has found its thing behind
  EXPECT_EQ(Insert(front_).num_new, 0);
  EXPECT_EQ(Insert(front_).num_new, 0);
  EXPECT_EQ(Insert(front_).num_new, 1);
}

TEST_F(ObjectLayerTest, ForgetsWhatIsHardlyEverNamedThoughItStandsInView) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  ASSERT_EQ(Object(0).state, ObjectState::kPresent);
  ObjectEvidence unnamed;
  unnamed.object = ObjectId(0);
  unnamed.num_missed = 10;
  Insert(front_, std::vector{unnamed});
  ASSERT_FALSE(map_.Objects().empty()) << "not yet";
  Insert(front_, std::vector{unnamed});
  EXPECT_EQ(map_.ObjectSlot(0).state, ObjectState::kErased);
  EXPECT_TRUE(map_.changes().empty()) << "it was never there, so it did not go";
}

TEST_F(ObjectLayerTest, CallsAThingAsItsSizeSuggests) {
  constexpr int kSuitcaseClass = 28;
  const Eigen::Vector3d size(0.55, 0.5, 0.2);
  room_.things = {{BoxAt(kPlace, size), kChairClass, TrackId(1), 2.0F}};
  Settle(front_);
  room_.things[0].class_id = kSuitcaseClass;
  Insert(front_);
  ASSERT_EQ(map_.Objects().size(), 1U);
  EXPECT_EQ(Object(0).class_id, kSuitcaseClass) << "two votes to one, but no chair is so low";
}

TEST_F(ObjectLayerTest, MakesNoObjectsWithoutDepth) {
  room_.things = {Chair(kPlace)};
  test::ThingView seen = test::LookAtThings(room_, camera_, front_, now_);
  seen.view.depth_mm.setTo(0);
  KeyframeProposal blind;
  blind.objects = {seen.view, seen.sightings, {}};
  EXPECT_EQ(Insert(front_, blind).num_new, 0);
  blind.objects = {DepthView{}, seen.sightings, {}};
  EXPECT_EQ(Insert(front_, blind).num_new, 0);
  EXPECT_TRUE(map_.Objects().empty());
}

TEST_F(ObjectLayerTest, SurvivesAThousandFalseDetections) {
  Rng rng(3);
  const auto noise = [&](const DepthView& view, std::uint32_t first_track) {
    std::vector<ObjectSighting> sightings;
    for (std::uint32_t i = 0; i < 1000; ++i) {
      ObjectSighting sighting;
      sighting.track = TrackId(first_track + i);
      sighting.class_id = static_cast<int>(rng.Index(kNumCocoClasses));
      sighting.score = rng.Uniform(0.3, 1.0);
      cv::Mat mask = cv::Mat::zeros(view.depth_mm.size(), CV_8UC1);
      const auto u = static_cast<int>(rng.Index(140));
      const auto v = static_cast<int>(rng.Index(100));
      mask(cv::Rect(u, v, 20, 20)).setTo(255);
      sighting.region = test::RegionOf(view, mask);
      sighting.box = sighting.region.box;
      sighting.first_detected = sighting.detected = now_;
      sightings.push_back(std::move(sighting));
    }
    return sightings;
  };
  room_.things = {Chair(kPlace)};
  const DepthView view = test::LookAtThings(room_, camera_, front_, now_).view;
  for (std::uint32_t i = 0; i < 2; ++i) {
    KeyframeProposal proposal;
    proposal.objects = {view, noise(view, 1000 * i), {}};
    Insert(front_, proposal);
  }
  EXPECT_LE(map_.Objects().size(), 200U) << "the surest of each keyframe";
  EXPECT_TRUE(map_.changes().empty());
}

TEST_F(ObjectLayerTest, TakesAClockThatJumpsBack) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  now_ = Stamp{5};
  room_.things.clear();
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  EXPECT_EQ(Object(0).state, ObjectState::kAbsent);
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kRemoved);
  room_.things = {Chair({2.0, 0.2, 0.0}, 7)};
  Settle(PoseLookingAt({0.0, 0.2, 0.0}, {2.0, 0.2, 0.0}));
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kMoved);
}

TEST_F(ObjectLayerTest, MergesWhatDriftHadMadeTwo) {
  room_.things = {Chair(kPlace, 1)};
  Insert(front_);
  const Se3 drifted(front_.rotation, front_.translation + Eigen::Vector3d(1.5, 0.0, 0.0));
  room_.things = {Chair(kPlace + Eigen::Vector3d(1.5, 0.0, 0.0), 2)};
  Insert(drifted);
  ASSERT_EQ(map_.Objects().size(), 2U);
  EXPECT_EQ(layer_->MergeAllDoubles(map_), 0) << "they are 1.5 m apart";
  map_.SetPose(KeyframeId(1), front_);  // as a loop would
  EXPECT_EQ(layer_->MergeAllDoubles(map_), 1);
  EXPECT_EQ(map_.Objects(), std::vector<ObjectId>{ObjectId(0)});
  EXPECT_EQ(map_.Resolve(ObjectId(1)), ObjectId(0));
  EXPECT_EQ(Object(0).num_sightings, 2);
}

TEST_F(ObjectLayerTest, TakesEvidenceForWhatIsMergedOrUnknown) {
  room_.things = {Chair(kPlace)};
  Insert(front_);
  EXPECT_NO_THROW(Insert(front_, std::vector{Through(ObjectId(99), 4), Seen(ObjectId(0))}));
  EXPECT_EQ(Object(0).state, ObjectState::kPresent);
}

TEST_F(ObjectLayerTest, UpdatesOncePerVisitWhenToldSo) {
  MapObjectOptions objects;
  objects.belief_update = "visit";
  objects.visit_gap_keyframes = 3;
  MakeLayer(objects);
  room_.things = {Chair(kPlace)};
  Settle(front_);
  ASSERT_EQ(Object(0).state, ObjectState::kPresent);
  room_.things.clear();
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  EXPECT_EQ(Object(0).state, ObjectState::kPresent) << "this visit has had its say";
  for (int i = 0; i < 3; ++i)
    Insert(front_);
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  EXPECT_EQ(Object(0).state, ObjectState::kAbsent);
}

TEST_F(ObjectLayerTest, MeasuresByMapPointsWhenToldSo) {
  MapObjectOptions objects;
  objects.extent = "points";
  MakeLayer(objects);
  room_.things = {Chair(kPlace)};
  has_points_ = true;
  keypoint_track_ = TrackId(1);
  Insert(front_);
  Insert(front_);
  const Eigen::Vector3d centroid = map_.CentroidOf(Object(0));
  EXPECT_LT((centroid - map_.FindPoint(PointId(0))->p_world).norm(), 1e-6);
}

TEST_F(ObjectLayerTest, DoesNothingWhenSwitchedOff) {
  MapObjectOptions objects;
  objects.enabled = false;
  MakeLayer(objects);
  room_.things = {Chair(kPlace)};
  EXPECT_EQ(Insert(front_).num_new, 0);
  EXPECT_TRUE(map_.Objects().empty());
}

TEST_F(ObjectLayerTest, MarksChangesBetweenSessions) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  map_.StartSession();
  layer_->Reset();
  room_.things.clear();
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_TRUE(map_.changes()[0].is_between_sessions);
}

}  // namespace
}  // namespace cslam
