// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/orb.h"

#include "cslam/util/check.h"
#include "cslam/util/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>
#include <vector>

namespace cslam {
namespace {

// A scene of random discs and squares, known at every real position, so that it can be seen
// through any similarity transform without resampling.
class Scene {
 public:
  explicit Scene(std::uint64_t seed) : cells_(kCells * kCells) {
    Rng rng(seed);
    for (int i = 0; i < 700; ++i) {
      const double size = 4.0 + 36.0 * rng.Uniform() * rng.Uniform();
      const Shape shape{rng.Uniform(0.0, kSide), rng.Uniform(0.0, kSide), size,
                        rng.Uniform(20.0, 235.0), rng.Uniform() < 0.5};
      for (int row = CellOf(shape.y - size); row <= CellOf(shape.y + size); ++row) {
        for (int column = CellOf(shape.x - size); column <= CellOf(shape.x + size); ++column) {
          cells_[static_cast<std::size_t>(row * kCells + column)].push_back(shape);
        }
      }
    }
  }

  // x, y: from the scene's centre.
  double At(double x, double y) const {
    x += 0.5 * kSide;
    y += 0.5 * kSide;
    double value = 128.0;
    for (const Shape& s : cells_[static_cast<std::size_t>(CellOf(y) * kCells + CellOf(x))]) {
      const double dx = std::abs(x - s.x);
      const double dy = std::abs(y - s.y);
      const bool is_inside =
          s.is_disc ? dx * dx + dy * dy < s.size * s.size : std::max(dx, dy) < s.size;
      if (is_inside) value = s.value;
    }
    return value;
  }

 private:
  struct Shape {
    double x, y, size, value;
    bool is_disc;
  };
  static constexpr double kSide = 1100.0;
  static constexpr int kCells = 32;
  static int CellOf(double x) {
    return std::clamp(static_cast<int>(x / kSide * kCells), 0, kCells - 1);
  }

  std::vector<std::vector<Shape>> cells_;
};

// Where an image pixel lies in the scene: turned about the image centre, scaled, shifted.
struct View {
  double angle_rad = 0.0, scale = 1.0, shift_x = 0.0, shift_y = 0.0;

  cv::Point2d ToScene(double u, double v) const {
    const double c = scale * std::cos(angle_rad);
    const double s = scale * std::sin(angle_rad);
    return {c * (u - 160) - s * (v - 120) + shift_x, s * (u - 160) + c * (v - 120) + shift_y};
  }
};

constexpr int kWidth = 320;
constexpr int kHeight = 240;

cv::Mat Render(const Scene& scene, const View& view) {
  cv::Mat image(kHeight, kWidth, CV_8UC1);
  constexpr int kSamples = 3;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      double sum = 0.0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const double du = (i % kSamples + 0.5) / kSamples - 0.5;
        const double dv = (i / kSamples + 0.5) / kSamples - 0.5;
        const cv::Point2d p = view.ToScene(u + du, v + dv);
        sum += scene.At(p.x, p.y);
      }
      image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(sum / (kSamples * kSamples));
    }
  }
  return image;
}

const cv::Mat& Picture() {
  static const cv::Mat picture = Render(Scene(1), View{});
  return picture;
}

cv::Mat Noise(cv::Size size) {
  Rng rng(7);
  cv::Mat image(size, CV_8UC1);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(rng.Index(256));
    }
  }
  return image;
}

bool AreEqual(const OrbFeatures& a, const OrbFeatures& b) {
  const auto is_same = [](const Corner& p, const Corner& q) {
    return std::tuple(p.u, p.v, p.angle_rad, p.response, p.octave) ==
           std::tuple(q.u, q.v, q.angle_rad, q.response, q.octave);
  };
  return a.descriptors == b.descriptors && std::equal(a.corners.begin(), a.corners.end(),
                                                      b.corners.begin(), b.corners.end(), is_same);
}

// How features of two views of one scene agree.
struct Agreement {
  int matches = 0;            // mutual nearest neighbours
  int correct = 0;            // of them, less than 3 px (of their level) apart
  double median_error = 0.0;  // of the correct ones, px of their level
  double median_turn_error_rad = 0.0;
};

