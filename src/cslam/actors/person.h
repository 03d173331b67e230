// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/sim/scene_builder.h"
#include "cslam/sim/world.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

class AssetFolder;  // assets/asset_folder.h

// A skeleton with a skin: the body of one person, with his or her own size and clothes.
class PersonModel;

// assets: where the packages' files are, or null for the plain look (capsules). Both have the same
// skeleton. The variant picks height, build, skin, hair and clothes.
std::shared_ptr<const PersonModel> MakePersonModel(const AssetFolder* assets, int variant);

// What a person does while he or she is there; a pure function of time.
struct PersonPose;
class PersonMotion {
 public:
  virtual ~PersonMotion() = default;
  // Nothing while the person is away.
  virtual std::shared_ptr<const PersonPose> At(double time_s) const = 0;
};

// A place on the floor that the person passes (or, if the next is the same place, stands at).
struct FloorPoint {
  double time_s = 0.0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  std::optional<double> facing_rad = std::nullopt;  // while it stands here; else the way it came
};

// Walks smoothly through the points, facing the way it goes (turning on the spot where it has to),
// feet planted, stride to match the speed; while standing, shifts weight and gestures a little.
// There from the first point's time to the last one's.
std::shared_ptr<const PersonMotion> Walk(std::vector<FloorPoint> points, std::uint64_t seed);

// Sits (on a seat of the given height at T_world_seat's origin on the floor, facing -y as props do)
// and gestures with arms, head and trunk, between two times.
struct Sitting {
  Se3 T_world_seat;
  double seat_height_m = 0.45;
  double from_s = 0.0;
  double to_s = 1e9;
  double liveliness = 1.0;  // 0: still, 1: talks with both hands
};
std::shared_ptr<const PersonMotion> Sit(const Sitting& sitting, std::uint64_t seed);

// As `walk`, but holding something in both hands before the chest between two times (the hands
// take half a second to get there and to leave again).
struct Load {
  double width_m = 0.4;   // between the hands
  double depth_m = 0.4;   // away from the chest
  double bottom_m = 0.9;  // above the floor
};
std::shared_ptr<const PersonMotion> Carrying(std::shared_ptr<const PersonMotion> walk,
                                             double from_s, double to_s, const Load& load = {});

// Bottom centre of what Carrying() holds, front of the thing to the front of the person; the person
// must be there at that time.
Se3 T_world_Carried(const PersonMotion& motion, double time_s);

// Adds the person's body to the scene as an object of class 0; returns its instance id.
int AddPerson(SceneBuilder& scene, const PersonModel& model, const std::string& name);

// The entry for World::animations.
Animation Animate(std::shared_ptr<const PersonModel> model,
                  std::shared_ptr<const PersonMotion> motion);

}  // namespace cslam
