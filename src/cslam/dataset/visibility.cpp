// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/visibility.h"

#include "cslam/util/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cslam {
namespace {

constexpr int kSamplesPerAxis = 4;
constexpr double kNearM = 0.05;       // things nearer to the camera's plane are not projected
constexpr double kContactM = 0.03;    // a box that holds a point by less still touches it
constexpr double kViewMarginPx = 20;  // around the picture, for what counts as out of view

std::array<Eigen::Vector3d, 8> CornersOf(const PlacedBox& box) {
  std::array<Eigen::Vector3d, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d sign((i & 1U) != 0 ? 0.5 : -0.5, (i & 2U) != 0 ? 0.5 : -0.5,
                               (i & 4U) != 0 ? 0.5 : -0.5);
    corners[i] = box.T_world_box * Eigen::Vector3d(sign.cwiseProduct(box.size_m));
  }
  return corners;
}

bool Holds(const PlacedBox& box, const Eigen::Vector3d& p_world, double margin_m) {
  const Eigen::Vector3d p = box.T_world_box.Inverse() * p_world;
  return ((p.cwiseAbs() - 0.5 * box.size_m).array() < margin_m).all();
}

// Whether the box meets the straight line from one point to the other.
bool Blocks(const PlacedBox& box, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Se3 T_box_world = box.T_world_box.Inverse();
  const Eigen::Vector3d a = T_box_world * from;
  const Eigen::Vector3d d = T_box_world * to - a;
  double enter = 0.0;
  double leave = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double half = 0.5 * box.size_m[i];
    if (std::abs(d[i]) < 1e-12) {
      if (std::abs(a[i]) > half) return false;
      continue;
    }
    const double t0 = (-half - a[i]) / d[i];
    const double t1 = (half - a[i]) / d[i];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return enter < leave;
}

std::vector<Eigen::Vector3d> SamplesOf(const PlacedBox& box) {
  std::vector<Eigen::Vector3d> samples;
  const auto share = [](int i) { return (i + 0.5) / kSamplesPerAxis - 0.5; };
  for (int x = 0; x < kSamplesPerAxis; ++x)
    for (int y = 0; y < kSamplesPerAxis; ++y)
      for (int z = 0; z < kSamplesPerAxis; ++z) {
        const Eigen::Vector3d p(share(x), share(y), share(z));
        samples.push_back(box.T_world_box * Eigen::Vector3d(p.cwiseProduct(box.size_m)));
      }
  return samples;
}

// The part of the picture around what is seen of the box.
double PictureShare(const PlacedBox& box, const Camera& camera, const Se3& T_camera_world) {
  Eigen::Array2d low(1e9, 1e9);
  Eigen::Array2d high(-1e9, -1e9);
  for (const Eigen::Vector3d& corner : CornersOf(box)) {
    Eigen::Vector3d p = T_camera_world * corner;
    p.z() = std::max(p.z(), kNearM);
    const Eigen::Array2d uv = Project(camera, p).array();
    low = low.min(uv);
    high = high.max(uv);
  }
  const Eigen::Array2d size(camera.width, camera.height);
  const Eigen::Array2d seen = (high.min(size) - low.max(0.0)).max(0.0);
  return seen.prod() / size.prod();
}

// Longest stretch of samples for which a view is clear.
class LongestLook {
 public:
  explicit LongestLook(double step_s) : step_s_(step_s) {}
  void Add(bool is_clear) {
    run_ = is_clear ? run_ + 1 : 0;
    longest_ = std::max(longest_, run_);
  }
  double seconds() const { return longest_ * step_s_; }

 private:
  double step_s_;
  int run_ = 0;
  int longest_ = 0;
};

}  // namespace

