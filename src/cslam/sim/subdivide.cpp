// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/scene.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <map>
#include <utility>

namespace cslam {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;  // smaller index first

// Splits edges once; a vertex in the middle of an edge serves both triangles at it.
class EdgeSplitter {
 public:
  EdgeSplitter(Mesh& mesh, double max_edge_m)
      : mesh_(mesh), max_squared_m2_(static_cast<float>(max_edge_m * max_edge_m)) {}

  // Triangles that replace this one: two if its longest edge is too long, else itself.
  void Split(const Triangle& triangle, std::vector<Triangle>& to) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (IsLonger(EdgeOf(triangle, i), EdgeOf(triangle, longest))) longest = i;
    }
    const Edge edge = EdgeOf(triangle, longest);
    if (SquaredLength(edge) <= max_squared_m2_) {
      to.push_back(triangle);
      return;
    }
    const std::uint32_t middle = MiddleOf(edge);
    Triangle first = triangle;
    Triangle second = triangle;
    first.vertices[(longest + 1) % 3] = middle;
    second.vertices[longest] = middle;
    to.push_back(first);
    to.push_back(second);
  }

 private:
  static Edge EdgeOf(const Triangle& triangle, std::size_t i) {
    return std::minmax({triangle.vertices[i], triangle.vertices[(i + 1) % 3]});
  }

  float SquaredLength(const Edge& edge) const {
    return (mesh_.positions[edge.first] - mesh_.positions[edge.second]).squaredNorm();
  }

  // A strict order of edges, so that both triangles at one agree.
  bool IsLonger(const Edge& a, const Edge& b) const {
    return std::pair(SquaredLength(a), a) > std::pair(SquaredLength(b), b);
  }

  std::uint32_t MiddleOf(const Edge& edge) {
    const auto [at, is_new] =
        middles_.emplace(edge, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (!is_new) return at->second;
    const auto [a, b] = edge;
    const Eigen::Vector3f position = 0.5F * (mesh_.positions[a] + mesh_.positions[b]);
    const Eigen::Vector3f sum = mesh_.normals[a] + mesh_.normals[b];
    const Eigen::Vector3f normal = sum.norm() > 1e-6F ? sum.normalized() : mesh_.normals[a];
    const Eigen::Vector2f uv = 0.5F * (mesh_.uvs[a] + mesh_.uvs[b]);
    mesh_.positions.push_back(position);
    mesh_.normals.push_back(normal);
    mesh_.uvs.push_back(uv);
    return at->second;
  }

  Mesh& mesh_;
  float max_squared_m2_;
  std::map<Edge, std::uint32_t> middles_;
};

}  // namespace

Mesh SubdivideLongEdges(Mesh mesh, double max_edge_m) {
  CSLAM_CHECK(max_edge_m > 0.0, "{} m", max_edge_m);
  EdgeSplitter splitter(mesh, max_edge_m);
  while (true) {
    std::vector<Triangle> triangles;
    triangles.reserve(2 * mesh.triangles.size());
    for (const Triangle& triangle : mesh.triangles)
      splitter.Split(triangle, triangles);
    const bool is_done = triangles.size() == mesh.triangles.size();
    mesh.triangles = std::move(triangles);
    if (is_done) return mesh;
  }
}

}  // namespace cslam
