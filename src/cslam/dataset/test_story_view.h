// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/story.h"
#include "cslam/geometry/camera.h"
#include "cslam/sim/ray_scene.h"
#include "cslam/sim/scene.h"
#include "cslam/sim/world.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

namespace cslam::test {

// What a camera of few pixels sees of a story at one time: no light, no colour.
struct GlimpseOf {
  double nearest_m = std::numeric_limits<double>::infinity();  // along the optical axis
  double people_share = 0.0;                                   // of the picture
  double empty_share = 0.0;                                    // rays that leave the rooms
  std::map<int, double> shares;                                // by instance
};

// Casts rays into a story's world: what rests for good is built once, the rest at each look.
class StoryView {
 public:
  StoryView(const Story& story, const Camera& camera)
      : world_(story.world), camera_(camera), still_(OnlyGeometry(world_.scene)), rays_(still_) {
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u)
        pixel_rays_.push_back(Unproject(camera, {u, v}, 1.0).cast<float>());
    }
  }

  GlimpseOf At(double time_s, const Se3& T_world_camera) const {
    const Scene moving = MovingAt(time_s);
    const RayScene moving_rays(moving);
    const Eigen::Vector3f origin = T_world_camera.translation.cast<float>();
    const Eigen::Matrix3f R = T_world_camera.R().cast<float>();
    std::vector<Eigen::Vector3f> rays;
    for (const Eigen::Vector3f& ray : pixel_rays_)
      rays.push_back(R * ray);
    const std::vector<RayHit> far = rays_.Cast(origin, rays);
    const std::vector<RayHit> near = moving_rays.Cast(origin, rays);
    GlimpseOf glimpse;
    const double share = 1.0 / static_cast<double>(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double still_m = Distance(still_, far[i], origin, rays[i]);
      const double moving_m = Distance(moving, near[i], origin, rays[i]);
      const double nearest_m = std::min(still_m, moving_m);
      if (nearest_m == std::numeric_limits<double>::infinity()) {
        glimpse.empty_share += share;
        continue;
      }
      const std::uint32_t object = moving_m < still_m ? near[i].object : far[i].object;
      glimpse.shares[static_cast<int>(object)] += share;
      if (world_.scene.objects[object].class_id == 0) glimpse.people_share += share;
      glimpse.nearest_m = std::min(glimpse.nearest_m, nearest_m);
    }
    return glimpse;
  }

 private:
  static Scene WithoutLooks(const Scene& scene) {
    Scene bare;
    bare.objects = scene.objects;
    return bare;
  }

  Scene OnlyGeometry(const Scene& scene) const {
    Scene bare = WithoutLooks(scene);
    for (const auto& [id, timeline] : world_.timelines)
      bare.objects[static_cast<std::size_t>(id)].mesh = {};
    for (const auto& [id, animation] : world_.animations)
      bare.objects[static_cast<std::size_t>(id)].mesh = {};
    return bare;
  }

  Scene MovingAt(double time_s) const {
    Scene moving;
    moving.objects.resize(world_.scene.objects.size());
    for (const auto& [id, timeline] : world_.timelines) {
      const ObjectState state = StateAt(timeline, time_s);
      if (state.presence == Presence::kAway) continue;
      SceneObject& object = moving.objects[static_cast<std::size_t>(id)];
      object = world_.scene.objects[static_cast<std::size_t>(id)];
      object.T_world_object = state.T_world_object;
    }
    for (const auto& [id, animation] : world_.animations) {
      std::optional<BodyShape> shape = animation(time_s);
      if (!shape) continue;
      SceneObject& object = moving.objects[static_cast<std::size_t>(id)];
      object = world_.scene.objects[static_cast<std::size_t>(id)];
      object.T_world_object = Se3();
      object.mesh.positions = std::move(shape->positions);
    }
    return moving;
  }

  static double Distance(const Scene& scene, const RayHit& hit, const Eigen::Vector3f& origin,
                         const Eigen::Vector3f& ray) {
    if (hit.object == RayHit::kNone) return std::numeric_limits<double>::infinity();
    const SceneObject& object = scene.objects[hit.object];
    const Triangle& triangle = object.mesh.triangles[hit.triangle];
    const auto corner = [&](std::size_t i) -> Eigen::Vector3d {
      return object.T_world_object *
             Eigen::Vector3d(object.mesh.positions[triangle.vertices[i]].cast<double>());
    };
    const Eigen::Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    return normal.dot(corner(0) - origin.cast<double>()) / normal.dot(ray.cast<double>());
  }

  const World& world_;
  Camera camera_;
  Scene still_;
  RayScene rays_;
  std::vector<Eigen::Vector3f> pixel_rays_;
};

}  // namespace cslam::test
