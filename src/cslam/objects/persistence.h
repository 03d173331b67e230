// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace cslam {

class OptionList;

// Recursive Bayes on H, "this object stands at its place" (Eqs. 11 to 14 of the paper, with the
// usual normalisation), as log odds: every view adds log(p(Y|H=1) / p(Y|H=0)).
struct PersistenceOptions {
  double p_detect = 0.5;          // a thing in plain view is detected
  double p_detect_wrong = 0.15;   // something is detected where it is not, at a score of 0.5
  double distance_sigma = 0.5;    // of a measured centre from the stored one, in class distances
  double p_through_there = 0.15;  // its place is looked through though it stands there
  double p_through_gone = 0.6;    // the same when it is gone
  double max_belief = 0.98;       // beliefs stay between this and its complement
  double activate_at = 0.94;      // belief from which on its points are used ...
  double deactivate_at = 0.55;    // ... and below which no longer
  double absent_at = 0.3;         // below, what was present is gone
  double erase_at = 0.1;          // below, a candidate never was
};
void Describe(OptionList& list, PersistenceOptions& options);

// Belief to log odds and back.
double LogOdds(double probability);
double Probability(double log_odds);

// log(p(Y|H=1) / p(Y|H=0)) of one view in which ...
// ... it was detected, distance (in class distances) from its stored centre, with such a score;
double SeenLogRatio(double distance, double score, const PersistenceOptions& options);
// ... its surface was in plain view and was not detected;
double MissedLogRatio(const PersistenceOptions& options);
// ... its place was looked through.
double LookedThroughLogRatio(const PersistenceOptions& options);

// One step: the belief's log odds with evidence added, within bounds.
double UpdatedLogOdds(double log_odds, double log_ratio, const PersistenceOptions& options);

}  // namespace cslam
