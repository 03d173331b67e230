// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/knowable_changes.h"

#include "cslam/dataset/truth_lookup.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

namespace cslam {
namespace {

constexpr double kSameTimeS = 1e-3;  // JSON and microsecond stamps round
constexpr double kUnmovedM = 0.05;   // what is back in its place has not changed
constexpr double kForever = std::numeric_limits<double>::infinity();

// Changes of one thing, in order of time.
using Chain = std::vector<KnowableChange>;

// The least of a view that could tell anybody of a change.
ClearViewOptions GlimpseOf(const ClearViewOptions& clear) {
  ClearViewOptions glimpse = clear;
  glimpse.min_clear_share = std::min(clear.min_clear_share, 0.2);
  glimpse.min_frames = 1;
  glimpse.min_picture_share = 0.0;
  glimpse.max_distance_m = kForever;
  return glimpse;
}

std::optional<double> Earlier(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

// When a thing left the place it was at before the change: carried things leave before they arrive.
double LeftAt(const TrueObject& object, const TrueChange& change) {
  double left_s = change.time_s;
  for (const Rest& rest : RestsOf(object)) {
    const bool is_before = rest.to_s <= change.time_s + kSameTimeS;
    const bool is_there =
        (rest.T_world_object.translation - change.from->translation).norm() < 1e-3;
    if (is_before && is_there) left_s = rest.to_s;
  }
  return std::min(left_s, change.time_s);
}

class ChangeSurvey {
 public:
  ChangeSurvey(const SceneTruth& truth, double start_s, double end_s,
               const SceneEvalOptions& options)
      : truth_(truth), start_s_(start_s), end_s_(end_s), options_(options) {}

  std::vector<KnowableChange> Survey() {
    std::map<int, Chain> chains = ChainsOfThings();
    for (auto& [instance, chain] : chains)
      chain = Merged(std::move(chain));
    std::vector<KnowableChange> changes;
    for (auto& [instance, chain] : chains) {
      for (std::size_t i = 0; i < chain.size(); ++i) {
        const bool is_last = i + 1 == chain.size();
        next_left_s_.push_back(is_last ? end_s_ : chain[i + 1].left_s);
        changes.push_back(std::move(chain[i]));
      }
    }
    LookAt(changes);
    std::erase_if(changes, [&](const KnowableChange& c) { return !IsAsked(c.change); });
    std::stable_sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) {
      return a.change.time_s < b.change.time_s;
    });
    return changes;
  }

 private:
  const TrueObject& ObjectOf(int instance) const {
    const TrueObject* object = FindObject(truth_.objects, instance);
    if (object == nullptr) {
      throw Error("'{}' speaks of instance {}, which objects.json does not have",
                  (truth_.folder / "changes.json").string(), instance);
    }
    return *object;
  }

  bool IsAsked(const TrueChange& change) const {
    const bool is_replaced = change.kind == ChangeKind::kReplaced;
    return options_.classes.contains(change.class_id) &&
           (!is_replaced || options_.classes.contains(change.new_class_id));
  }

  std::map<int, Chain> ChainsOfThings() const {
    std::map<int, Chain> chains;
    for (const TrueChange& change : truth_.changes.changes) {
      const TrueObject& object = ObjectOf(change.instance);
      KnowableChange knowable{.change = change};
      knowable.arrived_s = change.time_s;
      knowable.left_s = change.from ? LeftAt(object, change) : change.time_s;
      if (knowable.left_s > end_s_ || change.time_s < start_s_) continue;
      chains[change.instance].push_back(std::move(knowable));
    }
    return chains;
  }

  // The place that tells a change from the next one of the same thing: where it stands in between,
  // or, if it is away, where it stood.
  PlaceQuery Between(const KnowableChange& before, const KnowableChange& after) const {
    const TrueObject& object = ObjectOf(before.change.instance);
    const bool is_there = before.change.to.has_value();
    return {.box = BoxOf(object, is_there ? *before.change.to : *before.change.from),
            .from_s = std::max(start_s_, before.arrived_s),
            .until_s = after.left_s,
            .shown_instance = is_there && object.class_id >= 0 ? object.instance : 0};
  }

  Chain Merged(Chain chain) const {
    Chain merged;
    for (KnowableChange& change : chain) {
      const bool may_merge = !merged.empty() && change.change.kind != ChangeKind::kReplaced &&
                             merged.back().change.kind != ChangeKind::kReplaced;
      if (!may_merge || IsSeen(Between(merged.back(), change))) {
        merged.push_back(std::move(change));
        continue;
      }
      KnowableChange both = Join(merged.back(), change);
      merged.back() = std::move(both);
    }
    return merged;
  }

  bool IsSeen(const PlaceQuery& query) const {
    return FirstClearViews(truth_, {&query, 1}, options_.clear_view).front().has_value();
  }

  static KnowableChange Join(const KnowableChange& a, const KnowableChange& b) {
    KnowableChange both = b;
    both.change.from = a.change.from;
    both.change.is_carried_in_view |= a.change.is_carried_in_view;
    both.left_s = a.left_s;
    both.num_merged += a.num_merged;
    both.parts = a.parts.empty() ? std::vector{a} : a.parts;
    both.parts.push_back(b);
    if (both.change.from && both.change.to) both.change.kind = ChangeKind::kMoved;
    if (both.change.from && !both.change.to) both.change.kind = ChangeKind::kRemoved;
    if (!both.change.from && both.change.to) both.change.kind = ChangeKind::kAdded;
    return both;
  }

