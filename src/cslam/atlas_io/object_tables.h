// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/atlas_io/sqlite_file.h"
#include "cslam/map/map_view.h"

#include <vector>

// Private to the writer and the reader of map files.
namespace cslam {

void WriteObjects(TableWriter& row, const MapView& map);
std::vector<MapObject> ReadObjects(TableReader& row, int version);  // of the file's format

void WriteChanges(TableWriter& row, const MapView& map);
std::vector<MapChange> ReadChanges(TableReader& row);

}  // namespace cslam
