// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/trajectory_plot.h"

#include "cslam/eval/plot_data.h"
#include "cslam/eval/svg.h"
#include "cslam/util/atomic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace cslam {
namespace {

constexpr double kWidthPx = 900.0;
constexpr double kLeftPx = 76.0;
constexpr double kRightPx = 876.0;
constexpr double kTopPx = 112.0;
constexpr double kMinPathHeightPx = 340.0;
constexpr double kMaxPathHeightPx = 680.0;
constexpr double kTimeHeightPx = 130.0;
constexpr double kBetweenPx = 66.0;
constexpr double kBottomPx = 56.0;

constexpr const char* kReferenceStyle =
    R"(stroke="#9aa3ad" stroke-width="2" stroke-linejoin="round")";
constexpr const char* kUnknownColour = "#4a78b5";
constexpr const char* kGridStyle = R"(stroke="#e9ecef" stroke-width="1")";
constexpr const char* kFrameStyle = R"(fill="none" stroke="#adb5bd" stroke-width="1")";
constexpr const char* kStartStyle = R"(fill="#2b8a3e" stroke="#ffffff" stroke-width="1.5")";
constexpr const char* kEndStyle = R"(fill="#c92a2a" stroke="#ffffff" stroke-width="1.5")";
constexpr const char* kTickStyle = R"(font-size="11" fill="#495057")";
constexpr const char* kLabelStyle = R"(font-size="12" fill="#343a40")";

struct Interval {
  double min = 0.0;
  double max = 1.0;

  double Length() const { return max - min; }
  double Middle() const { return 0.5 * (min + max); }
};

Interval Around(double middle, double length) {
  return {middle - 0.5 * length, middle + 0.5 * length};
}

// A rectangle on paper and what its edges mean.
struct Panel {
  double top_px = 0.0;
  double height_px = 0.0;
  Interval right;  // from kLeftPx to kRightPx
  Interval up;     // from the bottom to the top

  Eigen::Vector2d ToPixel(double x, double y) const {
    return {kLeftPx + (x - right.min) / right.Length() * (kRightPx - kLeftPx),
            top_px + (up.max - y) / up.Length() * height_px};
  }
  double BottomPx() const { return top_px + height_px; }
};

// The unit in which lengths up to the given one read well.
struct LengthUnit {
  const char* name;
  double per_metre;
};

LengthUnit UnitFor(double length_m) {
  if (length_m < 0.01) return {"mm", 1000.0};
  if (length_m < 1.0) return {"cm", 100.0};
  return {"m", 1.0};
}

std::string FormatLength(double length_m) {
  const LengthUnit unit = UnitFor(length_m);
  return fmt::format("{:.2f} {}", unit.per_metre * length_m, unit.name);
}

// share 0 to 1 of the largest error: from dark blue over red to orange, readable on white.
std::string ErrorColour(double share) {
  constexpr std::array<std::array<double, 3>, 4> kStops = {
      {{38, 50, 148}, {126, 26, 158}, {214, 64, 92}, {250, 150, 40}}};
  const double position = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(position), kStops.size() - 2);
  const double alpha = position - static_cast<double>(i);
  const auto channel = [&](std::size_t c) {
    return static_cast<int>(std::lround((1.0 - alpha) * kStops[i][c] + alpha * kStops[i + 1][c]));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2));
}

constexpr int kNumColours = 24;

template <typename Function>
void ForEachPoint(const PlotData& data, Function function) {
  for (const auto& piece : data.estimate)
    std::for_each(piece.begin(), piece.end(), function);
}

