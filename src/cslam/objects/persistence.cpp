// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/persistence.h"

#include "cslam/util/options.h"

#include <algorithm>
#include <cmath>

namespace cslam {

void Describe(OptionList& list, PersistenceOptions& o) {
  list.Add("p_detect", o.p_detect, {0.01, 0.99}, "",
           "Probability that a view of a thing in plain sight has its detection.");
  list.Add("p_detect_wrong", o.p_detect_wrong, {0.01, 0.99}, "",
           "Probability of such a detection where there is no such thing, at score 0.5; lower at "
           "higher scores.");
  list.Add("distance_sigma", o.distance_sigma, {0.05, 5.0}, "",
           "Standard deviation of a measured centre, as share of the class distance.");
  list.Add("p_through_there", o.p_through_there, {0.01, 0.99}, "",
           "Probability that its place is looked through though it stands there.");
  list.Add("p_through_gone", o.p_through_gone, {0.01, 0.99}, "",
           "Probability that its place is looked through when it is gone.");
  list.Add("max_belief", o.max_belief, {0.6, 0.9999}, "",
           "Beliefs stay between this and its complement, so that they can still turn.");
  list.Add("activate_at", o.activate_at, {0.5, 0.99}, "",
           "Belief from which on an object's points are used (BeliefThreshold of the paper).");
  list.Add("deactivate_at", o.deactivate_at, {0.5, 0.99}, "",
           "Belief below which they are no longer: hysteresis.");
  list.Add("absent_at", o.absent_at, {0.01, 0.5}, "",
           "Belief below which an object that was present counts as gone.");
  list.Add("erase_at", o.erase_at, {0.001, 0.5}, "",
           "Belief below which one that never was believed in is forgotten.");
}

double LogOdds(double probability) {
  return std::log(probability / (1.0 - probability));
}

double Probability(double log_odds) {
  return 1.0 / (1.0 + std::exp(-log_odds));
}

double SeenLogRatio(double distance, double score, const PersistenceOptions& options) {
  constexpr double kFloor = 0.05;  // something else of its class may have been detected there
  const double in_sigmas = distance / options.distance_sigma;
  const double if_there = options.p_detect * std::exp(-0.5 * in_sigmas * in_sigmas);
  const double quality = std::clamp(2.0 * score, 0.5, 2.0);
  const double if_not = options.p_detect_wrong / quality;
  return std::log((if_there + kFloor * if_not) / (if_not + kFloor * if_not));
}

double MissedLogRatio(const PersistenceOptions& options) {
  return std::log((1.0 - options.p_detect) / (1.0 - options.p_detect_wrong));
}

double LookedThroughLogRatio(const PersistenceOptions& options) {
  return std::log(options.p_through_there / options.p_through_gone);
}

double UpdatedLogOdds(double log_odds, double log_ratio, const PersistenceOptions& options) {
  const double limit = LogOdds(options.max_belief);
  return std::clamp(log_odds + log_ratio, -limit, limit);
}

}  // namespace cslam
