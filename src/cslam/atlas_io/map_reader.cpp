// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/atlas_io/bytes.h"
#include "cslam/atlas_io/keyframe_blobs.h"
#include "cslam/atlas_io/map_file.h"
#include "cslam/atlas_io/map_schema.h"
#include "cslam/atlas_io/object_tables.h"
#include "cslam/atlas_io/row_values.h"
#include "cslam/atlas_io/sqlite_file.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <system_error>

namespace cslam {
namespace {

namespace fs = std::filesystem;

// What SQLite's file header (its documentation, section 1.3) says, numbers big-endian.
class FileHeader {
 public:
  explicit FileHeader(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    stream.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    is_complete_ = static_cast<std::size_t>(stream.gcount()) == bytes_.size();
  }

  bool IsSqlite() const {
    constexpr std::string_view kMagic("SQLite format 3\0", 16);
    return is_complete_ && std::string_view(bytes_.data(), kMagic.size()) == kMagic;
  }
  std::uint32_t page_bytes() const { return Number(16, 2) == 1 ? 65536 : Number(16, 2); }
  std::uint32_t num_pages() const { return Number(28, 4); }
  std::uint32_t user_version() const { return Number(60, 4); }
  std::uint32_t application_id() const { return Number(68, 4); }

 private:
  std::uint32_t Number(std::size_t offset, std::size_t size) const {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < size; ++i)
      number = number << 8 | static_cast<unsigned char>(bytes_[offset + i]);
    return number;
  }

  std::array<char, 100> bytes_{};
  bool is_complete_ = false;
};

// Returns the version of the format.
int CheckHeader(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    throw Error("there is no map file '{}'", path.string());
  }
  const std::uintmax_t size = fs::file_size(path);
  const FileHeader header(path);
  if (!header.IsSqlite() || header.application_id() != std::uint32_t{kMapApplicationId}) {
    throw Error("'{}' is not a map of changing-slam, or its beginning is damaged", path.string());
  }
  if (header.user_version() > std::uint32_t{kMapFormatVersion}) {
    throw Error("'{}' has map format {}, this program knows formats up to {}; use a newer one",
                path.string(), header.user_version(), kMapFormatVersion);
  }
  if (header.user_version() < std::uint32_t{kOldestMapFormatVersion}) {
    throw Error(
        "'{}' has map format {}, this program knows formats from {} on; make it anew with "
        "'run --save-map'",
        path.string(), header.user_version(), kOldestMapFormatVersion);
  }
  const std::uintmax_t expected = std::uintmax_t{header.page_bytes()} * header.num_pages();
  if (size != expected) {
    throw Error("'{}' is damaged: it has {} bytes instead of {}; take an older copy", path.string(),
                size, expected);
  }
  return static_cast<int>(header.user_version());
}

// Neither more nor other than what we write: a view or trigger could do anything.
void CheckSchema(const SqliteFile& file, int version) {
  TableReader row(file, "sqlite_schema", "sql", "rowid");
  for (const MapTable& table : kMapTables) {
    if (!row.NextRow() || row.IsNull() || row.Text() != CreateTableSql(table, version)) {
      throw Error("its tables are not those of a map");
    }
  }
  if (row.NextRow()) throw Error("it has more tables than a map");
}

MapFileInfo ReadInfo(TableReader& row) {
  MapFileInfo info;
  if (!row.NextRow()) throw Error("it does not say what it is");
  ReadRowId(row);
  info.program = row.Text();
  info.created = row.Text();
  info.camera.name = row.Text();
  info.camera.approximate = ReadInt(row, 0, 1) != 0;
  info.camera.depth_units_per_m = row.Double();
  Camera& c = info.camera.camera;
  constexpr int kMaxSide = std::numeric_limits<std::uint16_t>::max();
  c.width = ReadInt(row, 1, kMaxSide);
  c.height = ReadInt(row, 1, kMaxSide);
  for (double* value : {&c.fx, &c.fy, &c.cx, &c.cy, &c.k1, &c.k2, &c.p1, &c.p2, &c.k3})
    *value = row.Double();
  if (const std::string reason = WhyInvalid(c); !reason.empty()) {
    throw Error("its camera cannot be used: {}", reason);
  }
  if (row.NextRow()) throw Error("it says twice what it is");
  return info;
}

std::vector<double> ReadLevels(TableReader& row) {
  std::vector<double> scales;
  while (row.NextRow()) {
    ReadRowId(row);
    scales.push_back(row.Double());
  }
  return scales;
}

