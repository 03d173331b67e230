// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/loop_closer.h"

#include "cslam/map/test_room.h"
#include "cslam/mapping/correction.h"
#include "cslam/mapping/full_ba.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

constexpr int kTurn = 36;  // keyframes of a full circle
constexpr int kRoomPoints = 1800;

Se3 SmallDrift() {
  return Exp((Vector6() << 0.001, 0.004, 0.0005, 0.0, 0.0, 0.0).finished());
}

PlaceSensor RoomSensor() {
  return {.camera = test::RoomCamera(),
          .bounds = UndistortedBounds(test::RoomCamera()),
          .baseline_m = test::kRoomBaselineM,
          .model = MeasurementModel(test::kRoomScales, 1.0)};
}

PlaceIndex IndexOf(const MapView& map) {
  PlaceIndex index;
  for (const KeyframeId id : map.Keyframes()) {
    const Keyframe& keyframe = *map.FindKeyframe(id);
    index.Add(id, SelectDescriptors(keyframe.data->features, PlaceKeypoints(map, keyframe)));
  }
  return index;
}

const LoopRecord* FindVerdict(const LoopOutcome& outcome, LoopVerdict verdict) {
  for (const LoopRecord& record : outcome.records) {
    if (record.verdict == verdict) return &record;
  }
  return nullptr;
}

// Reasons of all records, for messages of failed tests.
std::string Reasons(const LoopOutcome& outcome) {
  std::string reasons;
  for (const LoopRecord& record : outcome.records)
    reasons += std::string(ToString(record.verdict)) + ": " + record.reason + "; ";
  return reasons;
}

LoopOutcome ProcessNewest(LoopCloser& closer, test::RoomMapper& mapper) {
  const MapView snapshot = mapper.map().Snapshot();
  return closer.Process(snapshot.Keyframes().back(), snapshot, IndexOf(snapshot));
}

// A circle with drift that has just come round to where it began.
class LoopCloserTest : public testing::Test {
 protected:
  LoopCloserTest()
      : mapper_(test::DriftingCircle(test::MakeRoom(kRoomPoints, 1), kTurn, 1, SmallDrift())) {}

  // The next keyframe of the circle, with the same drift.
  static KeyframeId AddNext(test::RoomMapper& mapper) {
    const auto last = mapper.map().Keyframes().back();
    const Se3 T_true = test::CirclePose(static_cast<double>(last.value() + 1) / kTurn);
    const Se3 T_last_next = mapper.truth()[last.index()].Inverse() * T_true;
    return mapper.Add(
        T_true, mapper.map().FindKeyframe(last)->T_world_camera * T_last_next * SmallDrift(), last);
  }
  // Come round a little farther, with a thing in the room that was not there the first time.
  static test::RoomMapper SecondVisitWith(const test::TestBox& thing) {
    auto mapper = test::DriftingCircle(test::MakeRoom(kRoomPoints, 1), kTurn, 0, SmallDrift());
    mapper.room().things.push_back(thing);
    for (int i = 0; i < 3; ++i)
      AddNext(mapper);
    return mapper;
  }
  double Error() { return test::PositionError(mapper_.map(), mapper_.truth()); }

  test::RoomMapper mapper_;
  LoopCloser closer_{RoomSensor(), {}};
};

TEST_F(LoopCloserTest, ClosesADriftingCircle) {
  const double before = Error();
  EXPECT_GT(before, 0.05);
  const LoopOutcome outcome = ProcessNewest(closer_, mapper_);
  ASSERT_TRUE(outcome.correction.has_value()) << Reasons(outcome);
  const CorrectionReport report = ApplyCorrection(mapper_.map(), *outcome.correction);
  EXPECT_TRUE(report.is_applied()) << report.refusal;
  EXPECT_EQ(mapper_.map().CheckInvariants(), "");
  EXPECT_LT(Error(), 0.2 * before);
  EXPECT_GT(report.points_fused, 30);
  EXPECT_EQ(mapper_.map().loops().size(), 1U);
}

