// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/optim/pose_optimizer.h"

#include "cslam/optim/residuals.h"
#include "cslam/util/options.h"

#include <Eigen/Cholesky>

#include <array>
#include <cmath>
#include <cstddef>

namespace cslam {
namespace {

constexpr std::size_t kLanes = 8;  // observations handled together, one per SIMD lane
using Lanes = std::array<double, kLanes>;

constexpr Lanes Ones() {
  Lanes ones{};
  ones.fill(1.0);
  return ones;
}

constexpr double kBehindChi2 = 1e4;      // of a point that a step brings behind the camera
constexpr double kCostTolerance = 1e-6;  // a round ends when a step gains less than this share
constexpr double kChi2Tolerance = 1e-9;  // ... or less than this in all
constexpr double kStartDamping = 1e-5;   // share of the diagonal
constexpr double kLargestDamping = 1e6;  // beyond, no step helps
constexpr double kDampingFactor = 10.0;  // up after a bad step, down after a good one
constexpr std::size_t kMinObservations = 3;

// kLanes observations side by side; unused lanes have no information.
struct alignas(64) ObservationBlock {
  Lanes x{}, y{}, z{};          // p_world
  Lanes u{}, v{}, disparity{};  // u and v from the principal point
  Lanes information_px{}, information_disparity{};
  Lanes threshold = Ones();  // chi2
  Lanes kernel = Ones();     // chi2
  Lanes weight{};
  Lanes active{};  // the weight if it takes part, otherwise 0
};

// Sums per lane; the normal equations' lower triangle row by row.
struct alignas(64) NormalSums {
  std::array<Lanes, 21> hessian{};
  std::array<Lanes, 6> gradient{};
  Lanes cost{};
};

struct NormalEquations {
  Matrix6 hessian = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  double cost = 0.0;  // sum of chi2, with the kernel if it is on
};

enum class Kernel { kNone, kCauchy };

struct Errors {
  Lanes a, b, inverse_z;  // x / z, y / z, 1 / z
  Lanes u, v, disparity;
  Lanes chi2, is_in_front;
};

// World to camera, as plain numbers for the lanes.
struct CameraFromWorld {
  explicit CameraFromWorld(const Se3& T_world_camera)
      : R(T_world_camera.R().transpose()), t(-(R * T_world_camera.translation)) {}
  Eigen::Matrix3d R;
  Eigen::Vector3d t;
};

Errors ComputeErrors(const PixelDisparityModel& model, const CameraFromWorld& pose,
                     const ObservationBlock& block) {
  const Eigen::Matrix3d R = pose.R;
  const Eigen::Vector3d t = pose.t;
  const double fx = model.fx();
  const double fy = model.fy();
  const double fx_baseline = model.fx_baseline();
  Errors e;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = R(0, 0) * block.x[i] + R(0, 1) * block.y[i] + R(0, 2) * block.z[i] + t(0);
    const double y = R(1, 0) * block.x[i] + R(1, 1) * block.y[i] + R(1, 2) * block.z[i] + t(1);
    const double z = R(2, 0) * block.x[i] + R(2, 1) * block.y[i] + R(2, 2) * block.z[i] + t(2);
    e.is_in_front[i] = z >= kMinProjectionDepth ? 1.0 : 0.0;
    e.inverse_z[i] = 1.0 / (z >= kMinProjectionDepth ? z : 1.0);
    e.a[i] = x * e.inverse_z[i];
    e.b[i] = y * e.inverse_z[i];
    e.u[i] = fx * e.a[i] - block.u[i];
    e.v[i] = fy * e.b[i] - block.v[i];
    e.disparity[i] = fx_baseline * e.inverse_z[i] - block.disparity[i];
    const double chi2 = block.information_px[i] * (e.u[i] * e.u[i] + e.v[i] * e.v[i]) +
                        block.information_disparity[i] * e.disparity[i] * e.disparity[i];
    e.chi2[i] = z >= kMinProjectionDepth ? chi2 : kBehindChi2;
  }
  return e;
}

constexpr std::size_t LowerIndex(std::size_t row, std::size_t column) {
  return row * (row + 1) / 2 + column;
}

// Adds weight * J^T J and weight * J^T error of one residual row, whose Jacobian is zero outside
// the given (ascending) columns.
template <std::size_t... kColumns>
void AddRow(const std::array<Lanes, sizeof...(kColumns)>& jacobian, const Lanes& weight,
            const Lanes& error, NormalSums& sums) {
  constexpr std::array<std::size_t, sizeof...(kColumns)> kColumn{kColumns...};
#pragma GCC unroll 6
  for (std::size_t r = 0; r < kColumn.size(); ++r) {
    Lanes weighted;
    for (std::size_t i = 0; i < kLanes; ++i)
      weighted[i] = weight[i] * jacobian[r][i];
    Lanes& gradient = sums.gradient[kColumn[r]];
    for (std::size_t i = 0; i < kLanes; ++i)
      gradient[i] += weighted[i] * error[i];
#pragma GCC unroll 6
    for (std::size_t c = 0; c <= r; ++c) {
      Lanes& hessian = sums.hessian[LowerIndex(kColumn[r], kColumn[c])];
      for (std::size_t i = 0; i < kLanes; ++i)
        hessian[i] += weighted[i] * jacobian[c][i];
    }
  }
}

// Derivatives by x of T_world_camera * Exp(x): p_camera moves by [Skew(p_camera), -I] * x.
void AddRows(const PixelDisparityModel& model, const Errors& e, const Lanes& weight_px,
             const Lanes& weight_disparity, NormalSums& sums) {
  const double fx = model.fx();
  const double fy = model.fy();
  const double fx_baseline = model.fx_baseline();
  std::array<Lanes, 5> by_u;          // columns 0 1 2 3 5
  std::array<Lanes, 5> by_v;          // columns 0 1 2 4 5
  std::array<Lanes, 3> by_disparity;  // columns 0 1 5
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double a = e.a[i];
    const double b = e.b[i];
    const double inverse_z = e.inverse_z[i];
    by_u[0][i] = fx * a * b;
    by_u[1][i] = -fx * (1.0 + a * a);
    by_u[2][i] = fx * b;
    by_u[3][i] = -fx * inverse_z;
    by_u[4][i] = fx * a * inverse_z;
    by_v[0][i] = fy * (1.0 + b * b);
    by_v[1][i] = -fy * a * b;
    by_v[2][i] = -fy * a;
    by_v[3][i] = -fy * inverse_z;
    by_v[4][i] = fy * b * inverse_z;
    by_disparity[0][i] = fx_baseline * b * inverse_z;
    by_disparity[1][i] = -fx_baseline * a * inverse_z;
    by_disparity[2][i] = fx_baseline * inverse_z * inverse_z;
  }
  AddRow<0, 1, 2, 3, 5>(by_u, weight_px, e.u, sums);
  AddRow<0, 1, 2, 4, 5>(by_v, weight_px, e.v, sums);
  AddRow<0, 1, 5>(by_disparity, weight_disparity, e.disparity, sums);
}

