// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/office_stage.h"

#include <numbers>

namespace cslam {
namespace {

constexpr double kRoomLengthM = 7.0;   // x
constexpr double kRoomDepthM = 7.0;    // y
constexpr double kFrontDeskYM = 4.25;  // middle of the desks nearer to the camera
constexpr double kBackDeskYM = 5.02;
constexpr double kHalfTurn = std::numbers::pi;

RoomShell OfficeShell(SceneBuilder& scene, const PropLibrary& props, std::uint64_t seed) {
  Rng rng(seed, 0, 52);
  const auto surface = [&](SurfaceKind kind) {
    return props.AddSurface(scene, kind, static_cast<int>(rng.Index(1000)));
  };
  RoomShell shell;
  shell.size_m = {kRoomLengthM, kRoomDepthM};
  shell.walls = {surface(SurfaceKind::kPlaster), surface(SurfaceKind::kPlaster),
                 surface(SurfaceKind::kPlaster), surface(SurfaceKind::kWallpaper)};
  shell.floor = surface(SurfaceKind::kParquet);
  shell.ceiling = surface(SurfaceKind::kPlaster);
  return shell;
}

void FurnishWalls(RoomDecorator& room) {
  for (const double along : {0.7, 2.7, 4.5, 6.3})
    room.AgainstWall(PropKind::kBookcase, Wall::kNorth, along);
  room.Hang(Wall::kNorth, 1.7, 1.05, 0.64);
  room.Hang(Wall::kNorth, 3.6, 1.20, 0.60);
  room.Hang(Wall::kNorth, 5.4, 1.00, 0.60);
  room.AgainstWall(PropKind::kCarton, Wall::kNorth, 1.7, 0.2);
  room.AgainstWall(PropKind::kCabinet, Wall::kNorth, 5.4);

  room.Put(PropKind::kPottedPlant, AtWall(room.room(), Wall::kWest, 6.2, 0.42));
  room.Hang(Wall::kWest, 5.2, 1.05, 0.68);
  room.Put(PropKind::kBooks, room.AgainstWall(PropKind::kCabinet, Wall::kWest, 4.3));
  room.Hang(Wall::kWest, 4.0, 1.25, 0.52);
  room.AgainstWall(PropKind::kBookcase, Wall::kWest, 3.1);
  room.Hang(Wall::kWest, 2.0, 0.95, 0.75);
  room.Put(PropKind::kCarton, room.AgainstWall(PropKind::kCarton, Wall::kWest, 1.2));

  room.Put(PropKind::kCarton, room.AgainstWall(PropKind::kCabinet, Wall::kEast, 0.9));
  room.Hang(Wall::kEast, 1.9, 0.85, 0.75);
  room.AgainstWall(PropKind::kBookcase, Wall::kEast, 3.0);
  room.Hang(Wall::kEast, 4.0, 1.05, 0.60);
  room.Hang(Wall::kEast, 5.3, 0.75, 0.75);

  room.Door(Wall::kSouth, 1.0);
  room.Hang(Wall::kSouth, 2.3, 1.15, 0.60);
  room.Hang(Wall::kSouth, 3.5, 1.05, 0.83);
  room.Put(PropKind::kBooks, room.AgainstWall(PropKind::kCabinet, Wall::kSouth, 2.5));
  room.Hang(Wall::kSouth, 4.7, 0.95, 0.68);
  room.AgainstWall(PropKind::kCarton, Wall::kSouth, 4.2, 0.3);
  room.AgainstWall(PropKind::kBookcase, Wall::kSouth, 5.8);
}

// Things on a desk as someone leaves them; side is 1 or -1.
void CoverDesk(PropPlacer& put, const Se3& T_world_top, double side) {
  const auto at = [&](double x, double y, double turn_rad) {
    return T_world_top * Standing(side * x + put.rng().Uniform(-0.03, 0.03),
                                  y + put.rng().Uniform(-0.03, 0.03), 0.0,
                                  turn_rad + put.rng().Uniform(-0.15, 0.15));
  };
  put.Put(PropKind::kMonitor, at(-0.05, 0.12, 0.1 * side));
  put.Put(PropKind::kKeyboard, at(-0.05, -0.18, 0.0));
  put.Put(PropKind::kMug, at(0.32, -0.2, 1.0));
  put.Put(PropKind::kBooks, at(0.5, 0.1, 0.5));
  put.Put(PropKind::kBottle, at(-0.45, 0.05, 0.0));
  put.Put(PropKind::kBooks, at(-0.52, -0.15, -0.4));
}

void FurnishDesks(PropPlacer& put) {
  const auto front = [&](double x) {
    return put.Put(PropKind::kDesk, Standing(x, kFrontDeskYM, 0.0)).T_world_top;
  };
  CoverDesk(put, front(kOfficeMiddleXM - 0.71), -1.0);
  CoverDesk(put, front(kOfficeMiddleXM + 0.71), 1.0);
  for (const double x : {kOfficeMiddleXM - 0.71, kOfficeMiddleXM + 0.71}) {
    const Se3 T_world_top =
        put.Put(PropKind::kDesk, Standing(x, kBackDeskYM, 0.0, kHalfTurn)).T_world_top;
    put.Put(PropKind::kMonitor, T_world_top * Standing(0.15, 0.1, 0.0, 0.2));
    put.Put(PropKind::kCarton, T_world_top * Standing(-0.4, 0.0, 0.0, 0.3));
  }
}

std::array<OfficeSeat, 2> PutSeats(PropPlacer& put, const std::array<Se3, 2>& places) {
  std::array<OfficeSeat, 2> seats;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PropPlacer::Placed chair = put.Put(PropKind::kChair, places[i]);
    seats[i] = {chair.id, places[i], chair.T_world_top.translation.z()};
  }
  return seats;
}

std::array<Se3, 2> SeatPlaces(bool in_front) {
  if (in_front) return {Standing(2.93, 2.95, 0.0, 0.55), Standing(4.1, 3.0, 0.0, -0.6)};
  return {Standing(2.55, 3.6, 0.0, kHalfTurn + 0.25), Standing(4.5, 3.5, 0.0, -0.5)};
}

}  // namespace

