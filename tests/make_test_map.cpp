// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes the map of two rooms that the tests of "changing-slam map" look into; with "empty", one
// without a keyframe.
#include "cslam/atlas_io/test_atlas.h"

#include <string_view>

int main(int argc, char** argv) {
  const bool is_empty = argc == 3 && std::string_view(argv[2]) == "empty";
  if (argc != 2 && !is_empty) return 2;
  cslam::SaveMap(argv[1],
                 is_empty ? cslam::Map(cslam::test::kLevelScales) : cslam::test::MakeAtlas(),
                 cslam::test::MakeMapFileInfo());
  return 0;
}