void AddBlock(const PixelDisparityModel& model, const CameraFromWorld& pose,
              const ObservationBlock& block, Kernel kernel, NormalSums& sums) {
  const Errors e = ComputeErrors(model, pose, block);
  Lanes weight;
  if (kernel == Kernel::kCauchy) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double stretched = 1.0 + e.chi2[i] / block.kernel[i];
      weight[i] = block.active[i] / stretched;
      sums.cost[i] += block.active[i] * block.kernel[i] * std::log(stretched);
    }
  } else {
    for (std::size_t i = 0; i < kLanes; ++i) {
      weight[i] = block.active[i];
      sums.cost[i] += block.active[i] * e.chi2[i];
    }
  }
  Lanes weight_px;
  Lanes weight_disparity;
  for (std::size_t i = 0; i < kLanes; ++i) {
    weight_px[i] = weight[i] * e.is_in_front[i] * block.information_px[i];
    weight_disparity[i] = weight[i] * e.is_in_front[i] * block.information_disparity[i];
  }
  AddRows(model, e, weight_px, weight_disparity, sums);
}

double Sum(const Lanes& lanes) {
  double sum = 0.0;
  for (const double value : lanes)
    sum += value;
  return sum;
}

// The observations in lanes, with who takes part.
class PoseProblem {
 public:
  PoseProblem(const Camera& camera, double baseline_m,
              std::span<const PoseObservation> observations, const PoseOptimizerOptions& options)
      : model_(camera, baseline_m),
        blocks_((observations.size() + kLanes - 1) / kLanes),
        is_usable_(observations.size()) {
    for (std::size_t i = 0; i < observations.size(); ++i) {
      const Measurement m = MeasurementOf(observations[i]);
      is_usable_[i] = m.is_usable && observations[i].p_world.allFinite() &&
                      std::isfinite(observations[i].weight) && observations[i].weight > 0.0;
      if (!is_usable_[i]) continue;
      ObservationBlock& block = blocks_[i / kLanes];
      const std::size_t lane = i % kLanes;
      block.x[lane] = observations[i].p_world.x();
      block.y[lane] = observations[i].p_world.y();
      block.z[lane] = observations[i].p_world.z();
      block.u[lane] = m.value.x() - camera.cx;
      block.v[lane] = m.value.y() - camera.cy;
      block.disparity[lane] = m.value.z();
      block.information_px[lane] = observations[i].information_px;
      block.information_disparity[lane] =
          m.has_disparity ? observations[i].information_disparity : 0.0;
      block.weight[lane] = observations[i].weight;
      block.kernel[lane] = options.kernel_chi2;
      block.threshold[lane] = m.has_disparity ? options.chi2_depth : options.chi2_mono;
    }
  }