PropPlacer::Placed PropPlacer::PutVariant(PropKind kind, int variant, const Se3& T_world_prop,
                                          const std::string& name) {
  const int id = props_.Add(scene_, kind, variant, name.empty() ? std::string(NameOf(kind)) : name,
                            T_world_prop);
  return {id, T_world_prop * Standing(0.0, 0.0, props_.TopM(kind, variant))};
}

PropPlacer::Placed PropPlacer::Put(PropKind kind, const Se3& T_world_prop,
                                   const std::string& name) {
  return PutVariant(kind, AnyVariant(), T_world_prop, name);
}

Office AddOffice(SceneBuilder& scene, const PropLibrary& props, const OfficeOptions& options) {
  Office office;
  office.room = OfficeShell(scene, props, options.seed);
  office.home = {{kOfficeMiddleXM, 1.35, 1.4}, 0.5 * std::numbers::pi, -0.14};
  AddShells(scene, {&office.room, 1});
  RoomDecorator room(props, scene, office.room, options.seed);
  FurnishWalls(room);
  room.Rug(Standing(kOfficeMiddleXM, 2.9, 0.0, 0.03), {3.6, 1.7}, SurfaceKind::kCarpet,
           static_cast<int>(room.rng().Index(1000)));
  PropPlacer put(scene, props, options.seed);
  FurnishDesks(put);
  office.seats = PutSeats(put, SeatPlaces(options.chairs_in_front));
  office.back_seats =
      PutSeats(put, {Standing(2.2, 5.56, 0.0, 0.1), Standing(4.6, 5.56, 0.0, -0.15)});
  office.T_world_teddy = room.AgainstWall(PropKind::kCabinet, Wall::kEast, 4.2);
  office.teddy_id = room.Put(PropKind::kTeddyBear, office.T_world_teddy);
  return office;
}

}  // namespace cslam
