// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/office_day_story.h"

#include "cslam/dataset/carried_object.h"
#include "cslam/dataset/handheld_motion.h"
#include "cslam/dataset/office_stage.h"
#include "cslam/dataset/people_cast.h"
#include "cslam/dataset/stage_room.h"

#include <array>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace cslam {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kHandHeightM = 1.25;
constexpr double kLookSouthShare = 0.87;  // of a visit: when the desks are behind the camera
constexpr Load kTeddyLoad{.width_m = 0.3, .depth_m = 0.3, .bottom_m = 0.95};
constexpr Load kChairLoad{.width_m = 0.48, .depth_m = 0.5, .bottom_m = 0.5};  // held by its seat

struct Visits {
  int count = 3;
  double length_s = 48.0;
  double reach = 1.0;  // how far from the middle the camera goes; less in the short form
};

Visits VisitsOf(const StoryOptions& options) {
  if (options.is_short) return {2, 0.5 * kShortOfficeDayS, 0.5};
  return {3, kOfficeDayS / 3.0, 1.0};
}

// One visit: in, along the desks to the left and to the right, and out again with a full turn.
CameraMotion VisitTour(const Visits& visits, std::uint64_t seed) {
  struct Stop {
    double share;  // of the visit
    double x, y;   // m
    double yaw_deg, pitch_deg;
  };
  static constexpr std::array<Stop, 13> kStops{{{0.00, 3.5, 1.9, 90.0, -9.0},
                                                {0.10, 3.3, 1.7, 92.0, -9.0},
                                                {0.22, 1.7, 1.9, 122.0, -10.0},
                                                {0.32, 1.4, 2.8, 65.0, -12.0},
                                                {0.42, 2.2, 1.8, 55.0, -9.0},
                                                {0.50, 3.9, 1.5, 25.0, -8.0},
                                                {0.60, 5.4, 2.0, 70.0, -9.0},
                                                {0.67, 5.5, 2.7, 125.0, -12.0},
                                                {0.74, 4.6, 2.1, 175.0, -9.0},
                                                {0.80, 3.6, 2.3, 235.0, -7.0},
                                                {kLookSouthShare, 3.5, 2.4, 285.0, -7.0},
                                                {0.94, 3.5, 2.2, 370.0, -8.0},
                                                {1.00, 3.5, 1.9, 450.0, -9.0}}};
  constexpr double kRoundingS = 0.7;
  const Eigen::Vector2d middle(kOfficeMiddleXM, 1.9);
  std::vector<TimedView> views;
  for (int visit = 0; visit < visits.count; ++visit) {
    for (const Stop& stop : kStops) {
      if (visit > 0 && stop.share == 0.0) continue;  // that is the last visit's end
      const Eigen::Vector2d p = middle + visits.reach * (Eigen::Vector2d(stop.x, stop.y) - middle);
      views.push_back({(visit + stop.share) * visits.length_s,
                       {{p.x(), p.y(), kHandHeightM},
                        (stop.yaw_deg + 360.0 * visit) * kDegree,
                        stop.pitch_deg * kDegree},
                       0.0});
    }
  }
  HandTremor tremor;
  tremor.seed = seed;
  return HandheldMotion(std::move(views), kRoundingS, tremor);
}

FloorPoint At(double time_s, double x, double y) {
  return {time_s, {x, y}};
}

// The same, turned to a yaw while standing there.
FloorPoint Facing(double time_s, double x, double y, double yaw_deg) {
  return {time_s, {x, y}, yaw_deg * kDegree};
}

class OfficeDay {
 public:
  OfficeDay(const Stage& stage, const StoryOptions& options)
      : visits_(VisitsOf(options)),
        options_(options),
        scene_(options.seed, kStoryLightCellM),
        office_(AddOffice(scene_, stage.props, {.seed = options.seed})),
        put_(scene_, stage.props, options.seed + 1),
        cast_(scene_, stage.assets, options.seed) {}

  Story Make() {
    AddLooseThings();
    AddFirstPerson();
    if (visits_.count > 2) AddSecondPerson();
    AddSittingPerson();
    Story story;
    story.world.scene = scene_.Take(RoomLighting({&office_.room, 1}));
    story.world.timelines = std::move(timelines_);
    story.world.animations = cast_.Take();
    story.camera = VisitTour(visits_, options_.seed);
    story.people = {.min_mean_share = 0.02, .min_peak_share = 0.15, .leave_view = true};
    return story;
  }

 private:
  double LookSouth(int visit) const { return (visit + kLookSouthShare) * visits_.length_s; }

  // What changes while nobody looks.
  void AddLooseThings() {
    const Se3 T_world_before = Standing(0.72, 5.2, 0.0, 0.5 * std::numbers::pi);
    const Se3 T_world_after = Standing(6.25, 5.35, 0.0, -0.5 * std::numbers::pi);
    const int suitcase = put_.Put(PropKind::kSuitcase, T_world_before).id;
    timelines_[suitcase] = MovedAt(LookSouth(0), T_world_before, T_world_after);
    if (visits_.count < 3) return;
    const Se3 T_world_backpack = Standing(kOfficeMiddleXM, 3.68, 0.0, 0.1);
    const int backpack = put_.Put(PropKind::kBackpack, T_world_backpack).id;
    timelines_[backpack] = RemovedAt(LookSouth(1), T_world_backpack);
    const Se3 T_world_plant = Standing(0.75, 5.2, 0.0);
    const int plant = put_.Put(PropKind::kPottedPlant, T_world_plant, "new_plant").id;
    timelines_[plant] = AddedAt(LookSouth(1), T_world_plant);
  }

