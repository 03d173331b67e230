// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/resting_scene.h"

namespace cslam {
namespace {

bool IsSamePose(const Se3& a, const Se3& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

bool RestsAt(const World& world, int instance, double time_s) {
  return !world.animations.contains(instance) &&
         StateAt(world, instance, time_s).presence == Presence::kResting;
}

std::vector<PlacedObject> PlaceResting(const World& world, double time_s) {
  std::vector<PlacedObject> placed;
  for (int i = 0; i < static_cast<int>(world.scene.objects.size()); ++i) {
    if (!RestsAt(world, i, time_s)) continue;
    placed.push_back(Place(world.scene, i, StateAt(world, i, time_s).T_world_object));
  }
  return placed;
}

}  // namespace

RestingScene::RestingScene(const World& world, double time_s, const RestingScene* similar)
    : world_(world),
      resting_(world.scene.objects.size()),
      placed_(PlaceResting(world, time_s)),
      rays_(placed_),
      baker_(world.scene.lighting, rays_),
      facets_(world.scene) {
  for (const PlacedObject& object : placed_) {
    Resting& resting = resting_[static_cast<std::size_t>(object.instance)];
    resting.is_here = true;
    resting.T_world_object = StateAt(world, object.instance, time_s).T_world_object;
  }
  std::vector<Ball> changes;
  if (similar != nullptr) changes = ChangesSince(*similar);
  for (const PlacedObject& object : placed_) {
    const auto i = static_cast<std::size_t>(object.instance);
    const bool has_stayed =
        similar != nullptr && similar->resting_[i].is_here &&
        IsSamePose(similar->resting_[i].T_world_object, resting_[i].T_world_object);
    resting_[i].irradiance =
        has_stayed ? baker_.BakeAgain(object, similar->resting_[i].irradiance, changes)
                   : baker_.Bake(object);
    facets_.Add(object, GainsOf(*object.mesh, resting_[i].irradiance));
  }
}

const std::vector<float>& RestingScene::irradiance(int instance) const {
  return resting_[static_cast<std::size_t>(instance)].irradiance;
}

Ball RestingScene::Around(int instance) const {
  const Resting& resting = resting_[static_cast<std::size_t>(instance)];
  const PlacedObject object = Place(world_.scene, instance, resting.T_world_object);
  const Eigen::AlignedBox3d bounds = BoundsOf(object);
  if (bounds.isEmpty()) return {};
  return {bounds.center(), 0.5 * bounds.diagonal().norm()};
}

std::vector<Ball> RestingScene::ChangesSince(const RestingScene& similar) const {
  std::vector<Ball> changes;
  for (std::size_t i = 0; i < resting_.size(); ++i) {
    const Resting& now = resting_[i];
    const Resting& then = similar.resting_[i];
    if (now.is_here == then.is_here &&
        (!now.is_here || IsSamePose(now.T_world_object, then.T_world_object))) {
      continue;
    }
    if (now.is_here) changes.push_back(Around(static_cast<int>(i)));
    if (then.is_here) changes.push_back(similar.Around(static_cast<int>(i)));
  }
  return changes;
}

}  // namespace cslam
