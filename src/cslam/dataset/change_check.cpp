// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/truth_builder.h"
#include "cslam/dataset/truth_check.h"
#include "cslam/dataset/truth_lookup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

constexpr double kSameTimeS = 1e-3;     // JSON rounds
constexpr double kSamePlaceM = 1e-3;    // nearer poses are the same
constexpr double kSameAngleRad = 1e-3;  // less turned ones, too

bool IsSameTime(double a_s, double b_s) {
  return std::abs(a_s - b_s) <= kSameTimeS;
}

bool IsSamePose(const Se3& a, const Se3& b) {
  const PoseDifference difference = Difference(a, b);
  return difference.distance_m <= kSamePlaceM && difference.angle_rad <= kSameAngleRad;
}

bool IsSamePose(const std::optional<Se3>& a, const std::optional<Se3>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return IsSamePose(*a, *b);
}

// What an object's intervals say happens to it: it comes, goes, or is somewhere else afterwards.
struct Event {
  const TrueObject* object = nullptr;
  double end_s = 0.0;  // when it has come to rest or is gone
  std::optional<Se3> from;
  std::optional<Se3> to;
  bool is_told = false;  // by a change
};

Se3 PoseOf(const TrueInterval& resting) {
  return resting.poses.empty() ? Se3() : resting.poses.front().T_world_object;
}

bool HasMoved(const Se3& from, const Se3& to) {
  const PoseDifference difference = Difference(from, to);
  return difference.distance_m >= kMinMoveM || difference.angle_rad >= kMinTurnRad;
}

// Walks along an object's intervals: while it is carried or pushed it is on its way from the last
// place it rested at; a gap is a time away.
class EventFinder {
 public:
  EventFinder(const TrueObject& object, double duration_s)
      : object_(object), duration_s_(duration_s) {}

  std::vector<Event> Find() {
    for (const TrueInterval& interval : object_.intervals) {
      if (rest_ != nullptr && interval.from_s > present_until_s_ + kSameTimeS) Leave();
      if (!interval.is_moving) Arrive(interval);
      present_until_s_ = interval.to_s;
    }
    if (rest_ != nullptr && present_until_s_ < duration_s_ - kSameTimeS) Leave();
    return events_;
  }

 private:
  void Leave() {
    events_.push_back({.object = &object_,
                       .end_s = present_until_s_,
                       .from = PoseOf(*rest_),
                       .to = {},
                       .is_told = false});
    rest_ = nullptr;
  }

  void Arrive(const TrueInterval& interval) {
    const bool is_first = rest_ == nullptr && interval.from_s <= kSameTimeS;
    const bool is_still = rest_ != nullptr && !HasMoved(PoseOf(*rest_), PoseOf(interval));
    if (!is_first && !is_still) {
      events_.push_back({.object = &object_,
                         .end_s = interval.from_s,
                         .from = rest_ != nullptr ? std::optional(PoseOf(*rest_)) : std::nullopt,
                         .to = PoseOf(interval),
                         .is_told = false});
    }
    rest_ = &interval;
  }

  const TrueObject& object_;
  double duration_s_;
  const TrueInterval* rest_ = nullptr;  // where it rested last; null while away
  double present_until_s_ = 0.0;
  std::vector<Event> events_;
};

class ChangeChecker {
 public:
  explicit ChangeChecker(const TrueObjects& objects) : objects_(objects) {
    for (const TrueObject& object : objects.objects) {
      if (object.is_deformable) continue;
      const std::vector<Event> found = EventFinder(object, objects.duration_s).Find();
      events_.insert(events_.end(), found.begin(), found.end());
    }
  }

  Findings Run(const TrueChanges& changes) {
    for (std::size_t i = 0; i < changes.changes.size(); ++i) {
      const TrueChange& change = changes.changes[i];
      place_ = fmt::format("changes.json, change {} ({} of instance {} at {:.3f} s)", i,
                           NameOf(change.kind), change.instance, change.time_s);
      if (i > 0 && change.time_s < changes.changes[i - 1].time_s) Say("is out of order");
      Check(change);
    }
    for (const Event& event : events_) {
      if (!event.is_told) findings_.push_back(Untold(event));
    }
    return findings_;
  }

