// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/util/id.h"
#include "cslam/util/stamp.h"
#include "cslam/vision/box.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cslam {

enum class ObjectState : std::uint8_t {
  kCandidate,  // seen, but not believed in yet
  kPresent,    // believed to stand where it was seen
  kAbsent,     // its place was seen without it; kept, for it may come back
  kMerged,     // turned out to be another: continues as merged_into
  kErased,     // was never there; the id stays taken
};
const char* ToString(ObjectState state);

// Why a belief changed.
enum class BeliefCause : std::uint8_t {
  kCreated,
  kSeen,
  kMissed,
  kLookedThrough,
  kMerged,
  kDisplaced
};
const char* ToString(BeliefCause cause);

struct BeliefStep {
  Stamp stamp;
  float belief = 0.5F;
  BeliefCause cause = BeliefCause::kCreated;

  bool operator==(const BeliefStep&) const = default;
};

// A cell of an object's surface that depth was measured in.
struct SurfaceVoxel {
  std::array<std::int16_t, 3> cell{};
  Eigen::Vector3f p = Eigen::Vector3f::Zero();  // mean of the readings, m, reference camera frame
  std::uint16_t num_inside = 0;                 // views in which the object's region covered it
  std::uint16_t num_outside = 0;  // views of the object in which it was seen outside the region
};

// What is known of an object's surface; never changes once made.
struct ObjectSurface {
  double voxel_m = 0.03;
  std::vector<SurfaceVoxel> voxels;      // sorted by cell
  std::vector<Eigen::Vector3f> samples;  // few of the trusted ones, spread evenly
};

// An upright or oriented box, in whatever frame its owner says.
struct OrientedBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

// Colours of an object: 3 x 8 bins of hue (coloured pixels), saturation and value; sums to 3.
using ColourHistogram = std::array<float, 24>;

// A thing of the map ("MapObject" in the paper). Plain data: only Map changes it. All geometry is
// kept in the camera frame of one keyframe and so follows every correction.
struct MapObject {
  struct ClassVote {
    std::int16_t class_id = -1;
    float weight = 0.0F;  // sum of detection scores
  };

  ObjectId id;
  MapId map;
  ObjectState state = ObjectState::kCandidate;
  ObjectId merged_into;
  int class_id = -1;             // COCO; the most likely one, by votes and size
  std::vector<ClassVote> votes;  // most first
  double log_odds = 0.0;         // of the belief in its persistence (Eqs. 11 to 14)
  bool is_active = false;        // its points take part in estimation and place recognition

  KeyframeId reference;
  std::shared_ptr<const ObjectSurface> surface;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // m, reference camera frame
  OrientedBox box;                                     // reference camera frame
  ColourHistogram colours{};

  Box first_box;    // undistorted px
  Box current_box;  // when seen last
  TrackId track;    // the tracker's name for it when seen last
  KeyframeId first_keyframe;
  KeyframeId arrived_keyframe;  // when its present stay was first seen: later, if it was gone
  KeyframeId last_keyframe;
  Stamp first_seen;
  Stamp last_seen;
  std::optional<Stamp> absent_since;
  std::uint32_t first_session = 0;
  std::uint32_t last_session = 0;
  std::int32_t num_sightings = 0;  // keyframes in which it was detected
  // Frames that had it wholly in view, near by, with and without its detection.
  std::int32_t num_named_views = 0;
  std::int32_t num_unnamed_views = 0;
  std::vector<BeliefStep> history;

  bool IsAlive() const { return state < ObjectState::kMerged; }
};

double BeliefOf(const MapObject& object);  // 0 to 1

// Counts a vote for a class. Which class the object has is not decided here.
void AddVote(MapObject& object, const MapObject::ClassVote& vote);

// Adds the present belief to the history, which keeps its first step and the newest ones.
void NoteBelief(MapObject& object, Stamp now, BeliefCause cause);

enum class MapChangeKind : std::uint8_t { kRemoved, kAdded, kMoved, kReplaced };
const char* ToString(MapChangeKind kind);

// Something that was otherwise before. Where: at the objects' centroids.
struct MapChange {
  MapChangeKind kind = MapChangeKind::kRemoved;
  ObjectId object;      // what left or moved; what came, if added
  ObjectId new_object;  // moved: the same thing at its new place; replaced: what stands there now
  Stamp last_seen_there;
  std::optional<Stamp> first_seen_absent;
  Stamp reported;  // when the last piece of it was known
  double confidence = 0.0;
  std::int32_t num_absent_views = 0;
  std::int32_t num_seen_views = 0;
  bool is_between_sessions = false;

  bool operator==(const MapChange&) const = default;
};

}  // namespace cslam
