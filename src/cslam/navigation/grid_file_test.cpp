// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/navigation/grid_file.h"

#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

OccupancyGrid SmallGrid() {
  OccupancyGrid grid;
  grid.resolution_m = 0.1;
  grid.width = 2;
  grid.height = 2;
  grid.origin_m = {-1.0, 2.0};
  grid.has_floor = true;
  grid.cells = {CellState::kFree, CellState::kOccupied, CellState::kUnknown, CellState::kFree};
  return grid;
}

TEST(FormatGridPgm, PutsTheLargestYOnTop) {
  const std::string pgm = FormatGridPgm(SmallGrid());
  EXPECT_EQ(pgm, std::string("P5\n2 2\n255\n") + '\xCD' + '\xFE' + '\xFE' + '\0');
}

TEST(FormatGridYaml, HasWhatMapServerReads) {
  const std::string yaml = FormatGridYaml(SmallGrid(), "a.pgm");
  for (const char* line :
       {"image: a.pgm\n", "resolution: 0.1\n", "origin: [-1.000000, 2.000000, 0.0]\n",
        "negate: 0\n", "occupied_thresh: 0.65\n", "free_thresh: 0.196\n"}) {
    EXPECT_NE(yaml.find(line), std::string::npos) << line;
  }
}

TEST(WriteOccupancyGrid, WritesBothFilesOrSaysWhyNot) {
  const TestFolder folder;
  WriteOccupancyGrid(folder.path() / "room.yaml", SmallGrid());
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "room.yaml"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "room.pgm"));
  EXPECT_THROW(WriteOccupancyGrid(folder.path() / "none" / "room.yaml", SmallGrid()), Error);
}

}  // namespace
}  // namespace cslam
