// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/story_check.h"

#include "cslam/dataset/story_views.h"
#include "cslam/dataset/truth_builder.h"
#include "cslam/dataset/truth_lookup.h"
#include "cslam/util/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

constexpr int kPerson = 0;           // COCO
constexpr double kSameTimeS = 1e-3;  // JSON rounds

// Times between which nobody may see the object: for one pushed or carried, the whole way.
struct Span {
  double from_s = 0.0;
  double to_s = 0.0;
};

class StoryChecker {
 public:
  StoryChecker(const CheckFrames& frames, const SequenceTruth& truth,
               const StoryCheckOptions& options)
      : objects_(*truth.objects), changes_(*truth.changes), views_(frames, truth, options) {}

  ChangeEvidence Judge(const TrueChange& change) const {
    ChangeEvidence evidence{.change = change,
                            .num_views_before = 0,
                            .num_views_after = 0,
                            .last_view_before_s = {},
                            .first_view_after_s = {},
                            .is_in_view_when_it_happens = IsInView(change),
                            .problem = {}};
    const std::vector<std::size_t> before = ViewsBefore(change);
    const std::vector<std::size_t> after = ViewsAfter(change);
    evidence.num_views_before = before.size();
    evidence.num_views_after = after.size();
    if (!before.empty()) evidence.last_view_before_s = views_.time_s(before.back());
    if (!after.empty()) evidence.first_view_after_s = views_.time_s(after.front());
    return evidence;
  }

 private:
  std::vector<std::size_t> ViewsBefore(const TrueChange& change) const {
    const std::size_t end = views_.FirstFrameAt(SpanOf(change.instance, change.time_s).from_s);
    if (change.kind != ChangeKind::kAdded) return views_.Showing(change.instance, 0, end);
    if (!change.to) return {};
    return views_.SeeingEmpty(change.instance, *change.to, 0, end);
  }

  std::vector<std::size_t> ViewsAfter(const TrueChange& change) const {
    const std::size_t begin = views_.FirstFrameAt(change.time_s);
    switch (change.kind) {
      case ChangeKind::kReplaced:
        return views_.Showing(change.new_instance, begin, views_.size());
      case ChangeKind::kRemoved:
        return ViewsOfLeftPlace(change, begin);
      case ChangeKind::kMoved:
      case ChangeKind::kAdded:
        return views_.Showing(change.instance, begin, views_.size());
    }
    return {};
  }

  std::vector<std::size_t> ViewsOfLeftPlace(const TrueChange& change, std::size_t begin) const {
    if (!change.from) return {};
    auto views = views_.SeeingEmpty(change.instance, *change.from, begin, views_.size());
    // A new thing may stand before the place: it tells the same.
    for (const TrueChange& other : changes_.changes) {
      const bool has_come = other.kind == ChangeKind::kAdded || other.kind == ChangeKind::kReplaced;
      if (!views.empty() || !has_come || !other.to) continue;
      const double distance_m = (other.to->translation - change.from->translation).norm();
      const bool is_same_time = std::abs(other.time_s - change.time_s) <= kSameTimeS;
      if (!is_same_time || distance_m > kReplaceDistanceM) continue;
      const bool is_added = other.kind == ChangeKind::kAdded;
      views = views_.Showing(is_added ? other.instance : other.new_instance, begin, views_.size());
    }
    return views;
  }

  bool IsInView(const TrueChange& change) const {
    if (IsSeenDuring(change.instance, SpanOf(change.instance, change.time_s))) return true;
    return change.kind == ChangeKind::kReplaced &&
           IsSeenDuring(change.new_instance, SpanOf(change.new_instance, change.time_s));
  }

  // From when the object leaves its place until it is at rest again, around a change's time.
  Span SpanOf(int instance, double time_s) const {
    Span span{time_s, time_s};
    const TrueObject* object = FindObject(objects_, instance);
    if (object == nullptr) return span;
    for (const TrueInterval& interval : object->intervals) {
      const bool is_around =
          interval.from_s <= time_s + kSameTimeS && time_s - kSameTimeS <= interval.to_s;
      if (!interval.is_moving || !is_around) continue;
      span = {std::min(span.from_s, interval.from_s), std::max(span.to_s, interval.to_s)};
    }
    return span;
  }

