// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/simulated_sequence.h"

#include "cslam/sim/room.h"
#include "cslam/sim/test_world.h"
#include "cslam/util/check.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace cslam {
namespace {

// The tour at 320 x 240 without noise; made once, for the room takes half a second.
const SimulatedSequence& CleanTour() {
  static const SimulatedSequence tour =
      MakeDemoSequence({.width = 320, .height = 240, .noise = SensorNoise::kOff});
  return tour;
}

SimulatedSequence TinyTour(std::uint64_t seed) {
  return MakeDemoSequence({.width = 160, .height = 120, .seed = seed});
}

double Difference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L1);
}

// Depth at a sub-pixel place, by interpolating inverse depth (exact on planes); empty at object
// borders and creases.
std::optional<double> InterpolateDepth(const RenderedView& view, const Eigen::Vector2d& uv) {
  const int u = static_cast<int>(std::floor(uv.x()));
  const int v = static_cast<int>(std::floor(uv.y()));
  if (u < 1 || v < 1 || u + 2 >= view.depth_m.cols || v + 2 >= view.depth_m.rows) return {};
  const auto inverse = [&](int du, int dv) {
    return 1.0 / static_cast<double>(view.depth_m.at<float>(v + dv, u + du));
  };
  const auto id = [&](int du, int dv) { return view.instances.at<std::uint16_t>(v + dv, u + du); };
  if (id(0, 0) != id(1, 0) || id(0, 0) != id(0, 1) || id(0, 0) != id(1, 1)) return {};
  const double crease = inverse(0, 0) + inverse(1, 1) - inverse(1, 0) - inverse(0, 1);
  if (std::abs(crease) > 1e-4 * inverse(0, 0)) return {};
  const double a = uv.x() - u;
  const double b = uv.y() - v;
  return 1.0 / ((1.0 - b) * ((1.0 - a) * inverse(0, 0) + a * inverse(1, 0)) +
                b * ((1.0 - a) * inverse(0, 1) + a * inverse(1, 1)));
}

// |depth| errors (m) of the pixels of frame i seen again in frame j.
std::vector<double> ReprojectionErrors(const SimulatedSequence& sequence, int i, int j) {
  const RenderedView from = sequence.Truth(i);
  const RenderedView to = sequence.Truth(j);
  const Se3 T_to_from = sequence.T_world_camera(j).Inverse() * sequence.T_world_camera(i);
  std::vector<double> errors_m;
  for (int v = 0; v < from.depth_m.rows; ++v) {
    for (int u = 0; u < from.depth_m.cols; ++u) {
      const auto z = static_cast<double>(from.depth_m.at<float>(v, u));
      const Eigen::Vector3d p = T_to_from * Unproject(sequence.camera(), {u, v}, z);
      if (p.z() <= 0.1) continue;
      const std::optional<double> seen = InterpolateDepth(to, Project(sequence.camera(), p));
      constexpr double kHiddenM = 0.03;  // something stands before the point
      if (seen && std::abs(*seen - p.z()) < kHiddenM) errors_m.push_back(std::abs(*seen - p.z()));
    }
  }
  std::ranges::sort(errors_m);
  return errors_m;
}

TEST(SimulatedSequence, DepthAgreesBetweenFramesUnderTheTruePoses) {
  const SimulatedSequence& sequence = CleanTour();
  for (const int i : {30, 200, 410}) {
    const std::vector<double> errors_m = ReprojectionErrors(sequence, i, i + 12);
    ASSERT_GT(errors_m.size(), 30000U) << "frame " << i;
    EXPECT_LT(errors_m[errors_m.size() * 95 / 100], 0.001) << "frame " << i;
    EXPECT_LT(errors_m[errors_m.size() / 2], 1e-5) << "frame " << i;
  }
}

TEST(SimulatedSequence, GivesTheSameBytesInAnyOrderAndFromAnyCopy) {
  const SimulatedSequence sequence = TinyTour(1);
  const SimulatedSequence copy = sequence;
  const SimulatedSequence again = TinyTour(1);
  const RgbdFrame first = sequence.Frame(100);
  static_cast<void>(sequence.Frame(7));
  for (const RgbdFrame& frame : {sequence.Frame(100), copy.Frame(100), again.Frame(100)}) {
    EXPECT_EQ(Difference(first.bgr, frame.bgr), 0.0);
    EXPECT_EQ(Difference(first.gray, frame.gray), 0.0);
    EXPECT_EQ(Difference(first.depth_m, frame.depth_m), 0.0);
  }
}

TEST(SimulatedSequence, ChangesRoomAndNoiseWithTheSeed) {
  EXPECT_GT(Difference(TinyTour(1).Frame(0).bgr, TinyTour(2).Frame(0).bgr), 1e5);
}

TEST(SimulatedSequence, CountsAndStampsFramesByRate) {
  const Scene scene = MakeRoom({.texels_per_m = 60.0, .light_cell_m = 1.0});
  const auto make = [&](double fps, int num_frames) {
    return SimulatedSequence(scene, MakeDemoPath(1),
                             {.width = 64, .height = 48, .fps = fps, .num_frames = num_frames});
  };
  EXPECT_EQ(make(30.0, 0).size(), 600);
  EXPECT_EQ(make(15.0, 0).size(), 300);
  const SimulatedSequence sequence = make(15.0, 20);
  EXPECT_EQ(sequence.size(), 20);
  EXPECT_EQ(FormatStamp(sequence.stamp(0)), "1.000000");
  EXPECT_EQ(FormatStamp(sequence.stamp(2)), "1.133333");
  // A lower rate resamples the same story.
  EXPECT_LT(cslam::Difference(make(30.0, 0).T_world_camera(200), make(15.0, 0).T_world_camera(100))
                .distance_m,
            1e-5);
  EXPECT_THROW(static_cast<void>(sequence.Frame(20)), InternalError);
  EXPECT_THROW(static_cast<void>(sequence.Frame(-1)), InternalError);
}

