// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/world.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace cslam {
namespace {

// The carry's pose; front().time_s <= time_s < back().time_s.
Se3 PoseDuring(const Carry& carry, double time_s) {
  const auto next = std::ranges::upper_bound(carry, time_s, {}, &TimedPose::time_s);
  const auto last = std::prev(next);
  const double share = (time_s - last->time_s) / (next->time_s - last->time_s);
  return Interpolate(last->T_world_object, next->T_world_object, share);
}

}  // namespace

Placement StateAt(const Timeline& timeline, double time_s) {
  for (const Stay& stay : timeline.stays) {
    if (stay.from_s <= time_s && time_s < stay.to_s) {
      return {Presence::kResting, stay.T_world_object};
    }
  }
  for (const Carry& carry : timeline.carries) {
    if (!carry.empty() && carry.front().time_s <= time_s && time_s < carry.back().time_s)
      return {Presence::kMoving, PoseDuring(carry, time_s)};
  }
  return {};
}

Placement StateAt(const World& world, int instance, double time_s) {
  const auto timeline = world.timelines.find(instance);
  if (timeline != world.timelines.end()) return StateAt(timeline->second, time_s);
  const auto& object = world.scene.objects[static_cast<std::size_t>(instance)];
  return {Presence::kResting, object.T_world_object};
}

World WithoutObjects(World world, const std::function<bool(const SceneObject&)>& is_left_out) {
  World rest{.scene = std::move(world.scene), .timelines = {}, .animations = {}};
  std::vector<SceneObject> objects = std::exchange(rest.scene.objects, {});
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (is_left_out(objects[i])) continue;
    const auto before = static_cast<int>(i);
    const auto after = static_cast<int>(rest.scene.objects.size());
    rest.scene.objects.push_back(std::move(objects[i]));
    if (auto node = world.timelines.extract(before)) rest.timelines[after] = node.mapped();
    if (auto node = world.animations.extract(before)) rest.animations[after] = node.mapped();
  }
  return rest;
}

std::vector<double> TimesOfChange(const World& world) {
  std::vector<double> times_s;
  const auto add = [&](double time_s) {
    if (std::isfinite(time_s)) times_s.push_back(time_s);
  };
  for (const auto& [instance, timeline] : world.timelines) {
    for (const Stay& stay : timeline.stays) {
      add(stay.from_s);
      add(stay.to_s);
    }
    for (const Carry& carry : timeline.carries) {
      if (carry.empty()) continue;
      add(carry.front().time_s);
      add(carry.back().time_s);
    }
  }
  std::ranges::sort(times_s);
  const auto repeated = std::ranges::unique(times_s);
  times_s.erase(repeated.begin(), repeated.end());
  return times_s;
}

}  // namespace cslam