  // In the frames from just before the span to just after it.
  bool IsSeenDuring(int instance, const Span& span) const {
    const std::size_t after = views_.FirstFrameAt(span.to_s);
    const std::size_t begin = views_.FirstFrameAt(span.from_s);
    const std::size_t end = std::min(after + 1, views_.size());
    for (std::size_t i = begin == 0 ? 0 : begin - 1; i < end; ++i) {
      if (views_.VisiblePx(i, instance) > 0) return true;
    }
    return false;
  }

  const TrueObjects& objects_;
  const TrueChanges& changes_;
  StoryViews views_;
};

std::string NameOfChange(const TrueObjects& objects, const TrueChange& change) {
  const TrueObject* object = FindObject(objects, change.instance);
  return fmt::format("'{}' (instance {}) {} at {:.3f} s",
                     object != nullptr ? object->name : std::string("?"), change.instance,
                     NameOf(change.kind), change.time_s);
}

// What is wrong with the change; what may only be cut off goes to the warnings.
void Judge(StoryEvidence& evidence, ChangeEvidence& change, const TrueObjects& objects,
           bool is_whole) {
  const std::string name = NameOfChange(objects, change.change);
  const bool is_added = change.change.kind == ChangeKind::kAdded;
  const bool is_removed = change.change.kind == ChangeKind::kRemoved;
  const bool is_carried = change.change.is_carried_in_view;
  if (change.is_in_view_when_it_happens && is_carried) return;  // seen all along
  if (change.is_in_view_when_it_happens) {
    change.problem = fmt::format("{}: the camera sees it happen", name);
  } else if (change.num_views_before == 0) {
    if (is_added) {
      evidence.warnings.push_back(fmt::format("{}: its empty place is never in view before", name));
    } else {
      change.problem = fmt::format("{}: it is never in view before", name);
    }
  } else if (change.num_views_after == 0) {
    change.problem = fmt::format("{}: {} is never in view afterwards", name,
                                 is_removed ? "its empty place" : "what stands there");
    if (!is_whole) {
      evidence.warnings.push_back(change.problem + " (the story is cut)");
      return;
    }
  }
  if (!change.problem.empty()) evidence.errors.push_back(change.problem);
}

PeopleFigures MeasurePeople(const DetectionRecord& record) {
  PeopleFigures figures;
  const double area = static_cast<double>(record.width_px) * record.height_px;
  bool was_seen = false;
  for (const RecordedFrame& frame : record.frames) {
    double share = 0.0;
    for (const RecordedDetection& d : frame.detections) {
      if (d.class_id == kPerson) share += d.visible_px / area;
    }
    figures.leave_view |= was_seen && share == 0.0;
    was_seen |= share > 0.0;
    figures.peak_share = std::max(figures.peak_share, share);
    figures.mean_share += share / static_cast<double>(record.frames.size());
  }
  return figures;
}

void JudgePeople(StoryEvidence& evidence, const StoryCheckOptions& options) {
  const PeopleFigures& people = *evidence.people;
  const PeopleClaim& claim = options.people;
  Findings broken;
  if (people.mean_share < claim.min_mean_share) {
    broken.push_back(
        fmt::format("people fill {:.1f} % of the picture on average, {:.1f} % are claimed",
                    100.0 * people.mean_share, 100.0 * claim.min_mean_share));
  }
  if (people.peak_share < claim.min_peak_share) {
    broken.push_back(
        fmt::format("people fill at most {:.1f} % of the picture, {:.1f} % are claimed",
                    100.0 * people.peak_share, 100.0 * claim.min_peak_share));
  }
  if (claim.leave_view && !people.leave_view)
    broken.emplace_back("people never leave the picture, as is claimed");
  Findings& to = options.is_whole ? evidence.errors : evidence.warnings;
  for (const std::string& problem : broken)
    to.push_back(options.is_whole ? problem : problem + " for the whole story, which is cut");
}

}  // namespace

StoryEvidence CheckStory(const CheckFrames& frames, const SequenceTruth& truth,
                         const StoryCheckOptions& options) {
  CSLAM_CHECK(truth.objects && truth.changes, "a story needs objects and changes");
  StoryEvidence evidence;
  const StoryChecker checker(frames, truth, options);
  for (const TrueChange& change : truth.changes->changes) {
    evidence.changes.push_back(checker.Judge(change));
    Judge(evidence, evidence.changes.back(), *truth.objects, options.is_whole);
  }
  if (truth.detections) {
    evidence.people = MeasurePeople(*truth.detections);
    JudgePeople(evidence, options);
  }
  return evidence;
}

}  // namespace cslam