PlacedBox BoxAround(const Mesh& mesh, const Se3& T_world_object) {
  CSLAM_CHECK(!mesh.positions.empty());
  Eigen::Vector3f low = mesh.positions.front();
  Eigen::Vector3f high = low;
  for (const Eigen::Vector3f& p : mesh.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Eigen::Vector3d middle = 0.5 * (low + high).cast<double>();
  return {T_world_object * Se3(Eigen::Quaterniond::Identity(), middle),
          (high - low).cast<double>()};
}

double DistanceTo(const PlacedBox& box, const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d p = box.T_world_box.Inverse() * p_world;
  return (p.cwiseAbs() - 0.5 * box.size_m).cwiseMax(0.0).norm();
}

WorldBoxes::WorldBoxes(const World& world) : world_(world) {
  for (const SceneObject& object : world.scene.objects)
    own_.push_back(object.mesh.positions.empty() ? PlacedBox{} : BoxAround(object.mesh, Se3()));
}

PlacedBox WorldBoxes::Of(int instance, const Se3& T_world_object) const {
  const PlacedBox& own = own_.at(static_cast<std::size_t>(instance));
  return {T_world_object * own.T_world_box, own.size_m};
}

std::vector<PlacedBox> WorldBoxes::At(double time_s, int without) const {
  std::vector<PlacedBox> boxes;
  for (int instance = 1; instance < static_cast<int>(own_.size()); ++instance) {
    if (instance == without || world_.animations.contains(instance)) continue;
    const auto timeline = world_.timelines.find(instance);
    if (timeline == world_.timelines.end()) {
      const auto index = static_cast<std::size_t>(instance);
      boxes.push_back(Of(instance, world_.scene.objects[index].T_world_object));
      continue;
    }
    const Placement state = StateAt(timeline->second, time_s);
    if (state.presence != Presence::kAway) boxes.push_back(Of(instance, state.T_world_object));
  }
  return boxes;
}

bool MayBeInView(const PlacedBox& box, const Camera& camera, const Se3& T_world_camera,
                 double margin_px) {
  const Se3 T_camera_world = T_world_camera.Inverse();
  const double left = (camera.cx + 0.5 + margin_px) / camera.fx;
  const double right = (camera.width - 0.5 - camera.cx + margin_px) / camera.fx;
  const double up = (camera.cy + 0.5 + margin_px) / camera.fy;
  const double down = (camera.height - 0.5 - camera.cy + margin_px) / camera.fy;
  // How far inside each of the picture's five planes the furthest corner lies.
  Eigen::Array<double, 5, 1> inside = Eigen::Array<double, 5, 1>::Constant(-1.0);
  for (const Eigen::Vector3d& corner : CornersOf(box)) {
    const Eigen::Vector3d p = T_camera_world * corner;
    Eigen::Array<double, 5, 1> sides;
    sides << p.x() + left * p.z(), right * p.z() - p.x(), p.y() + up * p.z(), down * p.z() - p.y(),
        p.z();
    inside = inside.max(sides);
  }
  return (inside > 0.0).all();
}

BoxView ViewOf(const PlacedBox& box, const Camera& camera, const Se3& T_world_camera,
               std::span<const PlacedBox> occluders) {
  BoxView view;
  if (!MayBeInView(box, camera, T_world_camera, 0.0)) return view;
  const Se3 T_camera_world = T_world_camera.Inverse();
  view.picture_share = PictureShare(box, camera, T_camera_world);
  const std::vector<Eigen::Vector3d> samples = SamplesOf(box);
  int inside = 0;
  int clear = 0;
  for (const Eigen::Vector3d& sample : samples) {
    const Eigen::Vector3d p = T_camera_world * sample;
    if (p.z() < kNearM) continue;
    const Eigen::Vector2d uv = Project(camera, p);
    if (uv.x() < -0.5 || uv.y() < -0.5 || uv.x() >= camera.width - 0.5 ||
        uv.y() >= camera.height - 0.5)
      continue;
    ++inside;
    const bool is_hidden = std::ranges::any_of(occluders, [&](const PlacedBox& o) {
      return !Holds(o, sample, kContactM) && Blocks(o, T_world_camera.translation, sample);
    });
    if (!is_hidden) ++clear;
  }
  view.inside_share = static_cast<double>(inside) / static_cast<double>(samples.size());
  view.clear_share = static_cast<double>(clear) / static_cast<double>(samples.size());
  return view;
}

std::vector<SilentChange> SilentChanges(const World& world) {
  std::vector<SilentChange> changes;
  for (const auto& [instance, timeline] : world.timelines) {
    if (!timeline.carries.empty()) continue;
    std::vector<SilentChange> own;
    const std::vector<Stay>& stays = timeline.stays;
    for (std::size_t i = 0; i < stays.size(); ++i) {
      const bool follows = i > 0 && stays[i - 1].to_s == stays[i].from_s;
      if (std::isfinite(stays[i].from_s) && !follows)
        own.push_back({instance, stays[i].from_s, std::nullopt, stays[i].T_world_object});
      if (!std::isfinite(stays[i].to_s)) continue;
      const bool goes_on = i + 1 < stays.size() && stays[i + 1].from_s == stays[i].to_s;
      own.push_back({instance, stays[i].to_s, stays[i].T_world_object, std::nullopt});
      if (goes_on) own.back().to = stays[i + 1].T_world_object;
    }
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (i > 0) own[i].since_s = own[i - 1].time_s;
      if (i + 1 < own.size()) own[i].until_s = own[i + 1].time_s;
    }
    changes.insert(changes.end(), own.begin(), own.end());
  }
  std::ranges::stable_sort(changes, {}, &SilentChange::time_s);
  return changes;
}

