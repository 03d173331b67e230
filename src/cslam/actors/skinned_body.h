// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/skeleton.h"
#include "cslam/sim/scene.h"
#include "cslam/sim/world.h"

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace cslam {

constexpr std::size_t kMaxInfluences = 4;

// The joints that move a vertex; weights sum to 1, unused ones are 0.
struct Influence {
  std::array<std::uint8_t, kMaxInfluences> joints{};
  std::array<float, kMaxInfluences> weights{};
};
Influence Only(Joint joint);

// A surface that follows a skeleton. Everything is at the skeleton's rest.
struct SkinnedBody {
  Skeleton skeleton;
  Mesh mesh;                          // body frame; Triangle::material indexes pictures
  std::vector<Influence> influences;  // per vertex
  std::vector<cv::Mat> pictures;      // CV_8UC3
};

// Throws InternalError if arrays or indices do not fit or weights do not sum to 1.
void CheckBody(const SkinnedBody& body);

// The surface with the joints at the given frames (T_world_joint), by linear blending.
BodyShape Deform(const SkinnedBody& body, const JointFrames& T_world_joint);

// Unit normals, averaged over the triangles around each vertex by their areas; vertices at the same
// place share theirs.
std::vector<Eigen::Vector3f> SmoothNormals(const Mesh& mesh);

}  // namespace cslam
