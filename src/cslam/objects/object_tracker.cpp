// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/object_tracker.h"

#include "cslam/util/options.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace cslam {
namespace {

// Depth readings that a region must touch on the picture's border, or beside something nearer, to
// count as cut off.
bool IsClipped(const DepthRegion& region) {
  constexpr int kMinTouching = 3;
  int touching = 0;
  const cv::Mat& mask = region.mask;
  for (int u = 0; u < mask.cols; ++u) {
    touching += mask.at<std::uint8_t>(0, u) != 0 ? 1 : 0;
    touching += mask.at<std::uint8_t>(mask.rows - 1, u) != 0 ? 1 : 0;
  }
  for (int v = 0; v < mask.rows; ++v) {
    touching += mask.at<std::uint8_t>(v, 0) != 0 ? 1 : 0;
    touching += mask.at<std::uint8_t>(v, mask.cols - 1) != 0 ? 1 : 0;
  }
  return touching >= kMinTouching;
}

// Whether something clearly nearer stands right beside the region's pixels.
bool IsCovered(const DepthRegion& region, const DepthView& view) {
  constexpr float kNearerM = 0.25F;
  constexpr double kMinShare = 0.06;  // of the region's outline
  int outline = 0;
  int covered = 0;
  for (int v = 1; v + 1 < region.mask.rows; ++v) {
    for (int u = 1; u + 1 < region.mask.cols; ++u) {
      if (region.mask.at<std::uint8_t>(v, u) == 0) continue;
      const float own = view.DepthM(u, v) > 0.0F ? view.DepthM(u, v) : region.median_m;
      for (const auto& [du, dv] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (region.mask.at<std::uint8_t>(v + dv, u + du) != 0) continue;
        ++outline;
        const float other = view.DepthM(u + du, v + dv);
        if (other > 0.0F && other < own - kNearerM) ++covered;
      }
    }
  }
  return outline > 0 && covered > kMinShare * outline;
}

// Whether most of a lies within b, which is clearly larger: it sits on it or stands before it.
bool SitsOn(const Box& a, const Box& b) {
  constexpr double kInside = 0.7;
  constexpr double kSmaller = 0.6;
  return a.area() < kSmaller * b.area() && Intersect(a, b).area() > kInside * a.area();
}

// People first, then what sits on something before what it sits on, then nearer things, so that
// those behind leave out what is covered: the box of a chair behind somebody is full of that
// person, and that of a chair with a bear has the bear in the middle.
std::vector<std::size_t> FrontToBack(const std::vector<Detection>& detections,
                                     const std::vector<DepthRegion>& regions) {
  std::vector<std::size_t> left(detections.size());
  for (std::size_t i = 0; i < left.size(); ++i)
    left[i] = i;
  const auto rank = [&](std::size_t i) {
    const bool is_person = detections[i].class_id == kPersonClass;
    const bool carries = std::any_of(left.begin(), left.end(), [&](std::size_t j) {
      return j != i && SitsOn(detections[j].box, detections[i].box);
    });
    const float z = regions[i].empty() ? std::numeric_limits<float>::max() : regions[i].median_m;
    return std::tuple(!is_person, carries, z, i);
  };
  std::vector<std::size_t> order;
  while (!left.empty()) {
    const auto next = std::min_element(
        left.begin(), left.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    order.push_back(*next);
    left.erase(next);
  }
  return order;
}

}  // namespace

void Describe(OptionList& list, ObjectTrackerOptions& o) {
  list.Add("enabled", o.enabled, "Leave out people and moving things; off: all is background.");
  list.Add("label_movable", o.label_movable,
           "Hold back the keypoints of things that may move, not those of people alone.");
  list.Add(
      "hold_back_new", o.hold_back_new,
      "Hold back movable things until they are known to rest (the paper), instead of from when "
      "they are seen to move.");
  list.Add("filter_motion", o.filter_motion,
           "Use movable things again once their filter finds them static.");
  list.Add("min_iou", o.min_iou, {0.01, 1.0}, "",
           "Overlap of boxes from which on a detection is taken for a known object.");
  list.Add("bridge", o.bridge_s, {0.0, 60.0}, "s",
           "How long an object is carried on by its depth while the detector misses it.");
  list.Add("first_bridge", o.first_bridge_s, {0.0, 60.0}, "s",
           "The same for what was detected once; it grows with the time it has been seen, since "
           "detectors of people are set to find too many rather than too few.");
  list.Add("max_history", o.max_history_frames, {1, 1000}, "frames",
           "How late detections may come.");
  list.Add("left_behind", o.left_behind_m, {0.0, 100.0}, "m",
           "A nameless thing that was seen to move so far is left out while it stays in view, even "
           "at rest: what was brought is likely to be taken away again.");
  list.Add("max_growth", o.max_growth, {1.0, 100.0}, "",
           "A carried region stops growing at so many times its detected size.");
  list.Add("flat_score", o.flat_score, {0.0, 1.0}, "",
           "What the score of a thing counts, as far as the map of objects goes, that does not "
           "stand out from the wall or table: pictures pass for screens.");
  list.Group("region", o.region);
  list.Group("labels", o.labels);
  list.Group("filter", o.filter);
  list.Group("unknown", o.unknown);
}

ObjectTracker::ObjectTracker(const Camera& camera, const ObjectTrackerOptions& options)
    : camera_(camera), views_(camera), options_(options) {
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
    Associate(now_, detections);
    return;
  }
  const auto past = std::find_if(history_.begin(), history_.end(),
                                 [&](const Frame& f) { return f.id == detections.frame; });
  if (past != history_.end()) Associate(*past, detections);
}

