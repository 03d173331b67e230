// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/benchmark/top_view.h"

#include "cslam/eval/svg.h"
#include "cslam/semantics/coco.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cslam {
namespace {

constexpr double kWidthPx = 900.0;
constexpr double kMaxHeightPx = 900.0;
constexpr double kEdgePx = 24.0;
constexpr double kHeaderPx = 84.0;
constexpr double kMarginM = 0.3;
constexpr std::size_t kMaxPoints = 5000;  // drawn; evenly chosen from more

constexpr const char* kPathStyle = R"(stroke="#868e96" stroke-width="1.2")";
constexpr const char* kPointStyle = R"(fill="#adb5bd")";
constexpr const char* kGhostStyle = R"(fill="#e03131")";
constexpr const char* kPresentStyle = R"(stroke="#2b8a3e" stroke-width="3")";
constexpr const char* kFormerStyle = R"(stroke="#f08c00" stroke-width="2" stroke-dasharray="6 4")";
constexpr const char* kFoundStyle = R"(stroke="#1971c2" stroke-width="1.8")";
constexpr const char* kAbsentStyle =
    R"(stroke="#1971c2" stroke-width="1.3" stroke-dasharray="2 3")";
constexpr const char* kTextStyle = R"(font-size="12" fill="#495057")";

double Cross(const Eigen::Vector2d& o, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
}

// The outline of a box from above, closed.
std::vector<Eigen::Vector2d> Outline(const PlacedBox& box) {
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d sign((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5,
                               (i & 4) != 0 ? 0.5 : -0.5);
    const Eigen::Vector3d corner = sign.cwiseProduct(box.size_m);
    corners.emplace_back((box.T_world_box * corner).head<2>());
  }
  std::sort(corners.begin(), corners.end(), [](const auto& a, const auto& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Eigen::Vector2d> hull;  // monotone chain: below, then above
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t begin = hull.size();
    for (const Eigen::Vector2d& corner : corners) {
      while (hull.size() >= begin + 2 && Cross(hull[hull.size() - 2], hull.back(), corner) <= 1e-12)
        hull.pop_back();
      hull.push_back(corner);
    }
    hull.pop_back();
    std::reverse(corners.begin(), corners.end());
  }
  if (!hull.empty()) hull.push_back(hull.front());
  return hull;
}

// x to the right and y up on paper.
class Paper {
 public:
  explicit Paper(const Eigen::AlignedBox2d& extent_m) : extent_m_(extent_m) {
    const Eigen::Vector2d size = extent_m.sizes().cwiseMax(0.5);
    px_per_m_ = std::min((kWidthPx - 2.0 * kEdgePx) / size.x(), kMaxHeightPx / size.y());
    height_px_ = kHeaderPx + px_per_m_ * size.y() + kEdgePx;
  }

  double height_px() const { return height_px_; }
  double px_per_m() const { return px_per_m_; }
  Eigen::Vector2d ToPixel(const Eigen::Vector2d& p) const {
    return {kEdgePx + px_per_m_ * (p.x() - extent_m_.min().x()),
            kHeaderPx + px_per_m_ * (extent_m_.max().y() - p.y())};
  }
  bool Contains(const Eigen::Vector3d& p) const { return extent_m_.contains(p.head<2>().eval()); }

 private:
  Eigen::AlignedBox2d extent_m_;
  double px_per_m_ = 1.0;
  double height_px_ = 0.0;
};

// The middle 98 % of the points along an axis: a few stray ones lie anywhere.
void ExtendByMost(const std::vector<Eigen::Vector3d>& points, Eigen::AlignedBox2d& extent) {
  if (points.empty()) return;
  Eigen::Vector2d low;
  Eigen::Vector2d high;
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> values;
    std::transform(points.begin(), points.end(), std::back_inserter(values),
                   [axis](const Eigen::Vector3d& p) { return p[axis]; });
    std::sort(values.begin(), values.end());
    const std::size_t stray = values.size() / 100;
    low[axis] = values[stray];
    high[axis] = values[values.size() - 1 - stray];
  }
  extent.extend(low);
  extent.extend(high);
}

Eigen::AlignedBox2d Extent(const TopView& view) {
  Eigen::AlignedBox2d extent;
  for (const Eigen::Vector3d& p : view.path)
    extent.extend(p.head<2>().eval());
  for (const auto* boxes : {&view.present, &view.former}) {
    for (const LabelledBox& box : *boxes) {
      for (const Eigen::Vector2d& corner : Outline(box.box))
        extent.extend(corner);
    }
  }
  ExtendByMost(view.points, extent);
  if (extent.isEmpty()) extent.extend(Eigen::Vector2d::Zero().eval());
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kMarginM);
  return {extent.min() - margin, extent.max() + margin};
}

enum class LabelPlace { kAbove, kBelow };

void DrawBoxes(SvgImage& svg, const Paper& paper, const std::vector<LabelledBox>& boxes,
               const char* style, LabelPlace place) {
  for (const LabelledBox& box : boxes) {
    std::vector<Eigen::Vector2d> pixels;
    Eigen::AlignedBox2d around;
    for (const Eigen::Vector2d& corner : Outline(box.box)) {
      pixels.push_back(paper.ToPixel(corner));
      around.extend(pixels.back());
    }
    svg.Polyline(pixels, style);
    if (box.label.empty() || around.isEmpty()) continue;
    const double y_px =
        place == LabelPlace::kAbove ? around.min().y() - 4.0 : around.max().y() + 11.0;
    svg.Text({around.center().x(), y_px}, box.label,
             R"(font-size="10" text-anchor="middle" fill="#343a40" stroke="#ffffff" )"
             R"(stroke-width="2.5" paint-order="stroke")");
  }
}

