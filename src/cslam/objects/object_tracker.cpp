// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/object_tracker.h"

#include "cslam/objects/detection_regions.h"
#include "cslam/objects/region_outline.h"
#include "cslam/objects/second_names.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cslam {

ObjectTracker::ObjectTracker(const Camera& camera, const ObjectTrackerOptions& options)
    : camera_(camera), views_(camera), options_(options), uses_(camera, options) {
  RuleOf(options.labels);  // throws for an unknown one
}

void ObjectTracker::Clear() {
  objects_.clear();
  history_.clear();
  now_ = Frame{};
  newest_taken_.reset();
}

void ObjectTracker::StartWorld() {
  history_.clear();
  for (Object& object : objects_) {
    object.filter.reset();
    object.found_at.reset();
  }
}

double ObjectTracker::AreaM2(const DepthRegion& region) const {
  const double metres_per_px = static_cast<double>(region.median_m) / camera_.fx * now_.view.step;
  return region.num_pixels * metres_per_px * metres_per_px;
}

void ObjectTracker::Observe(FrameId frame, Stamp stamp, const cv::Mat& depth_m,
                            const Se3& T_world_predicted, const Se3& T_world_last,
                            const Detections* detections) {
  MoveWorld(T_world_last);
  now_ = Frame{frame, stamp, views_.Make(depth_m), T_world_predicted, false, 0.0, {}};
  for (Object& object : objects_)
    object.is_detected_now = false;
  for (Object& object : objects_) {
    if (history_.empty()) break;
    if (object.region.empty() || now_.view.empty()) continue;
    object.region = Carried(history_.back(), object.region, object);
    object.box = object.region.box;  // empty where the depth says that it is gone
  }
  if (detections != nullptr && (!newest_taken_ || *newest_taken_ < detections->frame)) {
    newest_taken_ = detections->frame;
    Detections undistorted = *detections;
    for (Detection& detection : undistorted.objects)
      detection.box = views_.Undistorted(detection.box);
    undistorted.objects =
        WithoutSecondNames(std::move(undistorted.objects), options_.second_name_iou);
    TakeIn(undistorted);
  }
  Forget();
  for (const Object& object : objects_)
    now_.objects.push_back({object.id, object.box});
}

// Corrections of the map move the world: all that is kept in it moves along.
void ObjectTracker::MoveWorld(const Se3& T_world_last) {
  const auto last =
      std::find_if(history_.rbegin(), history_.rend(), [](const Frame& f) { return f.is_settled; });
  if (last == history_.rend()) return;
  const Se3 T_new_old = T_world_last * last->T_world_camera.Inverse();
  for (Frame& past : history_)
    past.T_world_camera = T_new_old * past.T_world_camera;
  for (Object& object : objects_) {
    if (object.filter) object.filter->MoveWorld(T_new_old);
    if (object.found_at) object.found_at = T_new_old * *object.found_at;
  }
}

// Where a region of an earlier frame is in the present one. Only what moves may grow on the way:
// everything else is where it was.
DepthRegion ObjectTracker::Carried(const Frame& from, const DepthRegion& region,
                                   const Object& object) const {
  constexpr int kMinUpdates = 4;  // before a velocity means anything
  if (region.empty()) return {};
  const Se3 T_now_from = now_.T_world_camera.Inverse() * from.T_world_camera;
  const double dt_s = SecondsBetween(now_.stamp, from.stamp);
  const bool may_move = LabelOf(object) == KeypointLabel::kDynamic &&
                        (object.is_person() || object.class_id < 0 ||
                         (object.filter && object.filter->motion() == ObjectMotion::kMoving));
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double margin_px = 0.0;
  if (may_move) {
    margin_px = options_.region.carry_speed_mps * dt_s * camera_.fx /
                std::max(0.3, static_cast<double>(region.median_m));
    if (object.filter && object.filter->num_updates() >= kMinUpdates) {
      shift = now_.T_world_camera.R().transpose() * object.filter->velocity() * dt_s;
    }
  }
  DepthRegion carried = CarryRegion(from.view, region, now_.view, T_now_from, shift, margin_px,
                                    object.is_person(), options_.region);
  const double max_area_m2 = options_.max_growth * object.reference_area_m2;
  if (carried.empty() || max_area_m2 <= 0.0 || AreaM2(carried) <= max_area_m2) return carried;
  // It has run into a neighbour: take only what was there before.
  return CarryRegion(from.view, region, now_.view, T_now_from, shift, 0.0, object.is_person(),
                     options_.region);
}

