// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/robot_stories.h"

#include "cslam/dataset/test_props.h"
#include "cslam/dataset/visibility.h"
#include "cslam/sim/simulated_sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace cslam {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kFrameS = 1.0 / 30.0;

// What a story has to be: the paper's figures, and how often each thing moves (m), goes (r), comes
// (a), in order of time.
struct Expected {
  const char* name;
  RobotFigures figures;
  std::map<std::string, std::string> changes;
};

const std::vector<Expected>& AllExpected() {
  static const std::vector<Expected> all{
      {"static", kStaticFigures, {}},
      {"onechair", kOneChairFigures, {{"chair", "m"}, {"teddy_bear", "m"}}},
      {"vanishing",
       kVanishingFigures,
       {{"chair", "mr"}, {"teddy_bear", "mr"}, {"umbrella", "mr"}, {"suitcase", "r"}}},
      {"changing", kChangingFigures, {{"teddy_bear", "m"}}},
      {"shift",
       kShiftFigures,
       {{"umbrella", "m"},
        {"chair", "m"},
        {"teddy_bear", "m"},
        {"suitcase", "m"},
        {"monitor", "m"},
        {"mug", "m"}}},
      {"replacing",
       kReplacingFigures,
       {{"other_chair", "r"},
        {"teddy_bear", "r"},
        {"umbrella", "a"},
        {"chair", "r"},
        {"books", "r"}}}};
  return all;
}

const SequenceEntry& EntryOf(std::string_view name) {
  const std::span<const SequenceEntry> all = AllSequences();
  return *std::ranges::find(all, name, &SequenceEntry::name);
}

Story Make(std::string_view name, std::uint64_t seed, bool is_short) {
  const BoxProps props;
  return EntryOf(name).make({props, nullptr}, {.seed = seed, .is_short = is_short});
}

std::string NameOfInstance(const Story& story, int instance) {
  return story.world.scene.objects[static_cast<std::size_t>(instance)].name;
}

struct RideFigures {
  double length_m = 0.0;
  double turning_dps = 0.0;
  double max_mps = 0.0;
  double max_dps = 0.0;
};

RideFigures Measure(const CameraMotion& motion) {
  RideFigures figures;
  Se3 last = motion.T_world_camera(0.0);
  double turned_deg = 0.0;
  const int frames = static_cast<int>(motion.duration_s / kFrameS);
  for (int i = 1; i <= frames; ++i) {
    const Se3 next = motion.T_world_camera(i * kFrameS);
    const PoseDifference step = Difference(last, next);
    const double step_deg = step.angle_rad * kDegPerRad;
    figures.length_m += step.distance_m;
    turned_deg += step_deg;
    figures.max_mps = std::max(figures.max_mps, step.distance_m / kFrameS);
    figures.max_dps = std::max(figures.max_dps, step_deg / kFrameS);
    last = next;
  }
  figures.turning_dps = turned_deg / motion.duration_s;
  return figures;
}

// Every story in both forms, with a seed of its own.
class RobotStory : public testing::TestWithParam<std::tuple<std::size_t, bool, std::uint64_t>> {
 protected:
  const Expected& expected() const { return AllExpected()[std::get<0>(GetParam())]; }
  bool is_short() const { return std::get<1>(GetParam()); }
  std::uint64_t seed() const { return std::get<2>(GetParam()); }
  const Story& story() const { return story_; }

 private:
  const Story story_ = Make(expected().name, seed(), is_short());
};

INSTANTIATE_TEST_SUITE_P(All, RobotStory,
                         testing::Combine(testing::Range<std::size_t>(0, 6), testing::Bool(),
                                          testing::Values(1U, 2U)),
                         [](const auto& param) {
                           return std::string(AllExpected()[std::get<0>(param.param)].name) +
                                  (std::get<1>(param.param) ? "_short_" : "_long_") +
                                  std::to_string(std::get<2>(param.param));
                         });

