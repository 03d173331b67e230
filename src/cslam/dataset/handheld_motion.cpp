// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/handheld_motion.h"

#include "cslam/util/check.h"
#include "cslam/util/random.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace cslam {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// Position (m), yaw, pitch, roll (rad).
using Numbers = Eigen::Matrix<double, 6, 1>;

Numbers NumbersOf(const TimedView& view) {
  Numbers numbers;
  numbers << view.view.position, view.view.yaw_rad, view.view.pitch_rad, view.roll_rad;
  return numbers;
}

// max(0, x), rounded off over +-width: the integral of the integral of a triangle of area 1.
double RoundedRamp(double x, double width) {
  const double rest = width - std::abs(x);
  const double blend = rest > 0.0 ? rest * rest * rest / (6.0 * width * width) : 0.0;
  return std::max(0.0, x) + blend;
}

// A polygon over time as a sum of ramps, one per corner.
class RoundedPolygon {
 public:
  RoundedPolygon(const std::vector<TimedView>& views, double rounding_s)
      : start_(NumbersOf(views.front())), rounding_s_(rounding_s) {
    Numbers slope = Numbers::Zero();
    for (std::size_t i = 0; i < views.size(); ++i) {
      Numbers next = Numbers::Zero();
      if (i + 1 < views.size()) {
        const double step_s = views[i + 1].time_s - views[i].time_s;
        CSLAM_CHECK(step_s > 0.0, "view {} is not after view {}", i + 1, i);
        next = (NumbersOf(views[i + 1]) - NumbersOf(views[i])) / step_s;
      }
      corners_.push_back({views[i].time_s, next - slope});
      slope = next;
    }
  }

  Numbers At(double time_s) const {
    Numbers sum = start_;
    for (const Corner& corner : corners_)
      sum += RoundedRamp(time_s - corner.time_s, rounding_s_) * corner.change;
    return sum;
  }

 private:
  struct Corner {
    double time_s = 0.0;
    Numbers change;  // of the slope, per s
  };
  Numbers start_;
  double rounding_s_;
  std::vector<Corner> corners_;
};

Eigen::Vector3d Tremble(double time_s, Rng rng) {
  struct Band {
    double share, low_hz, high_hz;
  };
  constexpr std::array<Band, 3> kBands{{{1.0, 0.12, 0.3}, {0.22, 0.6, 1.2}, {0.035, 2.2, 3.8}}};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    for (const Band& band : kBands) {
      const double frequency_hz = rng.Uniform(band.low_hz, band.high_hz);
      const double phase_rad = rng.Uniform(0.0, 2.0 * std::numbers::pi);
      sum[axis] +=
          band.share * std::sin(2.0 * std::numbers::pi * frequency_hz * time_s + phase_rad);
    }
  }
  return sum;
}

// home, moved along its own axes (right, up, forward; m) and turned.
TimedView Near(const PathKey& home, double time_s, const Eigen::Vector3d& offset_m,
               const Eigen::Vector3d& yaw_pitch_roll_rad = Eigen::Vector3d::Zero()) {
  const Eigen::Matrix3d R = PoseAt({home.position, home.yaw_rad, 0.0}).R();
  TimedView view{time_s, home, yaw_pitch_roll_rad.z()};
  view.view.position += R * Eigen::Vector3d(offset_m.x(), -offset_m.y(), offset_m.z());
  view.view.yaw_rad += yaw_pitch_roll_rad.x();
  view.view.pitch_rad += yaw_pitch_roll_rad.y();
  return view;
}

HandTremor TremorOf(std::uint64_t seed) {
  HandTremor tremor;
  tremor.seed = seed;
  return tremor;
}

}  // namespace

CameraMotion HandheldMotion(std::vector<TimedView> views, double rounding_s,
                            const HandTremor& tremor) {
  CSLAM_CHECK(!views.empty() && rounding_s > 0.0);
  const auto polygon = std::make_shared<const RoundedPolygon>(views, rounding_s);
  CameraMotion motion;
  motion.duration_s = views.back().time_s;
  motion.T_world_camera = [polygon, tremor](double time_s) {
    const Numbers at = polygon->At(time_s);
    const Eigen::Vector3d shift_m = tremor.position_m * Tremble(time_s, Rng(tremor.seed, 0, 1));
    const Eigen::Vector3d turn_rad = tremor.rotation_rad * Tremble(time_s, Rng(tremor.seed, 0, 2));
    const Se3 roll(ExpSo3({0.0, 0.0, at[5]}), Eigen::Vector3d::Zero());
    return PoseAt({at.head<3>(), at[3], at[4]}) * roll * Se3(ExpSo3(turn_rad), shift_m);
  };
  return motion;
}