std::size_t Nearest(const Descriptor& query, const std::vector<Descriptor>& descriptors) {
  const auto nearest = std::ranges::min_element(
      descriptors, {}, [&](const Descriptor& d) { return HammingDistance(query, d); });
  return static_cast<std::size_t>(nearest - descriptors.begin());
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

Agreement Compare(const OrbFeatures& a, const View& view_a, const OrbFeatures& b,
                  const View& view_b) {
  Agreement result;
  std::vector<double> errors;
  std::vector<double> turn_errors;
  for (std::size_t i = 0; i < a.corners.size(); ++i) {
    const std::size_t j = Nearest(a.descriptors[i], b.descriptors);
    if (Nearest(b.descriptors[j], a.descriptors) != i) continue;
    ++result.matches;
    const Corner& ca = a.corners[i];
    const Corner& cb = b.corners[j];
    const cv::Point2d pa = view_a.ToScene(double{ca.u}, double{ca.v});
    const cv::Point2d pb = view_b.ToScene(double{cb.u}, double{cb.v});
    const double error = std::hypot(pa.x - pb.x, pa.y - pb.y) / std::pow(1.2, ca.octave);
    if (error > 3.0) continue;
    ++result.correct;
    errors.push_back(error);
    const double turn =
        double{ca.angle_rad} + view_a.angle_rad - double{cb.angle_rad} - view_b.angle_rad;
    turn_errors.push_back(std::abs(std::remainder(turn, 2.0 * std::numbers::pi)));
  }
  result.median_error = Median(errors);
  result.median_turn_error_rad = Median(turn_errors);
  return result;
}

Agreement CompareViews(const View& view, const OrbOptions& options = {.num_features = 400}) {
  const Scene scene(1);
  OrbExtractor extractor(options);
  const OrbFeatures a = extractor.Extract(Picture());
  const OrbFeatures b = extractor.Extract(Render(scene, view));
  return Compare(a, View{}, b, view);
}

TEST(OrbExtractor, FindsTheSameCornersAndDescriptorsWhenThePictureIsShifted) {
  const Agreement agreement = CompareViews({.shift_x = 5.3, .shift_y = -3.6});
  EXPECT_GT(agreement.correct, 200);
  EXPECT_GT(agreement.correct, 0.85 * agreement.matches);
  EXPECT_LT(agreement.median_error, 0.5);
}

TEST(OrbExtractor, TurnsDescriptorsAlongWhenThePictureIsTurned) {
  for (const double angle_rad : {0.4, 1.7, 3.0, 4.9}) {
    const Agreement agreement = CompareViews({.angle_rad = angle_rad});
    EXPECT_GT(agreement.correct, 110) << "angle " << angle_rad;
    EXPECT_GT(agreement.correct, 0.75 * agreement.matches) << "angle " << angle_rad;
    EXPECT_LT(agreement.median_turn_error_rad, 0.1) << "angle " << angle_rad;
  }
}

TEST(OrbExtractor, FindsCornersOnAnotherLevelWhenThePictureIsScaled) {
  const Agreement agreement = CompareViews({.scale = 1.2 * 1.2});
  EXPECT_GT(agreement.correct, 80);  // of at most about 200: the other view shows twice the area
  EXPECT_GT(agreement.correct, 0.7 * agreement.matches);
}

TEST(OrbExtractor, PlacesCornersBetterWhenSubpixelIsOn) {
  const View view{.shift_x = 3.5, .shift_y = 2.5};
  const Agreement fine = CompareViews(view, {.num_features = 400, .subpixel = true});
  const Agreement coarse = CompareViews(view, {.num_features = 400, .subpixel = false});
  EXPECT_LT(fine.median_error, 0.8 * coarse.median_error);
}

// The corner of a bright quadrant, half covered pixels included, is at (x, y) on every level.
TEST(OrbExtractor, PlacesACornerWithoutBiasOnEveryLevel) {
  OrbExtractor extractor(OrbOptions{});
  std::vector<double> du;
  std::vector<double> dv;
  for (int i = 0; i < 20; ++i) {
    const double x = 150 + 0.35 * i;
    const double y = 120 - 0.21 * i;
    cv::Mat image(kHeight, kWidth, CV_8UC1);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const double cover_x = std::abs(std::clamp(u + 0.5 - x, 0.0, 1.0) * 2.0 - 1.0);
        const double cover_y = std::abs(std::clamp(v + 0.5 - y, 0.0, 1.0) * 2.0 - 1.0);
        const double sign_x = u < x ? -1.0 : 1.0;
        const double sign_y = v < y ? -1.0 : 1.0;
        const double value = 128 + 90 * sign_x * sign_y * cover_x * cover_y;
        image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(value);
      }
    }
    for (const Corner& c : extractor.Extract(image).corners) {
      const double scale = std::pow(1.2, c.octave);
      const double error_u = (double{c.u} - x) / scale;
      const double error_v = (double{c.v} - y) / scale;
      if (std::hypot(error_u, error_v) > 4.0) continue;
      du.push_back(error_u);
      dv.push_back(error_v);
    }
  }
  ASSERT_FALSE(du.empty());
  EXPECT_NEAR(Median(du), 0.0, 0.5);
  EXPECT_NEAR(Median(dv), 0.0, 0.5);
}

TEST(OrbExtractor, GivesTheSameBytesWhenCalledAgain) {
  OrbExtractor extractor(OrbOptions{});
  const OrbFeatures first = extractor.Extract(Picture());
  extractor.Extract(Noise({200, 150}));
  extractor.Extract(Noise({kWidth, kHeight}));
  EXPECT_TRUE(AreEqual(first, extractor.Extract(Picture())));
  EXPECT_TRUE(AreEqual(first, OrbExtractor(OrbOptions{}).Extract(Picture())));
}

TEST(OrbExtractor, DoesNotTouchOrKeepTheImage) {
  cv::Mat image = Picture().clone();
  OrbExtractor extractor(OrbOptions{});
  extractor.Extract(image);
  EXPECT_EQ(image.u->refcount, 1);
  EXPECT_TRUE(std::equal(image.begin<std::uint8_t>(), image.end<std::uint8_t>(),
                         Picture().begin<std::uint8_t>()));
}

