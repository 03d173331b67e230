// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_changes.h"

#include "cslam/mapping/object_geometry.h"
#include "cslam/mapping/views_before.h"
#include "cslam/objects/object_sighting.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace cslam {
namespace {

double Confidence(const MapView& map, const MapChange& change) {
  double confidence = 1.0;
  if (const MapObject* object = map.FindObject(change.object)) {
    const double belief = BeliefOf(*object);
    confidence *= object->state == ObjectState::kAbsent ? 1.0 - belief : belief;
  }
  if (const MapObject* object = map.FindObject(change.new_object)) confidence *= BeliefOf(*object);
  return confidence;
}

// Seen from one side only a box is thin: it is taken to be as deep as it is wide.
bool StandsInside(const MapView& map, const MapObject& object, const MapObject& around) {
  const Eigen::Vector3d p = map.T_world_object(around).Inverse() * map.CentroidOf(object);
  const Eigen::Vector3d p_box = around.box.rotation.conjugate() * (p - around.box.center);
  const double middle_m = MiddleSideM(around.box);
  return (p_box.cwiseAbs().array() <= 0.5 * around.box.size_m.array().max(middle_m)).all();
}

bool IsSingle(const MapChange& change, MapChangeKind kind) {
  return change.kind == kind && !change.new_object.valid();
}

template <class Predicate>
std::optional<MapChange> LastTold(const MapView& map, const Predicate& matches) {
  const std::vector<MapChange>& changes = map.changes();
  const auto told = std::find_if(changes.rbegin(), changes.rend(), matches);
  return told == changes.rend() ? std::nullopt : std::optional(*told);
}

// What was told last of the object's coming ...
std::optional<MapChange> ToldArrival(const MapView& map, ObjectId id) {
  return LastTold(map, [&](const MapChange& c) {
    return c.new_object == id || (c.object == id && c.kind == MapChangeKind::kAdded);
  });
}

// ... and of its going.
std::optional<MapChange> ToldDeparture(const MapView& map, ObjectId id) {
  return LastTold(
      map, [&](const MapChange& c) { return c.object == id && c.kind != MapChangeKind::kAdded; });
}

// One thing at two places: what it was called at the old one counts at the new one.
void InheritVotes(Map& map, const MapChange& moved) {
  MapObject object = *map.FindObject(moved.new_object);
  for (const MapObject::ClassVote& vote : map.FindObject(moved.object)->votes)
    AddVote(object, vote);
  map.SetObject(std::move(object));
}

// What a joined change says of the thing that has gone ...
MapChange GoneHalf(const MapChange& joined) {
  MapChange gone = joined;
  gone.kind = MapChangeKind::kRemoved;
  gone.new_object = ObjectId();
  return gone;
}

// ... and of the one that has come.
MapChange ComeHalf(const MapView& map, const MapChange& joined) {
  MapChange come;
  come.kind = MapChangeKind::kAdded;
  come.object = joined.new_object;
  if (const MapObject* object = map.FindObject(come.object))
    come.last_seen_there = object->first_seen;
  come.reported = joined.reported;
  come.num_seen_views = joined.num_seen_views;
  come.is_between_sessions = joined.is_between_sessions;
  come.confidence = joined.confidence;
  return come;
}

// One thing came from one place, or took the place of one: of several changes that say so the first
// move stays, or the first replacement; the others' things have gone.
void LeaveToOne(std::vector<MapChange>& changes, ObjectId comer) {
  const auto says_so = [&](MapChangeKind kind) {
    return std::find_if(changes.begin(), changes.end(), [&](const MapChange& c) {
      return c.new_object == comer && c.kind == kind;
    });
  };
  auto stays = says_so(MapChangeKind::kMoved);
  if (stays == changes.end()) stays = says_so(MapChangeKind::kReplaced);
  for (auto change = changes.begin(); change != changes.end(); ++change) {
    if (change->new_object == comer && change != stays) *change = GoneHalf(*change);
  }
}

}  // namespace

ChangeList::ChangeList(const Camera& camera, const MapObjectOptions& options,
                       const ObjectClasses& classes)
    : camera_(camera), options_(options), classes_(classes) {}

bool ChangeList::LooksLike(const MapObject& a, const MapObject& b) const {
  if (!classes_.AreAlike(a.class_id, b.class_id)) return false;
  const double likeness = ColourLikeness(a.colours, b.colours);
  if (likeness < options_.min_likeness) return false;
  return SizeRatio(a.box, b.box) <= (likeness >= options_.sure_likeness
                                         ? options_.sure_max_size_ratio
                                         : options_.max_size_ratio);
}