CameraMotion StaticHand(const PathKey& home, double duration_s, std::uint64_t seed) {
  std::vector<TimedView> views{Near(home, 0.0, {0.0, 0.0, 0.0}),
                               Near(home, duration_s, {0.0, 0.0, 0.0})};
  return HandheldMotion(std::move(views), 1.0, TremorOf(seed));
}

CameraMotion XyzHand(const PathKey& home, double duration_s, double mean_speed_m_s,
                     std::uint64_t seed) {
  // Strokes along one axis each, in m from home; the last one leads back to the first.
  static constexpr std::array<std::array<double, 3>, 16> kCorners{{{0.36, 0.0, 0.0},
                                                                   {-0.36, 0.0, 0.02},
                                                                   {0.0, 0.02, 0.0},
                                                                   {0.0, 0.3, 0.0},
                                                                   {0.02, -0.3, 0.02},
                                                                   {0.0, 0.0, 0.0},
                                                                   {0.0, 0.0, 0.3},
                                                                   {0.02, 0.0, -0.4},
                                                                   {0.0, 0.0, 0.0},
                                                                   {-0.38, 0.03, 0.0},
                                                                   {0.4, 0.0, 0.0},
                                                                   {0.02, 0.28, -0.04},
                                                                   {0.0, -0.28, 0.0},
                                                                   {0.0, 0.0, -0.38},
                                                                   {0.02, 0.0, 0.28},
                                                                   {0.0, 0.0, 0.0}}};
  constexpr double kRoundingS = 0.45;
  constexpr double kTurnRad = 2.5 * kDegree;  // no hand keeps the direction on the way
  // Rounding and the meeting of strokes cost some way, which the tremor makes up for in part.
  const double stroke_speed_m_s = 1.12 * mean_speed_m_s;
  Rng rng(seed, 0, 3);
  std::vector<TimedView> views{Near(home, 0.0, {0.0, 0.0, 0.0})};
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; views.back().time_s < duration_s; ++i) {
    const Eigen::Vector3d to = Eigen::Map<const Eigen::Vector3d>(kCorners[i % 16].data());
    const Eigen::Vector3d turn_rad(rng.Uniform(-kTurnRad, kTurnRad),
                                   rng.Uniform(-kTurnRad, kTurnRad),
                                   rng.Uniform(-kTurnRad, kTurnRad));
    const double stroke_s = std::max(0.2, (to - from).norm() / stroke_speed_m_s);
    views.push_back(Near(home, views.back().time_s + stroke_s, to, turn_rad));
    from = to;
  }
  CameraMotion motion = HandheldMotion(std::move(views), kRoundingS, TremorOf(seed));
  motion.duration_s = duration_s;
  return motion;
}

CameraMotion RpyHand(const PathKey& home, double duration_s, std::uint64_t seed) {
  // Turns about one axis each: yaw, pitch, roll in degrees from home.
  static constexpr std::array<std::array<double, 3>, 12> kCorners{{{0.0, 0.0, 24.0},
                                                                   {0.0, 0.0, -24.0},
                                                                   {0.0, 0.0, 0.0},
                                                                   {0.0, 17.0, 0.0},
                                                                   {0.0, -15.0, 0.0},
                                                                   {0.0, 0.0, 0.0},
                                                                   {24.0, 0.0, 2.0},
                                                                   {-24.0, 0.0, -2.0},
                                                                   {0.0, 0.0, 0.0},
                                                                   {2.0, -14.0, -18.0},
                                                                   {-2.0, 14.0, 20.0},
                                                                   {0.0, 0.0, 0.0}}};
  constexpr double kTurnDegPerS = 24.0;
  constexpr double kRoundingS = 0.35;
  constexpr double kArmM = 0.22;  // the camera is turned about the elbow behind it
  Rng rng(seed, 0, 3);
  std::vector<TimedView> views{Near(home, 0.0, {0.0, 0.0, 0.0})};
  Eigen::Vector3d from_deg = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; views.back().time_s < duration_s; ++i) {
    const Eigen::Vector3d to_deg = Eigen::Map<const Eigen::Vector3d>(kCorners[i % 12].data());
    const Eigen::Vector3d arm_m(
        -kArmM * std::sin(to_deg.x() * kDegree) + rng.Uniform(-0.085, 0.085),
        kArmM * std::sin(to_deg.y() * kDegree) + rng.Uniform(-0.085, 0.085),
        rng.Uniform(-0.085, 0.085));
    const double turn_s = (to_deg - from_deg).norm() / kTurnDegPerS;
    views.push_back(Near(home, views.back().time_s + turn_s, arm_m, to_deg * kDegree));
    from_deg = to_deg;
  }
  CameraMotion motion = HandheldMotion(std::move(views), kRoundingS, TremorOf(seed));
  motion.duration_s = duration_s;
  return motion;
}

