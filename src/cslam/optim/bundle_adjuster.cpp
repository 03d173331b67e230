// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/optim/bundle_adjuster.h"

#include "cslam/optim/ba_residual.h"
#include "cslam/util/check.h"
#include "cslam/util/options.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <memory>

namespace cslam {
namespace {

// Above, the reduced camera system is mostly empty and a sparse factorisation is faster.
constexpr int kMostDensePoses = 60;

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

std::size_t Index(int i) {
  return static_cast<std::size_t>(i);
}

// Poses and points of a round: Ceres moves the numbers, PrepareForEvaluation() turns the moves of
// the poses into matrices once per evaluation instead of once per observation.
class BaState final : public ceres::EvaluationCallback {
 public:
  explicit BaState(const BaProblem& problem)
      : points_(problem.p_world),
        starts_(problem.T_world_camera.size()),
        moves_(problem.T_world_camera.size(), Vector6::Zero()),
        charts_(problem.T_world_camera.size()) {
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      starts_[i] = problem.T_world_camera[i].Inverse();
    }
    UpdateCharts();
  }

  void PrepareForEvaluation(bool /*evaluate_jacobians*/, bool new_evaluation_point) override {
    if (new_evaluation_point) UpdateCharts();
  }

  // Makes the current poses the origin of the moves, which become zero.
  void Rebase() {
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      if (moves_[i].isZero(0.0)) continue;
      starts_[i] = MovedPose(starts_[i], moves_[i]);
      moves_[i].setZero();
    }
    UpdateCharts();
  }

  // In the camera frame of a pose.
  Eigen::Vector3d InCamera(int pose, const Eigen::Vector3d& p_world) const {
    const PoseChart& chart = charts_[Index(pose)];
    return chart.R_camera_world * p_world + chart.t_camera_world;
  }

  const PoseChart& chart(int pose) const { return charts_[Index(pose)]; }
  const Se3& T_camera_world(int pose) const { return starts_[Index(pose)]; }  // after Rebase()
  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  std::size_t num_poses() const { return starts_.size(); }

  // What Ceres moves; three numbers each.
  double* point(int point) { return points_[Index(point)].data(); }
  double* rotation(int pose) { return moves_[Index(pose)].data(); }
  double* translation(int pose) { return moves_[Index(pose)].data() + 3; }

 private:
  void UpdateCharts() {
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      charts_[i] = MakePoseChart(starts_[i], moves_[i]);
    }
  }

  std::vector<Eigen::Vector3d> points_;
  std::vector<Se3> starts_;  // T_camera_world at the start of the round
  std::vector<Vector6> moves_;
  std::vector<PoseChart> charts_;
};

// One observation with what both kinds of cost function need of it.
struct BaTerm {
  Measurement measurement;
  int pose = 0;
  int point = 0;
  double threshold = 0.0;  // chi2
  bool is_active = false;  // takes part in the round
  bool pose_is_fixed = false;
};

// Three rows and blocks of three columns throughout (a pose is a rotation and a translation block,
// a missing depth reading a row of zeros): Ceres has its Schur elimination compiled for this size,
// not for 3x6 blocks, which cost twice the time.
template <int... kBlocks>
class ObservationCost final : public ceres::SizedCostFunction<3, 3, kBlocks...> {
 public:
  ObservationCost(const PixelDisparityModel& model, const BaState& state, const BaTerm& term)
      : model_(model), state_(state), term_(term) {}

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    if (!term_.is_active) {
      StoreZeros(residuals, jacobians);
      return true;
    }
    const Eigen::Vector3d p_world = Eigen::Vector3d::Map(parameters[0]);
    const Eigen::Vector3d p_camera = state_.InCamera(term_.pose, p_world);
    Eigen::Vector3d::Map(residuals) = BaError(model_, term_.measurement, p_camera);
    if (jacobians == nullptr) return true;
    const PoseChart& pose = state_.chart(term_.pose);
    const Eigen::Matrix3d by_translation =
        BaErrorByTranslation(model_, term_.measurement, p_camera);
    if (jacobians[0] != nullptr) {
      RowMajor3::Map(jacobians[0]).noalias() = by_translation * pose.R_camera_world;
    }
    if constexpr (sizeof...(kBlocks) == 2) {
      if (jacobians[1] != nullptr) {
        RowMajor3::Map(jacobians[1]) = BaErrorByRotation(by_translation, pose, p_camera);
      }
      if (jacobians[2] != nullptr) RowMajor3::Map(jacobians[2]) = by_translation;
    }
    return true;
  }

 private:
  static void StoreZeros(double* residuals, double** jacobians) {
    Eigen::Vector3d::Map(residuals).setZero();
    if (jacobians == nullptr) return;
    for (std::size_t i = 0; i <= sizeof...(kBlocks); ++i) {
      if (jacobians[i] != nullptr) RowMajor3::Map(jacobians[i]).setZero();
    }
  }

  const PixelDisparityModel& model_;
  const BaState& state_;
  const BaTerm& term_;
};
using FreePoseCost = ObservationCost<3, 3>;  // point, rotation, translation
using FixedPoseCost = ObservationCost<>;     // point

