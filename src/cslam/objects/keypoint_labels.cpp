// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/keypoint_labels.h"

#include "cslam/util/check.h"
#include "cslam/util/options.h"
#include "cslam/util/quantile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cslam {
namespace {

constexpr int kPerson = 0;

// Thumbnail pixels of a box, inside the view.
struct PixelRange {
  int u0, v0, u1, v1;
};
PixelRange RangeOf(const DepthView& view, const Box& box) {
  const double step = view.step;
  return {std::max(0, static_cast<int>(std::floor(box.x_min / step))),
          std::max(0, static_cast<int>(std::floor(box.y_min / step))),
          std::min(view.depth_mm.cols, static_cast<int>(std::ceil(box.x_max / step))),
          std::min(view.depth_mm.rows, static_cast<int>(std::ceil(box.y_max / step)))};
}

// What the bands rule needs to know of a thing, worked out once.
struct Band {
  bool is_occluded = false;  // by something that no detector named
  bool has_depth = false;
  double background_from_m = 0.0;
};

Band MakeBand(const DepthView& view, std::size_t index, std::span<const LabelledThing> things,
              const LabelOptions& options) {
  std::vector<Box> others;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (i != index && Iou(things[i].box, things[index].box) > 0.0) others.push_back(things[i].box);
  }
  const BoxDepths depths =
      MeasureBoxDepths(view, things[index].box, others, options.nearest_percentile);
  Band band;
  if (depths.num_readings == 0) return band;
  band.has_depth = true;
  const bool is_person = things[index].class_id == kPerson;
  const double threshold = is_person ? options.person_threshold_m : options.movable_threshold_m;
  band.background_from_m = depths.nearest_m + threshold;
  band.is_occluded = depths.sigma_m > options.max_depth_sigma_m ||
                     (depths.centre_m > 0.0 && depths.centre_m < depths.median_m - threshold &&
                      depths.centre_m > band.background_from_m);
  return band;
}

bool IsInBand(const Keypoint& keypoint, const Band& band, const LabelOptions& options) {
  if (band.is_occluded) return options.drop_occluded;
  if (!keypoint.HasDepth()) return options.drop_without_depth;
  if (!band.has_depth) return true;
  return static_cast<double>(keypoint.depth_m) <= band.background_from_m;
}

// Distance is counted in thumbnail pixels. The nearest of the region's readings around the
// keypoint decides whether the keypoint's own reading lies on the surface or behind it.
bool IsOnSurface(const Keypoint& keypoint, const DepthRegion& region, const DepthView& view,
                 const LabelOptions& options) {
  const int u = static_cast<int>(keypoint.uv_px.x()) / view.step;
  const int v = static_cast<int>(keypoint.uv_px.y()) / view.step;
  const int reach = std::max(1, (options.border_px + view.step - 1) / view.step);
  bool is_near = false;
  float surface_m = 0.0F;
  for (int dv = -reach; dv <= reach; ++dv) {
    for (int du = -reach; du <= reach; ++du) {
      const int nu = u + du;
      const int nv = v + dv;
      if (nu < 0 || nv < 0 || nu >= region.mask.cols || nv >= region.mask.rows) continue;
      if (region.mask.at<std::uint8_t>(nv, nu) == 0) continue;
      is_near = true;
      surface_m = std::max(surface_m, view.DepthM(nu, nv));
    }
  }
  if (!is_near) return false;
  if (!keypoint.HasDepth()) return options.drop_without_depth;
  if (surface_m == 0.0F) return true;
  return keypoint.depth_m < surface_m + static_cast<float>(options.surface_tolerance_m);
}

}  // namespace

void Describe(OptionList& list, LabelOptions& o) {
  list.Add("rule", o.rule,
           "How keypoints on an object are told from the background in its box: boxes (none are), "
           "bands (the paper's depth bands) or surfaces (connected in depth).");
  list.Add("person_threshold", o.person_threshold_m, {0.02, 3.0}, "m",
           "bands: this much behind a person's nearest depth the background begins.");
  list.Add("movable_threshold", o.movable_threshold_m, {0.02, 3.0}, "m",
           "bands: the same for other objects.");
  list.Add("nearest_percentile", o.nearest_percentile, {0.0, 0.5}, "",
           "bands: share of a box's readings nearer than what counts as its nearest depth.");
  list.Add("max_depth_sigma", o.max_depth_sigma_m, {0.05, 10.0}, "m",
           "bands: more spread of depth in a box speaks of an occluder without a name.");
  list.Add("drop_occluded", o.drop_occluded,
           "bands: leave out the keypoints of an occluded box (the paper's text) instead of "
           "keeping them as background (its Algorithm 1).");
  list.Add("drop_without_depth", o.drop_without_depth,
           "Take keypoints without a depth reading for the object's own.");
  list.Add("surface_tolerance", o.surface_tolerance_m, {0.01, 1.0}, "m",
           "surfaces: keypoints this far behind the object's surface are background.");
  list.Add("border", o.border_px, {0, 100}, "px",
           "surfaces: how far beyond the object's pixels its keypoints may lie.");
}

