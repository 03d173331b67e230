// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/report.h"

#include "cslam/util/check.h"
#include "cslam/util/text_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <numbers>
#include <utility>

namespace cslam {
namespace {

// Keeps the order in which the fields are written.
using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<Statistic, const char*>, 4> kStatistics = {{
    {Statistic::kRmse, "rmse"},
    {Statistic::kMean, "mean"},
    {Statistic::kMedian, "median"},
    {Statistic::kMax, "max"},
}};

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

ErrorStatistics InDegrees(const ErrorStatistics& radians) {
  ErrorStatistics s = radians;
  for (double* value : {&s.rmse, &s.mean, &s.median, &s.std, &s.min, &s.max})
    *value *= kDegreesPerRadian;
  s.sse *= kDegreesPerRadian * kDegreesPerRadian;
  return s;
}

std::array<std::pair<const char*, double>, 7> Named(const ErrorStatistics& s) {
  return {{{"rmse", s.rmse},
           {"mean", s.mean},
           {"median", s.median},
           {"std", s.std},
           {"min", s.min},
           {"max", s.max},
           {"sse", s.sse}}};
}

std::string FormatMatches(const PoseAssociation& association, const ReportNames& names) {
  TextTable table;
  table.AddRow(
      {"reference", fmt::format("{} ({} poses)", names.reference, association.num_reference)});
  table.AddRow(
      {"estimate", fmt::format("{} ({} poses)", names.estimate, association.num_estimate)});
  table.AddRow(
      {"matched",
       fmt::format("{} poses: {:.1f} % of the estimate, {:.1f} % of the "
                   "reference, stamps at most {:.1f} ms apart",
                   association.pairs.size(), 100.0 * association.EstimateShare(),
                   100.0 * association.ReferenceShare(), 1e3 * association.max_difference_s)});
  return table.Text();
}

std::string FormatLargest(const RpeResult& result) {
  const auto describe = [&](std::size_t index) {
    const RelativeError& error = result.errors[index];
    const std::vector<PosePair>& pairs = result.association.pairs;
    return fmt::format("{:.4f} m, {:.3f} deg from {} to {} s", error.translation_m,
                       kDegreesPerRadian * error.rotation_rad,
                       FormatStamp(pairs[error.first].stamp), FormatStamp(pairs[error.last].stamp));
  };
  return fmt::format("largest translation error: {}\nlargest rotation error: {}\n",
                     describe(result.translation_m.max_index),
                     describe(result.rotation_rad.max_index));
}

Json ToJson(const ErrorStatistics& statistics) {
  Json json = {{"count", statistics.count}};
  for (const auto& [name, value] : Named(statistics))
    json[name] = value;
  return json;
}

Json ToJson(const PoseAssociation& association) {
  return {{"num_reference", association.num_reference},
          {"num_estimate", association.num_estimate},
          {"num_matched", association.pairs.size()},
          {"share_of_estimate", association.EstimateShare()},
          {"share_of_reference", association.ReferenceShare()},
          {"max_stamp_difference_s", association.max_difference_s}};
}

Json ToJson(const Alignment& alignment) {
  const Eigen::Vector3d& t = alignment.T_a_b.translation;
  const Eigen::Quaterniond& q = alignment.T_a_b.rotation;
  return {{"translation_m", {t.x(), t.y(), t.z()}},
          {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}},
          {"scale", alignment.scale}};
}

template <typename Result>
Json CommonJson(const char* metric, const Result& result, const ReportNames& names) {
  return {{"metric", metric},
          {"description", Headline(result)},
          {"reference", names.reference},
          {"estimate", names.estimate},
          {"association", ToJson(result.association)}};
}

std::string Dump(const Json& json) {
  // A path need not be UTF-8; its odd bytes are replaced rather than thrown at the user.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

double ValueOf(const ErrorStatistics& statistics, Statistic statistic) {
  switch (statistic) {
    case Statistic::kRmse:
      return statistics.rmse;
    case Statistic::kMean:
      return statistics.mean;
    case Statistic::kMedian:
      return statistics.median;
    case Statistic::kMax:
      return statistics.max;
  }
  CSLAM_CHECK(false, "statistic {}", static_cast<int>(statistic));
  return 0.0;
}

std::optional<Statistic> ParseStatistic(std::string_view name) {
  for (const auto& [statistic, known] : kStatistics) {
    if (name == known) return statistic;
  }
  return std::nullopt;
}

std::string NameOf(Statistic statistic) {
  for (const auto& [known, name] : kStatistics) {
    if (statistic == known) return name;
  }
  CSLAM_CHECK(false, "statistic {}", static_cast<int>(statistic));
  return {};
}

std::string Headline(const AteResult& result) {
  return fmt::format("ATE, {}, {}", Describe(result.options.alignment),
                     Describe(result.options.association));
}

std::string Headline(const RpeResult& result) {
  return fmt::format("RPE, {}, {}", DescribeDelta(result.options),
                     Describe(result.options.association));
}

std::string FormatReport(const AteResult& result, const ReportNames& names) {
  TextTable table({{"error"}, {"m", TextAlign::kRight}});
  for (const auto& [name, value] : Named(result.statistics_m)) {
    const bool is_square = std::string_view(name) == "sse";
    table.AddRow({is_square ? "sse [m²]" : name, fmt::format("{:.6f}", value)});
  }
  if (result.options.alignment == TrajectoryAlignment::kSim3)
    table.AddRow({"scale", fmt::format("{:.6f}", result.alignment.scale)});
  return fmt::format("{}\n{}\n{}", Headline(result), FormatMatches(result.association, names),
                     table.Text());
}

std::string FormatReport(const RpeResult& result, const ReportNames& names) {
  TextTable table(
      {{"error"}, {"translation [m]", TextAlign::kRight}, {"rotation [deg]", TextAlign::kRight}});
  const auto translation = Named(result.translation_m);
  const auto rotation = Named(InDegrees(result.rotation_rad));
  for (std::size_t i = 0; i < translation.size(); ++i) {
    const bool is_square = std::string_view(translation[i].first) == "sse";
    table.AddRow({is_square ? "sse [m², deg²]" : translation[i].first,
                  fmt::format("{:.6f}", translation[i].second),
                  fmt::format("{:.5f}", rotation[i].second)});
  }
  return fmt::format("{}\n{}motions    {}\n\n{}\n{}", Headline(result),
                     FormatMatches(result.association, names), result.errors.size(), table.Text(),
                     FormatLargest(result));
}

std::string FormatJson(const AteResult& result, const ReportNames& names) {
  Json json = CommonJson("ate", result, names);
  json["alignment"] = ToJson(result.alignment);
  json["statistics_m"] = ToJson(result.statistics_m);
  Json errors = Json::array();
  for (std::size_t i = 0; i < result.errors_m.size(); ++i) {
    errors.push_back({{"stamp", FormatStamp(result.association.pairs[i].stamp)},
                      {"error_m", result.errors_m[i]}});
  }
  json["errors"] = std::move(errors);
  return Dump(json);
}

std::string FormatJson(const RpeResult& result, const ReportNames& names) {
  const std::vector<PosePair>& pairs = result.association.pairs;
  Json json = CommonJson("rpe", result, names);
  json["num_motions"] = result.errors.size();
  json["translation_m"] = ToJson(result.translation_m);
  json["rotation_deg"] = ToJson(InDegrees(result.rotation_rad));
  Json errors = Json::array();
  for (const RelativeError& error : result.errors) {
    errors.push_back({{"from", FormatStamp(pairs[error.first].stamp)},
                      {"to", FormatStamp(pairs[error.last].stamp)},
                      {"translation_m", error.translation_m},
                      {"rotation_deg", kDegreesPerRadian * error.rotation_rad}});
  }
  json["errors"] = std::move(errors);
  return Dump(json);
}

}  // namespace cslam
