// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// ORB extraction, whole and step by step, on a synthetic 640x480 picture with about as many
// corners as an office.
#include "cslam/util/random.h"
#include "cslam/vision/orb.h"
#include "cslam/vision/orb_distribute.h"
#include "cslam/vision/orb_kernels.h"
#include "cslam/vision/orb_pattern.h"

#include <benchmark/benchmark.h>
#include <opencv2/features2d.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace cslam {
namespace {

cv::Mat Picture() {
  Rng rng(1);
  cv::Mat sharp(480, 640, CV_8UC1, cv::Scalar(120));
  for (int i = 0; i < 400; ++i) {
    const cv::Rect box(
        static_cast<int>(rng.Uniform(-20.0, 640.0)), static_cast<int>(rng.Uniform(-20.0, 480.0)),
        static_cast<int>(rng.Uniform(4.0, 60.0)), static_cast<int>(rng.Uniform(4.0, 60.0)));
    sharp(box & cv::Rect(0, 0, 640, 480)).setTo(rng.Uniform(30.0, 220.0));
  }
  cv::Mat picture = sharp.clone();
  orb::Blur(sharp, orb::BestSimd(), picture);
  for (std::uint8_t& value : cv::Mat_<std::uint8_t>(picture)) {
    value = static_cast<std::uint8_t>(value + rng.Uniform(-4.0, 4.0));
  }
  return picture;
}

// The picture's pyramid, as OrbExtractor has it.
std::vector<cv::Mat> Pyramid(orb::Simd simd) {
  std::vector<cv::Mat> levels = {Picture()};
  for (const double scale : LevelScales(OrbOptions{})) {
    if (scale == 1.0) continue;
    const cv::Size size(static_cast<int>(std::lround(640 / scale)),
                        static_cast<int>(std::lround(480 / scale)));
    cv::Mat smaller;
    orb::Downscaler(levels.back().size(), size).Run(levels.back(), simd, smaller);
    levels.push_back(smaller);
  }
  return levels;
}

cv::Rect AreaOf(const cv::Mat& level) {
  return {orb::kBorder, orb::kBorder, level.cols - 2 * orb::kBorder, level.rows - 2 * orb::kBorder};
}

std::vector<std::vector<orb::Candidate>> Maxima(const std::vector<cv::Mat>& levels) {
  std::vector<std::vector<orb::Candidate>> maxima;
  for (const cv::Mat& level : levels) {
    cv::Mat scores, smoothed;
    orb::FastScores(level, 7, orb::BestSimd(), scores);
    orb::SmoothScores(scores, orb::BestSimd(), smoothed);
    maxima.push_back(orb::LocalMaxima(scores, smoothed, orb::BestSimd()));
  }
  return maxima;
}

orb::Simd SimdOf(const benchmark::State& state) {
  return state.range(0) != 0 ? orb::BestSimd() : orb::Simd::kBaseline;
}

void BM_Extract(benchmark::State& state) {
  const cv::Mat picture = Picture();
  OrbExtractor extractor({.num_features = static_cast<int>(state.range(0))});
  std::size_t count = 0;
  for (auto _ : state)
    count = extractor.Extract(picture).corners.size();
  state.counters["features"] = static_cast<double>(count);
}
BENCHMARK(BM_Extract)->Arg(500)->Arg(1000)->Arg(2000)->Unit(benchmark::kMicrosecond);

void BM_OpenCvOrbForComparison(benchmark::State& state) {
  const cv::Mat picture = Picture();
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(1000, 1.2F, 8, 19, 0, 2, cv::ORB::FAST_SCORE, 31, 7);
  for (auto _ : state) {
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
    orb->detectAndCompute(picture, cv::noArray(), keypoints, descriptors);
    benchmark::DoNotOptimize(descriptors.data);
  }
}
BENCHMARK(BM_OpenCvOrbForComparison)->Unit(benchmark::kMicrosecond);

// Argument of the steps: 0 baseline instructions, 1 the best this machine has.
void BM_StepPyramid(benchmark::State& state) {
  std::vector<cv::Mat> levels = Pyramid(orb::BestSimd());
  std::vector<orb::Downscaler> scalers;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    scalers.emplace_back(levels[i - 1].size(), levels[i].size());
  }
  for (auto _ : state) {
    for (std::size_t i = 1; i < levels.size(); ++i) {
      scalers[i - 1].Run(levels[i - 1], SimdOf(state), levels[i]);
    }
  }
}
BENCHMARK(BM_StepPyramid)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void BM_StepDetect(benchmark::State& state) {
  const std::vector<cv::Mat> levels = Pyramid(orb::BestSimd());
  std::vector<cv::Mat> scores(levels.size());
  cv::Mat smoothed;
  std::size_t count = 0;
  for (auto _ : state) {
    count = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      orb::FastScores(levels[i], 7, SimdOf(state), scores[i]);
      orb::SmoothScores(scores[i], SimdOf(state), smoothed);
      count += orb::LocalMaxima(scores[i], smoothed, SimdOf(state)).size();
    }
  }
  state.counters["candidates"] = static_cast<double>(count);
}
BENCHMARK(BM_StepDetect)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void BM_StepDistribute(benchmark::State& state) {
  const std::vector<cv::Mat> levels = Pyramid(orb::BestSimd());
  const std::vector<std::vector<orb::Candidate>> maxima = Maxima(levels);
  for (auto _ : state) {
    double count = 217.0;  // of 1000 on the finest level
    for (std::size_t i = 0; i < levels.size(); ++i, count /= 1.2) {
      const cv::Rect area = AreaOf(levels[i]);
      const auto thinned = orb::ThinOut(maxima[i], area, 20, static_cast<int>(count));
      benchmark::DoNotOptimize(
          orb::SelectEvenly(thinned, area, static_cast<int>(count), SimdOf(state)).data());
    }
  }
}
BENCHMARK(BM_StepDistribute)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void BM_StepBlur(benchmark::State& state) {
  const std::vector<cv::Mat> levels = Pyramid(orb::BestSimd());
  std::vector<cv::Mat> blurred(levels.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
      orb::Blur(levels[i], SimdOf(state), blurred[i]);
    }
  }
}
BENCHMARK(BM_StepBlur)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

// 1000 corners spread over the finest level.
std::vector<orb::Candidate> Corners(const cv::Mat& picture) {
  return orb::SelectEvenly(Maxima({picture})[0], AreaOf(picture), 1000, orb::BestSimd());
}

void BM_StepOrient(benchmark::State& state) {
  const cv::Mat picture = Picture();
  const std::vector<orb::Candidate> corners = Corners(picture);
  for (auto _ : state) {
    for (const orb::Candidate& c : corners) {
      const orb::Moments m = orb::DiscMoments(picture, c.x, c.y, SimdOf(state));
      benchmark::DoNotOptimize(std::atan2(static_cast<float>(m.y), static_cast<float>(m.x)));
    }
  }
}
BENCHMARK(BM_StepOrient)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void BM_StepDescribe(benchmark::State& state) {
  const cv::Mat picture = Picture();
  const std::vector<orb::Candidate> corners = Corners(picture);
  const orb::RotatedPattern pattern(orb::TestPattern());
  for (auto _ : state) {
    float angle_rad = 0.0F;
    for (const orb::Candidate& c : corners) {
      angle_rad = std::fmod(angle_rad + 1.0F, 6.28F);
      benchmark::DoNotOptimize(pattern.Describe(picture, c.x, c.y, angle_rad));
    }
  }
}
BENCHMARK(BM_StepDescribe)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cslam

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
