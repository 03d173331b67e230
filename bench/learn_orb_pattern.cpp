// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes the table of binary tests in src/cslam/vision/orb_pattern.inc (printed on stdout).
//
// As in Rublee et al. (ORB, ICCV 2011) the tests are chosen greedily from many random ones. Here
// each choice makes the most of one figure: by how many standard deviations the Hamming distance
// of different corners exceeds that of equal ones. Both are measured on pairs of views of synthetic
// scenes ("dead leaves", whose statistics are close to those of natural images).
#include "cslam/util/random.h"
#include "cslam/vision/orb_distribute.h"
#include "cslam/vision/orb_kernels.h"
#include "cslam/vision/orb_pattern.h"

#include <fmt/core.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace cslam::orb {
namespace {

constexpr int kNumScenes = 40;
constexpr int kCornersPerView = 700;
constexpr int kNumCandidateTests = 120'000;
// Of the Hamming distance of equal corners, bits^2; real pairs scatter that much by blur, noise
// and turning. Without it the choice strives too much for independent, hence weaker, tests.
constexpr double kVarianceOfEqual = 200.0;
constexpr double kCanvasScale = 3.0;  // canvas pixels per view pixel
constexpr int kMostMotionBlur = 6;    // px
constexpr int kWidth = 640;
constexpr int kHeight = 480;

// Leaves of all sizes, small ones more frequent, over soft noise of all scales.
cv::Mat MakeCanvas(Rng& rng) {
  const cv::Size size(static_cast<int>(kWidth * kCanvasScale * 1.6),
                      static_cast<int>(kHeight * kCanvasScale * 1.8));
  cv::Mat canvas(size, CV_32FC1, cv::Scalar(128));
  for (int i = 0; i < 9000; ++i) {
    const double radius = 4.0 / std::sqrt(1e-4 + rng.Uniform() * (1.0 - 1e-4));
    const cv::Point2d center(rng.Uniform(0.0, size.width), rng.Uniform(0.0, size.height));
    const cv::Scalar grey(rng.Uniform(10.0, 245.0));
    const int num_corners = 3 + static_cast<int>(rng.Index(6));
    const double turn = rng.Uniform(0.0, 2.0 * std::numbers::pi);
    const double aspect = rng.Uniform(0.3, 1.0);
    std::vector<cv::Point> polygon;
    for (int k = 0; k < (num_corners == 8 ? 40 : num_corners); ++k) {
      const double angle = 2.0 * std::numbers::pi * k / (num_corners == 8 ? 40 : num_corners);
      const double x = radius * std::cos(angle);
      const double y = radius * aspect * std::sin(angle);
      polygon.emplace_back(cvRound(center.x + x * std::cos(turn) - y * std::sin(turn)),
                           cvRound(center.y + x * std::sin(turn) + y * std::cos(turn)));
    }
    cv::fillConvexPoly(canvas, polygon, grey);
  }
  for (int cells = 8; cells <= 1024; cells *= 2) {
    cv::Mat noise(cells * 3 / 4, cells, CV_32FC1);
    for (float& value : cv::Mat_<float>(noise))
      value = static_cast<float>(rng.Gaussian() * 4.0);
    cv::resize(noise, noise, size, 0, 0, cv::INTER_CUBIC);
    canvas += noise;
  }
  cv::GaussianBlur(canvas, canvas, cv::Size(), 1.5);
  return canvas;
}

struct Feature {
  cv::Point2d canvas_px;
  std::vector<std::uint8_t> samples;  // smoothed grey at each point of the disc, turned
};

struct View {
  cv::Mat image, blurred;
  cv::Matx23d canvas_from_view;
};

View MakeView(const cv::Mat& canvas, Rng& rng) {
  const double angle = rng.Uniform(0.0, 2.0 * std::numbers::pi);
  const double scale = kCanvasScale * rng.Uniform(0.92, 1.08);
  const double c = scale * std::cos(angle);
  const double s = scale * std::sin(angle);
  const double x = 0.5 * canvas.cols + rng.Uniform(-30.0, 30.0);
  const double y = 0.5 * canvas.rows + rng.Uniform(-30.0, 30.0);
  View view;
  view.canvas_from_view = {c, -s, x - c * kWidth / 2 + s * kHeight / 2,
                           s, c,  y - s * kWidth / 2 - c * kHeight / 2};
  cv::Mat grey;
  cv::warpAffine(canvas, grey, view.canvas_from_view, cv::Size(kWidth, kHeight),
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REFLECT);
  const int blur_px = 1 + static_cast<int>(rng.Index(kMostMotionBlur));
  cv::blur(grey, grey, rng.Uniform() < 0.5 ? cv::Size(blur_px, 1) : cv::Size(1, blur_px));
  const double gain = rng.Uniform(0.85, 1.1);
  for (float& value : cv::Mat_<float>(grey)) {
    value = static_cast<float>(double{value} * gain + 3.0 * rng.Gaussian());
  }
  grey.convertTo(view.image, CV_8UC1);
  Blur(view.image, BestSimd(), view.blurred);
  return view;
}

std::vector<cv::Point> DiscPoints() {
  std::vector<cv::Point> points;
  for (int y = -kPatchRadius; y <= kPatchRadius; ++y) {
    for (int x = -kPatchRadius; x <= kPatchRadius; ++x) {
      if (x * x + y * y <= kPatchRadius * kPatchRadius) points.emplace_back(x, y);
    }
  }
  return points;
}

std::vector<Feature> Detect(const View& view, const std::vector<cv::Point>& disc) {
  const cv::Rect area(kBorder, kBorder, kWidth - 2 * kBorder, kHeight - 2 * kBorder);
  cv::Mat scores;
  cv::Mat smoothed;
  FastScores(view.image, 12, BestSimd(), scores);
  SmoothScores(scores, BestSimd(), smoothed);
  const std::vector<Candidate> maxima = LocalMaxima(scores, smoothed, BestSimd());
  std::vector<Feature> features;
  for (const Candidate& c : SelectEvenly(maxima, area, kCornersPerView, BestSimd())) {
    const Moments m = DiscMoments(view.image, c.x, c.y, BestSimd());
    const double angle = std::atan2(m.y, m.x);
    constexpr double kStep = 2.0 * std::numbers::pi / RotatedPattern::kSteps;
    const double cos = std::cos(std::round(angle / kStep) * kStep);
    const double sin = std::sin(std::round(angle / kStep) * kStep);
    const cv::Vec2d p = view.canvas_from_view * cv::Vec3d(c.x, c.y, 1.0);
    Feature feature{{p[0], p[1]}, {}};
    for (const cv::Point& q : disc) {
      const auto x = static_cast<int>(std::lround(cos * q.x - sin * q.y));
      const auto y = static_cast<int>(std::lround(sin * q.x + cos * q.y));
      feature.samples.push_back(view.blurred.at<std::uint8_t>(c.y + y, c.x + x));
    }
    features.push_back(std::move(feature));
  }
  return features;
}

struct FeaturePair {
  std::vector<std::uint8_t> first, second;  // samples
};

// Corners found in two views of a scene at the same place, to 1.5 px.
std::vector<FeaturePair> MakePairs(const std::vector<cv::Point>& disc) {
  std::vector<FeaturePair> pairs;
  for (int scene = 0; scene < kNumScenes; ++scene) {
    Rng rng(2026, static_cast<std::uint64_t>(scene));
    const cv::Mat canvas = MakeCanvas(rng);
    const std::vector<Feature> first = Detect(MakeView(canvas, rng), disc);
    const std::vector<Feature> second = Detect(MakeView(canvas, rng), disc);
    for (const Feature& a : first) {
      const auto distance = [&a](const Feature& b) { return cv::norm(a.canvas_px - b.canvas_px); };
      const auto b = std::ranges::min_element(second, {}, distance);
      if (b != second.end() && distance(*b) < 1.5 * kCanvasScale) {
        pairs.push_back({a.samples, b->samples});
      }
    }
  }
  return pairs;
}

// The outcomes of one test on all pairs.
struct Outcomes {
  TestPair test;
  std::vector<std::uint64_t> bits;  // of the first features
  double mean = 0.0;                // of the bits
  double gain = 0.0;                // P(differ | other corner) - P(differ | same corner)
};

Outcomes Run(cv::Point a, cv::Point b, std::size_t index_a, std::size_t index_b,
             const std::vector<FeaturePair>& pairs) {
  Outcomes outcomes;
  outcomes.test = {static_cast<std::int8_t>(a.x), static_cast<std::int8_t>(a.y),
                   static_cast<std::int8_t>(b.x), static_cast<std::int8_t>(b.y)};
  outcomes.bits.resize((pairs.size() + 63) / 64);
  int num_set = 0;
  int num_flips = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool first = pairs[i].first[index_a] < pairs[i].first[index_b];
    const bool second = pairs[i].second[index_a] < pairs[i].second[index_b];
    num_set += first ? 1 : 0;
    num_flips += first != second ? 1 : 0;
    outcomes.bits[i / 64] |= static_cast<std::uint64_t>(first) << (i % 64);
  }
  const auto count = static_cast<double>(pairs.size());
  outcomes.mean = num_set / count;
  outcomes.gain = 2.0 * outcomes.mean * (1.0 - outcomes.mean) - num_flips / count;
  return outcomes;
}

