// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/benchmark/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace cslam {
namespace {

constexpr const char* kNothing = "-";

std::string NumberText(std::optional<double> value, double factor, int decimals) {
  return value ? fmt::format("{:.{}f}", factor * *value, decimals) : std::string(kNothing);
}

ReportTable ErrorTable(const BenchmarkResult& result) {
  const FigureInfo& ate = FigureOf("ate_m");
  const FigureInfo& tracked = FigureOf("tracked_share");
  ReportTable table{.title = "Trajectories",
                    .note = "ATE RMSE of the final poses after rigid alignment, in mm.",
                    .columns = {"sequence", "objects on", "objects off", "on / off", "tracked % on",
                                "tracked % off"},
                    .rows = {}};
  const std::vector<std::string> labels = result.Labels();
  table.columns.insert(table.columns.end(), labels.begin(), labels.end());
  for (const std::string& sequence : result.plan.Sequences()) {
    std::vector<std::string> row{
        sequence,
        CellText(result.Of(sequence, ObjectLayer::kOn, ate), ate),
        CellText(result.Of(sequence, ObjectLayer::kOff, ate), ate),
        NumberText(result.Ratio(sequence, ate), 1.0, 2),
        CellText(result.Of(sequence, ObjectLayer::kOn, tracked), tracked),
        CellText(result.Of(sequence, ObjectLayer::kOff, tracked), tracked)};
    for (const std::string& label : labels)
      row.push_back(CellText(result.OfOther(sequence, label), ate));
    table.rows.push_back(std::move(row));
  }
  if (table.rows.size() < 2) return table;
  const auto mean = [&](ObjectLayer layer) {
    return NumberText(result.MeanOfMedians(layer, ate), ate.factor, ate.decimals);
  };
  std::vector<std::string> row{"mean", mean(ObjectLayer::kOn), mean(ObjectLayer::kOff)};
  row.resize(table.columns.size());
  table.rows.push_back(std::move(row));
  return table;
}

// Some figures of both layers, a row each.
ReportTable FigureTable(const BenchmarkResult& result, std::string title, std::string note,
                        std::initializer_list<std::string_view> keys) {
  ReportTable table{std::move(title), std::move(note), {"sequence", "objects"}, {}};
  for (const std::string_view key : keys)
    table.columns.emplace_back(FigureOf(key).heading);
  for (const std::string& sequence : result.plan.Sequences()) {
    for (const ObjectLayer layer : result.request.layers) {
      std::vector<std::string> row{sequence, std::string(NameOf(layer))};
      bool has_any = false;
      for (const std::string_view key : keys) {
        const auto spread = result.Of(sequence, layer, FigureOf(key));
        has_any = has_any || spread.has_value();
        row.push_back(CellText(spread, FigureOf(key)));
      }
      if (has_any) table.rows.push_back(std::move(row));
    }
  }
  return table;
}

std::vector<std::string> ScoreCells(const DetectionScore& score) {
  return {NumberText(score.F1(), 1.0, 2),
          fmt::format("{} of {}", score.num_matched, score.num_true),
          fmt::format("{}", score.num_reported - score.num_matched)};
}

// Of sequences in which little happens a single run says little.
ReportTable PooledTable(const BenchmarkResult& result) {
  ReportTable table{
      .title = "All runs together",
      .note = "Over all seeds and repeats, with the layer on; wrong: reported, and not true.",
      .columns = {"sequence", "objects F1", "matched", "wrong", "changes F1", "matched", "wrong"},
      .rows = {}};
  const auto add = [&](const std::string& name, const std::string& sequence) {
    const PooledScores pooled = result.Pooled(sequence, ObjectLayer::kOn);
    if (pooled.objects.num_true + pooled.objects.num_reported + pooled.changes.num_true +
            pooled.changes.num_reported ==
        0) {
      return;
    }
    std::vector<std::string> row{name};
    for (const DetectionScore& score : {pooled.objects, pooled.changes}) {
      for (std::string& cell : ScoreCells(score))
        row.push_back(std::move(cell));
    }
    table.rows.push_back(std::move(row));
  };
  const std::vector<std::string> sequences = result.plan.Sequences();
  for (const std::string& sequence : sequences)
    add(sequence, sequence);
  if (sequences.size() > 1) add("all", "");
  return table;
}

ReportTable FailureTable(const BenchmarkResult& result) {
  ReportTable table{"What failed", "", {"run", "why"}, {}};
  for (const FinishedRun& run : result.runs) {
    if (!run.figures) table.rows.push_back({run.run.folder.filename().string(), run.problem});
  }
  for (const OtherTrajectory& other : result.others) {
    if (other.ate_m) continue;
    table.rows.push_back(
        {fmt::format("{} on {}-{}", other.label, other.sequence, other.seed), other.problem});
  }
  return table;
}

}  // namespace

std::string CellText(const std::optional<Spread>& spread, const FigureInfo& figure) {
  if (!spread) return kNothing;
  const auto text = [&](double value) { return NumberText(value, figure.factor, figure.decimals); };
  if (spread->count < 2) return text(spread->median);
  return fmt::format("{} ({} to {})", text(spread->median), text(spread->min), text(spread->max));
}

std::vector<ReportTable> MakeTables(const BenchmarkResult& result) {
  std::vector<ReportTable> tables{
      ErrorTable(result),
      FigureTable(result, "Objects and changes",
                  "What the map said at the end; delay: from a clear view to the report.",
                  {"object_f1", "object_precision", "object_recall", "change_f1",
                   "change_precision", "change_recall", "delay_s", "max_delay_s"}),
      PooledTable(result),
      FigureTable(result, "Maps and loops",
                  "Ghosts: active points where something was, of all. Active: of the points of "
                  "settled, present objects.",
                  {"ghost_share", "active_share", "loops", "false_loops"}),
      FigureTable(result, "Cost", "Medians of the wall time a frame and a keyframe take.",
                  {"tracking_ms", "mapping_ms", "memory_mb", "run_s"}),
      FailureTable(result)};
  std::erase_if(tables, [](const ReportTable& table) { return table.rows.empty(); });
  return tables;
}

}  // namespace cslam