// Equal scale in both directions; as high as the path needs, within limits.
Panel PathPanel(const PlotData& data) {
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d high = -low;
  const auto include = [&](const PlotPoint& point) {
    low = low.min(point.top_m.array());
    high = high.max(point.top_m.array());
  };
  std::for_each(data.reference.begin(), data.reference.end(), include);
  ForEachPoint(data, include);
  if (!(low <= high).all()) low = high = 0.0;

  constexpr double kMargin = 1.12;
  constexpr double kSmallestM = 0.02;
  const Eigen::Array2d extent = (kMargin * (high - low)).max(kSmallestM);
  const Eigen::Array2d middle = 0.5 * (low + high);
  const double width_px = kRightPx - kLeftPx;
  Panel panel;
  panel.top_px = kTopPx;
  panel.height_px = std::round(
      std::clamp(width_px * extent.y() / extent.x(), kMinPathHeightPx, kMaxPathHeightPx));
  const double metres_per_px = std::max(extent.x() / width_px, extent.y() / panel.height_px);
  panel.right = Around(middle.x(), metres_per_px * width_px);
  panel.up = Around(middle.y(), metres_per_px * panel.height_px);
  return panel;
}

Panel TimePanel(const PlotData& data, double top_px) {
  Panel panel{.top_px = top_px, .height_px = kTimeHeightPx, .right = {}, .up = {}};
  double last_s = 0.0;
  Interval value{0.0, 0.0};
  ForEachPoint(data, [&](const PlotPoint& point) {
    last_s = std::max(last_s, point.time_s);
    if (!std::isfinite(point.value_m)) return;
    value.min = std::min(value.min, point.value_m);
    value.max = std::max(value.max, point.value_m);
  });
  constexpr double kHeadroom = 1.1;
  constexpr double kSmallestM = 1e-3;
  panel.right.max = last_s > 0.0 ? last_s : 1.0;
  panel.up = data.has_error
                 ? Interval{0.0, std::max(kHeadroom * value.max, kSmallestM)}
                 : Around(value.Middle(), std::max(kHeadroom * value.Length(), 10 * kSmallestM));
  return panel;
}

// per_unit: units of the labels in one of the panel.
void DrawAxes(SvgImage& svg, const Panel& panel, const std::string& right_label,
              const std::string& up_label, double per_unit) {
  const double px_per_tick = 62.0;
  const Ticks right = RoundTicks(panel.right.min, panel.right.max,
                                 static_cast<int>((kRightPx - kLeftPx) / px_per_tick));
  for (const double x : right.values) {
    const double x_px = panel.ToPixel(x, 0.0).x();
    svg.Line({x_px, panel.top_px}, {x_px, panel.BottomPx()}, kGridStyle);
    svg.Text({x_px, panel.BottomPx() + 16.0}, fmt::format("{:.{}f}", x, right.decimals),
             fmt::format("{} text-anchor=\"middle\"", kTickStyle));
  }
  const Ticks up = RoundTicks(per_unit * panel.up.min, per_unit * panel.up.max,
                              std::max(4, static_cast<int>(panel.height_px / px_per_tick)));
  for (const double y : up.values) {
    const double y_px = panel.ToPixel(0.0, y / per_unit).y();
    svg.Line({kLeftPx, y_px}, {kRightPx, y_px}, kGridStyle);
    svg.Text({kLeftPx - 8.0, y_px + 4.0}, fmt::format("{:.{}f}", y, up.decimals),
             fmt::format("{} text-anchor=\"end\"", kTickStyle));
  }
  svg.Rectangle({kLeftPx, panel.top_px}, {kRightPx - kLeftPx, panel.height_px}, kFrameStyle);
  svg.Text({0.5 * (kLeftPx + kRightPx), panel.BottomPx() + 36.0}, right_label,
           fmt::format("{} text-anchor=\"middle\"", kLabelStyle));
  const double middle_px = panel.top_px + 0.5 * panel.height_px;
  svg.Text({22.0, middle_px}, up_label,
           fmt::format("{} text-anchor=\"middle\" transform=\"rotate(-90 22 {:.1f})\"", kLabelStyle,
                       middle_px));
}

// -1 where no error is known.
int ColourOf(const PlotPoint& a, const PlotPoint& b, double max_m) {
  const double error_m = 0.5 * (a.value_m + b.value_m);
  if (!std::isfinite(error_m)) return -1;
  return std::min(kNumColours - 1, static_cast<int>(kNumColours * error_m / max_m));
}

std::string PathStyle(int colour) {
  const std::string name = colour < 0 ? kUnknownColour : ErrorColour((colour + 0.5) / kNumColours);
  return fmt::format(
      R"(stroke="{}" stroke-width="2.4" stroke-linejoin="round" stroke-linecap="round")", name);
}