class StopCallback final : public ceres::IterationCallback {
 public:
  explicit StopCallback(const std::function<bool()>& should_stop) : should_stop_(should_stop) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
    was_stopped_ = should_stop_ && should_stop_();
    return was_stopped_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

  bool was_stopped() const { return was_stopped_; }

 private:
  const std::function<bool()>& should_stop_;
  bool was_stopped_ = false;
};

ceres::Problem::Options ProblemOptions(ceres::EvaluationCallback* state) {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  options.evaluation_callback = state;
  return options;
}

// One bundle adjustment: the Ceres problem is built once and solved once per round.
class Adjustment {
 public:
  Adjustment(const BaProblem& problem, const BundleAdjusterOptions& options)
      : options_(options),
        model_(problem.camera, problem.baseline_m),
        state_(problem),
        kernel_(std::sqrt(options.kernel_chi2)),
        ceres_problem_(ProblemOptions(&state_)) {
    MakeTerms(problem);
    AddResiduals();
  }

  Adjustment(const Adjustment&) = delete;
  Adjustment& operator=(const Adjustment&) = delete;

  bool is_empty() const { return ceres_problem_.NumResidualBlocks() == 0; }

  // At most max_iterations Levenberg-Marquardt steps over the active terms.
  void SolveRound(int max_iterations, StopCallback& stop);

  // Keeps what fits the current state.
  void LeaveOutOutliers();

  double RobustCost() const;  // over all observations that can be judged
  BaResult Result(const BaProblem& problem) const;

 private:
  void MakeTerms(const BaProblem& problem);
  void AddResiduals();
  double Chi2Of(const BaTerm& term) const;
  ceres::Solver::Options SolverOptions() const;

  const BundleAdjusterOptions& options_;
  PixelDisparityModel model_;
  BaState state_;
  std::vector<BaTerm> terms_;            // one per observation
  std::deque<FreePoseCost> free_costs_;  // deques: cost functions cannot move
  std::deque<FixedPoseCost> fixed_costs_;
  ceres::HuberLoss kernel_;
  ceres::Problem ceres_problem_;
  ceres::ParameterBlockOrdering ordering_;
  int num_free_poses_ = 0;  // with observations
  int iterations_ = 0;
};

void Adjustment::MakeTerms(const BaProblem& problem) {
  terms_.resize(problem.observations.size());
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const BaObservation& o = problem.observations[i];
    BaTerm& term = terms_[i];
    term = {.measurement = MeasurementOf(o),
            .pose = o.pose,
            .point = o.point,
            .pose_is_fixed = problem.pose_is_fixed[Index(o.pose)] != 0};
    term.threshold = term.measurement.has_disparity ? options_.chi2_depth : options_.chi2_mono;
    term.is_active = std::isfinite(Chi2Of(term));
    term.measurement.is_usable &=
        state_.InCamera(o.pose, problem.p_world[Index(o.point)]).allFinite();
  }
}

void Adjustment::AddResiduals() {
  std::vector<std::uint8_t> point_is_used(state_.points().size());
  std::vector<std::uint8_t> pose_is_used(state_.num_poses());
  for (const BaTerm& term : terms_) {
    if (!term.measurement.is_usable) continue;
    double* point = state_.point(term.point);
    point_is_used[Index(term.point)] = 1;
    if (term.pose_is_fixed) {
      fixed_costs_.emplace_back(model_, state_, term);
      ceres_problem_.AddResidualBlock(&fixed_costs_.back(), &kernel_, point);
      continue;
    }
    pose_is_used[Index(term.pose)] = 1;
    free_costs_.emplace_back(model_, state_, term);
    ceres_problem_.AddResidualBlock(&free_costs_.back(), &kernel_, point,
                                    state_.rotation(term.pose), state_.translation(term.pose));
  }
  for (int i = 0; i < static_cast<int>(point_is_used.size()); ++i) {
    if (point_is_used[Index(i)]) ordering_.AddElementToGroup(state_.point(i), 0);
  }
  for (int i = 0; i < static_cast<int>(pose_is_used.size()); ++i) {
    if (!pose_is_used[Index(i)]) continue;
    ++num_free_poses_;
    ordering_.AddElementToGroup(state_.rotation(i), 1);
    ordering_.AddElementToGroup(state_.translation(i), 1);
  }
}