void ObjectTracker::TakeIn(const Detections& detections) {
  if (detections.frame == now_.id) {
    Associate(now_, detections.objects);
    return;
  }
  const auto past = std::find_if(history_.begin(), history_.end(),
                                 [&](const Frame& f) { return f.id == detections.frame; });
  if (past != history_.end()) Associate(*past, detections.objects);
}

// Late detections are compared both where they were seen and where they are now. Of a thing's
// region little may be left, like the belly of a bear: it is known by lying within the new one.
std::vector<BoxOverlap> ObjectTracker::Overlaps(const Frame& frame, const Detection& detection,
                                                std::size_t index,
                                                const DepthRegion& region_now) const {
  std::vector<BoxOverlap> overlaps;
  for (const Object& object : objects_) {
    if (object.class_id != detection.class_id && object.class_id >= 0) continue;
    double iou = Iou(object.box, frame.id == now_.id ? detection.box : region_now.box);
    const bool may_be_piece = object.class_id == detection.class_id && !object.is_person();
    if (may_be_piece && ShareInside(object.region, region_now) >= options_.min_inside)
      iou = std::max(iou, options_.min_iou);
    for (const PastObject& past : frame.objects) {
      if (past.id == object.id) iou = std::max(iou, Iou(past.box, detection.box));
    }
    if (iou >= options_.min_iou) overlaps.push_back({iou, index, object.id});
  }
  return overlaps;
}

void ObjectTracker::Associate(const Frame& frame, const std::vector<Detection>& detections) {
  const bool is_late = frame.id != now_.id;
  auto segmented = SegmentDetections(frame.view, detections, options_.region);
  std::vector<BoxOverlap> overlaps;
  for (std::size_t d = 0; d < segmented.size(); ++d) {
    const auto& [detection, region] = segmented[d];
    Object stranger;
    stranger.class_id = detection.class_id;
    const std::vector<BoxOverlap> more =
        Overlaps(frame, detection, d, is_late ? Carried(frame, region, stranger) : region);
    overlaps.insert(overlaps.end(), more.begin(), more.end());
  }
  const auto match = MatchBestFirst(std::move(overlaps), segmented.size());
  for (std::size_t d = 0; d < segmented.size(); ++d)
    Renew(match[d], segmented[d].detection, std::move(segmented[d].region), frame);
  std::vector<TrackId> renewed;
  for (const Object& object : objects_) {
    if (object.detected == frame.stamp && !object.is_person() && object.class_id >= 0)
      renewed.push_back(object.id);
  }
  for (const TrackId id : renewed)
    ForgetPiecesOf(id);
}

// What is carried on inside a thing of the same name that was just detected is a piece of it.
void ObjectTracker::ForgetPiecesOf(TrackId whole) {
  const auto object = std::find_if(objects_.begin(), objects_.end(),
                                   [&](const Object& o) { return o.id == whole; });
  const Object known = *object;
  std::erase_if(objects_, [&](const Object& o) {
    return o.id != whole && o.class_id == known.class_id && o.detected < known.detected &&
           ShareInside(o.region, known.region) >= options_.min_inside;
  });
}

// A detection updates its object, or becomes a new one.
void ObjectTracker::Renew(std::optional<TrackId> id, const Detection& detection, DepthRegion region,
                          const Frame& frame) {
  auto known = std::find_if(objects_.begin(), objects_.end(),
                            [&](const Object& o) { return id && o.id == *id; });
  if (known == objects_.end()) {
    Object fresh;
    fresh.id = TrackId(next_track_++);
    fresh.first_detected = frame.stamp;
    known = objects_.insert(objects_.end(), std::move(fresh));
  }
  Object& object = *known;
  object.class_id = detection.class_id;
  object.score = detection.score;
  object.detected = frame.stamp;
  object.is_detected_now = frame.id == now_.id;
  object.is_flat = region.is_flat;
  object.is_on_wall = region.is_on_wall;
  if (!region.empty()) object.reference_area_m2 = AreaM2(region);
  if (object.is_detected_now) {
    object.box = detection.box;
    object.region = std::move(region);
    return;
  }
  DepthRegion carried = Carried(frame, region, object);
  if (!carried.empty()) object.region = std::move(carried);
  object.box = object.region.empty() ? detection.box : object.region.box;
}

// The newest settled frame that is at least so old and was taken calmly.
const ObjectTracker::Frame* ObjectTracker::SettledBefore(double age_s) const {
  const auto frame = std::find_if(history_.rbegin(), history_.rend(), [&](const Frame& f) {
    return f.is_settled && f.turn_rate_dps <= options_.unknown.max_turn_rate_dps &&
           SecondsBetween(now_.stamp, f.stamp) >= age_s;
  });
  return frame == history_.rend() ? nullptr : &*frame;
}

