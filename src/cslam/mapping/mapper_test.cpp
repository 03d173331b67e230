// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/mapper.h"

#include "cslam/sim/test_frames.h"
#include "cslam/util/check.h"
#include "cslam/vision/matching.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace cslam {
namespace {

// Every tenth frame of the simulated tour: proposals as a tracker would send them.
const test::TestFrames& Frames() {
  static const auto frames =
      test::MakeTestFrames({.width = 320, .height = 240, .fps = 3.0, .num_frames = 12});
  return frames;
}

class MapperTest : public testing::Test {
 protected:
  MapperTest() {
    orb_.num_features = 500;
    options_.check_invariants = true;
  }
  Mapper MakeMapper() const { return {Frames().camera, orb_, depth_, options_}; }

  std::shared_ptr<const KeyframeData> DataOf(std::size_t i) const {
    const RgbdFrame& frame = *Frames().frames[i];
    auto data = std::make_shared<KeyframeData>();
    data->frame = frame.id;
    data->stamp = frame.stamp;
    data->features = MeasureFeatures(OrbExtractor(orb_).Extract(frame.gray), frame, Frames().camera,
                                     UndistortedBounds(Frames().camera), depth_);
    return data;
  }
  static Se3 Truth(std::size_t i) {
    return Frames().truth[0].T_world_camera.Inverse() * Frames().truth[i].T_world_camera;
  }
  KeyframeProposal FirstProposal(std::uint32_t id = 0, MapId map = MapId(0)) const {
    KeyframeProposal proposal;
    proposal.id = KeyframeId(id);
    proposal.map = map;
    proposal.reason = KeyframeReason::kStartsMap;
    proposal.data = DataOf(0);
    proposal.matches.resize(proposal.data->features.size());
    return proposal;
  }
  // Frame i relative to keyframe i - 1, matched with its points by descriptor; the pose may be off.
  KeyframeProposal NextProposal(const Mapper& mapper, std::uint32_t i,
                                const Se3& error = {}) const {
    KeyframeProposal proposal;
    proposal.id = KeyframeId(i);
    proposal.map = MapId(0);
    proposal.reason = KeyframeReason::kReferenceLost;
    proposal.data = DataOf(i);
    proposal.reference = KeyframeId(i - 1);
    proposal.T_reference_camera = Truth(i - 1).Inverse() * Truth(i) * error;
    proposal.matches.resize(proposal.data->features.size());
    const auto anchored = mapper.map().Resolve(proposal.reference);
    const Keyframe& reference = *mapper.map().FindKeyframe(anchored->keyframe);
    std::vector<int> seen;
    for (std::size_t k = 0; k < reference.points.size(); ++k) {
      if (reference.points[k].valid()) seen.push_back(static_cast<int>(k));
    }
    std::vector<int> all(proposal.matches.size());
    for (std::size_t k = 0; k < all.size(); ++k)
      all[k] = static_cast<int>(k);
    for (const Match& match :
         MatchByDescriptor(reference.data->features, seen, proposal.data->features, all,
                           {.max_distance = 50, .max_ratio = 0.8, .check_rotation = true})) {
      proposal.matches[static_cast<std::size_t>(match.keypoint)] =
          reference.points[static_cast<std::size_t>(match.query)];
    }
    return proposal;
  }
  void InsertAndRefine(Mapper& mapper, std::uint32_t count) const {
    mapper.Insert(FirstProposal());
    mapper.Refine();
    for (std::uint32_t i = 1; i < count; ++i) {
      mapper.Insert(NextProposal(mapper, i));
      mapper.Refine();
    }
  }
  // Mean squared reprojection error over all observations, px^2.
  double ReprojectionError(const MapView& map) const {
    double sum = 0.0;
    int count = 0;
    for (std::uint32_t i = 0; i < map.num_point_ids(); ++i) {
      const MapPoint* point = map.FindPoint(PointId(i));
      if (point == nullptr || point->observations.size() < 2) continue;
      for (const PointObservation& o : point->observations) {
        const Keyframe& keyframe = *map.FindKeyframe(o.keyframe);
        const auto& keypoint =
            keyframe.data->features.keypoints[static_cast<std::size_t>(o.keypoint)];
        const Eigen::Vector3d p_camera = keyframe.T_world_camera.Inverse() * point->p_world;
        const Eigen::Vector2d uv = Project(Frames().camera, p_camera);
        sum += std::min(100.0, (uv - keypoint.uv_px.cast<double>()).squaredNorm());
        ++count;
      }
    }
    return count == 0 ? 0.0 : sum / count;
  }