// Runs of equal colour become one line each.
void DrawPiece(SvgImage& svg, const Panel& panel, const std::vector<PlotPoint>& piece,
               std::optional<double> max_error_m) {
  std::vector<Eigen::Vector2d> run;
  int run_colour = -1;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Eigen::Vector2d pixel = panel.ToPixel(piece[i].top_m.x(), piece[i].top_m.y());
    const int colour = i > 0 && max_error_m ? ColourOf(piece[i - 1], piece[i], *max_error_m) : -1;
    if (run.size() > 1 && colour != run_colour) {
      svg.Polyline(run, PathStyle(run_colour));
      run = {run.back()};
    }
    run.push_back(pixel);
    run_colour = colour;
  }
  svg.Polyline(run, PathStyle(run_colour));
}

void DrawPaths(SvgImage& svg, const Panel& panel, const PlotData& data,
               std::optional<double> max_error_m) {
  std::vector<Eigen::Vector2d> reference;
  for (const PlotPoint& point : data.reference)
    reference.push_back(panel.ToPixel(point.top_m.x(), point.top_m.y()));
  svg.Polyline(reference, kReferenceStyle);
  for (const auto& piece : data.estimate)
    DrawPiece(svg, panel, piece, max_error_m);
  if (data.estimate.empty()) return;
  const Eigen::Vector2d& first = data.estimate.front().front().top_m;
  const Eigen::Vector2d& last = data.estimate.back().back().top_m;
  svg.Circle(panel.ToPixel(first.x(), first.y()), 6.0, kStartStyle);
  const Eigen::Vector2d half(5.0, 5.0);
  svg.Rectangle(panel.ToPixel(last.x(), last.y()) - half, 2.0 * half, kEndStyle);
}

