// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/placed_object.h"
#include "cslam/sim/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cslam {

// The first triangle a ray meets.
struct RayHit {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::uint32_t object = kNone;  // index into Scene::objects
  std::uint32_t triangle = 0;    // index into its mesh
};

// Ray queries against a scene (Embree, hidden here). The instruction set is pinned, so every
// x86-64 machine answers alike. Const calls may run on several threads at once.
class RayScene {
 public:
  // How long it serves: a scene for a single frame is made faster and searched more slowly.
  enum class Use { kLong, kOneFrame };

  explicit RayScene(std::span<const PlacedObject> objects, Use use = Use::kLong);
  explicit RayScene(const Scene& scene);  // all objects at their poses in the scene
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  // One hit per direction, for rays that share an origin; neighbours should be alike.
  std::vector<RayHit> Cast(const Eigen::Vector3f& origin,
                           std::span<const Eigen::Vector3f> directions) const;

  // For rays from one origin: is anything between distance 0 and 1 along each direction vector?
  std::vector<bool> AreBlocked(const Eigen::Vector3f& origin,
                               std::span<const Eigen::Vector3f> directions) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace cslam
