// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cslam {

struct BlendImage {
  std::string name;   // as Blender shows it
  std::string path;   // as stored: may be relative to the file ("//...")
  std::string bytes;  // of the packed image file; empty if it is not packed
};

struct BlendMaterial {
  std::string name;
  Eigen::Vector3f rgb = Eigen::Vector3f::Ones();  // diffuse, 0 to 1
  int image = -1;                                 // index; -1: none
};

struct BlendCorner {
  std::uint32_t vertex = 0;
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();  // v up, as in Blender
};

struct BlendPolygon {
  std::vector<BlendCorner> corners;  // counter-clockwise from outside
  int material = -1;                 // index into BlendContents::materials; -1: none
};

struct BlendWeight {
  int group = 0;
  float weight = 0.0F;
};

struct BlendMesh {
  std::string name;                        // of the object
  std::vector<Eigen::Vector3f> positions;  // m, world
  std::vector<BlendPolygon> polygons;
  std::vector<std::string> groups;                // names; those of bones deform with them
  std::vector<std::vector<BlendWeight>> weights;  // per vertex; empty if there are no groups
};

struct BlendBone {
  std::string name;
  int parent = -1;                                 // index; parents come first
  Eigen::Vector3f head = Eigen::Vector3f::Zero();  // m, world, in rest
  Eigen::Vector3f tail = Eigen::Vector3f::Zero();
};

struct BlendContents {
  std::vector<BlendMesh> meshes;  // one per mesh object, modifiers not applied
  std::vector<BlendBone> bones;   // of all armatures
  std::vector<BlendMaterial> materials;
  std::vector<BlendImage> images;
};

// Reads files of Blender 2.63 to 2.79. Throws Error that names the file and what is wrong.
BlendContents ReadBlendContents(const std::filesystem::path& path);

}  // namespace cslam