DepthRegion ObjectTracker::Segment(const DepthView& view, const Detection& detection,
                                   const cv::Mat& excluded) const {
  const bool is_person = detection.class_id == kPersonClass;
  return detection.mask.empty()
             ? SegmentBox(view, detection.box, is_person, excluded, options_.region)
             : SegmentMask(view, detection.box, detection.mask, is_person, excluded,
                           options_.region);
}

// Those behind leave out what is covered.
std::vector<DepthRegion> ObjectTracker::SegmentAll(const Frame& frame,
                                                   const Detections& detections) const {
  std::vector<DepthRegion> regions;
  regions.reserve(detections.objects.size());
  for (const Detection& detection : detections.objects)
    regions.push_back(Segment(frame.view, detection, {}));
  cv::Mat taken;
  for (const std::size_t i : FrontToBack(detections.objects, regions)) {
    const Detection& detection = detections.objects[i];
    bool overlaps = false;
    for (const Detection& other : detections.objects)
      overlaps = overlaps || (&other != &detection && Iou(other.box, detection.box) > 0.0);
    if (overlaps && !taken.empty()) regions[i] = Segment(frame.view, detection, taken);
    if (regions[i].empty()) continue;
    if (taken.empty()) taken = cv::Mat::zeros(regions[i].mask.size(), CV_8UC1);
    taken.setTo(255, regions[i].mask);
  }
  return regions;
}

// Best overlaps first, one to one, ties by id (Algorithm 2). Late detections are compared both
// where they were seen and where they are now.
void ObjectTracker::Associate(const Frame& frame, const Detections& detections) {
  const bool is_late = frame.id != now_.id;
  std::vector<DepthRegion> regions = SegmentAll(frame, detections);
  struct Pair {
    double iou;
    std::size_t detection;
    TrackId id;
  };
  std::vector<Pair> pairs;
  for (std::size_t d = 0; d < detections.objects.size(); ++d) {
    const Detection& detection = detections.objects[d];
    Box box_now = detection.box;
    if (is_late) {
      Object stranger;
      stranger.class_id = detection.class_id;
      box_now = Carried(frame, regions[d], stranger).box;
    }
    for (const Object& object : objects_) {
      if (object.class_id != detection.class_id && object.class_id >= 0) continue;
      double iou = Iou(object.box, box_now);
      for (const PastObject& past : frame.objects) {
        if (past.id == object.id) iou = std::max(iou, Iou(past.box, detection.box));
      }
      if (iou >= options_.min_iou) pairs.push_back({iou, d, object.id});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return a.iou != b.iou ? a.iou > b.iou : a.id < b.id;
  });
  std::vector<std::optional<TrackId>> match(detections.objects.size());
  std::vector<TrackId> used;
  for (const Pair& pair : pairs) {
    if (match[pair.detection] || std::find(used.begin(), used.end(), pair.id) != used.end()) {
      continue;
    }
    match[pair.detection] = pair.id;
    used.push_back(pair.id);
  }
  for (std::size_t d = 0; d < detections.objects.size(); ++d)
    Renew(match[d], detections.objects[d], std::move(regions[d]), frame);
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

KeypointLabel ObjectTracker::LabelOf(const Object& object) const {
  if (object.is_person() || object.class_id < 0) return KeypointLabel::kDynamic;
  if (!options_.label_movable) return KeypointLabel::kStatic;
  if (!options_.filter_motion) return KeypointLabel::kDynamic;
  const ObjectMotion motion = object.filter ? object.filter->motion() : ObjectMotion::kUnknown;
  const bool may_use = motion == ObjectMotion::kStatic ||
                       (motion == ObjectMotion::kUnknown && !options_.hold_back_new);
  return may_use ? KeypointLabel::kMovable : KeypointLabel::kDynamic;
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
