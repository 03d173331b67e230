// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/essential_graph.h"

#include <numbers>
#include <set>
#include <utility>

namespace cslam {
namespace {

// A place is full of edges between neighbours, and together they are far stiffer than one: the loop
// has to outweigh them all, or it closes only in part.
constexpr double kLoopSigmaShare = 0.05;

// Whether the map has a loop in it: its correction may have come too late and been refused. Bundle
// adjustment moves the ends of one that was applied by far less than this.
bool IsClosed(const MapView& map, const LoopEdge& loop) {
  constexpr double kMostM = 0.2;
  constexpr double kMostRad = 0.1;
  const auto T_world_match = map.T_world_keyframe(loop.match);
  const auto T_world_query = map.T_world_keyframe(loop.query);
  if (!T_world_match || !T_world_query) return false;
  const PoseDifference left = Difference(*T_world_match * loop.T_match_query, *T_world_query);
  return left.distance_m < kMostM && left.angle_rad < kMostRad;
}

class GraphBuilder {
 public:
  GraphBuilder(const MapView& map, MapId id, const EssentialGraphOptions& options)
      : map_(map), options_(options), node_of_(map.num_keyframe_ids(), -1) {
    for (const KeyframeId keyframe : map.Keyframes()) {
      const Keyframe& k = *map.FindKeyframe(keyframe);
      if (k.map != id) continue;
      node_of_[keyframe.index()] = static_cast<int>(keyframes_.size());
      keyframes_.push_back(keyframe);
      graph_.T_world_node.push_back(k.T_world_camera);
      graph_.node_is_fixed.push_back(k.parent.valid() ? 0 : 1);
    }
  }

  // As far apart as they are now.
  void Keep(KeyframeId a, KeyframeId b) { Add(a, b, PoseOf(a).Inverse() * PoseOf(b), 1.0); }

  // As measured.
  void Close(const LoopEdge& loop) {
    Add(loop.match, loop.query, loop.T_match_query, kLoopSigmaShare);
  }

  bool Has(KeyframeId id) const { return node_of_[id.index()] >= 0; }
  const PoseGraph& graph() const { return graph_; }
  const std::vector<KeyframeId>& keyframes() const { return keyframes_; }

 private:
  const Se3& PoseOf(KeyframeId id) const { return map_.FindKeyframe(id)->T_world_camera; }

  void Add(KeyframeId a, KeyframeId b, const Se3& T_a_b, double sigma_share) {
    if (a == b || !edges_.insert(std::minmax(a, b)).second) return;
    constexpr double kDegree = std::numbers::pi / 180.0;
    graph_.edges.push_back({node_of_[a.index()], node_of_[b.index()], T_a_b,
                            sigma_share * options_.sigma_deg * kDegree,
                            sigma_share * options_.sigma_m});
  }

  const MapView& map_;
  const EssentialGraphOptions& options_;
  std::vector<int> node_of_;  // by keyframe; -1: of another map
  std::vector<KeyframeId> keyframes_;
  std::set<std::pair<KeyframeId, KeyframeId>> edges_;
  PoseGraph graph_;
};

}  // namespace

std::vector<KeyframeMove> SpreadLoop(const MapView& map, const LoopEdge& loop,
                                     std::span<const LoopEdge> earlier,
                                     const EssentialGraphOptions& options) {
  GraphBuilder builder(map, map.FindKeyframe(loop.query)->map, options);
  builder.Close(loop);
  for (const KeyframeId id : builder.keyframes()) {
    const Keyframe& keyframe = *map.FindKeyframe(id);
    if (keyframe.parent.valid()) builder.Keep(keyframe.parent, id);
    for (const CovisibleKeyframe& c : keyframe.covisible) {
      if (c.id < id && c.shared_points >= options.min_shared_points) builder.Keep(c.id, id);
    }
  }
  for (const LoopEdge& e : earlier) {
    if (!IsClosed(map, e)) continue;
    const auto match = map.Resolve(e.match);
    const auto query = map.Resolve(e.query);
    if (!match || !query || !builder.Has(match->keyframe) || !builder.Has(query->keyframe))
      continue;
    builder.Keep(match->keyframe, query->keyframe);
  }
  const PoseGraphResult solved = OptimizePoseGraph(builder.graph(), options.solver);
  std::vector<KeyframeMove> moves;
  for (std::size_t i = 0; i < builder.keyframes().size(); ++i) {
    moves.push_back({builder.keyframes()[i],
                     solved.T_world_node[i] * builder.graph().T_world_node[i].Inverse()});
  }
  return moves;
}

std::vector<KeyframeMove> MoveRigidly(const MapView& map, MapId id, const Se3& T_new_old) {
  std::vector<KeyframeMove> moves;
  for (const KeyframeId keyframe : map.Keyframes()) {
    if (map.FindKeyframe(keyframe)->map == id) moves.push_back({keyframe, T_new_old});
  }
  return moves;
}

}  // namespace cslam