TEST_P(RobotStory, LastsAsLongAsTheRegistrySays) {
  const SequenceEntry& entry = EntryOf(expected().name);
  EXPECT_EQ(entry.sensor, SensorKind::kD435i);
  EXPECT_EQ(story().sensor, SensorKind::kD435i);
  EXPECT_DOUBLE_EQ(story().camera.duration_s,
                   is_short() ? entry.short_duration_s : entry.duration_s);
  EXPECT_LE(entry.short_duration_s, 40.0);
}

TEST_P(RobotStory, MovesAsThePapersTableSaysOrWithinASlamSystemsReach) {
  const RideFigures figures = Measure(story().camera);
  EXPECT_LE(figures.max_mps, 0.5);
  if (is_short()) {
    EXPECT_LE(figures.max_dps, 60.0);
    EXPECT_GE(figures.length_m, 3.0);
    return;
  }
  EXPECT_LE(figures.max_dps, 70.0);
  EXPECT_NEAR(figures.length_m / expected().figures.length_m, 1.0, 0.1);
  EXPECT_NEAR(figures.turning_dps / expected().figures.turning_dps, 1.0, 0.1);
}

TEST_P(RobotStory, RidesSmoothlyOnFlatGround) {
  constexpr double kStepS = 0.02;
  constexpr double kMaxAcceleration = 1.8;      // m/s^2
  constexpr double kMaxTurnAcceleration = 6.0;  // rad/s^2
  const CameraMotion& motion = story().camera;
  Se3 before = motion.T_world_camera(0.0);
  Se3 now = motion.T_world_camera(kStepS);
  double worst_m = 0.0;
  double worst_rad = 0.0;
  double worst_height_m = 0.0;
  for (double t = 2.0 * kStepS; t < motion.duration_s; t += kStepS) {
    const Se3 next = motion.T_world_camera(t);
    worst_m =
        std::max(worst_m, (next.translation - 2.0 * now.translation + before.translation).norm());
    worst_rad = std::max(worst_rad, (LogSo3((now.Inverse() * next).rotation) -
                                     LogSo3((before.Inverse() * now).rotation))
                                        .norm());
    worst_height_m = std::max(worst_height_m, std::abs(next.translation.z() - 0.4));
    before = now;
    now = next;
  }
  EXPECT_LE(worst_m / (kStepS * kStepS), kMaxAcceleration);
  EXPECT_LE(worst_rad / (kStepS * kStepS), kMaxTurnAcceleration);
  EXPECT_LE(worst_height_m, 0.005);
}

TEST_P(RobotStory, KeepsClearOfFurnitureAndWalls) {
  constexpr double kRobotRadiusM = 0.3;
  constexpr double kFlatM = 0.05;  // it drives over rugs
  const WorldBoxes boxes(story().world);
  const SceneObject& room = story().world.scene.objects.front();
  const PlacedBox shell = BoxAround(room.mesh, room.T_world_object);
  for (double t = 0.0; t < story().camera.duration_s; t += 0.5) {
    const Eigen::Vector3d p = story().camera.T_world_camera(t).translation;
    for (const PlacedBox& box : boxes.At(t))
      EXPECT_TRUE(box.size_m.z() < kFlatM || DistanceTo(box, p) > kRobotRadiusM)
          << t << " s at " << p.transpose() << ", box at "
          << box.T_world_box.translation.transpose();
    const Eigen::Vector3d from_middle = (shell.T_world_box.Inverse() * p).cwiseAbs();
    EXPECT_LT(from_middle.x(), 0.5 * shell.size_m.x() - kRobotRadiusM);
    EXPECT_LT(from_middle.y(), 0.5 * shell.size_m.y() - kRobotRadiusM);
  }
}

TEST_P(RobotStory, ChangesWhatTheStorySays) {
  std::map<std::string, std::string> found;
  for (const SilentChange& change : SilentChanges(story().world))
    found[NameOfInstance(story(), change.instance)] += change.from ? (change.to ? "m" : "r") : "a";
  EXPECT_EQ(found, expected().changes);
}