bool ChangeList::LooksTheSame(const MapObject& a, const MapObject& b) const {
  return ColourLikeness(a.colours, b.colours) >= options_.past.sure_likeness &&
         SizeRatio(a.box, b.box) <= options_.past.sure_max_size_ratio;
}

// What was seen while the other was there is neither the same nor in its place. Unless it was only
// while one looked at its place again, and found it empty: something else was taken for it then.
bool ChangeList::WentBefore(const MapObject& old_object, const MapObject& new_object) const {
  if (old_object.last_keyframe < new_object.arrived_keyframe) return true;
  if (!old_object.absent_since || !LooksTheSame(old_object, new_object) ||
      SecondsBetween(*old_object.absent_since, old_object.last_seen) >=
          options_.recognise_after_s) {
    return false;
  }
  return std::none_of(
      old_object.history.begin(), old_object.history.end(), [&](const BeliefStep& step) {
        return step.cause == BeliefCause::kSeen && new_object.first_seen < step.stamp &&
               HasPassed(step.stamp, *old_object.absent_since, options_.recognise_after_s);
      });
}

bool ChangeList::StandsAt(const MapView& map, const MapObject& a, const MapObject& b) const {
  return (map.CentroidOf(a) - map.CentroidOf(b)).norm() <= options_.replace_distance_m;
}

// Makes one change of two: change has one half, other the other half.
bool ChangeList::Join(const MapView& map, MapChange& change, const MapChange& other) const {
  const bool is_gone = IsSingle(change, MapChangeKind::kRemoved);
  const MapChange& removed = is_gone ? change : other;
  const MapChange& added = is_gone ? other : change;
  if (!IsSingle(removed, MapChangeKind::kRemoved) || !IsSingle(added, MapChangeKind::kAdded)) {
    return false;
  }
  const MapObject* old_object = map.FindObject(removed.object);
  const MapObject* new_object = map.FindObject(added.object);
  if (old_object == nullptr || new_object == nullptr || old_object == new_object) return false;
  if (old_object->map != new_object->map) return false;
  if (!WentBefore(*old_object, *new_object)) return false;
  MapChange joined = removed;
  if (LooksLike(*old_object, *new_object)) {
    joined.kind = MapChangeKind::kMoved;
  } else if (!classes_.AreAlike(old_object->class_id, new_object->class_id) &&
             StandsAt(map, *old_object, *new_object)) {
    joined.kind = MapChangeKind::kReplaced;
  } else {
    return false;
  }
  joined.new_object = added.object;
  joined.num_seen_views = added.num_seen_views;
  joined.is_between_sessions = removed.is_between_sessions && added.is_between_sessions;
  joined.reported = std::max(removed.reported, added.reported);
  joined.confidence = Confidence(map, joined);
  change = joined;
  return true;
}

MapChange ChangeList::GoneOf(const MapView& map, ObjectId id, Stamp now, int num_views,
                             std::uint32_t session) const {
  const MapObject& object = *map.FindObject(id);
  MapChange change;
  change.kind = MapChangeKind::kRemoved;
  change.object = id;
  change.last_seen_there = object.last_seen;
  change.first_seen_absent = object.absent_since;
  change.reported = now;
  change.num_absent_views = num_views;
  change.is_between_sessions = object.last_session < session;
  change.confidence = Confidence(map, change);
  return change;
}

void ChangeList::OnGone(Map& map, ObjectId id, Stamp now, int num_views,
                        std::uint32_t session) const {
  AddJoined(map, GoneOf(map, id, now, num_views, session));
}

void ChangeList::OnOriginFound(Map& map, ObjectId origin, ObjectId object, Stamp now, int num_views,
                               std::uint32_t session) const {
  AddJoined(map, GoneOf(map, origin, now, num_views, session), object);
}

// Whether the change and one that is told are two halves of one, and how well they go together: a
// thing that moved before one that was replaced. A replacement gives its half away to a move, and
// to one of a larger thing: of a chair with a bear on it the chair was replaced, even if the bear
// was missed first.
std::optional<ChangeList::Pairing> ChangeList::PairUp(const MapView& map, const MapChange& change,
                                                      const MapChange& told) const {
  Pairing pairing{change, std::nullopt, 0};
  if (Join(map, pairing.joined, told)) {
    pairing.rank = pairing.joined.kind == MapChangeKind::kMoved ? 4 : 1;
    return pairing;
  }
  if (told.kind != MapChangeKind::kReplaced) return std::nullopt;
  const bool is_gone = change.kind == MapChangeKind::kRemoved;
  const MapChange gone = GoneHalf(told);
  const MapChange come = ComeHalf(map, told);
  if (!Join(map, pairing.joined, is_gone ? come : gone)) return std::nullopt;
  pairing.left_over = is_gone ? gone : come;
  if (pairing.joined.kind == MapChangeKind::kMoved) {
    pairing.rank = 3;
    return pairing;
  }
  const MapObject* smaller = map.FindObject(told.object);
  const bool is_larger =
      is_gone && smaller != nullptr &&
      smaller->box.size_m.prod() < map.FindObject(change.object)->box.size_m.prod();
  pairing.rank = 2;
  return is_larger ? std::optional(pairing) : std::nullopt;
}

