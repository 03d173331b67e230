// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "check_text.h"

#include "cslam/util/text_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace cslam {
namespace {

using Json = nlohmann::ordered_json;

std::string Percent(double share) {
  return fmt::format("{:.1f} %", 100.0 * share);
}

std::string FilesText(const DatasetCheck& files) {
  return fmt::format(
      "{} of {} frames looked at; {} missing, {} unreadable, {} of wrong size, {} without depth; "
      "depth in {} of the pixels, median {:.2f} m",
      files.num_checked, files.num_frames, files.num_missing, files.num_unreadable,
      files.num_wrong_size, files.num_without_depth, Percent(files.depth_valid_share),
      files.median_depth_m);
}

std::string ReprojectionText(const SequenceCheck& check) {
  const ReprojectionFigures& all = check.reprojection->all;
  std::string text = fmt::format("median {:.2f} mm, 95th percentile {:.2f} mm", 1e3 * all.median_m,
                                 1e3 * all.p95_m);
  if (check.tolerance) text += fmt::format(" ({:.2f} of what is allowed)", all.p95_per_tolerance);
  return text +
         fmt::format("; {} hidden, {} looked through; {} pairs of frames, {} points, poses of {}",
                     Percent(all.hidden_share), Percent(all.pierced_share),
                     check.reprojection->pairs.size(), all.num_points, check.pose_file);
}

std::string TruthText(const TruthCheckResult& truth) {
  return fmt::format(
      "{} instance images, {} instances seen; {} held against their boxes, at most {} of their "
      "pixels outside",
      truth.num_frames, truth.num_regions, truth.num_posed, Percent(truth.max_outside_share));
}

std::string PeopleText(const PeopleFigures& people) {
  if (people.peak_share == 0.0) return "nobody is seen";
  return fmt::format("fill {} of the picture on average, {} at most; {}",
                     Percent(people.mean_share), Percent(people.peak_share),
                     people.leave_view ? "leave it now and then" : "never leave it");
}

std::string Figures(const SequenceCheck& check) {
  TextTable table;
  table.AddRow({"files", FilesText(check.files)});
  if (check.reprojection && !check.reprojection->pairs.empty())
    table.AddRow({"depth against poses", ReprojectionText(check)});
  if (check.truth) table.AddRow({"truth", TruthText(*check.truth)});
  if (check.story && check.story->people)
    table.AddRow({"people", PeopleText(*check.story->people)});
  return table.Text();
}

std::string TimeText(const std::optional<double>& time_s) {
  return time_s ? fmt::format("{:.2f}", *time_s) : "never";
}

std::string Changes(const StoryEvidence& story) {
  if (story.changes.empty()) return "";
  TextTable table({{"change"},
                   {"instance", TextAlign::kRight},
                   {"time [s]", TextAlign::kRight},
                   {"views before", TextAlign::kRight},
                   {"last [s]", TextAlign::kRight},
                   {"views after", TextAlign::kRight},
                   {"first [s]", TextAlign::kRight},
                   {"seen happening"}});
  for (const ChangeEvidence& e : story.changes) {
    const char* carried = e.change.is_carried_in_view ? "yes, carried" : "yes";
    table.AddRow({std::string(NameOf(e.change.kind)), std::to_string(e.change.instance),
                  fmt::format("{:.2f}", e.change.time_s), std::to_string(e.num_views_before),
                  TimeText(e.last_view_before_s), std::to_string(e.num_views_after),
                  TimeText(e.first_view_after_s), e.is_in_view_when_it_happens ? carried : "no"});
  }
  return table.Text();
}

Json NumberOrNull(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json ReprojectionJson(const SequenceCheck& check) {
  if (!check.reprojection) return nullptr;
  const ReprojectionFigures& all = check.reprojection->all;
  Json json{{"poses", check.pose_file},
            {"pairs", check.reprojection->pairs.size()},
            {"points", all.num_points},
            {"median_m", all.median_m},
            {"p95_m", all.p95_m},
            {"median_per_depth", all.median_relative},
            {"hidden_share", all.hidden_share},
            {"looked_through_share", all.pierced_share}};
  json["p95_per_tolerance"] = check.tolerance ? Json(all.p95_per_tolerance) : Json(nullptr);
  return json;
}

Json TruthJson(const std::optional<TruthCheckResult>& truth) {
  if (!truth) return nullptr;
  return {{"instance_images", truth->num_frames},
          {"instances_seen", truth->num_regions},
          {"held_against_boxes", truth->num_posed},
          {"max_share_outside_box", truth->max_outside_share}};
}

Json StoryJson(const std::optional<StoryEvidence>& story) {
  if (!story) return nullptr;
  Json changes = Json::array();
  for (const ChangeEvidence& e : story->changes) {
    changes.push_back({{"kind", NameOf(e.change.kind)},
                       {"instance", e.change.instance},
                       {"time_s", e.change.time_s},
                       {"views_before", e.num_views_before},
                       {"last_view_before_s", NumberOrNull(e.last_view_before_s)},
                       {"views_after", e.num_views_after},
                       {"first_view_after_s", NumberOrNull(e.first_view_after_s)},
                       {"seen_happening", e.is_in_view_when_it_happens},
                       {"carried_in_view", e.change.is_carried_in_view},
                       {"problem", e.problem}});
  }
  Json people = nullptr;
  if (story->people) {
    people = {{"mean_share", story->people->mean_share},
              {"peak_share", story->people->peak_share},
              {"leave_view", story->people->leave_view}};
  }
  return {{"changes", changes}, {"people", people}};
}

}  // namespace

std::string FormatCheck(const SequenceCheck& check) {
  std::string text;
  for (const std::string& error : check.errors)
    text += fmt::format("error    {}\n", error);
  for (const std::string& warning : check.warnings)
    text += fmt::format("warning  {}\n", warning);
  for (const std::string& what : check.skipped)
    text += fmt::format("skipped  {}\n", what);
  text += Figures(check);
  if (check.story) text += Changes(*check.story);
  const char* verdict = !check.errors.empty()     ? "not sound"
                        : !check.warnings.empty() ? "sound, with warnings"
                                                  : "sound";
  return text + verdict + "\n";
}

std::string FormatCheckJson(const SequenceCheck& check) {
  const DatasetCheck& files = check.files;
  const Json json{{"ok", check.errors.empty()},
                  {"errors", check.errors},
                  {"warnings", check.warnings},
                  {"skipped", check.skipped},
                  {"frames", files.num_frames},
                  {"checked_frames", files.num_checked},
                  {"missing", files.num_missing},
                  {"unreadable", files.num_unreadable},
                  {"wrong_size", files.num_wrong_size},
                  {"without_depth", files.num_without_depth},
                  {"depth_valid_share", files.depth_valid_share},
                  {"median_depth_m", files.median_depth_m},
                  {"reprojection", ReprojectionJson(check)},
                  {"truth", TruthJson(check.truth)},
                  {"story", StoryJson(check.story)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace cslam
