// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/atlas_io/bytes.h"
#include "cslam/atlas_io/keyframe_blobs.h"
#include "cslam/atlas_io/map_file.h"
#include "cslam/atlas_io/map_schema.h"
#include "cslam/atlas_io/object_tables.h"
#include "cslam/atlas_io/row_values.h"
#include "cslam/atlas_io/sqlite_file.h"
#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"

#include <signal.h>

#include <cerrno>
#include <charconv>
#include <optional>
#include <system_error>

namespace cslam {
namespace {

namespace fs = std::filesystem;

void WriteInfo(TableWriter& row, const MapFileInfo& info) {
  const Camera& c = info.camera.camera;
  row.Int(0);
  row.Text(info.program);
  row.Text(info.created);
  row.Text(info.camera.name);
  row.Int(info.camera.approximate ? 1 : 0);
  row.Double(info.camera.depth_units_per_m);
  row.Int(c.width);
  row.Int(c.height);
  for (const double value : {c.fx, c.fy, c.cx, c.cy, c.k1, c.k2, c.p1, c.p2, c.k3})
    row.Double(value);
  row.EndRow();
}

void WriteLevels(TableWriter& row, const std::vector<double>& scales) {
  for (const double scale : scales) {
    row.Int(row.num_rows());
    row.Double(scale);
    row.EndRow();
  }
}

void WriteAliveKeyframe(TableWriter& row, const Keyframe& keyframe) {
  const KeyframeData& data = *keyframe.data;
  CSLAM_CHECK(data.features.descriptors.size() == keyframe.points.size() &&
                  data.features.semantics.size() == keyframe.points.size(),
              "keyframe {}", keyframe.id.value());
  row.Null();  // forward_to
  WriteId(row, data.frame);
  WriteStamp(row, data.stamp);
  WritePose(row, keyframe.T_world_camera);
  const std::string keypoints = PackKeypoints(data.features.keypoints);
  const std::string descriptors = PackDescriptors(data.features.descriptors);
  const std::string semantics = PackSemantics(data.features.semantics);
  const std::string points = PackPoints(keyframe.points);
  for (const std::string* blob : {&keypoints, &descriptors, &semantics, &points})
    row.Blob(*blob);
  const std::string depth = PackImage(data.depth_small_mm);
  const std::string colours = PackImage(data.bgr_small);
  row.Int(data.depth_small_mm.cols);
  row.Int(data.depth_small_mm.rows);
  row.Blob(depth);
  row.Int(data.bgr_small.cols);
  row.Int(data.bgr_small.rows);
  row.Blob(colours);
  row.EndRow();
}

void WriteDeadKeyframe(TableWriter& row, const Keyframe& keyframe) {
  constexpr int kNumBlobColumns = 10;
  WriteId(row, keyframe.forward_to);
  WriteNulls(row, 2);  // frame and stamp
  if (keyframe.forward_to.valid()) {
    WritePose(row, keyframe.T_forward_self);
  } else {
    WriteNulls(row, 7);
  }
  WriteNulls(row, kNumBlobColumns);
  row.EndRow();
}

KeyframeState StateOf(const Keyframe& keyframe) {
  if (keyframe.IsAlive()) return KeyframeState::kAlive;
  return keyframe.forward_to.valid() ? KeyframeState::kForwarded : KeyframeState::kNone;
}

void WriteKeyframes(TableWriter& row, const MapView& map) {
  for (std::size_t i = 0; i < map.num_keyframe_ids(); ++i) {
    const Keyframe& keyframe = map.KeyframeSlot(i);
    row.Int(row.num_rows());
    row.Int(static_cast<std::int64_t>(StateOf(keyframe)));
    WriteId(row, keyframe.map);
    WriteId(row, keyframe.IsAlive() ? keyframe.parent : KeyframeId());
    if (keyframe.IsAlive()) {
      WriteAliveKeyframe(row, keyframe);
    } else {
      WriteDeadKeyframe(row, keyframe);
    }
  }
}

std::string PackAppearance(const MapPoint& point) {
  ByteWriter writer(kAppearanceBytes);
  for (const float value : point.normal)
    writer.Add(value);
  writer.Add(point.min_distance_m);
  writer.Add(point.max_distance_m);
  writer.Add(point.angle_rad);
  for (const std::uint64_t word : point.descriptor.words)
    writer.Add(word);
  return std::move(writer).Take();
}

void WritePoint(TableWriter& row, const MapPoint& point) {
  row.Int(row.num_rows());
  row.Int(static_cast<std::int64_t>(point.state));
  WriteId(row, point.state == PointState::kFused ? point.replaced_by : PointId());
  if (!point.IsActive()) {
    constexpr int kNumActiveColumns = 10;
    WriteNulls(row, kNumActiveColumns);
    row.EndRow();
    return;
  }
  WriteId(row, point.map);
  WriteVector(row, point.p_world);
  WriteId(row, point.reference);
  WriteId(row, point.created_by);
  row.Int(point.times_expected);
  row.Int(point.times_found);
  const std::string appearance = PackAppearance(point);
  row.Blob(appearance);
  WriteId(row, point.object);
  row.EndRow();
}

void WriteLoops(TableWriter& row, const std::vector<LoopEdge>& loops) {
  for (const LoopEdge& loop : loops) {
    row.Int(row.num_rows());
    WriteId(row, loop.match);
    WriteId(row, loop.query);
    WritePose(row, loop.T_match_query);
    row.EndRow();
  }
}

void WriteSessions(TableWriter& row, const MapView& map, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < map.sessions().size(); ++i) {
    row.Int(row.num_rows());
    WriteId(row, map.sessions()[i]);
    row.Text(i < names.size() ? names[i] : "");
    row.EndRow();
  }
}

void WriteChecksum(TableWriter& checksums, const MapTable& table, const TableWriter& writer) {
  checksums.Int(checksums.num_rows());
  checksums.Text(table.name);
  checksums.Int(writer.num_rows());
  checksums.Int(writer.crc());
  checksums.EndRow();
}

void WriteTables(const SqliteFile& file, const MapView& map, const MapFileInfo& info) {
  TableWriter checksums(file, kChecksumsTable.name, kChecksumsTable.num_columns);
  const auto write = [&](const MapTable& table, auto&& write_rows) {
    TableWriter writer(file, table.name, table.num_columns);
    write_rows(writer);
    WriteChecksum(checksums, table, writer);
  };
  write(kInfoTable, [&](TableWriter& row) { WriteInfo(row, info); });
  write(kLevelsTable, [&](TableWriter& row) { WriteLevels(row, info.level_scales); });
  write(kKeyframesTable, [&](TableWriter& row) { WriteKeyframes(row, map); });
  write(kPointsTable, [&](TableWriter& row) {
    for (std::size_t i = 0; i < map.num_point_ids(); ++i)
      WritePoint(row, map.PointSlot(i));
  });
  write(kObjectsTable, [&](TableWriter& row) { WriteObjects(row, map); });
  write(kChangesTable, [&](TableWriter& row) { WriteChanges(row, map); });
  write(kLoopsTable, [&](TableWriter& row) { WriteLoops(row, map.loops()); });
  write(kSessionsTable, [&](TableWriter& row) { WriteSessions(row, map, info.sessions); });
}

void WriteDatabase(const fs::path& path, const MapView& map, const MapFileInfo& info) {
  SqliteFile file = SqliteFile::OpenForWriting(path);
  file.Execute(fmt::format("PRAGMA application_id = {}", kMapApplicationId));
  file.Execute(fmt::format("PRAGMA user_version = {}", kMapFormatVersion));
  file.Execute("BEGIN");
  for (const MapTable& table : kMapTables)
    file.Execute(CreateTableSql(table));
  WriteTables(file, map, info);
  file.Execute("COMMIT");
  file.Close();
}

// The process that left "<name>.tmp-<pid>" or "<name>.tmp-<pid>-<number>"; nullopt for others.
std::optional<pid_t> OwnerOfTemporary(std::string_view file, const std::string& name) {
  const std::string prefix = name + ".tmp-";
  if (!file.starts_with(prefix)) return std::nullopt;
  file.remove_prefix(prefix.size());
  pid_t pid = 0;
  const char* const end = file.data() + file.size();
  const auto [rest, error] = std::from_chars(file.data(), end, pid);
  if (error != std::errc() || pid <= 0 || (rest != end && *rest != '-')) return std::nullopt;
  return pid;
}

// A map is large, and whoever was killed while saving one could not tidy up.
void RemoveLeftovers(const fs::path& path) {
  std::error_code ignored;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const std::string name = path.filename().string();
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const auto pid = OwnerOfTemporary(entry.path().filename().string(), name);
    const bool is_orphan = pid && kill(*pid, 0) != 0 && errno == ESRCH;
    if (is_orphan) fs::remove(entry.path(), ignored);
  }
}

}  // namespace

void SaveMap(const fs::path& path, const MapView& map, const MapFileInfo& info) {
  CSLAM_CHECK(!info.level_scales.empty());
  RemoveLeftovers(path);
  AtomicFile file(path);
  try {
    WriteDatabase(file.temporary_path(), map, info);
  } catch (const Error& error) {
    throw Error("cannot save the map as '{}': {}; an older file of that name is untouched",
                path.string(), error.what());
  }
  file.Commit();
}

}  // namespace cslam