// Adds a change, joined with the best of those that are told, of equal ones with that of the
// preferred object, or the later one. What that leaves over is added in turn; since moves keep
// their halves and things only get larger, it ends.
void ChangeList::AddJoined(Map& map, const MapChange& change, ObjectId preferred) const {
  std::vector<MapChange> changes = map.changes();
  std::optional<std::size_t> partner;
  Pairing best{change, std::nullopt, 0};
  for (std::size_t i = changes.size(); i-- > 0;) {
    const auto pairing = PairUp(map, change, changes[i]);
    const bool is_preferred = pairing && preferred.valid() && pairing->rank == best.rank &&
                              pairing->joined.new_object == preferred;
    if (!pairing || (pairing->rank <= best.rank && !is_preferred)) continue;
    partner = i;
    best = *pairing;
  }
  if (partner) changes.erase(changes.begin() + static_cast<std::ptrdiff_t>(*partner));
  if (best.joined.kind == MapChangeKind::kMoved) InheritVotes(map, best.joined);
  changes.push_back(best.joined);
  map.SetChanges(std::move(changes));
  if (best.left_over) AddJoined(map, *best.left_over);
}

// Known better, what was added may turn out to be what is missing elsewhere.
void ChangeList::RejoinAdded(Map& map, MapChange added, Stamp now) const {
  std::vector<MapChange> changes = map.changes();
  const bool has_partner = std::any_of(changes.begin(), changes.end(), [&](const MapChange& told) {
    return PairUp(map, added, told).has_value();
  });
  if (!has_partner) return;
  std::erase(changes, added);
  map.SetChanges(std::move(changes));
  added.reported = now;
  AddJoined(map, added);
}

// What nobody looked through, and is seen again, never went; unless what took its place was there
// and may have gone meanwhile: then it may have been put back. Nor does what was not told to go
// come.
bool ChangeList::TakeBackDisplacement(Map& map, ObjectId id, Stamp now) const {
  const auto told = ToldDeparture(map, id);
  if (!told) return true;
  if (told->num_absent_views > 0 || told->kind == MapChangeKind::kMoved) return false;
  const ObjectId comer_id = told->new_object;
  const MapObject* comer = map.FindObject(comer_id);
  if (comer != nullptr && (comer->state != ObjectState::kPresent ||
                           HasPassed(comer->last_seen, now, options_.recognise_after_s))) {
    return false;
  }
  std::vector<MapChange> changes = map.changes();
  std::erase(changes, *told);
  map.SetChanges(std::move(changes));
  if (comer == nullptr) return true;
  if (comer->arrived_keyframe == comer->first_keyframe) {
    OnArrived(map, comer_id, now, comer->first_session);
  } else {
    AddJoined(map, ComeHalf(map, *told));  // it had come back
  }
  return true;
}

void ChangeList::OnSeenAgain(Map& map, ObjectId id, Stamp now) const {
  const auto told = ToldArrival(map, id);
  if (told && IsSingle(*told, MapChangeKind::kAdded)) RejoinAdded(map, *told, now);
}

