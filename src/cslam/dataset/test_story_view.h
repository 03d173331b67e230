// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/assets/procedural_props.h"
#include "cslam/dataset/story.h"
#include "cslam/dataset/visibility.h"
#include "cslam/geometry/camera.h"
#include "cslam/sim/ray_scene.h"
#include "cslam/sim/scene.h"
#include "cslam/sim/simulated_sequence.h"
#include "cslam/sim/world.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace cslam::test {

// Procedural props with so little paint that a story is made in no time.
class CoarseProps : public ProceduralProps {
 public:
  CoarseProps() : ProceduralProps(30.0) {}
  cv::Mat Poster(int /*variant*/) const override { return {28, 40, CV_8UC3, cv::Scalar::all(90)}; }
};

// What a camera of few pixels sees of a story at one time: no light, no colour.
struct Glimpse {
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

  Glimpse At(double time_s, const Se3& T_world_camera) const {
    const Scene moving = MovingAt(time_s);
    const RayScene moving_rays(moving);
    const Eigen::Vector3f origin = T_world_camera.translation.cast<float>();
    const Eigen::Matrix3f R = T_world_camera.R().cast<float>();
    std::vector<Eigen::Vector3f> rays;
    for (const Eigen::Vector3f& ray : pixel_rays_)
      rays.push_back(R * ray);
    const std::vector<RayHit> far = rays_.Cast(origin, rays);
    const std::vector<RayHit> near = moving_rays.Cast(origin, rays);
    Glimpse glimpse;
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
      const Placement state = StateAt(timeline, time_s);
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

// What is seen every step_s of a story, by a Kinect of 48 x 36 px.
inline std::vector<Glimpse> Survey(const Story& story, double step_s) {
  const StoryView view(story, MakeSimulatedCamera(48, 36));
  std::vector<Glimpse> glimpses;
  for (double t = 0.0; t < story.camera.duration_s; t += step_s)
    glimpses.push_back(view.At(t, story.camera.T_world_camera(t)));
  return glimpses;
}

// How fast a story's camera goes at most, from frame to frame.
struct Fastest {
  double m_per_s = 0.0;
  double rad_per_s = 0.0;
  double length_m = 0.0;
};
inline Fastest FastestOf(const CameraMotion& motion) {
  constexpr double kStepS = 1.0 / 30.0;
  Fastest fastest;
  for (double t = 0.0; t + kStepS <= motion.duration_s; t += kStepS) {
    const PoseDifference step =
        Difference(motion.T_world_camera(t), motion.T_world_camera(t + kStepS));
    fastest.m_per_s = std::max(fastest.m_per_s, step.distance_m / kStepS);
    fastest.rad_per_s = std::max(fastest.rad_per_s, step.angle_rad / kStepS);
    fastest.length_m += step.distance_m;
  }
  return fastest;
}

// People as upright axes: their least distances from each other, from resting things up to the
// chest's height, and from the camera (all in plan, m).
struct Clearance {
  double people_m = std::numeric_limits<double>::infinity();
  double things_m = std::numeric_limits<double>::infinity();
  double camera_m = std::numeric_limits<double>::infinity();
};
inline Clearance ClearanceOf(const Story& story, double step_s) {
  constexpr double kShinM = 0.3;
  constexpr double kChestM = 1.2;
  const World& world = story.world;
  const WorldBoxes boxes(world);
  Clearance least;
  for (double t = 0.0; t < story.camera.duration_s; t += step_s) {
    std::vector<Eigen::Vector3d> people;
    for (const auto& [id, animation] : world.animations) {
      const std::optional<BodyShape> shape = animation(t);
      if (!shape || world.scene.objects[static_cast<std::size_t>(id)].name == "sitting_person")
        continue;
      const Eigen::Vector3d p = shape->T_world_body.translation;
      for (const Eigen::Vector3d& other : people)
        least.people_m = std::min(least.people_m, (other - p).head<2>().norm());
      people.push_back(p);
      const Eigen::Vector3d camera = story.camera.T_world_camera(t).translation;
      least.camera_m = std::min(least.camera_m, (camera - p).head<2>().norm());
    }
    for (std::size_t id = 1; id < world.scene.objects.size(); ++id) {
      const int instance = static_cast<int>(id);
      if (world.animations.contains(instance)) continue;
      const Placement state = StateAt(world, instance, t);
      if (state.presence != Presence::kResting) continue;
      const PlacedBox box = boxes.Of(instance, state.T_world_object);
      for (const Eigen::Vector3d& p : people) {
        for (const double height_m : {kShinM, kChestM}) {
          const Eigen::Vector3d at(p.x(), p.y(), height_m);
          least.things_m = std::min(least.things_m, DistanceTo(box, at));
        }
      }
    }
  }
  return least;
}

}  // namespace cslam::test