LabelRule RuleOf(const LabelOptions& options) {
  if (options.rule == "boxes") return LabelRule::kBoxes;
  if (options.rule == "bands") return LabelRule::kBands;
  if (options.rule == "surfaces") return LabelRule::kSurfaces;
  throw Error("unknown label rule '{}'; it is one of: boxes, bands, surfaces", options.rule);
}

BoxDepths MeasureBoxDepths(const DepthView& view, const Box& box, std::span<const Box> others,
                           double nearest_percentile) {
  BoxDepths result;
  if (view.empty() || box.empty()) return result;
  const PixelRange range = RangeOf(view, box);
  std::vector<float> all;
  std::vector<float> middle;
  double sum = 0.0;
  double sum_squared = 0.0;
  for (int v = range.v0; v < range.v1; ++v) {
    for (int u = range.u0; u < range.u1; ++u) {
      const float z = view.DepthM(u, v);
      if (z <= 0.0F) continue;
      const double x = (u + 0.5) * view.step;
      const double y = (v + 0.5) * view.step;
      if (std::any_of(others.begin(), others.end(), [&](const Box& b) { return b.Contains(x, y); }))
        continue;
      all.push_back(z);
      sum += static_cast<double>(z);
      sum_squared += static_cast<double>(z) * static_cast<double>(z);
      const bool is_middle = std::abs(x - 0.5 * (box.x_min + box.x_max)) < box.width() / 6.0 &&
                             std::abs(y - 0.5 * (box.y_min + box.y_max)) < box.height() / 6.0;
      if (is_middle) middle.push_back(z);
    }
  }
  result.num_readings = static_cast<int>(all.size());
  if (all.empty()) return result;
  const auto count = static_cast<double>(all.size());
  result.mean_m = sum / count;
  result.sigma_m = std::sqrt(std::max(0.0, sum_squared / count - result.mean_m * result.mean_m));
  result.nearest_m = static_cast<double>(QuantileOf(all, nearest_percentile));
  result.median_m = static_cast<double>(QuantileOf(all, 0.5));
  result.farthest_m = static_cast<double>(*std::max_element(all.begin(), all.end()));
  if (!middle.empty()) result.centre_m = static_cast<double>(QuantileOf(std::move(middle), 0.5));
  return result;
}

std::vector<KeypointSemantics> LabelKeypoints(std::span<const Keypoint> keypoints,
                                              std::span<const LabelledThing> things,
                                              const DepthView& view, const LabelOptions& options) {
  const LabelRule rule = RuleOf(options);
  std::vector<KeypointSemantics> labels(keypoints.size());
  if (things.empty()) return labels;
  std::vector<Band> bands(things.size());
  if (rule == LabelRule::kBands) {
    for (std::size_t i = 0; i < things.size(); ++i)
      bands[i] = MakeBand(view, i, things, options);
  }
  // Dynamic things first, then nearer ones; where a depth is not known, last.
  std::vector<std::size_t> order(things.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  const auto depth_of = [&](std::size_t i) {
    return things[i].region.empty() ? std::numeric_limits<float>::max() : things[i].region.median_m;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const bool a_is_dynamic = things[a].label == KeypointLabel::kDynamic;
    const bool b_is_dynamic = things[b].label == KeypointLabel::kDynamic;
    if (a_is_dynamic != b_is_dynamic) return a_is_dynamic;
    return depth_of(a) < depth_of(b);
  });
  for (std::size_t k = 0; k < keypoints.size(); ++k) {
    const Keypoint& keypoint = keypoints[k];
    for (const std::size_t i : order) {
      const LabelledThing& thing = things[i];
      const bool is_in_box = thing.box.Contains(static_cast<double>(keypoint.uv_px.x()),
                                                static_cast<double>(keypoint.uv_px.y()));
      bool is_own = is_in_box;
      if (rule == LabelRule::kSurfaces && !thing.region.empty()) {
        is_own = IsOnSurface(keypoint, thing.region, view, options);
      } else if (rule == LabelRule::kBands) {
        is_own = is_in_box && IsInBand(keypoint, bands[i], options);
      }
      if (!is_own) continue;
      labels[k] = {thing.label, static_cast<std::int16_t>(thing.class_id), thing.track};
      break;
    }
  }
  return labels;
}

}  // namespace cslam