ChangeViews ViewsAround(const WorldBoxes& boxes, const CameraMotion& motion, const Camera& camera,
                        const SilentChange& change, const ClearView& clear) {
  std::optional<PlacedBox> old_box;
  std::optional<PlacedBox> new_box;
  if (change.from) old_box = boxes.Of(change.instance, *change.from);
  if (change.to) new_box = boxes.Of(change.instance, *change.to);
  const auto may_see = [&](const std::optional<PlacedBox>& box, const Se3& T_world_camera) {
    return box && MayBeInView(*box, camera, T_world_camera, kViewMarginPx);
  };
  const auto is_clear = [&](const std::optional<PlacedBox>& box, const Se3& T_world_camera,
                            double t) {
    if (!may_see(box, T_world_camera)) return false;
    const BoxView view = ViewOf(*box, camera, T_world_camera, boxes.At(t, change.instance));
    return view.picture_share >= clear.min_picture_share &&
           view.clear_share >= clear.min_clear_share;
  };
  LongestLook before(clear.step_s), old_after(clear.step_s), new_after(clear.step_s);
  ChangeViews views{std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity(), 0.0, 0.0, 0.0};
  const double end_s = std::min(change.until_s, motion.duration_s);
  const int steps = static_cast<int>((end_s - change.since_s) / clear.step_s);
  for (int i = 0; i <= steps; ++i) {
    const double t = change.since_s + i * clear.step_s;
    const Se3 T_world_camera = motion.T_world_camera(t);
    const double away_s = std::abs(t - change.time_s);
    const bool is_before = t <= change.time_s;
    if (may_see(old_box, T_world_camera) || may_see(new_box, T_world_camera)) {
      double& unseen_s = is_before ? views.unseen_before_s : views.unseen_after_s;
      unseen_s = std::min(unseen_s, away_s);
    }
    if (is_before) {
      before.Add(is_clear(old_box ? old_box : new_box, T_world_camera, t));
    } else {
      old_after.Add(is_clear(old_box, T_world_camera, t));
      new_after.Add(is_clear(new_box, T_world_camera, t));
    }
  }
  views.before_s = before.seconds();
  views.old_after_s = old_after.seconds();
  views.new_after_s = new_after.seconds();
  return views;
}

}  // namespace cslam