 private:
  void Say(const std::string& problem) { findings_.push_back(place_ + ": " + problem); }

  void Check(const TrueChange& change) {
    if (change.time_s < 0.0 || change.time_s > objects_.duration_s + kSameTimeS) {
      Say(fmt::format("lies outside the sequence of {:.3f} s", objects_.duration_s));
      return;
    }
    if (!HasClass(change.instance, change.class_id)) return;
    switch (change.kind) {
      case ChangeKind::kRemoved:
        CheckEvent(change.instance, change.time_s, change.from, std::nullopt);
        break;
      case ChangeKind::kAdded:
        CheckEvent(change.instance, change.time_s, std::nullopt, change.to);
        break;
      case ChangeKind::kMoved:
        CheckMove(change);
        break;
      case ChangeKind::kReplaced:
        CheckReplacement(change);
        break;
    }
  }

  bool HasClass(int instance, int class_id) {
    const TrueObject* object = FindObject(objects_, instance);
    if (object == nullptr) {
      Say(fmt::format("instance {} is not in objects.json", instance));
      return false;
    }
    if (object->class_id == class_id) return true;
    Say(fmt::format("instance {} has class {} there, but {} in objects.json", instance, class_id,
                    object->class_id));
    return false;
  }

  void CheckMove(const TrueChange& change) {
    if (!change.from || !change.to) {
      Say("a move has two poses, from and to");
      return;
    }
    CheckEvent(change.instance, change.time_s, change.from, change.to);
  }

  void CheckReplacement(const TrueChange& change) {
    if (!change.from || !change.to) {
      Say("a replacement has two poses, from and to");
      return;
    }
    if (!HasClass(change.new_instance, change.new_class_id)) return;
    if (change.class_id == change.new_class_id) Say("replaces an object by one of its own class");
    const double distance_m = (change.from->translation - change.to->translation).norm();
    if (distance_m > kReplaceDistanceM + kSamePlaceM) {
      Say(fmt::format("the new object stands {:.2f} m from the old one, over {} m", distance_m,
                      kReplaceDistanceM));
    }
    // One of the two happens at the time told, the other may have happened before.
    const Event* gone =
        TakeEvent(change.instance, change.time_s, change.from, std::nullopt, /*or_before=*/true);
    const Event* come = TakeEvent(change.new_instance, change.time_s, std::nullopt, change.to,
                                  /*or_before=*/true);
    if (gone == nullptr || come == nullptr) {
      Say(fmt::format("objects.json does not have instance {} {}",
                      gone == nullptr ? change.instance : change.new_instance,
                      gone == nullptr ? "go there" : "come there"));
    }
  }

  void CheckEvent(int instance, double time_s, const std::optional<Se3>& from,
                  const std::optional<Se3>& to) {
    if (TakeEvent(instance, time_s, from, to, /*or_before=*/false) != nullptr) return;
    Say("the object's intervals in objects.json do not show it");
  }

  const Event* TakeEvent(int instance, double time_s, const std::optional<Se3>& from,
                         const std::optional<Se3>& to, bool or_before) {
    for (Event& event : events_) {
      const bool is_time = IsSameTime(event.end_s, time_s) || (or_before && event.end_s < time_s);
      if (event.is_told || event.object->instance != instance || !is_time) continue;
      if (!IsSamePose(event.from, from) || !IsSamePose(event.to, to)) continue;
      event.is_told = true;
      return &event;
    }
    return nullptr;
  }

  static std::string Untold(const Event& event) {
    const char* what = !event.from ? "comes" : !event.to ? "goes" : "moves";
    return fmt::format(
        "objects.json: '{}' (instance {}) {} at {:.3f} s, but changes.json does not tell",
        event.object->name, event.object->instance, what, event.end_s);
  }

  const TrueObjects& objects_;
  std::vector<Event> events_;
  std::string place_;
  Findings findings_;
};

}  // namespace

Findings CheckChanges(const TrueObjects& objects, const TrueChanges& changes) {
  return ChangeChecker(objects).Run(changes);
}

}  // namespace cslam
