// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/reprojection_check.h"

#include "cslam/dataset/surface_patch.h"
#include "cslam/dataset/truth_lookup.h"
#include "cslam/util/quantile.h"
#include "cslam/util/random.h"

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cslam {
namespace {

constexpr int kColumns = 160;                  // of the grid of pixels that are compared
constexpr std::size_t kMinPoints = 200;        // of a pair; fewer tell nothing
constexpr double kNearPartnerS = 0.2;          // a few frames at 30 Hz
constexpr double kFarPartnerS = 2.0;           // the camera has been elsewhere in between
constexpr double kFocusDistanceM = 2.0;        // where a frame's middle is assumed to be
constexpr double kMaxFocusOffset = 0.3;        // of the picture's width, for a far partner
constexpr double kMaxFarDistanceM = 1.5;       // between the cameras
constexpr double kMinFarCosine = 0.8;          // between the optical axes: 37 degrees
constexpr std::size_t kFarCandidates = 400;    // frames looked at for a far partner
constexpr double kMinOcclusionM = 0.010;       // nearer than predicted by more than this: hidden
constexpr double kOcclusionTolerances = 3.0;   // and by more than so many tolerances
constexpr std::uint64_t kPurposePartner = 71;  // stream of the generator

// What is kept of a frame while pairs are compared.
struct View {
  std::size_t frame = 0;
  double time_s = 0.0;
  Se3 T_world_camera;
  cv::Mat inverse_depth;
  cv::Mat instances;  // empty if there are none
};

std::optional<View> LoadView(const CheckFrames& frames, std::size_t i, const TrueObjects* objects) {
  const std::optional<Se3> pose = frames.T_world_camera(i);
  if (!pose) return std::nullopt;
  const cv::Mat depth_m = frames.DepthM(i);
  if (depth_m.empty()) return std::nullopt;
  View view{.frame = i,
            .time_s = objects != nullptr ? TimeOf(*objects, frames.stamp(i)) : 0.0,
            .T_world_camera = *pose,
            .inverse_depth = InverseDepth(depth_m),
            .instances = {}};
  if (frames.has_instances()) {
    view.instances = frames.Instances(i);
    if (view.instances.size() != depth_m.size()) return std::nullopt;
  }
  return view;
}

int InstanceAt(const View& view, int x, int y) {
  return view.instances.empty() ? 0 : view.instances.at<std::uint16_t>(y, x);
}

// Collected differences, one entry per compared point.
struct Differences {
  std::vector<double> absolute_m;
  std::vector<double> per_tolerance;
  std::vector<double> relative;
  std::size_t num_hidden = 0;
  std::size_t num_pierced = 0;

  void Append(const Differences& other) {
    absolute_m.insert(absolute_m.end(), other.absolute_m.begin(), other.absolute_m.end());
    per_tolerance.insert(per_tolerance.end(), other.per_tolerance.begin(),
                         other.per_tolerance.end());
    relative.insert(relative.end(), other.relative.begin(), other.relative.end());
    num_hidden += other.num_hidden;
    num_pierced += other.num_pierced;
  }
};

double Quantile(const std::vector<double>& values, double share) {
  return values.empty() ? 0.0 : QuantileOf(values, share);
}

ReprojectionFigures Summarise(const Differences& d) {
  ReprojectionFigures figures;
  figures.num_points = d.absolute_m.size();
  figures.median_m = Quantile(d.absolute_m, 0.5);
  figures.p95_m = Quantile(d.absolute_m, 0.95);
  figures.p95_per_tolerance = Quantile(d.per_tolerance, 0.95);
  figures.median_relative = Quantile(d.relative, 0.5);
  const auto total = static_cast<double>(figures.num_points + d.num_hidden);
  if (total > 0.0) {
    figures.hidden_share = static_cast<double>(d.num_hidden) / total;
    figures.pierced_share = static_cast<double>(d.num_pierced) / total;
  }
  return figures;
}

// Compares the pixels of one view with another view.
class PairComparison {
 public:
  PairComparison(const Camera& camera, const ReprojectionOptions& options,
                 const TrueObjects* objects)
      : camera_(camera),
        patches_(camera, {.window_px = options.window_px,
                          .min_cosine = options.min_cosine,
                          .tolerance = options.tolerance}),
        tolerance_(options.tolerance),
        objects_(objects) {}

  Differences Compare(const View& a, const View& b) const {
    Differences differences;
    const Se3 T_b_a = b.T_world_camera.Inverse() * a.T_world_camera;
    const int step = std::max(1, camera_.width / kColumns);
    for (int y = step / 2; y < camera_.height; y += step) {
      for (int x = step / 2; x < camera_.width; x += step) {
        if (IsComparable(a, b, InstanceAt(a, x, y))) ComparePixel(a, b, T_b_a, x, y, differences);
      }
    }
    return differences;
  }

 private:
  bool IsComparable(const View& a, const View& b, int instance) const {
    if (instance == 0) return true;
    return objects_ != nullptr && IsSamePlace(*objects_, instance, a.time_s, b.time_s);
  }

  void ComparePixel(const View& a, const View& b, const Se3& T_b_a, int x, int y,
                    Differences& differences) const {
    if (!patches_.IsFlat(a.inverse_depth, x, y)) return;
    const Eigen::Vector3d p_a =
        patches_.Ray(x, y) / static_cast<double>(a.inverse_depth.at<float>(y, x));
    const Eigen::Vector3d p_b = T_b_a * p_a;
    const std::optional<Eigen::Vector2d> uv = patches_.RawPixel(p_b);
    if (!uv) return;
    const auto left = static_cast<int>(std::floor(uv->x()));
    const auto top = static_cast<int>(std::floor(uv->y()));
    const int instance = InstanceAt(a, x, y);
    for (const auto& [u, v] : {std::pair(left, top), std::pair(left + 1, top),
                               std::pair(left, top + 1), std::pair(left + 1, top + 1)}) {
      if (InstanceAt(b, u, v) != instance) return;
    }
    const std::optional<double> z_b_m = patches_.DepthAt(b.inverse_depth, *uv);
    if (!z_b_m) return;
    const double difference_m = *z_b_m - p_b.z();
    const double tolerance_m = tolerance_.At(std::max(*z_b_m, p_b.z()));
    const double margin_m = std::max(kMinOcclusionM, kOcclusionTolerances * tolerance_m);
    if (difference_m < -margin_m) {
      ++differences.num_hidden;
      return;
    }
    if (difference_m > margin_m) ++differences.num_pierced;
    differences.absolute_m.push_back(std::abs(difference_m));
    differences.per_tolerance.push_back(std::abs(difference_m) / tolerance_m);
    differences.relative.push_back(std::abs(difference_m) / p_b.z());
  }

  Camera camera_;
  SurfacePatches patches_;
  DepthTolerance tolerance_;
  const TrueObjects* objects_;
};

// Whether b looks at what is in the middle of a's picture, from a similar side.
bool LooksAlike(const Camera& camera, const Se3& T_world_a, const Se3& T_world_b) {
  const Se3 T_b_a = T_world_b.Inverse() * T_world_a;
  if (T_b_a.translation.norm() > kMaxFarDistanceM) return false;
  if (T_b_a.R()(2, 2) < kMinFarCosine) return false;
  const Eigen::Vector3d focus_b = T_b_a * Eigen::Vector3d(0.0, 0.0, kFocusDistanceM);
  if (focus_b.z() <= 0.1) return false;
  const Eigen::Vector2d offset = Project(camera, focus_b) - Eigen::Vector2d(camera.cx, camera.cy);
  return offset.norm() < kMaxFocusOffset * camera.width;
}

std::optional<std::size_t> NearPartner(const CheckFrames& frames, std::size_t a) {
  for (std::size_t b = a + 1; b < frames.size(); ++b) {
    const bool is_late_enough =
        SecondsBetween(frames.stamp(b), frames.stamp(a)) >= kNearPartnerS || b + 1 == frames.size();
    if (is_late_enough && frames.T_world_camera(b)) return b;
  }
  return std::nullopt;
}

std::optional<std::size_t> FarPartner(const CheckFrames& frames, std::size_t a) {
  const Se3 T_world_a = *frames.T_world_camera(a);
  const std::size_t stride = std::max<std::size_t>(1, frames.size() / kFarCandidates);
  std::vector<std::size_t> partners;
  for (std::size_t b = 0; b < frames.size(); b += stride) {
    if (std::abs(SecondsBetween(frames.stamp(b), frames.stamp(a))) < kFarPartnerS) continue;
    const std::optional<Se3> pose = frames.T_world_camera(b);
    if (pose && LooksAlike(frames.camera(), T_world_a, *pose)) partners.push_back(b);
  }
  if (partners.empty()) return std::nullopt;
  Rng rng(1, a, kPurposePartner);
  return partners[rng.Index(partners.size())];
}

}  // namespace

std::vector<FramePair> ChoosePairs(const CheckFrames& frames, std::size_t num_anchors) {
  std::vector<FramePair> pairs;
  const std::size_t count = std::min(num_anchors, frames.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t a = k * frames.size() / count;
    if (!frames.T_world_camera(a)) continue;
    if (const auto b = NearPartner(frames, a)) pairs.push_back({a, *b});
    if (const auto b = FarPartner(frames, a)) pairs.push_back({a, *b});
  }
  return pairs;
}

ReprojectionResult CheckReprojection(const CheckFrames& frames, const TrueObjects* objects,
                                     const ReprojectionOptions& options) {
  const PairComparison comparison(frames.camera(), options, objects);
  ReprojectionResult result;
  Differences all;
  std::optional<View> a;
  for (const FramePair& pair : ChoosePairs(frames, options.num_anchors)) {
    if (!a || a->frame != pair.a) a = LoadView(frames, pair.a, objects);
    const std::optional<View> b = a ? LoadView(frames, pair.b, objects) : std::nullopt;
    if (!a || !b) continue;
    Differences differences = comparison.Compare(*a, *b);
    differences.Append(comparison.Compare(*b, *a));
    if (differences.absolute_m.size() + differences.num_hidden < kMinPoints) continue;
    all.Append(differences);
    result.pairs.push_back({.pair = pair, .figures = Summarise(differences)});
  }
  result.all = Summarise(all);
  return result;
}

}  // namespace cslam