CameraMotion HalfsphereHand(const PathKey& home, double duration_s, std::uint64_t seed) {
  // Azimuth (positive to the left) and elevation in degrees, as seen from the centre.
  static constexpr std::array<std::array<double, 2>, 10> kCorners{{{0.0, 4.0},
                                                                   {52.0, 8.0},
                                                                   {48.0, 28.0},
                                                                   {-46.0, 26.0},
                                                                   {-56.0, 4.0},
                                                                   {0.0, -6.0},
                                                                   {4.0, 48.0},
                                                                   {40.0, 20.0},
                                                                   {-8.0, 2.0},
                                                                   {-40.0, 40.0}}};
  constexpr double kRadiusM = 0.6;
  constexpr double kSpeedMPerS = 0.225;
  constexpr double kRoundingS = 0.5;
  constexpr double kDownDeg = 12.0;    // the half sphere's middle is a little above its centre
  constexpr double kGazeShare = 0.85;  // the gaze lags behind the way around the centre
  const Eigen::Vector3d forward(std::cos(home.yaw_rad), std::sin(home.yaw_rad), 0.0);
  const Eigen::Vector3d center =
      home.position +
      kRadiusM * (forward - Eigen::Vector3d(0.0, 0.0, std::sin(kDownDeg * kDegree)));
  const auto at = [&](double time_s, double azimuth_deg, double elevation_deg) {
    const double yaw_rad = home.yaw_rad - azimuth_deg * kDegree;
    const double up_rad = (elevation_deg + kDownDeg) * kDegree;
    TimedView view{time_s, home, 0.0};
    view.view.position = center + kRadiusM * Eigen::Vector3d(-std::cos(yaw_rad) * std::cos(up_rad),
                                                             -std::sin(yaw_rad) * std::cos(up_rad),
                                                             std::sin(up_rad));
    view.view.yaw_rad = home.yaw_rad - kGazeShare * azimuth_deg * kDegree;
    view.view.pitch_rad = home.pitch_rad - kGazeShare * elevation_deg * kDegree;
    return view;
  };
  constexpr double kLegDeg = 8.0;  // so that the chords stay near the sphere
  std::vector<TimedView> views{at(0.0, 0.0, 0.0)};
  Eigen::Vector2d from_deg = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; views.back().time_s < duration_s; ++i) {
    const Eigen::Vector2d to_deg = Eigen::Map<const Eigen::Vector2d>(kCorners[i % 10].data());
    const double legs = std::ceil((to_deg - from_deg).norm() / kLegDeg);
    for (double leg = 1.0; leg <= legs; leg += 1.0) {
      const Eigen::Vector2d deg = from_deg + leg / legs * (to_deg - from_deg);
      TimedView next = at(0.0, deg.x(), deg.y());
      const double way_m = (next.view.position - views.back().view.position).norm();
      next.time_s = views.back().time_s + std::max(way_m / kSpeedMPerS, 1e-3);
      views.push_back(next);
    }
    from_deg = to_deg;
  }
  CameraMotion motion = HandheldMotion(std::move(views), kRoundingS, TremorOf(seed));
  motion.duration_s = duration_s;
  return motion;
}

}  // namespace cslam
