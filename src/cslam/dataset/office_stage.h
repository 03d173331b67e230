// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/assets/prop_library.h"
#include "cslam/dataset/stage_room.h"
#include "cslam/sim/camera_path.h"
#include "cslam/sim/scene_builder.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>

namespace cslam {

// A seat in the office and how high it is.
struct OfficeSeat {
  int chair_id = 0;
  Se3 T_world_chair;
  double seat_height_m = 0.45;
};

// The office of the dynamic stories, after TUM's fr3: seen from `home`, a block of four desks with
// screens and chairs at 2.5 m, a free strip before it in which people walk, a way around it, and
// shelves and pictures at the walls.
struct Office {
  RoomShell room;
  PathKey home;
  std::array<OfficeSeat, 2> seats;       // before the desks, left and right as seen from home
  std::array<OfficeSeat, 2> back_seats;  // behind the desks
  int teddy_id = 0;                      // on a cabinet at the east wall
  Se3 T_world_teddy;
};

struct OfficeOptions {
  std::uint64_t seed = 1;
  bool chairs_in_front = false;  // the seats stand in the free strip, turned to the camera
};

Office AddOffice(SceneBuilder& scene, const PropLibrary& props, const OfficeOptions& options);

constexpr double kOfficeMiddleXM = 3.5;

// Puts props into a scene, of any variant.
class PropPlacer {
 public:
  PropPlacer(SceneBuilder& scene, const PropLibrary& props, std::uint64_t seed)
      : scene_(scene), props_(props), rng_(seed, 0, 51) {}

  struct Placed {
    int id = 0;
    Se3 T_world_top;  // where one can put things on it
  };
  // The name is the kind's unless one is given.
  Placed Put(PropKind kind, const Se3& T_world_prop, const std::string& name = {});
  Placed PutVariant(PropKind kind, int variant, const Se3& T_world_prop,
                    const std::string& name = {});

  int AnyVariant() { return static_cast<int>(rng_.Index(1000)); }
  Rng& rng() { return rng_; }

 private:
  SceneBuilder& scene_;
  const PropLibrary& props_;
  Rng rng_;
};

}  // namespace cslam