// How fast the camera has turned since the last settled frame.
double ObjectTracker::TurnRateDps(const Se3& T_world_camera) const {
  const Frame* last = history_.empty() || !history_.back().is_settled ? nullptr : &history_.back();
  if (last == nullptr) return 0.0;
  const double dt_s = SecondsBetween(now_.stamp, last->stamp);
  if (dt_s <= 0.0) return 0.0;
  const Vector6 moved = Log(last->T_world_camera.Inverse() * T_world_camera);
  return moved.head<3>().norm() / dt_s * 180.0 / std::numbers::pi;
}

int ObjectTracker::FindUnknown(const Se3& T_world_camera, int num_inliers) {
  if (!options_.unknown.enabled || num_inliers < options_.unknown.min_inliers) return 0;
  if (TurnRateDps(T_world_camera) > options_.unknown.max_turn_rate_dps) return 0;
  constexpr double kSlackS = 1e-3;  // stamps are not exact multiples of a frame's time
  std::vector<EarlierView> earlier;
  for (const double age_s :
       {options_.unknown.reference_age_s, 0.5 * options_.unknown.reference_age_s}) {
    const Frame* frame = SettledBefore(age_s - kSlackS);
    if (frame == nullptr || (!earlier.empty() && earlier.back().view == &frame->view)) continue;
    earlier.push_back({&frame->view, frame->T_world_camera.Inverse() * T_world_camera,
                       SecondsBetween(now_.stamp, frame->stamp)});
  }
  constexpr std::size_t kNumViews = 2;  // one alone may have a wrong pose
  if (earlier.size() < kNumViews) return 0;
  const auto regions = FindMovedRegions(now_.view, earlier, DynamicMask(), options_.unknown);
  for (const DepthRegion& region : regions)
    AddUnknown(region, T_world_camera);
  return static_cast<int>(regions.size());
}

// A new piece of an unknown thing already followed renews it.
void ObjectTracker::AddUnknown(const DepthRegion& region, const Se3& T_world_camera) {
  const double gap_px = 3.0 * now_.view.step;  // pieces of one thing may lie so far apart
  const Box near{region.box.x_min - gap_px, region.box.y_min - gap_px, region.box.x_max + gap_px,
                 region.box.y_max + gap_px};
  const auto known = std::find_if(objects_.begin(), objects_.end(), [&](const Object& o) {
    return o.class_id < 0 && !o.region.empty() && !Intersect(o.box, near).empty() &&
           std::abs(o.region.median_m - region.median_m) <
               static_cast<float>(options_.unknown.reach_m);
  });
  if (known != objects_.end()) {
    cv::Mat both = known->region.mask | region.mask;
    DepthRegion joined = GrowRegion(now_.view, both, both, 2.0 * options_.unknown.reach_m, 1.0);
    if (joined.empty()) return;
    known->region = std::move(joined);
    known->box = known->region.box;
    known->detected = now_.stamp;
    known->reference_area_m2 = AreaM2(known->region);
    return;
  }
  Object fresh;
  fresh.id = TrackId(next_track_++);
  fresh.first_detected = fresh.detected = now_.stamp;
  fresh.box = region.box;
  fresh.region = region;
  fresh.reference_area_m2 = AreaM2(region);
  fresh.is_detected_now = true;
  fresh.filter.emplace(T_world_camera, CentreMeasurement{.centre_camera = region.centre_camera});
  fresh.filtered = now_.stamp;
  objects_.push_back(std::move(fresh));
  now_.objects.push_back({objects_.back().id, region.box});
}

// Objects that nothing has confirmed for a while.
void ObjectTracker::Forget() {
  constexpr double kBlindS = 0.15;  // a box without any depth lives no longer than this
  std::erase_if(objects_, [&](const Object& object) {
    if (object.has_travelled && !object.region.empty()) return false;
    const bool was_mistaken =
        object.class_id < 0 && object.filter && object.filter->motion() == ObjectMotion::kStatic;
    if (was_mistaken) return true;
    const double age_s = SecondsBetween(now_.stamp, object.detected);
    const double seen_for_s = SecondsBetween(object.detected, object.first_detected);
    const double bridge_s = object.class_id < 0
                                ? options_.bridge_s
                                : std::min(options_.bridge_s, options_.first_bridge_s + seen_for_s);
    return age_s > (object.region.empty() ? std::min(kBlindS, bridge_s) : bridge_s);
  });
}

