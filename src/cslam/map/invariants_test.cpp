// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/map/map.h"
#include "cslam/map/test_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace cslam {
namespace {

using test::MakeKeyframe;
using testing::HasSubstr;

// Reaches behind the mutators to break what they keep whole.
class MapTestPeer : public Map {
 public:
  MapTestPeer() : Map(test::kLevelScales) {
    AddKeyframe(MakeKeyframe(0, 10, 0.0));
    AddKeyframe(MakeKeyframe(1, 10, 1.0, KeyframeId(0)));
    AddKeyframe(MakeKeyframe(2, 10, 2.0, KeyframeId(1)));
    for (int i = 0; i < 5; ++i) {
      const PointId point = AddPoint({0.0, 0.0, 4.0}, KeyframeId(0));
      for (const std::uint32_t k : {0U, 1U, 2U})
        AddObservation(point, KeyframeId(k), i);
      RefreshAppearance(point);
    }
  }
  Keyframe& keyframe(std::size_t i) { return keyframes_.Edit(i); }
  MapPoint& point(std::size_t i) { return points_.Edit(i); }
  void MiscountPoints() { ++num_points_; }
  void MiscountKeyframes() { ++num_keyframes_; }
};

TEST(CheckInvariants, HoldInAMapMadeByItsMutators) {
  EXPECT_EQ(MapTestPeer().CheckInvariants(), "");
  EXPECT_EQ(Map(test::kLevelScales).CheckInvariants(), "");
}

TEST(CheckInvariants, NoticePointThatDoesNotKnowWhoSeesIt) {
  MapTestPeer map;
  auto& observations = map.point(2).observations;
  observations.erase(observations.begin());
  map.point(2).reference = KeyframeId(1);
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("point 2 is not seen back by keyframe 0"));
}

TEST(CheckInvariants, NoticeKeyframeThatDoesNotKnowWhatItSees) {
  MapTestPeer map;
  map.keyframe(1).points[3] = PointId();
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("keyframe 1 does not see point 3 back"));
}

TEST(CheckInvariants, NoticeIdsOfWhatIsGone) {
  MapTestPeer map;
  map.keyframe(1).points[9] = PointId(77);
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("point 77, which is gone"));
  MapTestPeer other;
  other.point(0).observations.push_back({KeyframeId(8), 0});
  EXPECT_THAT(other.CheckInvariants(), HasSubstr("keyframe 8, which is gone"));
}

TEST(CheckInvariants, NoticeObservationsOutOfOrder) {
  MapTestPeer map;
  std::swap(map.point(0).observations.front(), map.point(0).observations.back());
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("point 0 are not sorted"));
}

TEST(CheckInvariants, NoticePointNobodySees) {
  MapTestPeer map;
  map.AddPoint({0.0, 0.0, 1.0}, KeyframeId(0));
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("point 5 has no observation"));
}

TEST(CheckInvariants, NoticeReferenceThatDoesNotSeeThePoint) {
  MapTestPeer map;
  map.point(1).reference = KeyframeId(9);
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("not seen by its reference"));
}

TEST(CheckInvariants, NoticeNumbersThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  MapTestPeer map;
  map.point(4).p_world.y() = nan;
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("point 4 is not finite"));
  MapTestPeer other;
  other.keyframe(2).T_world_camera.translation.z() = nan;
  EXPECT_THAT(other.CheckInvariants(), HasSubstr("pose of keyframe 2"));
}

TEST(CheckInvariants, NoticeMiscountedWeights) {
  MapTestPeer map;
  ++map.keyframe(1).covisible[0].shared_points;
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("weights of keyframe 1"));
  MapTestPeer other;
  other.keyframe(2).covisible.clear();
  EXPECT_THAT(other.CheckInvariants(), HasSubstr("weights of keyframe 2"));
}

TEST(CheckInvariants, NoticeParentsThatGoRoundInACircle) {
  MapTestPeer map;
  map.keyframe(1).parent = KeyframeId(2);
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("cycle of parents"));
}

TEST(CheckInvariants, NoticeParentThatIsGoneOrOfAnotherMap) {
  MapTestPeer map;
  map.keyframe(2).parent = KeyframeId(9);
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("parent 9 is gone"));
  MapTestPeer other;
  other.AddKeyframe(MakeKeyframe(3, 10, 0.0, {}, MapId(1)));
  other.AddKeyframe(MakeKeyframe(4, 10, 0.0, KeyframeId(2), MapId(1)));
  EXPECT_THAT(other.CheckInvariants(), HasSubstr("another map"));
}

TEST(CheckInvariants, NoticeMapInTwoPieces) {
  MapTestPeer map;
  map.keyframe(2).parent = KeyframeId();
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("2 roots"));
}

TEST(CheckInvariants, NoticePointSeenFromAnotherMap) {
  MapTestPeer map;
  map.point(0).map = MapId(3);
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("seen from another map"));
}

TEST(CheckInvariants, NoticeSlotsThatDoNotFitTheFeatures) {
  MapTestPeer map;
  map.keyframe(0).points.push_back(PointId());
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("wrong number of slots"));
}