TEST_P(RobotStory, ChangesOutOfViewWhatIsSeenBeforeAndAfter) {
  constexpr double kUnseenS = 0.5;
  constexpr double kSeenS = 2.0;
  constexpr double kMugShare = 0.003;  // a mug is that small, even from 2 m
  const Camera camera = MakeD435iCamera(640, 480);
  const WorldBoxes boxes(story().world);
  for (const SilentChange& change : SilentChanges(story().world)) {
    const std::string name = NameOfInstance(story(), change.instance);
    ClearView clear{.step_s = 0.2};
    if (name == "mug") clear.min_picture_share = kMugShare;
    const ChangeViews views = ViewsAround(boxes, story().camera, camera, change, clear);
    SCOPED_TRACE(name + " at " + std::to_string(change.time_s));
    EXPECT_GE(views.unseen_before_s, kUnseenS);
    EXPECT_GE(views.unseen_after_s, kUnseenS);
    EXPECT_GE(views.before_s, kSeenS);
    if (change.from) {
      EXPECT_GE(views.old_after_s, kSeenS);
    }
    if (change.to) {
      EXPECT_GE(views.new_after_s, kSeenS);
    }
  }
}

TEST_P(RobotStory, StandsThingsOnTheFloorOrOnEachOtherWithoutMixingThem) {
  const WorldBoxes boxes(story().world);
  const World& world = story().world;
  for (double t = 0.0; t < story().camera.duration_s; t += 1.0) {
    for (const auto& [a, timeline_a] : world.timelines) {
      for (const auto& [b, timeline_b] : world.timelines) {
        if (a >= b) continue;
        const Placement state_a = StateAt(timeline_a, t);
        const Placement state_b = StateAt(timeline_b, t);
        if (state_a.presence == Presence::kAway || state_b.presence == Presence::kAway) continue;
        const Eigen::Vector3d apart =
            state_a.T_world_object.translation - state_b.T_world_object.translation;
        // On one another, or beside each other.
        EXPECT_TRUE(std::abs(apart.z()) > 0.3 || apart.head<2>().norm() > 0.12)
            << NameOfInstance(story(), a) << " and " << NameOfInstance(story(), b) << " at " << t;
      }
    }
  }
}

TEST(RobotStories, AreTheSameForTheSameSeedAndNotForAnother) {
  const Story a = Make("shift", 7, true);
  const Story b = Make("shift", 7, true);
  const Story c = Make("shift", 8, true);
  for (const double t : {0.0, 11.3, 39.0}) {
    const PoseDifference same = Difference(a.camera.T_world_camera(t), b.camera.T_world_camera(t));
    EXPECT_EQ(same.distance_m, 0.0);
    const PoseDifference other = Difference(a.camera.T_world_camera(t), c.camera.T_world_camera(t));
    EXPECT_TRUE(t == 0.0 || other.distance_m > 0.0);
  }
  const int last = static_cast<int>(a.world.scene.objects.size()) - 1;
  const auto place = [&](const Story& story) {
    return story.world.timelines.at(last).stays.front().T_world_object.translation;
  };
  EXPECT_EQ(place(a), place(b));
  EXPECT_NE(place(a), place(c));
}

TEST(OneChairStory, LooksAtTheChairFromThreeSidesTheSameWayInBothPlaces) {
  for (const bool is_short : {false, true}) {
    const Story story = Make("onechair", 1, is_short);
    const std::vector<SilentChange> changes = SilentChanges(story.world);
    ASSERT_EQ(changes.size(), 2U);
    const SilentChange& chair = changes.front();
    const double moved_m = (chair.to->translation - chair.from->translation).norm();
    const double width_m = WorldBoxes(story.world).Of(chair.instance, Se3()).size_m.x();
    EXPECT_GT(moved_m, width_m);
    for (const Se3& place : {*chair.from, *chair.to}) {
      const bool is_before = &place == &*chair.from;
      double left_deg = 0.0;
      double right_deg = 0.0;
      for (double t = 0.0; t < story.camera.duration_s; t += 0.1) {
        if ((t < chair.time_s) != (place.translation == chair.from->translation)) continue;
        const Eigen::Vector3d p = place.Inverse() * story.camera.T_world_camera(t).translation;
        if (p.head<2>().norm() > 1.8) continue;
        const double angle_deg = std::atan2(p.x(), -p.y()) * kDegPerRad;
        left_deg = std::min(left_deg, angle_deg);
        right_deg = std::max(right_deg, angle_deg);
      }
      EXPECT_LT(left_deg, -28.0) << is_before;
      EXPECT_GT(right_deg, 28.0) << is_before;
    }
  }
}