  static bool CancelsOut(const KnowableChange& change) {
    const std::optional<Se3>& from = change.change.from;
    const std::optional<Se3>& to = change.change.to;
    if (!from && !to) return true;
    return from && to && (from->translation - to->translation).norm() < kUnmovedM;
  }

  // Until when the old place of a change stays without its thing.
  double EmptyUntil(const KnowableChange& change) const {
    for (const Rest& rest : RestsOf(ObjectOf(change.change.instance))) {
      const bool is_back =
          rest.from_s > change.left_s + kSameTimeS &&
          (rest.T_world_object.translation - change.change.from->translation).norm() < kUnmovedM;
      if (is_back) return std::min(end_s_, rest.from_s);
    }
    return end_s_;
  }

  PlaceQuery Before(const KnowableChange& change) const {
    const TrueObject& object = ObjectOf(change.change.instance);
    const bool was_there = change.change.from.has_value();
    return {.box = BoxOf(object, was_there ? *change.change.from : *change.change.to),
            .from_s = start_s_,
            .until_s = change.left_s,
            .shown_instance = was_there && object.class_id >= 0 ? object.instance : 0};
  }

  PlaceQuery OldPlace(const KnowableChange& change) const {
    PlaceQuery query = Before(change);
    query.from_s = std::max(start_s_, change.left_s);
    query.until_s = change.change.from ? EmptyUntil(change) : -kForever;
    query.shown_instance = 0;
    return query;
  }

  PlaceQuery NewPlace(const KnowableChange& change, double until_s) const {
    if (!change.change.to) return NoQuery();
    if (change.change.kind == ChangeKind::kReplaced)
      return ReplacementQuery(truth_, change.change.instance, change.left_s, end_s_);
    const TrueObject& object = ObjectOf(change.change.instance);
    return {.box = BoxOf(object, *change.change.to),
            .from_s = std::max(start_s_, change.arrived_s),
            .until_s = std::min(end_s_, until_s),
            .shown_instance = object.class_id >= 0 ? object.instance : 0};
  }

  void LookAt(std::vector<KnowableChange>& changes) const {
    std::vector<PlaceQuery> queries;
    for (std::size_t i = 0; i < changes.size(); ++i) {
      queries.push_back(Before(changes[i]));
      queries.push_back(OldPlace(changes[i]));
      queries.push_back(NewPlace(changes[i], next_left_s_[i]));
    }
    const auto views = FirstClearViews(truth_, queries, options_.clear_view);
    const auto glimpses = FirstClearViews(truth_, queries, GlimpseOf(options_.clear_view));
    for (std::size_t i = 0; i < changes.size(); ++i) {
      KnowableChange& change = changes[i];
      change.first_glimpse_s = Earlier(glimpses[3 * i + 1], glimpses[3 * i + 2]);
      change.old_view_s = views[3 * i + 1];
      change.new_view_s = views[3 * i + 2];
      if (change.change.from) change.from = queries[3 * i].box.T_world_box.translation;
      if (change.change.to) change.to = queries[3 * i + 2].box.T_world_box.translation;
      change.why_not = WhyNot(change, views[3 * i].has_value());
      for (KnowableChange& part : change.parts)
        Place(part);
    }
  }

  // Of a change that nobody had to notice on its own; who did must have seen some of it.
  void Place(KnowableChange& part) const {
    const TrueObject& object = ObjectOf(part.change.instance);
    if (part.change.from) part.from = BoxOf(object, *part.change.from).T_world_box.translation;
    if (part.change.to) part.to = BoxOf(object, *part.change.to).T_world_box.translation;
    part.first_glimpse_s = part.left_s;
  }

  static std::string WhyNot(const KnowableChange& change, bool was_seen_before) {
    if (change.num_merged > 1 && CancelsOut(change)) return "back before anybody looked";
    if (!was_seen_before) return "place not clearly seen before";
    const ChangeKind kind = change.change.kind;
    const bool needs_old = kind == ChangeKind::kRemoved || kind == ChangeKind::kMoved;
    if (needs_old && !change.old_view_s) return "old place not clearly seen again";
    if (kind != ChangeKind::kRemoved && !change.new_view_s)
      return "new place not clearly seen with it";
    return "";
  }

  const SceneTruth& truth_;
  double start_s_;
  double end_s_;
  const SceneEvalOptions& options_;
  std::vector<double> next_left_s_;  // when the thing of each change leaves again
};

}  // namespace

double KnowableChange::known_s() const {
  if (change.kind == ChangeKind::kRemoved) return old_view_s.value_or(kForever);
  if (change.kind == ChangeKind::kMoved)
    return std::max(old_view_s.value_or(kForever), new_view_s.value_or(kForever));
  return new_view_s.value_or(kForever);
}

std::vector<KnowableChange> KnowableChanges(const SceneTruth& truth, double start_s, double end_s,
                                            const SceneEvalOptions& options) {
  const SceneEvalOptions known = WithKnownClasses(options, truth.objects);
  return ChangeSurvey(truth, start_s, end_s, known).Survey();
}

}  // namespace cslam