void DrawTimeline(SvgImage& svg, const Panel& panel, const PlotData& data) {
  for (std::size_t i = 0; i < data.estimate.size(); ++i) {
    const auto& piece = data.estimate[i];
    if (i > 0) {
      const double from_px = panel.ToPixel(data.estimate[i - 1].back().time_s, 0.0).x();
      const double to_px = panel.ToPixel(piece.front().time_s, 0.0).x();
      svg.Rectangle({from_px, panel.top_px}, {to_px - from_px, panel.height_px},
                    R"(fill="#fa5252" fill-opacity="0.15")");
    }
    std::vector<Eigen::Vector2d> line;
    for (const PlotPoint& point : piece) {
      if (std::isfinite(point.value_m)) line.push_back(panel.ToPixel(point.time_s, point.value_m));
    }
    svg.Polyline(line, fmt::format(R"(stroke="{}" stroke-width="1.6")", kUnknownColour));
  }
}

void DrawRmse(SvgImage& svg, const Panel& panel, double rmse_m) {
  const double y_px = panel.ToPixel(0.0, rmse_m).y();
  svg.Line({kLeftPx, y_px}, {kRightPx, y_px},
           R"(stroke="#343a40" stroke-width="1" stroke-dasharray="5 4")");
  svg.Text({kRightPx - 6.0, y_px - 5.0}, "RMSE " + FormatLength(rmse_m),
           R"(font-size="11" fill="#343a40" text-anchor="end" stroke="#ffffff" stroke-width="3" )"
           R"(paint-order="stroke")");
}

std::string Summary(const TrajectoryPlot& plot) {
  if (plot.estimate.empty()) return "no poses";
  const double duration_s = SecondsBetween(plot.estimate.back().stamp, plot.estimate.front().stamp);
  const Alignment alignment = plot.ate ? plot.ate->alignment : Alignment{};
  const std::string extent =
      fmt::format("{:.1f} s, {:.2f} m", duration_s, alignment.scale * PathLength(plot.estimate));
  if (!plot.ate) return fmt::format("{} poses, {}", plot.estimate.size(), extent);
  return fmt::format("ATE RMSE {}, max {} ({}); {} of {} poses matched; {}",
                     FormatLength(plot.ate->statistics_m.rmse),
                     FormatLength(plot.ate->statistics_m.max),
                     Describe(plot.ate->options.alignment), plot.ate->association.pairs.size(),
                     plot.ate->association.num_estimate, extent);
}

void DrawErrorScale(SvgImage& svg, double left_px, double y_px, double max_error_m) {
  constexpr double kScaleWidthPx = 120.0;
  const double step_px = kScaleWidthPx / kNumColours;
  for (int i = 0; i < kNumColours; ++i) {
    svg.Rectangle({left_px + step_px * i, y_px - 7.0}, {step_px + 0.3, 6.0},
                  fmt::format("fill=\"{}\"", ErrorColour((i + 0.5) / kNumColours)));
  }
  svg.Text({left_px + kScaleWidthPx + 8.0, y_px},
           fmt::format("estimate, error 0 to {}", FormatLength(max_error_m)), kLabelStyle);
}

void DrawHeader(SvgImage& svg, const TrajectoryPlot& plot, const PlotData& data,
                std::optional<double> max_error_m) {
  svg.Text({kLeftPx, 36.0}, plot.title, R"(font-size="20" font-weight="bold" fill="#212529")");
  svg.Text({kLeftPx, 60.0}, Summary(plot), R"(font-size="13" fill="#495057")");
  const double y_px = 94.0;
  double x_px = kLeftPx;
  if (!data.reference.empty()) {
    svg.Line({x_px, y_px - 4.0}, {x_px + 26.0, y_px - 4.0}, kReferenceStyle);
    svg.Text({x_px + 34.0, y_px}, "ground truth", kLabelStyle);
    x_px += 140.0;
  }
  if (max_error_m) {
    DrawErrorScale(svg, x_px, y_px, *max_error_m);
    x_px += 345.0;
  } else {
    svg.Line({x_px, y_px - 4.0}, {x_px + 26.0, y_px - 4.0}, PathStyle(-1));
    svg.Text({x_px + 34.0, y_px}, "estimate", kLabelStyle);
    x_px += 120.0;
  }
  svg.Circle({x_px + 6.0, y_px - 4.0}, 6.0, kStartStyle);
  svg.Text({x_px + 18.0, y_px}, "start", kLabelStyle);
  svg.Rectangle({x_px + 66.0, y_px - 9.0}, {10.0, 10.0}, kEndStyle);
  svg.Text({x_px + 83.0, y_px}, "end", kLabelStyle);
  if (data.estimate.size() > 1) {
    svg.Rectangle({x_px + 124.0, y_px - 10.0}, {14.0, 12.0},
                  R"(fill="#fa5252" fill-opacity="0.15")");
    svg.Text({x_px + 144.0, y_px}, "no poses", kLabelStyle);
  }
}

}  // namespace

std::string FormatTrajectorySvg(const TrajectoryPlot& plot) {
  const PlotData data = PreparePlot(plot);
  std::optional<double> max_error_m;
  if (data.has_error) max_error_m = std::max(plot.ate->statistics_m.max, 1e-6);
  const Panel path = PathPanel(data);
  const Panel time = TimePanel(data, path.BottomPx() + kBetweenPx);

  SvgImage svg(kWidthPx, time.BottomPx() + kBottomPx);
  DrawHeader(svg, plot, data, max_error_m);
  DrawAxes(svg, path, data.right_axis, data.up_axis, 1.0);
  DrawPaths(svg, path, data, max_error_m);

  const LengthUnit unit = UnitFor(std::max(std::abs(time.up.min), std::abs(time.up.max)));
  DrawAxes(svg, time, "time [s]",
           fmt::format("{} [{}]", data.has_error ? "error" : "height", unit.name), unit.per_metre);
  DrawTimeline(svg, time, data);
  if (data.has_error) DrawRmse(svg, time, plot.ate->statistics_m.rmse);
  return svg.Document();
}

void WriteTrajectorySvg(const std::filesystem::path& path, const TrajectoryPlot& plot) {
  WriteFileAtomically(path, FormatTrajectorySvg(plot));
}

}  // namespace cslam