// Of features; a lens no camera has could ask for any number of cells.
ImageBounds CheckedBounds(const Camera& camera) {
  constexpr double kMaxGrowth = 20.0;  // times the image's longer side
  const ImageBounds bounds = UndistortedBounds(camera);
  const double limit = kMaxGrowth * std::max(camera.width, camera.height);
  for (const double side : {bounds.min_u, bounds.max_u, bounds.min_v, bounds.max_v}) {
    if (!(std::abs(side) < limit)) throw Error("its camera's distortion is out of all proportion");
  }
  return bounds;
}

cv::Mat ReadImage(TableReader& row, int type) {
  const std::int64_t width_px = row.Int();
  const std::int64_t height_px = row.Int();
  return UnpackImage(row.Blob(), width_px, height_px, type);
}

std::shared_ptr<const KeyframeData> ReadKeyframeBlobs(TableReader& row, int version,
                                                      KeyframeData data, const ImageBounds& bounds,
                                                      std::vector<PointId>& points) {
  FrameFeatures& features = data.features;
  features.keypoints = UnpackKeypoints(row.Blob());
  const std::size_t size = features.keypoints.size();
  features.descriptors = UnpackDescriptors(row.Blob(), size);
  features.semantics = UnpackSemantics(row.Blob(), size);
  points = UnpackPoints(row.Blob(), size);
  features.grid = KeypointGrid(bounds, features.keypoints);
  data.depth_small_mm = ReadImage(row, CV_16UC1);
  if (version >= 4) data.bgr_small = ReadImage(row, CV_8UC3);
  return std::make_shared<const KeyframeData>(std::move(data));
}

Keyframe ReadKeyframe(TableReader& row, int version, const ImageBounds& bounds) {
  const int num_blob_columns = version < 4 ? 7 : 10;
  Keyframe keyframe;
  const KeyframeId id(ReadRowId(row));
  const auto state = static_cast<KeyframeState>(ReadInt(row, 0, 2));
  keyframe.map = ReadId<MapId>(row);
  keyframe.parent = ReadId<KeyframeId>(row);
  keyframe.forward_to = ReadId<KeyframeId>(row);
  if (state != KeyframeState::kAlive) {
    SkipNulls(row, 2);
    if (state == KeyframeState::kForwarded) {
      keyframe.id = id;
      keyframe.T_forward_self = ReadPose(row);
    } else {
      SkipNulls(row, 7);
    }
    SkipNulls(row, num_blob_columns);
    return keyframe;
  }
  keyframe.id = id;
  KeyframeData data;
  data.frame = ReadId<FrameId>(row);
  data.stamp = Stamp{row.Int()};
  keyframe.T_world_camera = ReadPose(row);
  keyframe.data = ReadKeyframeBlobs(row, version, std::move(data), bounds, keyframe.points);
  return keyframe;
}

std::vector<Keyframe> ReadKeyframes(TableReader& row, int version, const ImageBounds& bounds) {
  std::vector<Keyframe> keyframes;
  while (row.NextRow())
    keyframes.push_back(ReadKeyframe(row, version, bounds));
  return keyframes;
}

void ReadAppearance(std::string_view bytes, MapPoint& point) {
  if (bytes.size() != kAppearanceBytes) throw Error("a point's blob has a wrong length");
  ByteReader reader(bytes);
  for (float& value : point.normal)
    value = reader.Next<float>();
  point.min_distance_m = reader.Next<float>();
  point.max_distance_m = reader.Next<float>();
  point.angle_rad = reader.Next<float>();
  for (std::uint64_t& word : point.descriptor.words)
    word = reader.Next<std::uint64_t>();
}

MapPoint ReadPoint(TableReader& row) {
  constexpr int kMaxInt = std::numeric_limits<int>::max();
  MapPoint point;
  point.id = PointId(ReadRowId(row));
  point.state = static_cast<PointState>(ReadInt(row, 0, static_cast<int>(PointState::kErased)));
  point.replaced_by = ReadId<PointId>(row);
  if (!point.IsActive()) {
    constexpr int kNumActiveColumns = 10;
    SkipNulls(row, kNumActiveColumns);
    return point;
  }
  point.map = ReadId<MapId>(row);
  point.p_world = ReadVector(row);
  point.reference = ReadId<KeyframeId>(row);
  point.created_by = ReadId<KeyframeId>(row);
  point.times_expected = ReadInt(row, 0, kMaxInt);
  point.times_found = ReadInt(row, 0, kMaxInt);
  ReadAppearance(row.Blob(), point);
  point.object = ReadId<ObjectId>(row);
  return point;
}

std::vector<MapPoint> ReadPoints(TableReader& row) {
  std::vector<MapPoint> points;
  while (row.NextRow())
    points.push_back(ReadPoint(row));
  return points;
}