void ChangeList::OnArrived(Map& map, ObjectId id, Stamp now, std::uint32_t session) const {
  const MapObject& object = *map.FindObject(id);
  const bool is_back = object.absent_since.has_value();
  if (is_back && TakeBackDisplacement(map, id, now)) return;
  if (!is_back && ToldArrival(map, id)) return OnSeenAgain(map, id, now);
  const ViewsBefore before =
      is_back ? ViewsBefore{} : LookBack(map, object, camera_, session, options_.view);
  const bool was_empty = is_back || (before.num_through >= options_.min_views_before &&
                                     before.num_through > 2 * before.num_standing);
  MapChange change;
  change.kind = MapChangeKind::kAdded;
  change.object = id;
  change.last_seen_there = object.first_seen;
  change.reported = now;
  change.num_absent_views = before.num_through;
  change.num_seen_views = object.num_sightings;
  change.is_between_sessions = before.is_between_sessions;
  change.confidence = Confidence(map, change);
  if (was_empty) {
    AddJoined(map, change);
    return;
  }
  // Nobody looked there before: it came only if something like it has gone, or what stood there.
  std::vector<MapChange> changes = map.changes();
  for (std::size_t i = changes.size(); i-- > 0;) {
    const MapObject* gone = map.FindObject(changes[i].object);
    if (!IsSingle(changes[i], MapChangeKind::kRemoved) || gone == nullptr ||
        before.num_standing > 0 || !(gone->last_keyframe < object.first_keyframe)) {
      continue;
    }
    MapChange joined = change;
    if (!Join(map, joined, changes[i])) continue;
    if (joined.kind == MapChangeKind::kReplaced && !StandsInside(map, object, *gone)) continue;
    if (joined.kind == MapChangeKind::kMoved &&
        ColourLikeness(object.colours, gone->colours) < options_.sure_likeness) {
      continue;
    }
    changes[i] = joined;
    if (joined.kind == MapChangeKind::kMoved) InheritVotes(map, joined);
    map.SetChanges(std::move(changes));
    return;
  }
}

// Two things cannot be in one place: the old one is gone although nobody could look through.
void ChangeList::OnDisplaced(Map& map, ObjectId id, ObjectId by, Stamp now,
                             std::uint32_t session) const {
  const MapObject& object = *map.FindObject(id);
  std::vector<MapChange> changes = map.changes();
  const bool is_taken = std::any_of(changes.begin(), changes.end(),
                                    [&](const MapChange& c) { return c.new_object == by; });
  MapChange change;
  change.kind = is_taken ? MapChangeKind::kRemoved : MapChangeKind::kReplaced;
  change.object = id;
  if (!is_taken) change.new_object = by;
  change.last_seen_there = object.last_seen;
  change.first_seen_absent = object.absent_since;
  change.reported = now;
  change.num_seen_views = map.FindObject(by)->num_sightings;
  change.is_between_sessions = object.last_session < session;
  change.confidence = Confidence(map, change);
  if (!is_taken) {
    std::erase_if(changes, [&](const MapChange& c) {
      return IsSingle(c, MapChangeKind::kAdded) && c.object == by;
    });
  }
  changes.push_back(change);
  map.SetChanges(std::move(changes));
}

std::vector<ObjectId> ChangeList::CameFromNowhere(const MapView& map) const {
  std::vector<ObjectId> objects;
  for (const MapChange& change : map.changes()) {
    if (IsSingle(change, MapChangeKind::kAdded)) objects.push_back(change.object);
  }
  return objects;
}

bool ChangeList::IsToldGone(const MapView& map, ObjectId gone) const {
  const auto told = ToldDeparture(map, gone);
  return told && IsSingle(*told, MapChangeKind::kRemoved);
}

bool ChangeList::MayTurnUp(const MapView& map, ObjectId gone) const {
  return !ToldDeparture(map, gone) || IsToldGone(map, gone);
}

bool ChangeList::MayComeFrom(const MapObject& object, const MapObject& origin) const {
  return origin.map == object.map && LooksLike(origin, object) &&
         origin.last_keyframe < object.arrived_keyframe;
}

void ChangeList::OnMistake(Map& map, ObjectId object) const {
  std::vector<MapChange> changes = map.changes();
  std::erase_if(changes, [&](const MapChange& c) { return c.object == object; });
  for (MapChange& change : changes) {
    if (change.new_object != object) continue;
    change.kind = MapChangeKind::kRemoved;
    change.new_object = ObjectId();
  }
  if (!map.changes().empty()) map.SetChanges(std::move(changes));
}

void ChangeList::OnMerged(Map& map, ObjectId keep, ObjectId drop) const {
  std::vector<MapChange> changes = map.changes();
  const auto told = ToldArrival(map, drop);
  if (told && IsSingle(*told, MapChangeKind::kAdded) && ToldArrival(map, keep))
    std::erase(changes, *told);  // it came once
  for (MapChange& change : changes) {
    if (change.object == drop) change.object = keep;
    if (change.new_object == drop) change.new_object = keep;
  }
  std::erase_if(changes, [](const MapChange& c) { return c.object == c.new_object; });
  LeaveToOne(changes, keep);
  // What came as a whole did not come in another piece as well.
  const std::vector<MapChange> all = changes;
  std::erase_if(changes, [&](const MapChange& c) {
    return IsSingle(c, MapChangeKind::kAdded) &&
           std::any_of(all.begin(), all.end(),
                       [&](const MapChange& other) { return other.new_object == c.object; });
  });
  if (!changes.empty() || !map.changes().empty()) map.SetChanges(std::move(changes));
}

}  // namespace cslam
