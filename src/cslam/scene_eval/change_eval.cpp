// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/change_eval.h"

#include "cslam/eval/statistics.h"
#include "cslam/scene_eval/assignment.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cslam {
namespace {

using Place = std::optional<Eigen::Vector3d>;

constexpr double kSameTimeS = 1e-3;  // stamps are rounded to microseconds

double DistanceBetween(const Place& a, const Place& b) {
  return (*a - *b).norm();
}

bool IsSamePlace(const Place& a, const Place& b, double max_distance_m) {
  if (!a || !b) return !a && !b;
  return DistanceBetween(a, b) <= max_distance_m;
}

// Kind, classes and places agree.
bool Agrees(const KnowableChange& truth, const ReportedChange& report,
            const SceneEvalOptions& options) {
  const bool is_replaced = report.kind == ChangeKind::kReplaced;
  return truth.change.kind == report.kind && truth.change.class_id == report.class_id &&
         (!is_replaced || truth.change.new_class_id == report.new_class_id) &&
         IsSamePlace(truth.from, report.from, options.max_distance_m) &&
         IsSamePlace(truth.to, report.to, options.max_distance_m);
}

double CostOf(const KnowableChange& truth, const ReportedChange& report) {
  double cost = 0.0;
  if (truth.from && report.from) cost += DistanceBetween(truth.from, report.from);
  if (truth.to && report.to) cost += DistanceBetween(truth.to, report.to);
  return cost;
}

// Whether every place that the report names is one of the change, with the class it had there.
bool IsAbout(const KnowableChange& truth, const ReportedChange& report,
             const SceneEvalOptions& options) {
  const bool is_replaced = truth.change.kind == ChangeKind::kReplaced;
  const auto is_old = [&](const Place& place, int class_id) {
    return truth.from && class_id == truth.change.class_id &&
           DistanceBetween(truth.from, place) <= options.max_distance_m;
  };
  const auto is_new = [&](const Place& place, int class_id) {
    const int new_class = is_replaced ? truth.change.new_class_id : truth.change.class_id;
    return truth.to && class_id == new_class &&
           DistanceBetween(truth.to, place) <= options.max_distance_m;
  };
  const int class_after =
      report.kind == ChangeKind::kReplaced ? report.new_class_id : report.class_id;
  return (!report.from || is_old(report.from, report.class_id)) &&
         (!report.to || is_new(report.to, class_after));
}

class ChangeJudge {
 public:
  ChangeJudge(std::vector<KnowableChange> changes, const std::vector<ReportedChange>& reports,
              Stamp start, const SceneEvalOptions& options)
      : options_(options) {
    for (KnowableChange& change : changes)
      evaluation_.changes.push_back({.truth = std::move(change)});
    for (const ReportedChange& report : reports) {
      if (IsAsked(report)) {
        evaluation_.reports.push_back(
            {.report = report, .time_s = SecondsBetween(report.reported, start)});
      } else {
        ++evaluation_.num_other_classes;
      }
    }
    std::stable_sort(evaluation_.reports.begin(), evaluation_.reports.end(),
                     [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  }

  ChangeEvaluation Judge() {
    SplitWhereTold();
    Match();
    for (JudgedReport& report : evaluation_.reports) {
      if (report.verdict != ChangeVerdict::kMatched) report.verdict = VerdictOnRest(report);
    }
    MarkMissed();
    Count();
    return std::move(evaluation_);
  }

 private:
  bool IsAsked(const ReportedChange& report) const {
    const bool is_replaced = report.kind == ChangeKind::kReplaced;
    return options_.classes.contains(report.class_id) &&
           (!is_replaced || options_.classes.contains(report.new_class_id));
  }

  bool IsTold(const KnowableChange& truth) const {
    return std::any_of(evaluation_.reports.begin(), evaluation_.reports.end(), [&](const auto& r) {
      return Agrees(truth, r.report, options_) && !IsEarly(truth, r);
    });
  }

  // Several changes that nobody had to tell apart, but this run did.
  void SplitWhereTold() {
    std::vector<JudgedChange> split;
    for (JudgedChange& change : evaluation_.changes) {
      const std::vector<KnowableChange> parts = change.truth.parts;
      const bool is_split =
          change.truth.counts() && !parts.empty() &&
          std::all_of(parts.begin(), parts.end(), [&](const auto& p) { return IsTold(p); });
      if (!is_split) split.push_back(std::move(change));
      for (const KnowableChange& part : is_split ? parts : std::vector<KnowableChange>{})
        split.push_back({.truth = part});
    }
    evaluation_.changes = std::move(split);
  }

  bool IsAboutAnyOf(const KnowableChange& truth, const ReportedChange& report) const {
    return IsAbout(truth, report, options_) ||
           std::any_of(truth.parts.begin(), truth.parts.end(),
                       [&](const KnowableChange& p) { return IsAbout(p, report, options_); });
  }

  static bool IsEarly(const KnowableChange& truth, const JudgedReport& report) {
    return !truth.first_glimpse_s || report.time_s < *truth.first_glimpse_s - kSameTimeS;
  }

  void Match() {
    PairCosts costs;
    for (const JudgedChange& change : evaluation_.changes) {
      auto& row = costs.emplace_back(evaluation_.reports.size());
      if (!change.truth.counts()) continue;
      for (std::size_t j = 0; j < row.size(); ++j) {
        const JudgedReport& report = evaluation_.reports[j];
        if (Agrees(change.truth, report.report, options_) && !IsEarly(change.truth, report))
          row[j] = CostOf(change.truth, report.report);
      }
    }
    const auto partners = AssignPairs(costs);
    for (std::size_t i = 0; i < partners.size(); ++i) {
      if (!partners[i]) continue;
      JudgedChange& change = evaluation_.changes[i];
      JudgedReport& report = evaluation_.reports[*partners[i]];
      report.verdict = ChangeVerdict::kMatched;
      change.report = partners[i];
      if (std::isfinite(change.truth.known_s()))
        change.delay_s = std::max(0.0, report.time_s - change.truth.known_s());
      if (change.truth.from && change.truth.old_view_s)
        change.delay_from_old_place_s = report.time_s - *change.truth.old_view_s;
    }
  }

  ChangeVerdict VerdictOnRest(const JudgedReport& report) const {
    for (const JudgedChange& change : evaluation_.changes) {
      if (!change.truth.counts() && IsAboutAnyOf(change.truth, report.report))
        return ChangeVerdict::kNotJudged;
    }
    for (const JudgedChange& change : evaluation_.changes) {
      const bool is_missed = change.truth.counts() && !change.report;
      if (!is_missed) continue;
      if (Agrees(change.truth, report.report, options_)) return ChangeVerdict::kEarly;
      if (IsAbout(change.truth, report.report, options_)) return ChangeVerdict::kPart;
    }
    return ChangeVerdict::kFalse;
  }

  void MarkMissed() {
    for (JudgedChange& change : evaluation_.changes) {
      if (!change.truth.counts() || change.report) continue;
      for (const JudgedReport& report : evaluation_.reports) {
        const bool is_about = IsAbout(change.truth, report.report, options_);
        if (report.verdict == ChangeVerdict::kEarly &&
            Agrees(change.truth, report.report, options_))
          change.is_early = true;
        if (report.verdict == ChangeVerdict::kPart && is_about) change.is_partial = true;
      }
    }
  }

  void Count() {
    for (const ChangeKind kind :
         {ChangeKind::kMoved, ChangeKind::kRemoved, ChangeKind::kAdded, ChangeKind::kReplaced})
      evaluation_.kinds[kind] = {};
    std::vector<double> delays;
    for (const JudgedChange& change : evaluation_.changes) {
      if (!change.truth.counts()) continue;
      DetectionScore& score = evaluation_.kinds[change.truth.change.kind];
      ++score.num_true;
      if (change.report) ++score.num_matched;
      if (change.delay_s) delays.push_back(*change.delay_s);
      evaluation_.num_partial += change.is_partial ? 1 : 0;
      evaluation_.num_early += change.is_early ? 1 : 0;
    }
    for (const JudgedReport& report : evaluation_.reports) {
      if (report.verdict != ChangeVerdict::kNotJudged)
        ++evaluation_.kinds[report.report.kind].num_reported;
    }
    for (const auto& [kind, score] : evaluation_.kinds)
      evaluation_.all += score;
    if (delays.empty()) return;
    const ErrorStatistics statistics = Summarise(delays);
    evaluation_.median_delay_s = statistics.median;
    evaluation_.max_delay_s = statistics.max;
  }

  const SceneEvalOptions& options_;
  ChangeEvaluation evaluation_;
};

}  // namespace

ChangeEvaluation EvaluateChanges(const SceneTruth& truth, const SceneRun& run,
                                 const SceneEvalOptions& options) {
  if (!run.changes)
    throw Error("'{}' holds no changes.json; run with the object layer on", run.folder.string());
  const SceneEvalOptions known = WithGapOf(WithKnownClasses(options, truth.objects), truth, run);
  return JudgeChanges(KnowableChanges(truth, truth.TimeOf(run.memory_start()),
                                      truth.TimeOf(run.last_stamp()), known),
                      *run.changes, truth.objects.start, known);
}

ChangeEvaluation JudgeChanges(std::vector<KnowableChange> changes,
                              const std::vector<ReportedChange>& reports, Stamp start,
                              const SceneEvalOptions& options) {
  return ChangeJudge(std::move(changes), reports, start, options).Judge();
}

}  // namespace cslam
