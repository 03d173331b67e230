// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/moving_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cslam {
namespace {

constexpr double kVelocityStepS = 0.004;
constexpr double kProbeSpacingM =
    0.45;  // of the places along a mover's height where light is taken
constexpr float kGainWithoutProbe = 0.6F;

std::optional<PlacedObject> PlaceMover(const World& world, int instance, double time_s) {
  const auto animation = world.animations.find(instance);
  if (animation != world.animations.end()) {
    const std::optional<BodyShape> shape = animation->second(time_s);
    if (!shape) return std::nullopt;
    return Place(world.scene, instance, *shape);
  }
  const Placement state = StateAt(world, instance, time_s);
  if (state.presence != Presence::kMoving) return std::nullopt;
  return Place(world.scene, instance, state.T_world_object);
}

std::vector<PlacedObject> PlaceMovers(const World& world, double time_s) {
  std::vector<PlacedObject> placed;
  for (int i = 0; i < static_cast<int>(world.scene.objects.size()); ++i) {
    if (!world.animations.contains(i) && !world.timelines.contains(i)) continue;
    if (std::optional<PlacedObject> mover = PlaceMover(world, i, time_s))
      placed.push_back(std::move(*mover));
  }
  return placed;
}

// Light cubes at several heights of a mover's middle.
class LightColumn {
 public:
  LightColumn(const Eigen::AlignedBox3d& bounds, const LightBaker& baker) {
    const double height_m = bounds.sizes().z();
    const int count = std::max(1, static_cast<int>(std::ceil(height_m / kProbeSpacingM)));
    for (int i = 0; i < count; ++i) {
      Eigen::Vector3d p = bounds.center();
      p.z() = bounds.min().z() + (i + 0.5) / count * height_m;
      const LightCube cube = baker.CubeAt(p);
      if (std::ranges::all_of(cube, [](float e) { return e == 0.0F; })) continue;  // inside a thing
      probes_.push_back({static_cast<float>(p.z()), cube});
    }
  }

  float GainAt(float z, const Eigen::Vector3f& normal) const {
    if (probes_.empty()) return kGainWithoutProbe;
    const auto above = std::ranges::lower_bound(probes_, z, {}, &Probe::z);
    const Probe& high = above == probes_.end() ? probes_.back() : *above;
    const Probe& low = above == probes_.begin() ? probes_.front() : *(above - 1);
    const float span = high.z - low.z;
    const float share = span > 0.0F ? std::clamp((z - low.z) / span, 0.0F, 1.0F) : 0.0F;
    const float irradiance =
        (1.0F - share) * Towards(low.cube, normal) + share * Towards(high.cube, normal);
    return std::max(kMinGain, GainOf(irradiance));
  }

 private:
  struct Probe {
    float z = 0.0F;
    LightCube cube{};
  };

  static float Towards(const LightCube& cube, const Eigen::Vector3f& normal) {
    float sum = 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float n = normal[static_cast<Eigen::Index>(axis)];
      sum += n * n * cube[2 * axis + (n < 0.0F ? 1 : 0)];
    }
    return sum;
  }

  std::vector<Probe> probes_;  // by height
};

std::vector<float> GainsOfMover(const PlacedObject& object, const LightBaker& baker) {
  const LightColumn column(BoundsOf(object), baker);
  std::vector<float> gains;
  gains.reserve(object.positions_m.size());
  for (std::size_t v = 0; v < object.positions_m.size(); ++v)
    gains.push_back(
        column.GainAt(static_cast<float>(object.positions_m[v].z()), object.normals[v]));
  return gains;
}

}  // namespace

MovingScene::MovingScene(const World& world, double time_s, const RestingScene& resting)
    : placed_(PlaceMovers(world, time_s)), facets_(world.scene), shadow_(placed_) {
  if (placed_.empty()) return;
  rays_.emplace(placed_, RayScene::Use::kOneFrame);
  for (const PlacedObject& object : placed_) {
    facets_.Add(object, GainsOfMover(object, resting.baker()));
    AddVelocities(object, world, time_s);
  }
}

void MovingScene::AddVelocities(const PlacedObject& object, const World& world, double time_s) {
  const std::optional<PlacedObject> later =
      PlaceMover(world, object.instance, time_s + kVelocityStepS);
  for (const Triangle& triangle : object.mesh->triangles) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    if (later) {
      for (const std::uint32_t v : triangle.vertices)
        sum += later->positions_m[v] - object.positions_m[v];
    }
    velocities_.emplace_back((sum / (3.0 * kVelocityStepS)).cast<float>());
  }
}

}  // namespace cslam