  NormalEquations Linearise(const Se3& T_world_camera, Kernel kernel) const {
    const CameraFromWorld pose(T_world_camera);
    NormalSums sums;
    for (const ObservationBlock& block : blocks_)
      AddBlock(model_, pose, block, kernel, sums);
    NormalEquations equations;
    for (std::size_t row = 0; row < 6; ++row) {
      const auto r = static_cast<Eigen::Index>(row);
      equations.gradient(r) = Sum(sums.gradient[row]);
      for (std::size_t column = 0; column <= row; ++column) {
        const auto c = static_cast<Eigen::Index>(column);
        equations.hessian(r, c) = Sum(sums.hessian[LowerIndex(row, column)]);
        equations.hessian(c, r) = equations.hessian(r, c);
      }
    }
    equations.cost = Sum(sums.cost);
    return equations;
  }

  // Whether each observation fits the pose.
  std::vector<std::uint8_t> Judge(const Se3& T_world_camera) const {
    const CameraFromWorld pose(T_world_camera);
    std::vector<std::uint8_t> is_inlier(is_usable_.size());
    for (std::size_t i = 0; i < is_inlier.size(); i += kLanes) {
      const ObservationBlock& block = blocks_[i / kLanes];
      const Errors e = ComputeErrors(model_, pose, block);
      for (std::size_t lane = 0; lane < kLanes && i + lane < is_inlier.size(); ++lane) {
        is_inlier[i + lane] = is_usable_[i + lane] && e.is_in_front[lane] > 0.0 &&
                              e.chi2[lane] <= block.threshold[lane];
      }
    }
    return is_inlier;
  }

  // Usable observations whose point lies in front of the camera.
  std::vector<std::uint8_t> InFront(const Se3& T_world_camera) const {
    const CameraFromWorld pose(T_world_camera);
    std::vector<std::uint8_t> is_in_front(is_usable_.size());
    for (std::size_t i = 0; i < is_in_front.size(); ++i) {
      const Errors e = ComputeErrors(model_, pose, blocks_[i / kLanes]);
      is_in_front[i] = is_usable_[i] && e.is_in_front[i % kLanes] > 0.0;
    }
    return is_in_front;
  }

  void Activate(const std::vector<std::uint8_t>& is_active) {
    for (std::size_t i = 0; i < is_active.size(); ++i) {
      ObservationBlock& block = blocks_[i / kLanes];
      block.active[i % kLanes] = is_active[i] ? block.weight[i % kLanes] : 0.0;
    }
  }

 private:
  PixelDisparityModel model_;
  std::vector<ObservationBlock> blocks_;
  std::vector<std::uint8_t> is_usable_;
};

