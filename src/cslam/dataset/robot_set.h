// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/robot_motion.h"
#include "cslam/dataset/stage_room.h"
#include "cslam/dataset/story.h"
#include "cslam/sim/scene_builder.h"
#include "cslam/util/random.h"

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace cslam {

// A prop of a story: which one it is, and where.
struct SetPiece {
  PropKind kind = PropKind::kChair;
  int variant = 0;
  int instance = 0;
  Se3 T_world_prop;
};

// The laboratory in which a robot story plays, and the things that come and go in it.
class RobotSet {
 public:
  RobotSet(const Stage& stage, const StoryOptions& options, LabOptions lab);

  // A place on the floor from which a front looks into the direction (deg, 0: +x), moved a little
  // by the seed.
  Se3 Spot(const Eigen::Vector2d& position_m, double front_deg = -90.0);

  int AnyVariant() { return static_cast<int>(rng_.Index(1000)); }

  // A chair that detectors know even with something before its back, in one of its usual colours.
  int KnownChair() { return kNumChairs * static_cast<int>(rng_.Index(kNumColors)); }

  // There from the start on.
  SetPiece Place(PropKind kind, int variant, const std::string& name, const Se3& T_world_prop);
  // Its top or seat, and what stands there.
  Se3 TopOf(const SetPiece& piece) const;
  SetPiece PlaceOn(const SetPiece& below, PropKind kind, const std::string& name,
                   const Se3& T_top_prop = Se3());

  // What happens, in order of time for each piece; the pieces on top have to be told, too.
  void Move(SetPiece& piece, double time_s, const Se3& T_world_prop);
  void MoveWith(SetPiece& below, const std::vector<SetPiece*>& above, double time_s,
                const Se3& T_world_below);
  void Remove(const SetPiece& piece, double time_s);
  void ComeLater(const SetPiece& piece, double time_s);  // instead of from the start on

  Story Finish(const RobotRide& ride);

 private:
  static constexpr int kNumChairs = 4;  // models in the packages, the best known one first
  static constexpr int kNumColors = 3;

  const PropLibrary& props_;
  SceneBuilder scene_;
  RoomShell room_;
  Rng rng_;
  std::map<int, Timeline> timelines_;
};

}  // namespace cslam
