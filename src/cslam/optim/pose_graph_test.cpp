// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/optim/pose_graph.h"

#include "cslam/util/check.h"
#include "cslam/util/random.h"

#include <gtest/gtest.h>

#include <numbers>

namespace cslam {
namespace {

Se3 RandomMotion(Rng& rng, double sigma_rad, double sigma_m) {
  Vector6 tangent;
  for (int i = 0; i < 6; ++i)
    tangent[i] = (i < 3 ? sigma_rad : sigma_m) * rng.Gaussian();
  return Exp(tangent);
}

// Poses on a circle that look outwards.
std::vector<Se3> CirclePoses(int count, double radius_m) {
  std::vector<Se3> poses;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    poses.emplace_back(ExpSo3({0.0, -angle, 0.0}), Eigen::Vector3d(radius_m * std::cos(angle), 0.0,
                                                                   radius_m * std::sin(angle)));
  }
  return poses;
}

void AddEdge(PoseGraph& graph, const std::vector<Se3>& truth, int a, int b, double sigma = 0.1) {
  graph.edges.push_back(
      {a, b, truth[static_cast<std::size_t>(a)].Inverse() * truth[static_cast<std::size_t>(b)],
       sigma, sigma});
}

// A ring of exact edges whose poses have been pushed off.
PoseGraph PerturbedRing(const std::vector<Se3>& truth) {
  Rng rng(3);
  PoseGraph graph;
  graph.node_is_fixed.assign(truth.size(), 0);
  graph.node_is_fixed[0] = 1;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    graph.T_world_node.push_back(i == 0 ? truth[0] : truth[i] * RandomMotion(rng, 0.2, 0.3));
    AddEdge(graph, truth, static_cast<int>(i), static_cast<int>((i + 1) % truth.size()));
  }
  return graph;
}

double LargestError(const std::vector<Se3>& a, const std::vector<Se3>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const PoseDifference difference = Difference(a[i], b[i]);
    largest = std::max({largest, difference.angle_rad, difference.distance_m});
  }
  return largest;
}

TEST(OptimizePoseGraph, FindsTheKnownOptimumWhenEdgesAreExact) {
  const auto truth = CirclePoses(40, 2.0);
  const PoseGraph graph = PerturbedRing(truth);
  ASSERT_GT(LargestError(graph.T_world_node, truth), 0.3);
  const PoseGraphResult result =
      OptimizePoseGraph(graph, {.max_iterations = 100, .function_tolerance = 1e-12});
  EXPECT_LT(LargestError(result.T_world_node, truth), 1e-5);
  EXPECT_LT(result.final_cost, 1e-8);
  EXPECT_GT(result.initial_cost, 1.0);
  EXPECT_TRUE(result.has_converged);
}

TEST(OptimizePoseGraph, SharesADisagreementByTheSigmas) {
  // A line of two edges of 1 m each against one that says 2.3 m: 0.3 m to share out. Weights per
  // metre^2: 1, 1/4, 1/9; by hand, the least squares give each edge an error of 0.3 * sigma^2 / 14.
  PoseGraph graph;
  graph.T_world_node.resize(3);
  graph.node_is_fixed = {1, 0, 0};
  const auto forward = [](double m) { return Se3({1, 0, 0, 0}, {0.0, 0.0, m}); };
  graph.edges = {{0, 1, forward(1.0), 1.0, 1.0},
                 {1, 2, forward(1.0), 1.0, 2.0},
                 {0, 2, forward(2.3), 1.0, 3.0}};
  const auto result = OptimizePoseGraph(graph, {.function_tolerance = 1e-14});
  EXPECT_NEAR(result.T_world_node[1].translation.z(), 1.0 + 0.3 / 14.0, 1e-6);
  EXPECT_NEAR(result.T_world_node[2].translation.z(), 2.0 + 0.3 * 5.0 / 14.0, 1e-6);
  EXPECT_NEAR(result.final_cost, 0.5 * 0.09 / 14.0, 1e-6);
}

TEST(OptimizePoseGraph, LeavesFixedAndUntouchedNodesAlone) {
  const auto truth = CirclePoses(6, 1.0);
  PoseGraph graph = PerturbedRing(truth);
  graph.node_is_fixed[3] = 1;
  graph.T_world_node.push_back(Se3({1, 0, 0, 0}, {7.0, 8.0, 9.0}));
  graph.node_is_fixed.push_back(0);
  const auto result = OptimizePoseGraph(graph, {});
  for (const std::size_t i : {0U, 3U, 6U})
    EXPECT_EQ(result.T_world_node[i].Matrix(), graph.T_world_node[i].Matrix());
  EXPECT_NE(result.T_world_node[1].Matrix(), graph.T_world_node[1].Matrix());
}

TEST(OptimizePoseGraph, HoldsTheFirstNodeOfAPartThatHasNoFixedOne) {
  const auto truth = CirclePoses(5, 1.0);
  PoseGraph graph = PerturbedRing(truth);
  graph.node_is_fixed.assign(5, 0);
  const auto result = OptimizePoseGraph(graph, {.function_tolerance = 1e-12});
  EXPECT_EQ(result.T_world_node[0].Matrix(), graph.T_world_node[0].Matrix());
  EXPECT_LT(LargestError(result.T_world_node, truth), 1e-5);
}

TEST(OptimizePoseGraph, LimitsAWrongEdgeWhenTheKernelIsOn) {
  const auto truth = CirclePoses(20, 2.0);
  PoseGraph graph = PerturbedRing(truth);
  for (int i = 0; i < 20; ++i)
    AddEdge(graph, truth, i, (i + 2) % 20);
  graph.edges.push_back({2, 12, Se3({1, 0, 0, 0}, {0.0, 0.0, 1.0}), 0.1, 0.1});
  const auto plain = OptimizePoseGraph(graph, {.max_iterations = 200});
  const auto robust = OptimizePoseGraph(graph, {.max_iterations = 200, .kernel_chi2 = 1.0});
  EXPECT_LT(LargestError(robust.T_world_node, truth),
            0.5 * LargestError(plain.T_world_node, truth));
}

TEST(OptimizePoseGraph, GivesTheSameBytesTwice) {
  const PoseGraph graph = PerturbedRing(CirclePoses(30, 2.0));
  const auto a = OptimizePoseGraph(graph, {});
  const auto b = OptimizePoseGraph(graph, {});
  for (std::size_t i = 0; i < graph.T_world_node.size(); ++i)
    EXPECT_EQ(a.T_world_node[i].Matrix(), b.T_world_node[i].Matrix());
}

TEST(OptimizePoseGraph, RefusesEdgesToNodesThatDoNotExist) {
  PoseGraph graph;
  graph.T_world_node.resize(2);
  graph.node_is_fixed = {1, 0};
  graph.edges = {{0, 2, Se3(), 1.0, 1.0}};
  EXPECT_THROW(OptimizePoseGraph(graph, {}), InternalError);
}

}  // namespace
}  // namespace cslam
