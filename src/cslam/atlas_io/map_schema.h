// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/atlas_io/map_file.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

// Private to the writer and the reader of map files.
namespace cslam {

// In the header of the file, where SQLite leaves room for it: "CSLM".
inline constexpr std::int32_t kMapApplicationId = 0x43534C4D;

struct MapTable {
  const char* name;
  const char* columns;  // as in CREATE TABLE
  int num_columns;
};

// Poses, positions and scales have no declared type, so SQLite keeps them bit by bit.
inline constexpr MapTable kInfoTable{
    "info",
    "id INTEGER PRIMARY KEY, program TEXT, created TEXT, camera TEXT, is_approximate INTEGER,"
    " depth_units_per_m, width_px INTEGER, height_px INTEGER, fx_px, fy_px, cx_px, cy_px,"
    " k1, k2, p1, p2, k3",
    17};
inline constexpr MapTable kLevelsTable{"levels", "id INTEGER PRIMARY KEY, scale", 2};
inline constexpr MapTable kKeyframesTable{
    "keyframes",
    "id INTEGER PRIMARY KEY, state INTEGER, map INTEGER, parent INTEGER, forward_to INTEGER,"
    " frame INTEGER, stamp_ns INTEGER, tx, ty, tz, qx, qy, qz, qw,"
    " keypoints BLOB, descriptors BLOB, semantics BLOB, points BLOB,"
    " depth_width_px INTEGER, depth_height_px INTEGER, depth_mm BLOB,"
    " colour_width_px INTEGER, colour_height_px INTEGER, colours BLOB",
    24};
// Of these the last ones came with version 4.
inline constexpr std::string_view kKeyframeColumnsSince4 =
    ", colour_width_px INTEGER, colour_height_px INTEGER, colours BLOB";
inline constexpr MapTable kPointsTable{
    "points",
    "id INTEGER PRIMARY KEY, state INTEGER, replaced_by INTEGER, map INTEGER, x, y, z,"
    " reference INTEGER, created_by INTEGER, times_expected INTEGER, times_found INTEGER,"
    " appearance BLOB, object INTEGER",
    13};
inline constexpr MapTable kObjectsTable{
    "objects",
    "id INTEGER PRIMARY KEY, state INTEGER, merged_into INTEGER, map INTEGER, class_id INTEGER,"
    " votes BLOB, log_odds, is_active INTEGER, reference INTEGER, x, y, z,"
    " box_x, box_y, box_z, box_size_x, box_size_y, box_size_z, box_qx, box_qy, box_qz, box_qw,"
    " colours BLOB, voxel_m, voxels BLOB, samples BLOB,"
    " first_box_x_min, first_box_y_min, first_box_x_max, first_box_y_max,"
    " box_x_min, box_y_min, box_x_max, box_y_max, track INTEGER,"
    " first_keyframe INTEGER, arrived_keyframe INTEGER, last_keyframe INTEGER,"
    " first_seen_ns INTEGER, last_seen_ns INTEGER, absent_since_ns INTEGER,"
    " first_session INTEGER, last_session INTEGER, num_sightings INTEGER, history BLOB,"
    " num_named_views INTEGER, num_unnamed_views INTEGER",
    47};
// Of these the last ones came with version 3.
inline constexpr std::string_view kObjectColumnsSince3 =
    ", num_named_views INTEGER, num_unnamed_views INTEGER";
inline constexpr MapTable kChangesTable{
    "changes",
    "id INTEGER PRIMARY KEY, kind INTEGER, object INTEGER, new_object INTEGER,"
    " last_seen_there_ns INTEGER, first_seen_absent_ns INTEGER, reported_ns INTEGER, confidence,"
    " num_absent_views INTEGER, num_seen_views INTEGER, is_between_sessions INTEGER",
    11};
inline constexpr MapTable kLoopsTable{
    "loops", "id INTEGER PRIMARY KEY, match INTEGER, query INTEGER, tx, ty, tz, qx, qy, qz, qw",
    10};
inline constexpr MapTable kSessionsTable{
    "sessions", "id INTEGER PRIMARY KEY, first_keyframe INTEGER, name TEXT", 3};
inline constexpr MapTable kChecksumsTable{
    "checksums", "id INTEGER PRIMARY KEY, name TEXT, num_rows INTEGER, crc32 INTEGER", 4};

inline constexpr std::array kMapTables = {kInfoTable,   kLevelsTable,   kKeyframesTable,
                                          kPointsTable, kObjectsTable,  kChangesTable,
                                          kLoopsTable,  kSessionsTable, kChecksumsTable};

// Normal, distances and angle as floats, then the descriptor.
inline constexpr std::size_t kAppearanceBytes = 6 * sizeof(float) + 32;

// As SQLite keeps it, letter by letter.
inline std::string CreateTableSql(const MapTable& table, int version = kMapFormatVersion) {
  std::string_view columns = table.columns;
  const auto leave_out = [&columns](std::string_view last) {
    if (columns.ends_with(last)) columns.remove_suffix(last.size());
  };
  if (version < 3) leave_out(kObjectColumnsSince3);
  if (version < 4) leave_out(kKeyframeColumnsSince4);
  return std::string("CREATE TABLE ") + table.name + "(" + std::string(columns) + ")";
}

// The column keyframes.state.
enum class KeyframeState : std::int8_t {
  kAlive = 0,
  kForwarded = 1,  // culled: a pose relative to forward_to
  kNone = 2,       // the id is taken, and stands for nothing
};

}  // namespace cslam
