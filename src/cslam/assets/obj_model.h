// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/scene.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace cslam {

struct ObjMaterial {
  std::string name;
  Eigen::Vector3d diffuse{0.8, 0.8, 0.8};  // RGB, 0 to 1, display values
  double opacity = 1.0;
  std::filesystem::path texture;  // empty: none
};

// A Wavefront OBJ file as it is, in its own axes and units. Every triangle has three vertices of
// its own; a triangle's material is an index into `materials`; v runs down in the texture; normals
// and uvs that the file does not give are zero.
struct ObjModel {
  Mesh mesh;
  std::vector<ObjMaterial> materials;
};

// Reads an OBJ file and the MTL files it names. Polygons are cut into fans; lines and points are
// left out; a material that no MTL file describes is light grey. Throws Error with file and line.
ObjModel ReadObjModel(const std::filesystem::path& path);

// Materials of an MTL file.
std::vector<ObjMaterial> ReadMtl(const std::filesystem::path& path);

}  // namespace cslam
