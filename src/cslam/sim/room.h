// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/scene.h"

#include <cstdint>

namespace cslam {

struct RoomOptions {
  std::uint64_t seed = 1;
  double texels_per_m = 960.0;  // of textures seen from near; walls and floor get a part of it
  double light_cell_m = 0.12;   // spacing of the baked light
};

// A furnished study of 6 x 5 x 2.7 m (x from 0 to 6, y from 0 to 5): desks with screens, book
// shelves, cabinets, a sofa, boxes, pictures. The seed changes every texture and the clutter, not
// the big furniture, so that one camera path fits all seeds.
Scene MakeRoom(const RoomOptions& options);

}  // namespace cslam
