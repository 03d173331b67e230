// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/map/map_object.h"

#include <cmath>

namespace cslam {

const char* ToString(ObjectState state) {
  switch (state) {
    case ObjectState::kCandidate:
      return "candidate";
    case ObjectState::kPresent:
      return "present";
    case ObjectState::kAbsent:
      return "absent";
    case ObjectState::kMerged:
      return "merged";
    case ObjectState::kErased:
      return "erased";
  }
  return "?";
}

const char* ToString(BeliefCause cause) {
  switch (cause) {
    case BeliefCause::kCreated:
      return "created";
    case BeliefCause::kSeen:
      return "seen";
    case BeliefCause::kMissed:
      return "missed";
    case BeliefCause::kLookedThrough:
      return "looked_through";
    case BeliefCause::kMerged:
      return "merged";
    case BeliefCause::kDisplaced:
      return "displaced";
  }
  return "?";
}

const char* ToString(MapChangeKind kind) {
  switch (kind) {
    case MapChangeKind::kRemoved:
      return "removed";
    case MapChangeKind::kAdded:
      return "added";
    case MapChangeKind::kMoved:
      return "moved";
    case MapChangeKind::kReplaced:
      return "replaced";
  }
  return "?";
}

double BeliefOf(const MapObject& object) {
  return 1.0 / (1.0 + std::exp(-object.log_odds));
}

void AddVote(MapObject& object, const MapObject::ClassVote& vote) {
  auto known = std::find_if(object.votes.begin(), object.votes.end(),
                            [&](const auto& v) { return v.class_id == vote.class_id; });
  if (known == object.votes.end()) known = object.votes.insert(known, {vote.class_id, 0.0F});
  known->weight += vote.weight;
  std::stable_sort(object.votes.begin(), object.votes.end(),
                   [](const auto& a, const auto& b) { return a.weight > b.weight; });
}

void NoteBelief(MapObject& object, Stamp now, BeliefCause cause) {
  const auto belief = static_cast<float>(BeliefOf(object));
  if (!object.history.empty() && object.history.back().belief == belief &&
      object.history.back().cause == cause) {
    object.history.back().stamp = now;
    return;
  }
  constexpr std::size_t kMaxHistory = 500;
  if (object.history.size() >= kMaxHistory) object.history.erase(object.history.begin() + 1);
  object.history.push_back({now, belief, cause});
}

}  // namespace cslam