std::vector<KeypointSemantics> ObjectTracker::Label(std::span<const Keypoint> keypoints) const {
  std::vector<LabelledThing> things;
  for (const Object& object : objects_) {
    const KeypointLabel label = LabelOf(object);
    if (label == KeypointLabel::kStatic) continue;
    things.push_back({object.box, object.region, object.class_id, object.id, label});
  }
  return LabelKeypoints(keypoints, things, now_.view, options_.labels);
}

cv::Mat ObjectTracker::DynamicMask() const {
  cv::Mat mask;
  for (const Object& object : objects_) {
    if (LabelOf(object) != KeypointLabel::kDynamic || object.region.empty()) continue;
    if (mask.empty()) mask = cv::Mat::zeros(object.region.mask.size(), CV_8UC1);
    mask.setTo(255, object.region.mask);
  }
  return mask;
}

void ObjectTracker::Settle(const Se3& T_world_camera,
                           const Eigen::Matrix3d& position_covariance_m2) {
  now_.T_world_camera = T_world_camera;
  now_.turn_rate_dps = TurnRateDps(T_world_camera);
  for (Object& object : objects_) {
    if (object.region.empty()) continue;
    const CentreMeasurement measurement{
        .centre_camera = object.region.centre_camera,
        .is_clipped = IsClipped(object.region) || IsCovered(object.region, now_.view),
        .camera_covariance_m2 = position_covariance_m2,
        .surface = SurfaceMotionOf(object)};
    if (!object.filter) {
      object.filter.emplace(T_world_camera, measurement);
    } else if (object.filtered < now_.stamp) {
      const double dt_s = SecondsBetween(now_.stamp, object.filtered);
      object.filter->Predict(dt_s, options_.filter);
      object.filter->Update(T_world_camera, measurement, dt_s, options_.filter);
    }
    object.filtered = now_.stamp;
    NoteTravel(object);
  }
  now_.is_settled = true;
  Remember();
}

void ObjectTracker::NoteTravel(Object& object) const {
  if (object.class_id >= 0 || object.has_travelled) return;
  if (!object.found_at) object.found_at = object.filter->position();
  const double way_m = (object.filter->position() - *object.found_at).norm();
  object.has_travelled =
      object.filter->motion() == ObjectMotion::kMoving && way_m > options_.left_behind_m;
}

// Whether the object's surface stands where it stood a moment ago.
SurfaceMotion ObjectTracker::SurfaceMotionOf(const Object& object) const {
  constexpr double kSlackS = 1e-3;
  const Frame* before = SettledBefore(0.5 * options_.unknown.reference_age_s - kSlackS);
  if (before == nullptr || now_.turn_rate_dps > options_.unknown.max_turn_rate_dps) {
    return SurfaceMotion::kNotKnown;
  }
  const EarlierView earlier{&before->view, before->T_world_camera.Inverse() * now_.T_world_camera,
                            SecondsBetween(now_.stamp, before->stamp)};
  return JudgeSurface(now_.view, object.region, earlier, options_.unknown);
}

void ObjectTracker::SettleLost() {
  Remember();
}

void ObjectTracker::Remember() {
  history_.push_back(now_);
  while (static_cast<int>(history_.size()) > options_.max_history_frames)
    history_.pop_front();
}

std::vector<TrackedObject> ObjectTracker::objects() const {
  std::vector<TrackedObject> result;
  for (const Object& object : objects_) {
    if (object.box.empty()) continue;  // gone, and kept for the moment in case it comes back
    TrackedObject out;
    out.track = object.id;
    out.class_id = object.class_id;
    out.score = object.score;
    out.box = views_.Distorted(object.box);
    out.label = LabelOf(object);
    out.is_detected = object.is_detected_now;
    if (object.filter) {
      out.motion = object.filter->motion();
      out.p_world = object.filter->position();
      out.velocity_mps = object.filter->velocity();
    }
    result.push_back(out);
  }
  return result;
}

std::vector<ObjectSighting> ObjectTracker::Sightings() const {
  std::vector<ObjectSighting> sightings;
  for (const Object& object : objects_) {
    if (object.class_id < 0 || object.is_person() || object.region.empty()) continue;
    if (object.filter && object.filter->motion() == ObjectMotion::kMoving) continue;
    if (uses_.IsRoom(object)) continue;
    sightings.push_back({.track = object.id,
                         .class_id = object.class_id,
                         .score = object.score * (object.is_flat ? options_.flat_score : 1.0),
                         .box = object.box,
                         .region = object.region,
                         .first_detected = object.first_detected,
                         .detected = object.detected,
                         .colours = {}});
  }
  return sightings;
}

}  // namespace cslam