TEST_F(LoopCloserTest, FullBundleAdjustmentAfterwardsMakesItExact) {
  const double before = Error();
  const LoopOutcome outcome = ProcessNewest(closer_, mapper_);
  ASSERT_TRUE(outcome.correction.has_value()) << Reasons(outcome);
  ApplyCorrection(mapper_.map(), *outcome.correction);
  const auto refinement = AdjustFully(mapper_.map().Snapshot(), MapId(0), mapper_.camera(),
                                      DepthOptions{}, RoomSensor().model, {});
  ASSERT_TRUE(refinement.has_value());
  EXPECT_TRUE(ApplyRefinement(mapper_.map(), *refinement).is_applied());
  EXPECT_EQ(mapper_.map().CheckInvariants(), "");
  EXPECT_LT(Error(), 0.1 * before);
}

TEST_F(LoopCloserTest, RecordsWhyALoopWasClosed) {
  const LoopOutcome outcome = ProcessNewest(closer_, mapper_);
  const LoopRecord* record = FindVerdict(outcome, LoopVerdict::kClosed);
  ASSERT_NE(record, nullptr) << Reasons(outcome);
  EXPECT_EQ(record->query, KeyframeId(kTurn));
  EXPECT_EQ(record->query_stamp, Stamp{1'000'000'000LL * kTurn});
  EXPECT_EQ(record->match_stamp, Stamp{1'000'000'000LL * record->match.value()});
  const Se3 T_true =
      mapper_.truth()[record->match.index()].Inverse() * mapper_.truth()[record->query.index()];
  EXPECT_LT(Difference(T_true, *record->T_match_query).distance_m, 0.03);
  EXPECT_GE(record->evidence.num_inliers, 40);
  EXPECT_GE(record->evidence.num_confirmations, 2);
  EXPECT_GT(record->evidence.depth_compared, 1000);
  EXPECT_LT(record->evidence.depth_contradicted, 0.05);
  EXPECT_GT(record->evidence.path_m, 4.0);
  EXPECT_GT(record->evidence.drift_m, 0.05);
  EXPECT_FALSE(record->reason.empty());
}

TEST_F(LoopCloserTest, CorrectsAMapThatHasGrownSince) {
  const LoopOutcome outcome = ProcessNewest(closer_, mapper_);
  ASSERT_TRUE(outcome.correction.has_value()) << Reasons(outcome);
  AddNext(mapper_);
  AddNext(mapper_);
  const double before = Error();
  const CorrectionReport report = ApplyCorrection(mapper_.map(), *outcome.correction);
  EXPECT_EQ(report.keyframes_carried, 2);
  EXPECT_EQ(mapper_.map().CheckInvariants(), "");
  EXPECT_LT(Error(), 0.2 * before);
}

TEST_F(LoopCloserTest, CorrectsAMapWhoseKeyframesWereCulledSince) {
  const LoopOutcome outcome = ProcessNewest(closer_, mapper_);
  ASSERT_TRUE(outcome.correction.has_value()) << Reasons(outcome);
  const double before = Error();
  mapper_.map().CullKeyframe(outcome.correction->loop.query);
  for (const std::uint32_t id : {5U, 6U, 20U})
    mapper_.map().CullKeyframe(KeyframeId(id));
  EXPECT_TRUE(ApplyCorrection(mapper_.map(), *outcome.correction).is_applied());
  EXPECT_EQ(mapper_.map().CheckInvariants(), "");
  EXPECT_LT(Error(), 0.2 * before);
}

TEST_F(LoopCloserTest, FindsNothingNewOnceTheLoopIsClosed) {
  const LoopOutcome first = ProcessNewest(closer_, mapper_);
  ASSERT_TRUE(first.correction.has_value()) << Reasons(first);
  ApplyCorrection(mapper_.map(), *first.correction);
  const LoopOutcome second = ProcessNewest(closer_, mapper_);
  EXPECT_FALSE(second.correction.has_value()) << Reasons(second);
}

TEST_F(LoopCloserTest, WaitsForLaterKeyframesWhenNeighboursAreNotAsked) {
  LoopOptions options;
  options.confirmations = 3;
  options.confirming_neighbours = 0;
  LoopCloser closer(RoomSensor(), options);
  for (int i = 1; i <= 2; ++i) {
    const LoopOutcome outcome = ProcessNewest(closer, mapper_);
    EXPECT_FALSE(outcome.correction.has_value());
    const LoopRecord* record = FindVerdict(outcome, LoopVerdict::kPending);
    ASSERT_NE(record, nullptr) << Reasons(outcome);
    EXPECT_EQ(record->evidence.num_confirmations, i);
    AddNext(mapper_);
  }
  EXPECT_TRUE(ProcessNewest(closer, mapper_).correction.has_value());
}

TEST_F(LoopCloserTest, OnlyFusesWhereThereIsNoDrift) {
  auto mapper = test::DriftingCircle(test::MakeRoom(kRoomPoints, 1), kTurn, 1, Se3());
  const LoopOutcome outcome = ProcessNewest(closer_, mapper);
  ASSERT_TRUE(outcome.correction.has_value()) << Reasons(outcome);
  EXPECT_TRUE(outcome.correction->moves.empty());
  const CorrectionReport report = ApplyCorrection(mapper.map(), *outcome.correction);
  EXPECT_GT(report.points_fused, 30);
  EXPECT_LT(test::PositionError(mapper.map(), mapper.truth()), 1e-9);
}

TEST_F(LoopCloserTest, LetsNothingProveALoopThatMayHaveBeenMoved) {
  MapObject furniture;
  furniture.map = MapId(0);
  furniture.reference = KeyframeId(0);
  furniture.state = ObjectState::kPresent;
  furniture.is_active = true;
  const ObjectId object = mapper_.map().AddObject(std::move(furniture));
  for (std::uint32_t first = 0; first < 4; ++first) {
    for (const PointId point : mapper_.map().FindKeyframe(KeyframeId(first))->points) {
      if (point.valid()) mapper_.map().AssignPoint(point, object);
    }
  }
  EXPECT_FALSE(ProcessNewest(closer_, mapper_).correction.has_value());
  LoopOptions options;
  options.use_objects = true;
  LoopCloser trusting{RoomSensor(), options};
  const LoopOutcome outcome = ProcessNewest(trusting, mapper_);
  EXPECT_TRUE(outcome.correction.has_value()) << Reasons(outcome);
}

TEST_F(LoopCloserTest, RefusesALookAlikePlaceThatMeasuredDepthContradicts) {
  auto mapper = SecondVisitWith({{-0.2, -1.3, 1.7}, {3.0, 1.3, 2.2}});
  const LoopOutcome outcome = ProcessNewest(closer_, mapper);
  EXPECT_FALSE(outcome.correction.has_value());
  const bool is_depth =
      std::any_of(outcome.records.begin(), outcome.records.end(), [](const LoopRecord& r) {
        return r.verdict == LoopVerdict::kRefused && r.evidence.depth_contradicted > 0.2 &&
               r.reason.find("depth contradicts") != std::string::npos;
      });
  EXPECT_TRUE(is_depth) << Reasons(outcome);
}

TEST_F(LoopCloserTest, RefusesALoopThatOneArmchairContradicts) {
  auto mapper = SecondVisitWith({{0.2, -0.2, 2.0}, {0.7, 0.5, 2.4}});
  const LoopOutcome refused = ProcessNewest(closer_, mapper);
  EXPECT_FALSE(refused.correction.has_value());
  LoopOptions options;
  options.depth_check.max_contradicted = 0.2;
  LoopCloser trusting{RoomSensor(), options};
  const LoopOutcome closed = ProcessNewest(trusting, mapper);
  const LoopRecord* record = FindVerdict(closed, LoopVerdict::kClosed);
  ASSERT_NE(record, nullptr) << Reasons(closed);
  EXPECT_GT(record->evidence.depth_contradicted, 0.05);
}

TEST_F(LoopCloserTest, RefusesATwinPlaceMetresAway) {
  // The second half of the way is estimated 3 m off: another room that looks the same.
  auto mapper = test::DriftingCircle(test::MakeRoom(kRoomPoints, 1), kTurn, 0, Se3());
  const Se3 T_twin(Eigen::Quaterniond::Identity(), {3.0, 0.0, 0.0});
  KeyframeId last(kTurn - 1);
  for (int i = 0; i < 3; ++i) {
    const Se3 T_true = test::CirclePose(static_cast<double>(kTurn + i) / kTurn);
    last = mapper.Add(T_true, T_twin * T_true, last);
  }
  const LoopOutcome outcome = ProcessNewest(closer_, mapper);
  EXPECT_FALSE(outcome.correction.has_value());
  ASSERT_FALSE(outcome.records.empty());
  EXPECT_NE(Reasons(outcome).find("more than drift explains"), std::string::npos)
      << Reasons(outcome);
}

TEST_F(LoopCloserTest, WeldsTwoMaps) {
  const Se3 T_other_world = test::CirclePose(0.37, 5.0);  // the second map lies anywhere
  auto mapper = test::DriftingCircle(test::MakeRoom(kRoomPoints, 1), kTurn, -12, Se3());
  KeyframeId last;
  for (int i = 0; i < 8; ++i) {
    const Se3 T_true = test::CirclePose((30.0 + i) / kTurn);  // comes round to map 0's beginning
    last = mapper.Add(T_true, T_other_world * T_true, last, MapId(1));
  }
  const LoopOutcome outcome = ProcessNewest(closer_, mapper);
  ASSERT_TRUE(outcome.correction.has_value()) << Reasons(outcome);
  EXPECT_EQ(outcome.correction->map, MapId(1));
  EXPECT_EQ(outcome.correction->merge_into, MapId(0));
  EXPECT_NE(FindVerdict(outcome, LoopVerdict::kMerged), nullptr);
  const CorrectionReport report = ApplyCorrection(mapper.map(), *outcome.correction);
  EXPECT_TRUE(report.is_applied()) << report.refusal;
  EXPECT_EQ(mapper.map().CheckInvariants(), "");
  EXPECT_GT(report.points_fused, 20);
  EXPECT_EQ(mapper.map().FindKeyframe(last)->map, MapId(0));
  EXPECT_LT(test::PositionError(mapper.map(), mapper.truth()), 0.03);
  EXPECT_TRUE(mapper.map().loops().empty());
}

TEST_F(LoopCloserTest, WeldsNoMapsBetweenWhichNoCameraCanHaveGone) {
  auto mapper = test::DriftingCircle(test::MakeRoom(kRoomPoints, 1), kTurn, -12, Se3());
  KeyframeId last;
  for (int i = 0; i < 8; ++i) {
    const Se3 T_true = test::CirclePose((30.0 + i) / kTurn);
    last = mapper.Add(T_true, T_true, last, MapId(1));
  }
  LoopOptions options;
  options.max_drift_m = 0.1;
  options.max_speed_m_s = 0.2;  // a second passes between two keyframes, 0.7 m lie between the maps
  LoopCloser closer(RoomSensor(), options);
  const LoopOutcome outcome = ProcessNewest(closer, mapper);
  EXPECT_FALSE(outcome.correction.has_value());
  EXPECT_NE(Reasons(outcome).find("from one map to the other"), std::string::npos)
      << Reasons(outcome);
}

TEST_F(LoopCloserTest, GivesTheSameTwice) {
  LoopCloser other(RoomSensor(), {});
  const LoopOutcome a = ProcessNewest(closer_, mapper_);
  const LoopOutcome b = ProcessNewest(other, mapper_);
  ASSERT_TRUE(a.correction && b.correction);
  ASSERT_EQ(a.correction->moves.size(), b.correction->moves.size());
  for (std::size_t i = 0; i < a.correction->moves.size(); ++i) {
    EXPECT_EQ(a.correction->moves[i].T_new_old.Matrix(), b.correction->moves[i].T_new_old.Matrix());
  }
  ASSERT_EQ(a.correction->pairs.size(), b.correction->pairs.size());
  ASSERT_EQ(a.correction->found.size(), b.correction->found.size());
}

TEST_F(LoopCloserTest, FindsNothingInAnEmptyMapOrForACulledKeyframe) {
  const Map empty(test::kRoomScales);
  EXPECT_TRUE(closer_.Process(KeyframeId(0), empty, PlaceIndex()).records.empty());
  mapper_.map().CullKeyframe(KeyframeId(kTurn));
  const MapView snapshot = mapper_.map().Snapshot();
  EXPECT_TRUE(closer_.Process(KeyframeId(kTurn), snapshot, IndexOf(snapshot)).records.empty());
}

}  // namespace
}  // namespace cslam