struct RoundResult {
  Se3 T_world_camera;
  int iterations = 0;
};

// Levenberg-Marquardt over the active observations. The cost never rises.
RoundResult Minimise(const PoseProblem& problem, const Se3& start, int max_iterations) {
  RoundResult result{.T_world_camera = start};
  NormalEquations current = problem.Linearise(start, Kernel::kCauchy);
  double damping = kStartDamping;
  while (result.iterations < max_iterations && damping <= kLargestDamping) {
    ++result.iterations;
    Matrix6 damped = current.hessian;
    damped.diagonal() *= 1.0 + damping;
    const Eigen::LLT<Matrix6> cholesky(damped);
    const Vector6 step = -cholesky.solve(current.gradient);
    if (cholesky.info() != Eigen::Success || !step.allFinite()) {
      damping *= kDampingFactor;
      continue;
    }
    const double expected_gain = -step.dot(2.0 * current.gradient + current.hessian * step);
    if (!(expected_gain > kCostTolerance * current.cost + kChi2Tolerance)) break;
    const Se3 trial = result.T_world_camera * Exp(step);
    const NormalEquations next = problem.Linearise(trial, Kernel::kCauchy);
    if (!(next.cost < current.cost)) {
      damping *= kDampingFactor;
      continue;
    }
    const double gain = current.cost - next.cost;
    result.T_world_camera = trial;
    current = next;
    damping /= kDampingFactor;
    if (gain <= kCostTolerance * current.cost) break;
  }
  return result;
}

std::size_t Count(const std::vector<std::uint8_t>& flags) {
  std::size_t count = 0;
  for (const std::uint8_t flag : flags)
    count += flag;
  return count;
}

}  // namespace

void Describe(OptionList& list, PoseOptimizerOptions& o) {
  list.Add("rounds", o.rounds, {1, 20}, "",
           "Rounds, after each of which outliers are judged anew.");
  list.Add("iterations_per_round", o.iterations_per_round, {1, 100}, "",
           "Most Levenberg-Marquardt steps of a round.");
  list.Add("kernel_chi2", o.kernel_chi2, {0.01, 1000.0}, "sigma^2",
           "Squared error at which Cauchy's kernel halves an observation's weight.");
  list.Add("chi2_mono", o.chi2_mono, {0.1, 1000.0}, "sigma^2",
           "Largest squared error of an inlier without depth reading.");
  list.Add("chi2_depth", o.chi2_depth, {0.1, 1000.0}, "sigma^2",
           "Largest squared error of an inlier with depth reading.");
}

PoseSolution OptimizePose(const Camera& camera, double baseline_m, const Se3& T_world_camera,
                          std::span<const PoseObservation> observations,
                          const PoseOptimizerOptions& options) {
  PoseSolution solution;
  solution.T_world_camera = T_world_camera;
  solution.is_inlier.resize(observations.size());
  if (!T_world_camera.IsFinite()) return solution;

  PoseProblem problem(camera, baseline_m, observations, options);
  std::vector<std::uint8_t> is_active = problem.InFront(T_world_camera);
  for (int round = 0; round < options.rounds; ++round) {
    if (Count(is_active) < kMinObservations) break;
    problem.Activate(is_active);
    const RoundResult result =
        Minimise(problem, solution.T_world_camera, options.iterations_per_round);
    solution.T_world_camera = result.T_world_camera;
    solution.iterations += result.iterations;
    std::vector<std::uint8_t> judged = problem.Judge(solution.T_world_camera);
    const bool is_settled = judged == is_active;
    is_active = std::move(judged);
    if (is_settled) break;
  }

  solution.is_inlier = problem.Judge(solution.T_world_camera);
  solution.num_inliers = static_cast<int>(Count(solution.is_inlier));
  problem.Activate(solution.is_inlier);
  const NormalEquations at_solution = problem.Linearise(solution.T_world_camera, Kernel::kNone);
  solution.information = at_solution.hessian;
  if (solution.num_inliers > 0) solution.mean_chi2 = at_solution.cost / solution.num_inliers;
  return solution;
}

}  // namespace cslam