  OrbOptions orb_;
  DepthOptions depth_;
  MapperOptions options_;
};

TEST_F(MapperTest, InsertPublishesTheKeyframeAndItsPointsBeforeAnyRefinement) {
  Mapper mapper = MakeMapper();
  const MapUpdate update = mapper.Insert(FirstProposal());
  EXPECT_EQ(update.step, MapUpdate::Step::kInserted);
  EXPECT_EQ(update.keyframe, KeyframeId(0));
  EXPECT_EQ(update.snapshot->revision, 1U);
  EXPECT_EQ(update.snapshot->proposals_applied, 1U);
  EXPECT_EQ(update.snapshot->map.num_keyframes(), 1U);
  EXPECT_GT(update.points_created, 100);
  EXPECT_EQ(update.snapshot->map.num_points(), static_cast<std::size_t>(update.points_created));
  const MapUpdate refined = mapper.Refine();
  EXPECT_EQ(refined.step, MapUpdate::Step::kRefined);
  EXPECT_EQ(refined.snapshot->revision, 2U);
  EXPECT_EQ(refined.snapshot->proposals_applied, 1U);
}

TEST_F(MapperTest, PublishedSnapshotsNeverChange) {
  Mapper mapper = MakeMapper();
  const auto first = mapper.Insert(FirstProposal()).snapshot;
  const std::size_t num_points = first->map.num_points();
  const Eigen::Vector3d p_world = first->map.FindPoint(PointId(0))->p_world;
  mapper.Refine();
  mapper.Insert(NextProposal(mapper, 1));
  mapper.Refine();
  EXPECT_EQ(first->map.num_keyframes(), 1U);
  EXPECT_EQ(first->map.num_points(), num_points);
  EXPECT_EQ(first->map.FindPoint(PointId(0))->p_world, p_world);
}

TEST_F(MapperTest, ProposalIsPlacedRelativeToItsReferenceAsItIsNow) {
  Mapper mapper = MakeMapper();
  mapper.Insert(FirstProposal());
  mapper.Refine();
  const KeyframeProposal proposal = NextProposal(mapper, 1);
  mapper.Insert(proposal);
  const Keyframe& keyframe = *mapper.map().FindKeyframe(KeyframeId(1));
  EXPECT_LT(Difference(keyframe.T_world_camera, proposal.T_reference_camera).distance_m, 1e-12);
  EXPECT_EQ(keyframe.parent, KeyframeId(0));
  EXPECT_GT(keyframe.covisible.at(0).shared_points, 50);
}

TEST_F(MapperTest, RefusesAProposalWhoseReferenceItDoesNotKnow) {
  Mapper mapper = MakeMapper();
  mapper.Insert(FirstProposal());
  mapper.Refine();
  KeyframeProposal proposal = NextProposal(mapper, 1);
  proposal.reference = KeyframeId(77);
  const MapUpdate update = mapper.Insert(proposal);
  EXPECT_EQ(update.step, MapUpdate::Step::kRefused);
  EXPECT_EQ(update.snapshot->proposals_applied, 2U) << "it is no longer in flight";
  EXPECT_EQ(mapper.map().num_keyframes(), 1U);
  proposal.reference = KeyframeId(0);
  EXPECT_EQ(mapper.Insert(proposal).step, MapUpdate::Step::kInserted) << "its id is still free";
}

TEST_F(MapperTest, FollowsStaleIdsOfMatches) {
  Mapper mapper = MakeMapper();
  mapper.Insert(FirstProposal());
  mapper.Refine();
  KeyframeProposal proposal = NextProposal(mapper, 1);
  for (std::size_t i = 0; i < proposal.matches.size(); i += 3)
    proposal.matches[i] = PointId(1'000'000 + static_cast<std::uint32_t>(i));
  EXPECT_EQ(mapper.Insert(proposal).step, MapUpdate::Step::kInserted);
}

TEST_F(MapperTest, CountsSightingsAndForgetsThoseOfPointsThatAreGone) {
  Mapper mapper = MakeMapper();
  mapper.Insert(FirstProposal());
  mapper.Refine();
  KeyframeProposal proposal = NextProposal(mapper, 1);
  const auto matched = std::find_if(proposal.matches.begin(), proposal.matches.end(),
                                    [](PointId id) { return id.valid(); });
  ASSERT_NE(matched, proposal.matches.end());
  proposal.sightings = {{*matched, 20, 12}, {PointId(999'999), 5, 5}};
  mapper.Insert(proposal);
  EXPECT_EQ(mapper.map().FindPoint(*matched)->times_expected, 21);
  EXPECT_EQ(mapper.map().FindPoint(*matched)->times_found, 13);
}

TEST_F(MapperTest, ErasesPointsThatAreRarelyFound) {
  Mapper mapper = MakeMapper();
  mapper.Insert(FirstProposal());
  mapper.Refine();
  KeyframeProposal proposal = NextProposal(mapper, 1);
  std::vector<PointId> unlucky;
  for (const PointId id : mapper.map().FindKeyframe(KeyframeId(0))->points) {
    if (id.valid() && unlucky.size() < 5) unlucky.push_back(id);
  }
  for (const PointId id : unlucky)
    proposal.sightings.push_back({id, 100, 10});
  mapper.Insert(proposal);
  EXPECT_GE(mapper.Refine().points_culled, 5);
  for (const PointId id : unlucky)
    EXPECT_EQ(mapper.map().Resolve(id), std::nullopt);
}

TEST_F(MapperTest, NearKeypointsBecomePointsFarOnesOnlyUntilThereAreEnough) {
  depth_.near_baselines = 20.0;  // 1.6 m
  options_.min_near_points = 0;
  Mapper near_only = MakeMapper();
  near_only.Insert(FirstProposal());
  options_.min_near_points = 200;
  Mapper with_far = MakeMapper();
  with_far.Insert(FirstProposal());
  const auto far_points = [&](const Mapper& mapper) {
    int count = 0;
    const Keyframe& keyframe = *mapper.map().FindKeyframe(KeyframeId(0));
    for (std::size_t i = 0; i < keyframe.points.size(); ++i) {
      const auto z = static_cast<double>(keyframe.data->features.keypoints[i].depth_m);
      if (keyframe.points[i].valid() && z > depth_.near_depth_m()) ++count;
    }
    return count;
  };
  EXPECT_EQ(far_points(near_only), 0);
  EXPECT_GT(far_points(with_far), 0);
  EXPECT_GE(with_far.map().num_points(), 200U);
  EXPECT_LE(with_far.map().num_points(), std::max<std::size_t>(201U, near_only.map().num_points()));
}

TEST_F(MapperTest, LocalBundleAdjustmentLowersTheReprojectionError) {
  Mapper mapper = MakeMapper();
  InsertAndRefine(mapper, 3);
  const Se3 error(ExpSo3({0.004, -0.006, 0.003}), {0.01, -0.008, 0.012});
  const auto inserted = mapper.Insert(NextProposal(mapper, 3, error));
  const auto refined = mapper.Refine();
  EXPECT_GT(refined.ba_iterations, 0);
  EXPECT_FALSE(refined.ba_was_stopped);
  const double before = ReprojectionError(inserted.snapshot->map);
  const double after = ReprojectionError(refined.snapshot->map);
  EXPECT_LT(after, 0.6 * before) << before << " px^2 before";
  const Se3 truth = Truth(3);
  const auto distance = [&](const MapUpdate& update) {
    return Difference(truth, *update.snapshot->map.T_world_keyframe(KeyframeId(3))).distance_m;
  };
  EXPECT_LT(distance(refined), distance(inserted));
}

TEST_F(MapperTest, BundleAdjustmentStopsWhenToldSo) {
  Mapper mapper = MakeMapper();
  InsertAndRefine(mapper, 3);
  const Se3 error(ExpSo3({0.004, -0.006, 0.003}), {0.01, -0.008, 0.012});
  mapper.Insert(NextProposal(mapper, 3, error));
  const auto refined = mapper.Refine([] { return true; });
  EXPECT_TRUE(refined.ba_was_stopped);
  EXPECT_EQ(mapper.map().CheckInvariants(), "");
}

TEST_F(MapperTest, CullsAKeyframeThatShowsNothingNew) {
  Mapper mapper = MakeMapper();
  InsertAndRefine(mapper, 2);
  // The same view again and again: all but the newest become redundant.
  int culled = 0;
  for (std::uint32_t id = 2; id < 8; ++id) {
    KeyframeProposal proposal = NextProposal(mapper, 1);
    proposal.id = KeyframeId(id);
    proposal.reference = KeyframeId(id - 1);
    proposal.T_reference_camera = Se3();
    const auto anchored = mapper.map().Resolve(proposal.reference);
    const auto& seen = mapper.map().FindKeyframe(anchored->keyframe)->points;
    if (seen.size() == proposal.matches.size()) proposal.matches = seen;
    mapper.Insert(proposal);
    culled += mapper.Refine().keyframes_culled;
  }
  EXPECT_GT(culled, 0);
  for (std::uint32_t id = 0; id < 8; ++id)
    EXPECT_TRUE(mapper.map().T_world_keyframe(KeyframeId(id)).has_value()) << "keyframe " << id;
}

TEST_F(MapperTest, KeepsItsMapWholeAndTrueOverManyKeyframes) {
  Mapper mapper = MakeMapper();
  InsertAndRefine(mapper, 12);
  EXPECT_EQ(mapper.map().CheckInvariants(), "");
  for (std::uint32_t i = 0; i < 12; ++i) {
    const auto T_world_camera = mapper.map().T_world_keyframe(KeyframeId(i));
    ASSERT_TRUE(T_world_camera.has_value());
    EXPECT_LT(Difference(Truth(i), *T_world_camera).distance_m, 0.05) << "keyframe " << i;
  }
}

TEST_F(MapperTest, ResetForgetsTheMapButUsesNoIdTwice) {
  Mapper mapper = MakeMapper();
  InsertAndRefine(mapper, 2);
  const std::size_t point_ids = mapper.map().num_point_ids();
  mapper.Reset();
  EXPECT_EQ(mapper.map().num_keyframes(), 0U);
  EXPECT_EQ(mapper.map().num_points(), 0U);
  EXPECT_THROW(mapper.Refine(), InternalError) << "nothing has been inserted";
  EXPECT_THROW(mapper.Insert(FirstProposal(1)), InternalError) << "keyframe 1 existed";
  const MapUpdate update = mapper.Insert(FirstProposal(5, MapId(1)));
  const Keyframe& keyframe = *update.snapshot->map.FindKeyframe(KeyframeId(5));
  for (const PointId id : keyframe.points) {
    EXPECT_TRUE(!id.valid() || id.index() >= point_ids) << "point " << id.value();
  }
}

TEST_F(MapperTest, RevisionsGrowThroughAReset) {
  Mapper mapper = MakeMapper();
  const auto before = mapper.Insert(FirstProposal()).snapshot->revision;
  mapper.Reset();
  EXPECT_GT(mapper.Insert(FirstProposal(1, MapId(1))).snapshot->revision, before);
}

}  // namespace
}  // namespace cslam