// The ways (m) from the views of a thing in its old place to the same views of it in its new one.
std::vector<double> WaysBetweenEqualViews(const CameraMotion& motion, const SilentChange& change) {
  struct View {
    Se3 T_thing_camera;
    double way_m;
  };
  std::vector<View> before;
  double way_m = 0.0;
  std::vector<double> ways_m;
  Se3 last = motion.T_world_camera(0.0);
  for (double t = 0.0; t < motion.duration_s; t += 0.1) {
    const Se3 T_world_camera = motion.T_world_camera(t);
    way_m += Difference(last, T_world_camera).distance_m;
    last = T_world_camera;
    const bool is_before = t < change.time_s;
    const Se3 T_thing_camera = (is_before ? change.from : change.to)->Inverse() * T_world_camera;
    if (T_thing_camera.translation.norm() > 1.9) continue;
    if (is_before) {
      before.push_back({T_thing_camera, way_m});
      continue;
    }
    for (const View& view : before) {
      const PoseDifference apart = Difference(view.T_thing_camera, T_thing_camera);
      if (apart.distance_m < 0.1 && apart.angle_rad < 0.05) ways_m.push_back(way_m - view.way_m);
    }
  }
  return ways_m;
}

TEST(OneChairStory, LeavesSoLongAWayBetweenEqualViewsThatDriftMightExplainTheMove) {
  // Of places.loop: what a loop may move its newer end by, always and per metre of the way.
  constexpr double kMaxDriftM = 0.3;
  constexpr double kMaxDriftShare = 0.05;
  for (const bool is_short : {false, true}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const Story story = Make("onechair", seed, is_short);
      const SilentChange chair = SilentChanges(story.world).front();
      const double moved_m = (chair.to->translation - chair.from->translation).norm();
      const std::vector<double> ways_m = WaysBetweenEqualViews(story.camera, chair);
      const auto num_tempting = std::ranges::count_if(ways_m, [&](double way_m) {
        return kMaxDriftM + kMaxDriftShare * way_m > moved_m + 0.03;
      });
      const double share = static_cast<double>(num_tempting) / static_cast<double>(ways_m.size());
      EXPECT_GT(share, is_short ? 0.7 : 0.1) << ways_m.size() << " equal views, seed " << seed;
    }
  }
}

TEST(ReplacingStory, PutsTheUmbrellaWhereTheChairWas) {
  const Story story = Make("replacing", 3, false);
  std::optional<Eigen::Vector3d> chair;
  std::optional<Eigen::Vector3d> umbrella;
  for (const SilentChange& change : SilentChanges(story.world)) {
    const std::string name = NameOfInstance(story, change.instance);
    if (name == "other_chair") chair = change.from->translation;
    if (name == "umbrella") umbrella = change.to->translation;
  }
  ASSERT_TRUE(chair && umbrella);
  EXPECT_LT((*chair - *umbrella).norm(), 0.5);
}

TEST(VanishingStory, LeavesNothing) {
  for (const bool is_short : {false, true}) {
    const Story story = Make("vanishing", 1, is_short);
    for (const auto& [instance, timeline] : story.world.timelines)
      EXPECT_EQ(StateAt(timeline, story.camera.duration_s).presence, Presence::kAway)
          << NameOfInstance(story, instance);
  }
}

}  // namespace
}  // namespace cslam