double Adjustment::Chi2Of(const BaTerm& term) const {
  return Chi2(model_, term.measurement,
              state_.InCamera(term.pose, state_.points()[Index(term.point)]));
}

ceres::Solver::Options Adjustment::SolverOptions() const {
  ceres::Solver::Options options;
  options.linear_solver_type =
      num_free_poses_ <= kMostDensePoses ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
  // Not LAPACK or SuiteSparse, whose BLAS may bring threads of its own.
  options.dense_linear_algebra_library_type = ceres::EIGEN;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>(ordering_);
  options.num_threads = 1;
  options.jacobi_scaling = false;  // the damping is scaled by the diagonal already
  options.function_tolerance = options_.function_tolerance;
  options.logging_type = ceres::SILENT;
  return options;
}

void Adjustment::SolveRound(int max_iterations, StopCallback& stop) {
  if (max_iterations <= 0) return;
  ceres::Solver::Options options = SolverOptions();
  options.max_num_iterations = max_iterations;
  options.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem_, &summary);
  iterations_ += std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  state_.Rebase();
}

void Adjustment::LeaveOutOutliers() {
  for (BaTerm& term : terms_)
    term.is_active = Chi2Of(term) <= term.threshold;
}

double Adjustment::RobustCost() const {
  double cost = 0.0;
  for (const BaTerm& term : terms_) {
    const double chi2 = Chi2Of(term);
    if (std::isfinite(chi2)) cost += 0.5 * HuberCost(chi2, options_.kernel_chi2);
  }
  return cost;
}

BaResult Adjustment::Result(const BaProblem& problem) const {
  BaResult result;
  result.T_world_camera = problem.T_world_camera;
  for (int i = 0; i < static_cast<int>(problem.T_world_camera.size()); ++i) {
    if (problem.pose_is_fixed[Index(i)]) continue;
    result.T_world_camera[Index(i)] = state_.T_camera_world(i).Inverse();
  }
  result.p_world = state_.points();
  result.is_outlier.reserve(terms_.size());
  for (const BaTerm& term : terms_) {
    const double chi2 = Chi2Of(term);
    const bool is_outlier = !(chi2 <= term.threshold);
    result.is_outlier.push_back(is_outlier);
    if (!is_outlier) result.final_cost += 0.5 * chi2;
  }
  result.iterations = iterations_;
  return result;
}

void CheckProblem(const BaProblem& problem) {
  const std::size_t num_poses = problem.T_world_camera.size();
  CSLAM_CHECK(problem.pose_is_fixed.size() == num_poses, "{} flags for {} poses",
              problem.pose_is_fixed.size(), num_poses);
  for (const BaObservation& o : problem.observations) {
    CSLAM_CHECK(o.pose >= 0 && Index(o.pose) < num_poses, "pose {} of {}", o.pose, num_poses);
    CSLAM_CHECK(o.point >= 0 && Index(o.point) < problem.p_world.size(), "point {} of {}", o.point,
                problem.p_world.size());
  }
}

}  // namespace

void Describe(OptionList& list, BundleAdjusterOptions& o) {
  list.Add("iterations_robust", o.iterations_robust, {0, 1000}, "",
           "Most iterations of the first round, over all observations.");
  list.Add("iterations_final", o.iterations_final, {0, 1000}, "",
           "Most iterations of the second round, with outliers left out.");
  list.Add("kernel_chi2", o.kernel_chi2, {0.01, 1000.0}, "sigma^2",
           "Squared error beyond which Huber's kernel grows linearly.");
  list.Add("chi2_mono", o.chi2_mono, {0.1, 1000.0}, "sigma^2",
           "Largest squared error of an inlier without depth reading.");
  list.Add("chi2_depth", o.chi2_depth, {0.1, 1000.0}, "sigma^2",
           "Largest squared error of an inlier with depth reading.");
  list.Add("function_tolerance", o.function_tolerance, {0.0, 1.0}, "",
           "A round ends once a step lowers the cost by less than this share.");
}

BaResult AdjustBundle(const BaProblem& problem, const BundleAdjusterOptions& options,
                      const std::function<bool()>& should_stop) {
  CheckProblem(problem);
  Adjustment adjustment(problem, options);
  const double initial_cost = adjustment.RobustCost();
  StopCallback stop(should_stop);
  if (!adjustment.is_empty()) {
    adjustment.SolveRound(options.iterations_robust, stop);
    if (!stop.was_stopped()) {
      adjustment.LeaveOutOutliers();
      adjustment.SolveRound(options.iterations_final, stop);
    }
  }
  BaResult result = adjustment.Result(problem);
  result.initial_cost = initial_cost;
  result.was_stopped = stop.was_stopped();
  return result;
}

}  // namespace cslam
