// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/benchmark/report_text.h"

#include "cslam/eval/svg.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace cslam {
namespace {

using nlohmann::ordered_json;

constexpr const char* kTitle = "Changing-SLAM: benchmark of the object layer";

std::string Introduction(const BenchmarkResult& result) {
  const BenchmarkRequest& request = result.request;
  return fmt::format(
      "{} sequences in {} form, {} seed{} from {} on, {} run{} of each; the layer of objects on "
      "and "
      "off. Cells: the median, and the least and the most of several.",
      result.plan.Sequences().size(), request.is_short ? "short" : "long", request.num_seeds,
      request.num_seeds == 1 ? "" : "s", request.first_seed, request.num_repeats,
      request.num_repeats == 1 ? "" : "s");
}

void AppendMarkdown(const ReportTable& table, std::string& text) {
  text += fmt::format("\n## {}\n\n", table.title);
  if (!table.note.empty()) text += table.note + "\n\n";
  std::string rule = "|";
  text += "|";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    text += fmt::format(" {} |", table.columns[i]);
    rule += i == 0 ? "---|" : "---:|";
  }
  text += "\n" + rule + "\n";
  for (const std::vector<std::string>& row : table.rows) {
    text += "|";
    for (const std::string& cell : row)
      text += fmt::format(" {} |", cell);
    text += "\n";
  }
}

void AppendHtml(const ReportTable& table, std::string& text) {
  text += fmt::format("<h2>{}</h2>\n", EscapeXml(table.title));
  if (!table.note.empty()) text += fmt::format("<p>{}</p>\n", EscapeXml(table.note));
  text += "<table>\n<tr>";
  for (const std::string& column : table.columns)
    text += fmt::format("<th>{}</th>", EscapeXml(column));
  text += "</tr>\n";
  for (const std::vector<std::string>& row : table.rows) {
    text += "<tr>";
    for (const std::string& cell : row)
      text += fmt::format("<td>{}</td>", EscapeXml(cell));
    text += "</tr>\n";
  }
  text += "</table>\n";
}

// An SVG document as an element of a page.
std::string_view Inlined(std::string_view svg) {
  const std::size_t begin = svg.find("<svg");
  return begin == std::string_view::npos ? std::string_view() : svg.substr(begin);
}

constexpr const char* kStyle = R"(<style>
body { font-family: 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif; color: #212529;
       max-width: 1900px; margin: 2em auto; padding: 0 1em; }
table { border-collapse: collapse; margin: 0.5em 0 1.5em; }
th, td { border: 1px solid #dee2e6; padding: 4px 10px; text-align: right; }
th:first-child, td:first-child { text-align: left; }
th { background: #f1f3f5; }
.pair { display: flex; flex-wrap: wrap; gap: 12px; }
.pair svg { max-width: 100%; height: auto; border: 1px solid #dee2e6; }
</style>
)";

ordered_json ToJson(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json ToJson(const std::optional<Spread>& spread) {
  if (!spread) return nullptr;
  return {{"count", spread->count},
          {"median", spread->median},
          {"min", spread->min},
          {"max", spread->max}};
}

ordered_json FiguresToJson(const RunFigures& figures) {
  ordered_json json = ordered_json::object();
  for (const FigureInfo& info : AllFigures())
    json[std::string(info.key)] = ToJson(figures.*info.value);
  return json;
}

ordered_json SequenceToJson(const BenchmarkResult& result, const std::string& sequence) {
  ordered_json json = {{"name", sequence}};
  for (const ObjectLayer layer : result.request.layers) {
    ordered_json figures = ordered_json::object();
    for (const FigureInfo& info : AllFigures())
      figures[std::string(info.key)] = ToJson(result.Of(sequence, layer, info));
    json[fmt::format("objects_{}", NameOf(layer))] = std::move(figures);
  }
  json["ate_ratio"] = ToJson(result.Ratio(sequence, FigureOf("ate_m")));
  ordered_json others = ordered_json::object();
  for (const std::string& label : result.Labels())
    others[label] = ToJson(result.OfOther(sequence, label));
  json["other_ate_m"] = std::move(others);
  return json;
}

ordered_json RunToJson(const BenchmarkResult& result, const FinishedRun& run) {
  const PlannedData& data = result.plan.data[run.run.data];
  return {{"sequence", data.sequence},
          {"seed", data.seed},
          {"objects", NameOf(run.run.layer)},
          {"repeat", run.run.repeat},
          {"folder", run.run.folder.string()},
          {"figures", run.figures ? FiguresToJson(*run.figures) : ordered_json(nullptr)},
          {"problem", run.problem}};
}

}  // namespace

std::string FormatMarkdown(const BenchmarkResult& result) {
  std::string text = fmt::format("# {}\n\n{}\n\n", kTitle, Introduction(result));
  for (const auto& [name, value] : result.facts)
    text += fmt::format("- {}: {}\n", name, value);
  for (const ReportTable& table : MakeTables(result))
    AppendMarkdown(table, text);
  return text;
}

std::string FormatHtml(const BenchmarkResult& result, const std::vector<RunDrawing>& drawings) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{0}</title>\n"
      "{1}</head>\n<body>\n<h1>{0}</h1>\n<p>{2}</p>\n<ul>\n",
      kTitle, kStyle, EscapeXml(Introduction(result)));
  for (const auto& [name, value] : result.facts)
    text += fmt::format("<li>{}: {}</li>\n", EscapeXml(name), EscapeXml(value));
  text += "</ul>\n";
  for (const ReportTable& table : MakeTables(result))
    AppendHtml(table, text);
  for (const RunDrawing& drawing : drawings) {
    text += fmt::format("<h2>{}</h2>\n<div class=\"pair\">\n{}{}</div>\n", EscapeXml(drawing.title),
                        Inlined(drawing.top_view), Inlined(drawing.trajectory));
  }
  return text + "</body>\n</html>\n";
}

std::string FormatJson(const BenchmarkResult& result) {
  ordered_json json = {{"format", "benchmark"}, {"version", 1}};
  json["is_short"] = result.request.is_short;
  json["first_seed"] = result.request.first_seed;
  json["num_seeds"] = result.request.num_seeds;
  json["num_repeats"] = result.request.num_repeats;
  for (const auto& [name, value] : result.facts)
    json["facts"][name] = value;
  json["sequences"] = ordered_json::array();
  for (const std::string& sequence : result.plan.Sequences())
    json["sequences"].push_back(SequenceToJson(result, sequence));
  json["runs"] = ordered_json::array();
  for (const FinishedRun& run : result.runs)
    json["runs"].push_back(RunToJson(result, run));
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace cslam
