// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/robot_set.h"

#include "cslam/util/check.h"

#include <numbers>

namespace cslam {
namespace {

constexpr double kSpotNoiseM = 0.03;
constexpr double kSpotNoiseRad = 0.1;

LabOptions WithSeed(LabOptions lab, std::uint64_t seed) {
  lab.seed = seed;
  return lab;
}

}  // namespace

RobotSet::RobotSet(const Stage& stage, const StoryOptions& options, LabOptions lab)
    : props_(stage.props),
      scene_(options.seed, kStoryLightCellM),
      room_(AddLab(scene_, stage.props, WithSeed(lab, options.seed))),
      rng_(options.seed, 0, 61) {}

Se3 RobotSet::Spot(const Eigen::Vector2d& position_m, double front_deg) {
  const double dx = rng_.Uniform(-kSpotNoiseM, kSpotNoiseM);
  const double dy = rng_.Uniform(-kSpotNoiseM, kSpotNoiseM);
  const double turn_rad = rng_.Uniform(-kSpotNoiseRad, kSpotNoiseRad);
  return Standing(position_m.x() + dx, position_m.y() + dy, 0.0,
                  (front_deg + 90.0) * std::numbers::pi / 180.0 + turn_rad);
}

SetPiece RobotSet::Place(PropKind kind, int variant, const std::string& name,
                         const Se3& T_world_prop) {
  const int instance = props_.Add(scene_, kind, variant, name, T_world_prop);
  timelines_[instance].stays.push_back({.T_world_object = T_world_prop});
  return {kind, variant, instance, T_world_prop};
}

Se3 RobotSet::TopOf(const SetPiece& piece) const {
  return piece.T_world_prop * Standing(0.0, 0.0, props_.TopM(piece.kind, piece.variant));
}

SetPiece RobotSet::PlaceOn(const SetPiece& below, PropKind kind, const std::string& name,
                           const Se3& T_top_prop) {
  return Place(kind, AnyVariant(), name, TopOf(below) * T_top_prop);
}

void RobotSet::Move(SetPiece& piece, double time_s, const Se3& T_world_prop) {
  std::vector<Stay>& stays = timelines_.at(piece.instance).stays;
  CSLAM_CHECK(stays.back().from_s < time_s);
  stays.back().to_s = time_s;
  stays.push_back({.from_s = time_s, .T_world_object = T_world_prop});
  piece.T_world_prop = T_world_prop;
}

void RobotSet::MoveWith(SetPiece& below, const std::vector<SetPiece*>& above, double time_s,
                        const Se3& T_world_below) {
  const Se3 T_new_old = T_world_below * below.T_world_prop.Inverse();
  Move(below, time_s, T_world_below);
  for (SetPiece* piece : above)
    Move(*piece, time_s, T_new_old * piece->T_world_prop);
}

void RobotSet::Remove(const SetPiece& piece, double time_s) {
  Stay& last = timelines_.at(piece.instance).stays.back();
  CSLAM_CHECK(last.from_s < time_s);
  last.to_s = time_s;
}

void RobotSet::ComeLater(const SetPiece& piece, double time_s) {
  std::vector<Stay>& stays = timelines_.at(piece.instance).stays;
  CSLAM_CHECK(stays.size() == 1 && time_s < stays.front().to_s);
  stays.front().from_s = time_s;
}

Story RobotSet::Finish(const RobotRide& ride) {
  Story story;
  story.world.scene = scene_.Take(RoomLighting({&room_, 1}));
  story.world.timelines = std::move(timelines_);
  story.camera = ride.camera;
  story.sensor = SensorKind::kD435i;
  return story;
}

}  // namespace cslam