TEST(CheckInvariants, NoticeMiscountedTotals) {
  MapTestPeer map;
  map.MiscountPoints();
  EXPECT_THAT(map.CheckInvariants(), HasSubstr("number of points"));
  MapTestPeer other;
  other.MiscountKeyframes();
  EXPECT_THAT(other.CheckInvariants(), HasSubstr("number of keyframes"));
}

// Two thousand random edits through the public mutators.
class RandomEdits {
 public:
  explicit RandomEdits(std::uint64_t seed) : rng_(seed), map_(test::kLevelScales) {
    map_.AddKeyframe(MakeKeyframe(next_keyframe_++, 20));
  }
  const Map& map() const { return map_; }
  int num_culled() const { return num_culled_; }
  int num_fused() const { return num_fused_; }

  void Step() {
    const double dice = rng_.Uniform();
    if (dice < 0.04) {
      map_.AddKeyframe(MakeKeyframe(next_keyframe_, 20, next_keyframe_, AnyKeyframe()));
      next_keyframe_ += 1 + static_cast<std::uint32_t>(rng_.Index(2));
    } else if (dice < 0.30) {
      const KeyframeId reference = AnyKeyframe();
      if (const int keypoint = FreeKeypoint(reference); keypoint >= 0) {
        map_.AddObservation(map_.AddPoint(AnyPosition(), reference), reference, keypoint);
      }
    } else if (dice < 0.80) {
      map_.AddObservation(AnyPoint(), AnyKeyframe(), static_cast<int>(rng_.Index(20)));
    } else {
      EditPoints(dice);
    }
  }

 private:
  void EditPoints(double dice) {
    const PointId point = AnyPoint();
    if (dice < 0.84) {
      const auto& seen = map_.FindPoint(point)->observations;
      map_.RemoveObservation(point, seen[rng_.Index(seen.size())].keyframe);
    } else if (dice < 0.86) {
      map_.ErasePoint(point);
    } else if (dice < 0.92) {
      map_.FusePoints(point, AnyPoint());
      ++num_fused_;
    } else if (dice < 0.95) {
      const KeyframeId keyframe = AnyKeyframe();
      if (!map_.FindKeyframe(keyframe)->parent.valid() || map_.num_keyframes() < 5) return;
      map_.CullKeyframe(keyframe);
      ++num_culled_;
    } else {
      map_.SetPosition(point, AnyPosition());
      map_.RefreshGeometry(point);
    }
  }

  Eigen::Vector3d AnyPosition() {
    return {rng_.Uniform(-5.0, 5.0), rng_.Uniform(-5.0, 5.0), rng_.Uniform(1.0, 5.0)};
  }
  KeyframeId AnyKeyframe() {
    const auto ids = map_.Keyframes();
    return ids[rng_.Index(ids.size())];
  }
  int FreeKeypoint(KeyframeId id) const {
    const auto& points = map_.FindKeyframe(id)->points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i].valid()) return static_cast<int>(i);
    }
    return -1;
  }
  PointId AnyPoint() {
    for (std::size_t tries = 0; tries < 50; ++tries) {
      const PointId id(static_cast<std::uint32_t>(rng_.Index(map_.num_point_ids() + 1)));
      if (map_.FindPoint(id) != nullptr) return id;
    }
    for (const KeyframeId keyframe : map_.Keyframes()) {
      if (const int keypoint = FreeKeypoint(keyframe); keypoint >= 0) {
        const PointId id = map_.AddPoint(AnyPosition(), keyframe);
        map_.AddObservation(id, keyframe, keypoint);
        return id;
      }
    }
    throw InternalError("AnyPoint", "no keypoint is free", std::source_location::current());
  }

  Rng rng_;
  Map map_;
  std::uint32_t next_keyframe_ = 0;
  int num_culled_ = 0;
  int num_fused_ = 0;
};

TEST(CheckInvariants, HoldAfterTwoThousandRandomEdits) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    RandomEdits edits(seed);
    for (int step = 1; step <= 2000; ++step) {
      edits.Step();
      if (step % 50 == 0) {
        ASSERT_EQ(edits.map().CheckInvariants(), "") << "seed " << seed << ", step " << step;
      }
    }
    EXPECT_GT(edits.num_culled(), 10);
    EXPECT_GT(edits.num_fused(), 50);
    EXPECT_GT(edits.map().num_points(), 100U);
  }
}

TEST(CheckInvariants, IdsOfCulledAndFusedResolveAfterRandomEdits) {
  RandomEdits edits(4);
  for (int step = 0; step < 2000; ++step)
    edits.Step();
  const Map& map = edits.map();
  std::size_t resolved_keyframes = 0;
  for (std::uint32_t i = 0; i < map.num_keyframe_ids(); ++i) {
    const auto anchored = map.Resolve(KeyframeId(i));
    if (!anchored) continue;
    ++resolved_keyframes;
    EXPECT_NE(map.FindKeyframe(anchored->keyframe), nullptr);
  }
  EXPECT_EQ(resolved_keyframes, map.num_keyframes() + static_cast<std::size_t>(edits.num_culled()));
  for (std::uint32_t i = 0; i < map.num_point_ids(); ++i) {
    const auto id = map.Resolve(PointId(i));
    EXPECT_TRUE(!id || map.FindPoint(*id) != nullptr) << "point " << i;
  }
}

}  // namespace
}  // namespace cslam