  // Walks through during the first visit; during the second one brings the teddy bear from
  // the cabinet to a chair.
  void AddFirstPerson() {
    const double t = visits_.length_s;
    // As the camera comes back from the left.
    const double take_s = t + (visits_.count > 2 ? 18.5 : 5.2);
    const double put_s = take_s + 5.2;
    std::vector<FloorPoint> points;
    if (visits_.count > 2) {
      points = {At(0.0, 5.6, 2.75),  At(2.5, 3.7, 2.7),   At(4.5, 3.7, 2.7),   At(7.0, 1.6, 3.0),
                At(10.5, 1.4, 6.15), At(14.0, 3.5, 6.28), At(27.0, 3.5, 6.28), At(30.0, 5.65, 6.1)};
    } else {
      points = {At(0.0, 3.0, 2.75), At(1.2, 3.0, 2.75), At(4.0, 5.6, 3.0), At(7.5, 5.65, 6.1)};
    }
    for (const FloorPoint& point :
         {At(take_s - 4.6, 5.65, 6.1), Facing(take_s - 0.8, 6.1, 2.85, 0.0),
          Facing(take_s + kLiftS, 6.1, 2.85, 0.0), Facing(put_s - kLiftS, 4.35, 2.95, 75.0),
          Facing(put_s + 0.3, 4.35, 2.95, 75.0), At(put_s + 2.1, 5.6, 3.0),
          At(put_s + 5.3, 5.65, 6.1), At(put_s + 8.4, 3.5, 6.28), At(put_s + 12.0, 3.5, 6.28),
          At(put_s + 120.0, 3.5, 6.28)})
      points.push_back(point);
    const auto walk = Walk(std::move(points), cast_.MotionSeed());
    const auto motion = Carrying(walk, take_s, put_s, kTeddyLoad);
    cast_.Add("first_person", motion);
    Errand errand{take_s, put_s, office_.T_world_teddy, Se3()};
    const OfficeSeat& seat = office_.seats[1];
    errand.T_world_to = seat.T_world_chair * Standing(0.0, -0.02, seat.seat_height_m);
    timelines_[office_.teddy_id] = TakenOnce(*motion, errand);
  }

  // Carries the other chair along the desks as the third visit begins.
  void AddSecondPerson() {
    const double t = 2.0 * visits_.length_s;
    const double take_s = t + 0.8;
    const double put_s = t + 10.2;
    std::vector<FloorPoint> points{At(t - 14.0, 1.4, 6.0),
                                   At(t - 7.0, 1.4, 6.0),
                                   At(t - 3.0, 1.5, 3.2),
                                   Facing(t - 1.0, 2.5, 2.95, 90.0),
                                   Facing(take_s + kLiftS, 2.5, 2.95, 90.0),
                                   At(put_s - kLiftS - 1.5, 5.2, 2.8),
                                   Facing(put_s - kLiftS, 5.65, 3.75, 85.0),
                                   Facing(put_s + 5.5, 5.65, 3.75, 85.0),
                                   At(put_s + 6.7, 5.45, 2.75),
                                   At(put_s + 8.4, 4.4, 2.65),
                                   At(put_s + 11.4, 2.2, 2.75),
                                   At(put_s + 14.4, 1.4, 4.2),
                                   At(put_s + 16.6, 1.4, 6.0),
                                   At(t + 60.0, 1.4, 6.0)};
    const auto walk = Walk(std::move(points), cast_.MotionSeed());
    const auto motion = Carrying(walk, take_s, put_s, kChairLoad);
    cast_.Add("second_person", motion);
    const OfficeSeat& seat = office_.seats[0];
    const Errand errand{take_s, put_s, seat.T_world_chair, Standing(5.75, 4.45, 0.0, 2.6)};
    timelines_[seat.chair_id] = TakenOnce(*motion, errand);
  }

  // Works at a desk behind the screens all day.
  void AddSittingPerson() {
    Sitting sitting;
    sitting.T_world_seat = office_.back_seats[0].T_world_chair;
    sitting.seat_height_m = office_.back_seats[0].seat_height_m;
    sitting.liveliness = 0.5;
    cast_.Add("sitting_person", Sit(sitting, cast_.MotionSeed()));
  }

  Visits visits_;
  StoryOptions options_;
  SceneBuilder scene_;
  Office office_;
  PropPlacer put_;
  PeopleCast cast_;
  std::map<int, Timeline> timelines_;
};

}  // namespace

Story MakeOfficeDay(const Stage& stage, const StoryOptions& options) {
  return OfficeDay(stage, options).Make();
}

}  // namespace cslam
