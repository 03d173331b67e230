// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/skinned_body.h"

#include "cslam/util/check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace cslam {

Influence Only(Joint joint) {
  Influence influence;
  influence.joints[0] = static_cast<std::uint8_t>(joint);
  influence.weights[0] = 1.0F;
  return influence;
}

void CheckBody(const SkinnedBody& body) {
  const std::size_t n = body.mesh.positions.size();
  CSLAM_CHECK(body.mesh.normals.size() == n && body.mesh.uvs.size() == n);
  CSLAM_CHECK(body.influences.size() == n);
  for (const Influence& influence : body.influences) {
    const float sum = std::accumulate(influence.weights.begin(), influence.weights.end(), 0.0F);
    CSLAM_CHECK(std::abs(sum - 1.0F) < 1e-4F, "weights sum to {}", sum);
    for (const std::uint8_t joint : influence.joints)
      CSLAM_CHECK(joint < kNumJoints);
  }
  for (const Triangle& triangle : body.mesh.triangles) {
    for (const std::uint32_t vertex : triangle.vertices)
      CSLAM_CHECK(vertex < n);
    CSLAM_CHECK(triangle.material >= 0 &&
                static_cast<std::size_t>(triangle.material) < body.pictures.size());
  }
}

BodyShape Deform(const SkinnedBody& body, const JointFrames& T_world_joint) {
  using Matrix = Eigen::Matrix<float, 3, 4>;
  std::array<Matrix, kNumJoints> moves;
  for (std::size_t j = 0; j < kNumJoints; ++j) {
    const Se3 move = T_world_joint[j] * body.skeleton.T_body_joint[j].Inverse();
    moves[j] << move.R().cast<float>(), move.translation.cast<float>();
  }
  const std::size_t n = body.mesh.positions.size();
  BodyShape shape;
  shape.positions.reserve(n);
  shape.normals.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Influence& influence = body.influences[i];
    Matrix blend = influence.weights[0] * moves[influence.joints[0]];
    for (std::size_t k = 1; k < kMaxInfluences && influence.weights[k] > 0.0F; ++k)
      blend += influence.weights[k] * moves[influence.joints[k]];
    shape.positions.push_back(blend * body.mesh.positions[i].homogeneous());
    shape.normals.push_back((blend.leftCols<3>() * body.mesh.normals[i]).normalized());
  }
  return shape;
}

std::vector<Eigen::Vector3f> SmoothNormals(const Mesh& mesh) {
  constexpr float kSamePlace = 1e4F;  // per m: vertices within 0.1 mm share a normal
  using Key = std::tuple<long, long, long>;
  const auto key = [](const Eigen::Vector3f& p) {
    return Key{std::lround(p.x() * kSamePlace), std::lround(p.y() * kSamePlace),
               std::lround(p.z() * kSamePlace)};
  };
  std::map<Key, Eigen::Vector3f> sums;
  for (const Triangle& triangle : mesh.triangles) {
    const Eigen::Vector3f& a = mesh.positions[triangle.vertices[0]];
    const Eigen::Vector3f& b = mesh.positions[triangle.vertices[1]];
    const Eigen::Vector3f& c = mesh.positions[triangle.vertices[2]];
    const Eigen::Vector3f area = (b - a).cross(c - a);
    for (const Eigen::Vector3f* corner : {&a, &b, &c}) {
      const auto [place, is_new] = sums.try_emplace(key(*corner), Eigen::Vector3f::Zero());
      place->second += area;
    }
  }
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(mesh.positions.size());
  for (const Eigen::Vector3f& position : mesh.positions) {
    const auto place = sums.find(key(position));
    const bool is_used = place != sums.end() && place->second.norm() > 0.0F;
    normals.push_back(is_used ? place->second.normalized() : Eigen::Vector3f::UnitZ());
  }
  return normals;
}

}  // namespace cslam
