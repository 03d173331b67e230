// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"

#include <cstdint>
#include <vector>

namespace cslam {

class OptionList;

// Node b as seen from node a, with the standard deviations of what is known about it.
struct PoseGraphEdge {
  int a = 0;
  int b = 0;
  Se3 T_a_b;
  double sigma_rad = 1.0;
  double sigma_m = 1.0;
};

// A graph of relative poses as plain arrays: no map, no ids.
struct PoseGraph {
  std::vector<Se3> T_world_node;
  std::vector<std::uint8_t> node_is_fixed;  // one per node
  std::vector<PoseGraphEdge> edges;
};

struct PoseGraphOptions {
  int max_iterations = 50;
  // The solver ends early once a step lowers the cost by less than this share.
  double function_tolerance = 1e-6;
  // Squared error of an edge (6 dof, in sigmas) beyond which Huber's kernel grows linearly; 0: no
  // kernel. Off, since every edge has been verified before it gets here, and a kernel would spare
  // exactly the loop edge, which disagrees with all others at the start.
  double kernel_chi2 = 0.0;
};
void Describe(OptionList& list, PoseGraphOptions& options);

struct PoseGraphResult {
  std::vector<Se3> T_world_node;  // fixed ones unchanged
  double initial_cost = 0.0;      // half the sum of chi2, robust
  double final_cost = 0.0;
  int iterations = 0;
  bool has_converged = false;  // before the iterations ran out
};

// Minimises the disagreement of the edges over the free nodes. Nodes that no edge touches stay; a
// part of the graph without a fixed node keeps its first node where it is. Single-threaded and
// deterministic.
PoseGraphResult OptimizePoseGraph(const PoseGraph& graph, const PoseGraphOptions& options);

}  // namespace cslam
