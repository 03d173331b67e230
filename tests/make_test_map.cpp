// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes the map of two rooms that the tests of "changing-slam map" look into.
#include "cslam/atlas_io/test_atlas.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  cslam::SaveMap(argv[1], cslam::test::MakeAtlas(), cslam::test::MakeMapFileInfo());
  return 0;
}