void DrawLegend(SvgImage& svg, const TopView& view) {
  svg.Text({kEdgePx, 30.0}, view.title, R"(font-size="18" font-weight="bold" fill="#212529")");
  double x_px = kEdgePx;
  const auto line = [&](const char* style, const char* text, double width_px) {
    svg.Line({x_px, 54.0}, {x_px + 24.0, 54.0}, style);
    svg.Text({x_px + 30.0, 58.0}, text, kTextStyle);
    x_px += width_px;
  };
  line(kPresentStyle, "true thing", 110.0);
  line(kFormerStyle, "something was here", 175.0);
  line(kFoundStyle, "found", 90.0);
  line(kAbsentStyle, "found gone", 120.0);
  line(kPathStyle, "camera", 95.0);
  svg.Circle({x_px + 5.0, 54.0}, 3.0, kPointStyle);
  svg.Text({x_px + 14.0, 58.0}, "map point", kTextStyle);
  x_px += 90.0;
  svg.Circle({x_px + 5.0, 54.0}, 3.0, kGhostStyle);
  svg.Text({x_px + 14.0, 58.0}, fmt::format("ghost ({})", view.ghosts.size()), kTextStyle);
}

void DrawScale(SvgImage& svg, const Paper& paper) {
  const double y_px = paper.height_px() - 8.0;
  svg.Line({kEdgePx, y_px}, {kEdgePx + paper.px_per_m(), y_px},
           R"(stroke="#495057" stroke-width="2")");
  svg.Text({kEdgePx + paper.px_per_m() + 6.0, y_px + 4.0}, "1 m", kTextStyle);
}

std::string ClassLabel(int class_id) {
  return class_id < 0 ? std::string() : std::string(CocoClassName(class_id));
}

std::vector<LabelledBox> FormerPlaces(const SceneTruth& truth) {
  std::vector<LabelledBox> former;
  for (const TrueChange& change : truth.changes.changes) {
    if (!change.from) continue;
    const auto object =
        std::find_if(truth.objects.objects.begin(), truth.objects.objects.end(),
                     [&](const TrueObject& o) { return o.instance == change.instance; });
    if (object == truth.objects.objects.end()) continue;
    former.push_back({BoxOf(*object, *change.from), ClassLabel(object->class_id)});
  }
  return former;
}

}  // namespace

TopView MakeTopView(std::string title, const SceneTruth& truth, const SceneRun& run,
                    const RunEvaluation& evaluation) {
  TopView view;
  view.title = std::move(title);
  for (const StampedPose& pose : run.trajectory)
    view.path.push_back(run.T_truth_run * pose.T_world_camera.translation);
  if (run.map_points) view.points = *run.map_points;
  if (evaluation.objects.ghosts) view.ghosts = evaluation.objects.ghosts->ghosts;
  const double end_s = truth.TimeOf(run.last_stamp());
  for (const TruePlace& place :
       TruePlacesAt(truth, truth.TimeOf(run.first_stamp()), end_s, evaluation.objects.options)) {
    if (place.is_required) view.present.push_back({place.box, ClassLabel(place.class_id)});
  }
  view.former = FormerPlaces(truth);
  if (!run.objects) return view;
  for (const FoundObject& object : *run.objects) {
    const std::string label =
        fmt::format("{} {:.2f}", ClassLabel(object.report.class_id), object.report.belief);
    if (object.report.state == "present") view.found.push_back({object.box, label});
    if (object.report.state == "absent") view.absent.push_back({object.box, ""});
  }
  return view;
}

std::string FormatTopViewSvg(const TopView& view) {
  const Paper paper(Extent(view));
  SvgImage svg(kWidthPx, paper.height_px());
  const std::size_t step = view.points.size() / kMaxPoints + 1;
  for (std::size_t i = 0; i < view.points.size(); i += step) {
    if (!paper.Contains(view.points[i])) continue;
    svg.Circle(paper.ToPixel(view.points[i].head<2>()), 1.0, kPointStyle);
  }
  std::vector<Eigen::Vector2d> path;
  for (const Eigen::Vector3d& p : view.path)
    path.push_back(paper.ToPixel(p.head<2>()));
  svg.Polyline(path, kPathStyle);
  DrawBoxes(svg, paper, view.former, kFormerStyle, LabelPlace::kAbove);
  DrawBoxes(svg, paper, view.present, kPresentStyle, LabelPlace::kAbove);
  DrawBoxes(svg, paper, view.absent, kAbsentStyle, LabelPlace::kBelow);
  DrawBoxes(svg, paper, view.found, kFoundStyle, LabelPlace::kBelow);
  for (const Eigen::Vector3d& p : view.ghosts)
    svg.Circle(paper.ToPixel(p.head<2>()), 2.0, kGhostStyle);
  DrawLegend(svg, view);
  DrawScale(svg, paper);
  return svg.Document();
}

}  // namespace cslam