// The test world seen from the front for 7 s.
SimulatedSequence MakeStory(const SequenceOptions& options) {
  const Se3 T_world_camera = PoseAt({{0.0, -2.5, 1.0}, 0.5 * std::numbers::pi, -0.2});
  return SimulatedSequence(test::MakeTestWorld(),
                           {7.0, [T_world_camera](double) { return T_world_camera; }}, options);
}

TEST(SimulatedSequence, TellsTheSameStoryAtAnyRate) {
  const SimulatedSequence fast = MakeStory({.width = 160, .height = 120, .fps = 30.0});
  const SimulatedSequence slow = MakeStory({.width = 160, .height = 120, .fps = 5.0});
  EXPECT_EQ(fast.size(), 210);
  EXPECT_EQ(slow.size(), 35);
  EXPECT_EQ(slow.time_s(16), 3.2);
  EXPECT_EQ(slow.T_world_camera(0).translation.y(), -2.5);
  EXPECT_EQ(Difference(slow.Truth(16).instances, fast.Truth(96).instances), 0.0);
  EXPECT_EQ(Difference(slow.Truth(16).bgr, fast.Truth(96).bgr), 0.0);
}

TEST(SimulatedSequence, TakesTheCameraItIsGiven) {
  const SimulatedSequence sequence =
      MakeStory({.noise = SensorNoise::kD435i, .camera = MakeD435iCamera(160, 120)});
  EXPECT_EQ(sequence.camera(), MakeD435iCamera(160, 120));
  EXPECT_EQ(sequence.options().width, 160);
  EXPECT_EQ(sequence.Frame(0).bgr.size(), cv::Size(160, 120));
}

TEST(SimulatedSequence, ExposesByTimeAndOnlyWhatTheSensorSees) {
  SequenceOptions options{.width = 160, .height = 120, .fps = 10.0, .noise = SensorNoise::kOff};
  const SimulatedSequence plain = MakeStory(options);
  options.exposure = [](double time_s) { return time_s < 1.0 ? 1.0 : 0.2; };
  const SimulatedSequence dimmed = MakeStory(options);
  EXPECT_EQ(Difference(dimmed.Frame(5).bgr, plain.Frame(5).bgr), 0.0);
  EXPECT_EQ(Difference(dimmed.Truth(15).bgr, plain.Truth(15).bgr), 0.0);
  EXPECT_NEAR(cv::mean(dimmed.Frame(15).gray)[0] / cv::mean(plain.Frame(15).gray)[0], 0.48, 0.03);
}

TEST(SimulatedSequence, BlursWhatMovesAndNothingElse) {
  SequenceOptions options{.width = 160, .height = 120, .fps = 10.0};
  const SimulatedSequence sharp = MakeStory(options);
  options.shutter_s = 0.05;
  const SimulatedSequence blurred = MakeStory(options);
  EXPECT_EQ(Difference(sharp.Frame(0).bgr, blurred.Frame(0).bgr), 0.0);
  EXPECT_GT(Difference(sharp.Frame(30).bgr, blurred.Frame(30).bgr), 1000.0);
  EXPECT_EQ(Difference(sharp.Frame(30).depth_m, blurred.Frame(30).depth_m), 0.0);
}

TEST(SimulatedSequence, LooksLikeARoomToADepthSensor) {
  const SimulatedSequence sequence = TinyTour(1);
  double nearest_m = 1e9;
  double farthest_m = 0.0;
  for (int i = 0; i < sequence.size(); i += 20) {
    const RgbdFrame frame = sequence.Frame(i);
    EXPECT_EQ(frame.id, FrameId(static_cast<std::uint32_t>(i)));
    double low_m = 0.0;
    double high_m = 0.0;
    cv::minMaxLoc(frame.depth_m, &low_m, &high_m, nullptr, nullptr, frame.depth_m > 0.0F);
    nearest_m = std::min(nearest_m, low_m);
    farthest_m = std::max(farthest_m, high_m);
    EXPECT_GT(cv::countNonZero(frame.depth_m), 0.85 * 160 * 120) << "frame " << i;
  }
  EXPECT_GT(nearest_m, 0.45);
  EXPECT_LT(nearest_m, 0.7);
  EXPECT_GT(farthest_m, 4.3);
  EXPECT_LT(farthest_m, 5.6);
}

TEST(SimulatedSequence, HasAboutAsManyCornersAsRealRecordings) {
  // cv::FAST at 20 grey levels finds 1115 corners per frame of tum_fr1_desk and 724 per frame of
  // bonn_crowd_part (medians); the project's bar is 0.6 to 1.5 times a recording's count.
  const SimulatedSequence sequence = MakeDemoSequence({});
  std::vector<std::size_t> counts;
  for (int i = 0; i < sequence.size(); i += 85) {
    std::vector<cv::KeyPoint> corners;
    cv::FAST(sequence.Frame(i).gray, corners, 20);
    counts.push_back(corners.size());
    EXPECT_GT(corners.size(), 300U) << "frame " << i;
  }
  std::ranges::sort(counts);
  EXPECT_GT(counts[counts.size() / 2], 669U);
  EXPECT_LT(counts[counts.size() / 2], 1672U);
}

}  // namespace
}  // namespace cslam
