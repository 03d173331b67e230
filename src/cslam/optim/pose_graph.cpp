// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/optim/pose_graph.h"

#include "cslam/util/check.h"
#include "cslam/util/options.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace cslam {
namespace {

std::size_t Index(int i) {
  return static_cast<std::size_t>(i);
}

// Rotation vector and difference of translations between the measured and the present T_a_b, in
// sigmas. Blocks: rotation and translation of a, then of b; quaternions in Eigen's order.
class EdgeError {
 public:
  explicit EdgeError(const PoseGraphEdge& edge)
      : R_b_a_(edge.T_a_b.rotation.conjugate()),
        t_a_b_(edge.T_a_b.translation),
        information_rad_(1.0 / edge.sigma_rad),
        information_m_(1.0 / edge.sigma_m) {}

  template <typename T>
  bool operator()(const T* q_a, const T* t_a, const T* q_b, const T* t_b, T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    using Quaternion = Eigen::Quaternion<T>;
    const Quaternion R_world_a = Eigen::Map<const Quaternion>(q_a);
    const Quaternion R_world_b = Eigen::Map<const Quaternion>(q_b);
    const Quaternion R_a_world = R_world_a.conjugate();
    const Vector3 offset =
        Eigen::Map<const Vector3>(t_b) - Eigen::Map<const Vector3>(t_a);  // in the world
    const Quaternion error = R_b_a_.cast<T>() * (R_a_world * R_world_b);
    const T wxyz[4] = {error.w(), error.x(), error.y(), error.z()};
    ceres::QuaternionToAngleAxis(wxyz, residual);
    Eigen::Map<Vector3> rotation(residual);
    Eigen::Map<Vector3> translation(residual + 3);
    rotation *= T(information_rad_);
    translation = (R_a_world * offset - t_a_b_.cast<T>()) * T(information_m_);
    return true;
  }

 private:
  Eigen::Quaterniond R_b_a_;
  Eigen::Vector3d t_a_b_;
  double information_rad_;
  double information_m_;
};
using EdgeCost = ceres::AutoDiffCostFunction<EdgeError, 6, 4, 3, 4, 3>;

void CheckGraph(const PoseGraph& graph) {
  const std::size_t num_nodes = graph.T_world_node.size();
  CSLAM_CHECK(graph.node_is_fixed.size() == num_nodes, "{} flags for {} nodes",
              graph.node_is_fixed.size(), num_nodes);
  for (const PoseGraphEdge& edge : graph.edges) {
    CSLAM_CHECK(edge.a >= 0 && Index(edge.a) < num_nodes, "node {} of {}", edge.a, num_nodes);
    CSLAM_CHECK(edge.b >= 0 && Index(edge.b) < num_nodes, "node {} of {}", edge.b, num_nodes);
    CSLAM_CHECK(edge.a != edge.b, "an edge from node {} to itself", edge.a);
    CSLAM_CHECK(edge.sigma_rad > 0.0 && edge.sigma_m > 0.0 && edge.T_a_b.IsFinite());
  }
}

int RootOf(std::vector<int>& parents, int node) {
  while (parents[Index(node)] != node) {
    parents[Index(node)] = parents[Index(parents[Index(node)])];
    node = parents[Index(node)];
  }
  return node;
}

// The given fixed nodes, and the first node of every connected part that has none.
std::vector<std::uint8_t> HeldNodes(const PoseGraph& graph) {
  std::vector<int> parents(graph.T_world_node.size());
  std::iota(parents.begin(), parents.end(), 0);
  for (const PoseGraphEdge& edge : graph.edges) {
    const int a = RootOf(parents, edge.a);
    const int b = RootOf(parents, edge.b);
    parents[Index(std::max(a, b))] = std::min(a, b);  // so a part's root is its first node
  }
  std::vector<std::uint8_t> part_is_held(parents.size(), 0);
  for (int i = 0; i < static_cast<int>(parents.size()); ++i) {
    if (graph.node_is_fixed[Index(i)] != 0) part_is_held[Index(RootOf(parents, i))] = 1;
  }
  std::vector<std::uint8_t> held = graph.node_is_fixed;
  for (int i = 0; i < static_cast<int>(parents.size()); ++i) {
    if (RootOf(parents, i) == i && part_is_held[Index(i)] == 0) held[Index(i)] = 1;
  }
  return held;
}

ceres::Solver::Options SolverOptions(const PoseGraphOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  // Not SuiteSparse, whose BLAS may bring threads of its own.
  solver.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  solver.dense_linear_algebra_library_type = ceres::EIGEN;
  solver.num_threads = 1;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.function_tolerance;
  solver.logging_type = ceres::SILENT;
  return solver;
}

}  // namespace

void Describe(OptionList& list, PoseGraphOptions& o) {
  list.Add("max_iterations", o.max_iterations, {1, 10'000}, "",
           "Most Levenberg-Marquardt steps over the graph of keyframes.");
  list.Add("function_tolerance", o.function_tolerance, {0.0, 1.0}, "",
           "The solver ends once a step lowers the cost by less than this share.");
  list.Add("kernel_chi2", o.kernel_chi2, {0.0, 1e6}, "sigma^2",
           "Squared error of an edge beyond which Huber's kernel grows linearly; 0: no kernel.");
}

PoseGraphResult OptimizePoseGraph(const PoseGraph& graph, const PoseGraphOptions& options) {
  CheckGraph(graph);
  PoseGraphResult result;
  result.T_world_node = graph.T_world_node;
  if (graph.edges.empty()) {
    result.has_converged = true;
    return result;
  }
  ceres::Problem problem;
  const auto rotation = [&](int i) {
    return result.T_world_node[Index(i)].rotation.coeffs().data();
  };
  const auto translation = [&](int i) { return result.T_world_node[Index(i)].translation.data(); };
  for (const PoseGraphEdge& edge : graph.edges) {
    ceres::LossFunction* kernel =
        options.kernel_chi2 > 0.0 ? new ceres::HuberLoss(std::sqrt(options.kernel_chi2)) : nullptr;
    problem.AddResidualBlock(new EdgeCost(new EdgeError(edge)), kernel, rotation(edge.a),
                             translation(edge.a), rotation(edge.b), translation(edge.b));
  }
  const std::vector<std::uint8_t> held = HeldNodes(graph);
  for (int i = 0; i < static_cast<int>(held.size()); ++i) {
    if (!problem.HasParameterBlock(rotation(i))) continue;
    if (held[Index(i)] != 0) {
      problem.SetParameterBlockConstant(rotation(i));
      problem.SetParameterBlockConstant(translation(i));
    } else {
      problem.SetManifold(rotation(i), new ceres::EigenQuaternionManifold());
    }
  }
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(options), &problem, &summary);
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i] == 0) result.T_world_node[i].rotation.normalize();
  }
  result.initial_cost = summary.initial_cost;
  result.final_cost = summary.final_cost;
  result.iterations = std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  result.has_converged = summary.termination_type == ceres::CONVERGENCE;
  return result;
}

}  // namespace cslam