std::vector<LoopEdge> ReadLoops(TableReader& row) {
  std::vector<LoopEdge> loops;
  while (row.NextRow()) {
    ReadRowId(row);
    LoopEdge loop;
    loop.match = ReadId<KeyframeId>(row);
    loop.query = ReadId<KeyframeId>(row);
    loop.T_match_query = ReadPose(row);
    loops.push_back(loop);
  }
  return loops;
}

std::vector<KeyframeId> ReadSessions(TableReader& row, std::vector<std::string>& names) {
  std::vector<KeyframeId> sessions;
  while (row.NextRow()) {
    ReadRowId(row);
    sessions.push_back(ReadId<KeyframeId>(row));
    names.emplace_back(row.Text());
  }
  return sessions;
}

// What is held back follows from the objects.
void HoldBackPoints(MapContents& contents) {
  for (MapPoint& point : contents.points) {
    if (!point.object.valid()) continue;
    if (point.object.index() >= contents.objects.size()) {
      throw Error("point {} is part of an object that never was", point.id.value());
    }
    point.is_held_back = !contents.objects[point.object.index()].is_active;
  }
}

void CheckChecksum(TableReader& checksums, const MapTable& table, const TableReader& read) {
  if (!checksums.NextRow()) throw Error("the checksum of table '{}' is missing", table.name);
  ReadRowId(checksums);
  const bool is_its_own = checksums.Text() == table.name;
  if (!is_its_own || checksums.Int() != read.num_rows() || checksums.Int() != read.crc()) {
    throw Error("the checksum of table '{}' does not match", table.name);
  }
}

SavedMap ReadDatabase(const fs::path& path, int version) {
  const SqliteFile file = SqliteFile::OpenForReading(path);
  CheckSchema(file, version);
  TableReader checksums(file, kChecksumsTable.name, "*", "id");
  const auto read = [&](const MapTable& table, auto&& read_rows) {
    TableReader row(file, table.name, "*", "id");
    auto rows = read_rows(row);
    CheckChecksum(checksums, table, row);
    return rows;
  };
  MapFileInfo info = read(kInfoTable, ReadInfo);
  info.version = version;
  info.level_scales = read(kLevelsTable, ReadLevels);
  const ImageBounds bounds = CheckedBounds(info.camera.camera);
  MapContents contents;
  contents.level_scales = info.level_scales;
  contents.keyframes =
      read(kKeyframesTable, [&](TableReader& row) { return ReadKeyframes(row, version, bounds); });
  contents.points = read(kPointsTable, ReadPoints);
  contents.objects =
      read(kObjectsTable, [&](TableReader& row) { return ReadObjects(row, version); });
  contents.changes = read(kChangesTable, ReadChanges);
  contents.loops = read(kLoopsTable, ReadLoops);
  contents.sessions =
      read(kSessionsTable, [&](TableReader& row) { return ReadSessions(row, info.sessions); });
  HoldBackPoints(contents);
  if (checksums.NextRow()) throw Error("it has more checksums than tables");
  return {.info = std::move(info), .map = Map(std::move(contents))};
}

}  // namespace

SavedMap LoadMap(const fs::path& path) {
  const int version = CheckHeader(path);
  try {
    return ReadDatabase(path, version);
  } catch (const Error& error) {
    throw Error("'{}' is damaged: {}; take an older copy", path.string(), error.what());
  }
}

void RequireSameCamera(const fs::path& path, const MapFileInfo& info, const Camera& camera) {
  const Camera& saved = info.camera.camera;
  std::string differences;
  const auto compare = [&](const char* name, auto in_map, auto here) {
    if (in_map == here) return;
    differences +=
        fmt::format("{}{} {} instead of {}", differences.empty() ? "" : ", ", name, here, in_map);
  };
  compare("width", saved.width, camera.width);
  compare("height", saved.height, camera.height);
  compare("fx", saved.fx, camera.fx);
  compare("fy", saved.fy, camera.fy);
  compare("cx", saved.cx, camera.cx);
  compare("cy", saved.cy, camera.cy);
  compare("k1", saved.k1, camera.k1);
  compare("k2", saved.k2, camera.k2);
  compare("p1", saved.p1, camera.p1);
  compare("p2", saved.p2, camera.p2);
  compare("k3", saved.k3, camera.k3);
  if (differences.empty()) return;
  throw Error(
      "the map '{}' was made with another camera ({}): {}; use the camera of the map, or "
      "make a new one",
      path.string(), info.camera.name.empty() ? "unnamed" : info.camera.name, differences);
}

}  // namespace cslam
