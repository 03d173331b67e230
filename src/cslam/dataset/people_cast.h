// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/person.h"
#include "cslam/dataset/story.h"
#include "cslam/sim/scene_builder.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cslam {

// The people of a story: adds their bodies to the scene and collects their animations.
class PeopleCast {
 public:
  PeopleCast(SceneBuilder& scene, const AssetFolder* assets, std::uint64_t seed)
      : scene_(scene), assets_(assets), seed_(seed) {}

  // Adds the next person, dressed unlike the others; returns the instance id.
  int Add(const std::string& name, std::shared_ptr<const PersonMotion> motion);

  // A seed for the next person's motion.
  std::uint64_t MotionSeed() const { return seed_ * 16 + animations_.size(); }

  std::map<int, Animation> Take() { return std::move(animations_); }

 private:
  SceneBuilder& scene_;
  const AssetFolder* assets_;
  std::uint64_t seed_;
  std::map<int, Animation> animations_;
};

// A way that is walked again and again: the last point is the first one again, one period later.
// Gives what is walked from from_s to to_s of it (with the points just outside), from_s becoming
// time 0.
std::vector<FloorPoint> CutCycle(const std::vector<FloorPoint>& cycle, double from_s, double to_s);

// The same way mirrored at the line x = x_m.
std::vector<FloorPoint> Mirrored(std::vector<FloorPoint> points, double x_m);

}  // namespace cslam