std::vector<Outcomes> RunCandidates(const std::vector<cv::Point>& disc,
                                    const std::vector<FeaturePair>& pairs) {
  Rng rng(1);
  std::set<std::pair<std::size_t, std::size_t>> tried;
  std::vector<Outcomes> candidates;
  for (int i = 0; i < kNumCandidateTests; ++i) {
    const auto [a, b] = std::minmax({rng.Index(disc.size()), rng.Index(disc.size())});
    if (a == b || !tried.insert({a, b}).second) continue;
    candidates.push_back(Run(disc[a], disc[b], a, b, pairs));
  }
  return candidates;
}

// Covariance over pairs of different corners of whether test a differs and whether test b does.
double DifferenceCovariance(const Outcomes& a, const Outcomes& b, std::size_t count) {
  int num_unequal = 0;
  for (std::size_t i = 0; i < a.bits.size(); ++i) {
    num_unequal += std::popcount(a.bits[i] ^ b.bits[i]);
  }
  const double product = 1.0 - 2.0 * num_unequal / static_cast<double>(count);
  const double product_of_means = (1.0 - 2.0 * a.mean) * (1.0 - 2.0 * b.mean);
  return 0.25 * (product * product - product_of_means * product_of_means);
}

// Adds test after test, each time the one with which the Hamming distance of different corners
// exceeds that of equal ones by the most of its standard deviations.
std::vector<TestPair> Choose(const std::vector<Outcomes>& candidates, std::size_t count) {
  std::vector<double> covariance(candidates.size(), 0.0);  // with the sum of the chosen ones
  std::vector<bool> is_chosen(candidates.size(), false);
  std::vector<double> variance;
  for (const Outcomes& c : candidates)
    variance.push_back(DifferenceCovariance(c, c, count));
  std::vector<TestPair> tests;
  double gap = 0.0;
  double sum_variance = kVarianceOfEqual;
  while (tests.size() < 256) {
    std::size_t best = 0;
    double best_ratio = -1.0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const double ratio =
          (gap + candidates[i].gain) / std::sqrt(sum_variance + 2.0 * covariance[i] + variance[i]);
      if (is_chosen[i] || ratio <= best_ratio) continue;
      best = i;
      best_ratio = ratio;
    }
    is_chosen[best] = true;
    gap += candidates[best].gain;
    sum_variance += 2.0 * covariance[best] + variance[best];
    tests.push_back(candidates[best].test);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      covariance[i] += DifferenceCovariance(candidates[best], candidates[i], count);
    }
    if (std::has_single_bit(tests.size())) {
      fmt::print(stderr, "{} tests: gap {:.1f}, {:.2f} standard deviations\n", tests.size(), gap,
                 best_ratio);
    }
  }
  return tests;
}

}  // namespace
}  // namespace cslam::orb

int main() {
  using namespace cslam::orb;  // NOLINT(google-build-using-namespace): a tool of one file
  cv::setNumThreads(1);
  const std::vector<cv::Point> disc = DiscPoints();
  const std::vector<FeaturePair> pairs = MakePairs(disc);
  fmt::print(stderr, "{} pairs of features\n", pairs.size());
  const std::vector<Outcomes> candidates = RunCandidates(disc, pairs);
  fmt::print(
      "// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors\n"
      "// SPDX-License-Identifier: Apache-2.0\n"
      "// Printed by bench/learn_orb_pattern.cpp, the most telling tests first.\n");
  for (const TestPair& t : Choose(candidates, pairs.size())) {
    fmt::print("{{{}, {}, {}, {}}},\n", t.ax, t.ay, t.bx, t.by);
  }
}