TEST(OrbExtractor, TakesAPartOfALargerImage) {
  cv::Mat large = Noise({kWidth + 40, kHeight + 20});
  cv::Mat part = large(cv::Rect(13, 7, kWidth, kHeight));
  Picture().copyTo(part);
  OrbExtractor extractor(OrbOptions{});
  const OrbFeatures expected = extractor.Extract(Picture());
  EXPECT_TRUE(AreEqual(expected, extractor.Extract(part)));
}

TEST(OrbExtractor, SortsByOctaveThenRowThenColumn) {
  const OrbFeatures features = OrbExtractor(OrbOptions{}).Extract(Picture());
  EXPECT_EQ(features.corners.size(), features.descriptors.size());
  EXPECT_TRUE(std::ranges::is_sorted(
      features.corners, {}, [](const Corner& c) { return std::tuple(c.octave, c.v, c.u); }));
}

TEST(OrbExtractor, ReturnsExactlyAsManyAsAskedWhenThePictureHasEnough) {
  for (const int count : {1, 10, 333, 1000, 3000}) {
    OrbExtractor extractor({.num_features = count});
    EXPECT_EQ(extractor.Extract(Noise({640, 480})).corners.size(), static_cast<std::size_t>(count));
  }
}

TEST(OrbExtractor, SharesFeaturesInProportionToTheLevelsSide) {
  OrbExtractor extractor({.num_features = 1000});
  std::vector<int> counts(8);
  for (const Corner& c : extractor.Extract(Noise({640, 480})).corners) {
    ++counts[static_cast<std::size_t>(c.octave)];
  }
  for (std::size_t i = 1; i < counts.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(counts[i - 1]) / counts[i], 1.2, 0.05) << "level " << i;
  }
}

TEST(OrbExtractor, CoversFaintPartsByTheLowThresholdWhenOthersHaveContrast) {
  cv::Mat image = Picture().clone();
  cv::Mat left = image(cv::Rect(0, 0, kWidth / 2, kHeight));
  left.convertTo(left, -1, 0.15, 100);
  const auto num_faint = [&image](int fast_threshold_min) {
    OrbExtractor extractor({.num_features = 400, .fast_threshold_min = fast_threshold_min});
    return std::ranges::count_if(extractor.Extract(image).corners,
                                 [](const Corner& c) { return c.u < kWidth / 2.0F; });
  };
  EXPECT_LT(num_faint(20), 15);
  EXPECT_GT(num_faint(7), 40);
}

TEST(OrbExtractor, FindsNothingInAFlatPicture) {
  OrbExtractor extractor(OrbOptions{});
  const OrbFeatures features = extractor.Extract(cv::Mat(480, 640, CV_8UC1, cv::Scalar(77)));
  EXPECT_TRUE(features.corners.empty());
  EXPECT_TRUE(features.descriptors.empty());
}

TEST(OrbExtractor, FindsNothingInAPictureTooSmallForAPatch) {
  OrbExtractor extractor(OrbOptions{});
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(40, 480), cv::Size(640, 30)}) {
    EXPECT_TRUE(extractor.Extract(Noise(size)).corners.empty())
        << size.width << " x " << size.height;
  }
}

TEST(OrbExtractor, TakesSmallAndOddSizes) {
  for (const cv::Size size : {cv::Size(66, 37), cv::Size(67, 101), cv::Size(131, 69)}) {
    EXPECT_FALSE(OrbExtractor(OrbOptions{}).Extract(Noise(size)).corners.empty())
        << size.width << " x " << size.height;
  }
}

TEST(OrbExtractor, StaysInsideTheMask) {
  cv::Mat mask(kHeight, kWidth, CV_8UC1, cv::Scalar(0));
  mask(cv::Rect(60, 40, 150, 130)).setTo(1);
  OrbOptions options;
  options.subpixel = false;
  const OrbFeatures features = OrbExtractor(options).Extract(Picture(), mask);
  EXPECT_GT(features.corners.size(), 100U);
  for (const Corner& c : features.corners) {
    EXPECT_NE(mask.at<std::uint8_t>(cvRound(c.v), cvRound(c.u)), 0) << c.u << ' ' << c.v;
  }
}

TEST(OrbExtractor, RefusesImagesOfAnotherTypeOrMasksOfAnotherSize) {
  OrbExtractor extractor(OrbOptions{});
  EXPECT_THROW(extractor.Extract(cv::Mat(480, 640, CV_8UC3)), InternalError);
  EXPECT_THROW(extractor.Extract(cv::Mat()), InternalError);
  EXPECT_THROW(extractor.Extract(Picture(), cv::Mat(10, 10, CV_8UC1)), InternalError);
}

TEST(LevelScales, AreAGeometricSeries) {
  OrbOptions options;
  options.num_levels = 3;
  options.scale_factor = 1.5;
  EXPECT_THAT(LevelScales(options), testing::ElementsAre(1.0, 1.5, 2.25));
}

}  // namespace
}  // namespace cslam
