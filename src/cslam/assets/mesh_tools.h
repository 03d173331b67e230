// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/scene.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <functional>

namespace cslam {

// Steps that turn a mesh from a file into one fit for the renderer. All but Welded expect that
// every triangle has three vertices of its own, as ReadObjModel gives them, and keep it so.

Eigen::AlignedBox3d BoundsOf(const Mesh& mesh);

// Positions mapped by an affine transform; normals follow.
Mesh Mapped(Mesh mesh, const Eigen::Affine3d& T_b_a);

// Only the triangles for which keep(index) holds.
Mesh Filtered(const Mesh& mesh, const std::function<bool(std::size_t triangle)>& keep);

// Without triangles of less than this area (m^2), which have no sure normal, and without the second
// of two in the same place, as files have them for the back of thin things.
Mesh Cleaned(const Mesh& mesh, double min_area_m2);

// Triangles turned so that their front looks where there is more open space: files do not always
// wind them the same way.
Mesh FacingOutwards(Mesh mesh);

// Normals that agree with the triangles' fronts: those of the file where it has them, otherwise
// means over the neighbours whose planes differ by less than the crease angle.
Mesh WithNormals(Mesh mesh, double crease_rad);

// Triangles cut until no side is longer, without gaps between neighbours, so that light can be
// stored per vertex.
Mesh Subdivided(const Mesh& mesh, double max_side_m);

// Metric texture coordinates for the triangles of a material, seen along the axis that their
// planes face most.
Mesh WithBoxUvs(Mesh mesh, int material, double period_m);

// Vertices that agree in everything made one.
Mesh Welded(const Mesh& mesh);

}  // namespace cslam
