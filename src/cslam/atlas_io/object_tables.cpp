// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/atlas_io/object_tables.h"

#include "cslam/atlas_io/bytes.h"
#include "cslam/atlas_io/row_values.h"
#include "cslam/util/check.h"

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace cslam {
namespace {

constexpr int kMaxInt = std::numeric_limits<int>::max();
constexpr std::size_t kVoxelBytes = 22;
constexpr std::size_t kSampleBytes = 3 * sizeof(float);
constexpr std::size_t kVoteBytes = 6;
constexpr std::size_t kBeliefBytes = 13;

// How many elements a blob holds: a count in the file never decides about memory.
std::size_t NumElements(std::string_view bytes, std::size_t element_bytes) {
  if (bytes.size() % element_bytes != 0) throw Error("a blob has a wrong length");
  return bytes.size() / element_bytes;
}

float NextFinite(ByteReader& reader) {
  const float value = reader.Next<float>();
  if (!std::isfinite(value)) throw Error("a number of an object is not finite");
  return value;
}

Eigen::Vector3f NextVector(ByteReader& reader) {
  Eigen::Vector3f v;
  for (float& value : v)
    value = NextFinite(reader);
  return v;
}

std::string PackVoxels(const std::vector<SurfaceVoxel>& voxels) {
  ByteWriter writer(voxels.size() * kVoxelBytes);
  for (const SurfaceVoxel& voxel : voxels) {
    for (const std::int16_t index : voxel.cell)
      writer.Add(index);
    for (const float value : voxel.p)
      writer.Add(value);
    writer.Add(voxel.num_inside);
    writer.Add(voxel.num_outside);
  }
  return std::move(writer).Take();
}

std::vector<SurfaceVoxel> UnpackVoxels(std::string_view bytes) {
  std::vector<SurfaceVoxel> voxels(NumElements(bytes, kVoxelBytes));
  ByteReader reader(bytes);
  for (SurfaceVoxel& voxel : voxels) {
    for (std::int16_t& index : voxel.cell)
      index = reader.Next<std::int16_t>();
    voxel.p = NextVector(reader);
    voxel.num_inside = reader.Next<std::uint16_t>();
    voxel.num_outside = reader.Next<std::uint16_t>();
  }
  return voxels;
}

std::string PackSamples(const std::vector<Eigen::Vector3f>& samples) {
  ByteWriter writer(samples.size() * kSampleBytes);
  for (const Eigen::Vector3f& sample : samples) {
    for (const float value : sample)
      writer.Add(value);
  }
  return std::move(writer).Take();
}

std::vector<Eigen::Vector3f> UnpackSamples(std::string_view bytes) {
  std::vector<Eigen::Vector3f> samples(NumElements(bytes, kSampleBytes));
  ByteReader reader(bytes);
  for (Eigen::Vector3f& sample : samples)
    sample = NextVector(reader);
  return samples;
}

std::string PackVotes(const std::vector<MapObject::ClassVote>& votes) {
  ByteWriter writer(votes.size() * kVoteBytes);
  for (const MapObject::ClassVote& vote : votes) {
    writer.Add(vote.class_id);
    writer.Add(vote.weight);
  }
  return std::move(writer).Take();
}

std::vector<MapObject::ClassVote> UnpackVotes(std::string_view bytes) {
  std::vector<MapObject::ClassVote> votes(NumElements(bytes, kVoteBytes));
  ByteReader reader(bytes);
  for (MapObject::ClassVote& vote : votes) {
    vote.class_id = reader.Next<std::int16_t>();
    vote.weight = NextFinite(reader);
  }
  return votes;
}

std::string PackHistory(const std::vector<BeliefStep>& history) {
  ByteWriter writer(history.size() * kBeliefBytes);
  for (const BeliefStep& sample : history) {
    writer.Add(sample.stamp.ns);
    writer.Add(sample.belief);
    writer.Add(static_cast<std::uint8_t>(sample.cause));
  }
  return std::move(writer).Take();
}

std::vector<BeliefStep> UnpackHistory(std::string_view bytes) {
  std::vector<BeliefStep> history(NumElements(bytes, kBeliefBytes));
  ByteReader reader(bytes);
  for (BeliefStep& sample : history) {
    sample.stamp = Stamp{reader.Next<std::int64_t>()};
    sample.belief = NextFinite(reader);
    const auto cause = reader.Next<std::uint8_t>();
    if (cause > static_cast<std::uint8_t>(BeliefCause::kDisplaced)) {
      throw Error("a belief changed for reason {}, which is none", cause);
    }
    sample.cause = static_cast<BeliefCause>(cause);
  }
  return history;
}

std::string PackColours(const ColourHistogram& colours) {
  ByteWriter writer(colours.size() * sizeof(float));
  for (const float value : colours)
    writer.Add(value);
  return std::move(writer).Take();
}

ColourHistogram UnpackColours(std::string_view bytes) {
  ColourHistogram colours{};
  if (NumElements(bytes, sizeof(float)) != colours.size()) {
    throw Error("a blob has a wrong length");
  }
  ByteReader reader(bytes);
  for (float& value : colours)
    value = NextFinite(reader);
  return colours;
}

void WriteSurface(TableWriter& row, const ObjectSurface* surface) {
  constexpr int kNumColumns = 3;
  if (surface == nullptr) {
    WriteNulls(row, kNumColumns);
    return;
  }
  row.Double(surface->voxel_m);
  row.BlobCopy(PackVoxels(surface->voxels));
  row.BlobCopy(PackSamples(surface->samples));
}

std::shared_ptr<const ObjectSurface> ReadSurface(TableReader& row) {
  if (row.IsNull()) {
    SkipNulls(row, 3);
    return nullptr;
  }
  auto surface = std::make_shared<ObjectSurface>();
  surface->voxel_m = ReadFinite(row);
  if (surface->voxel_m <= 0.0) throw Error("an object's voxels have no size");
  surface->voxels = UnpackVoxels(row.Blob());
  surface->samples = UnpackSamples(row.Blob());
  return surface;
}

void WriteBox(TableWriter& row, const Box& box) {
  for (const double side : {box.x_min, box.y_min, box.x_max, box.y_max})
    row.Double(side);
}

Box ReadBox(TableReader& row) {
  Box box;
  for (double* side : {&box.x_min, &box.y_min, &box.x_max, &box.y_max})
    *side = ReadFinite(row);
  return box;
}

void WriteSightings(TableWriter& row, const MapObject& object) {
  WriteBox(row, object.first_box);
  WriteBox(row, object.current_box);
  WriteId(row, object.track);
  WriteId(row, object.first_keyframe);
  WriteId(row, object.arrived_keyframe);
  WriteId(row, object.last_keyframe);
  WriteStamp(row, object.first_seen);
  WriteStamp(row, object.last_seen);
  WriteStamp(row, object.absent_since);
  row.Int(object.first_session);
  row.Int(object.last_session);
  row.Int(object.num_sightings);
}

void ReadSightings(TableReader& row, MapObject& object) {
  object.first_box = ReadBox(row);
  object.current_box = ReadBox(row);
  object.track = ReadId<TrackId>(row);
  object.first_keyframe = ReadId<KeyframeId>(row);
  object.arrived_keyframe = ReadId<KeyframeId>(row);
  object.last_keyframe = ReadId<KeyframeId>(row);
  object.first_seen = Stamp{row.Int()};
  object.last_seen = Stamp{row.Int()};
  object.absent_since = ReadStamp(row);
  object.first_session = static_cast<std::uint32_t>(ReadInt(row, 0, kMaxInt));
  object.last_session = static_cast<std::uint32_t>(ReadInt(row, 0, kMaxInt));
  object.num_sightings = ReadInt(row, 0, kMaxInt);
}

void WriteObject(TableWriter& row, const MapObject& object) {
  row.Int(row.num_rows());
  row.Int(static_cast<std::int64_t>(object.state));
  WriteId(row, object.merged_into);
  WriteId(row, object.map);
  row.Int(object.class_id);
  row.BlobCopy(PackVotes(object.votes));
  row.Double(object.log_odds);
  row.Int(object.is_active ? 1 : 0);
  WriteId(row, object.reference);
  WriteVector(row, object.centroid);
  WriteVector(row, object.box.center);
  WriteVector(row, object.box.size_m);
  WriteRotation(row, object.box.rotation);
  row.BlobCopy(PackColours(object.colours));
  WriteSurface(row, object.surface.get());
  WriteSightings(row, object);
  row.BlobCopy(PackHistory(object.history));
  row.Int(object.num_named_views);
  row.Int(object.num_unnamed_views);
  row.EndRow();
}

MapObject ReadObject(TableReader& row, int version) {
  constexpr int kMaxClass = std::numeric_limits<std::int16_t>::max();
  MapObject object;
  object.id = ObjectId(ReadRowId(row));
  object.state = static_cast<ObjectState>(ReadInt(row, 0, static_cast<int>(ObjectState::kErased)));
  object.merged_into = ReadId<ObjectId>(row);
  object.map = ReadId<MapId>(row);
  object.class_id = ReadInt(row, -1, kMaxClass);
  object.votes = UnpackVotes(row.Blob());
  object.log_odds = ReadFinite(row);
  object.is_active = ReadInt(row, 0, 1) != 0;
  object.reference = ReadId<KeyframeId>(row);
  object.centroid = ReadVector(row);
  object.box.center = ReadVector(row);
  object.box.size_m = ReadVector(row);
  object.box.rotation = ReadRotation(row);
  object.colours = UnpackColours(row.Blob());
  object.surface = ReadSurface(row);
  ReadSightings(row, object);
  object.history = UnpackHistory(row.Blob());
  if (version >= 3) {
    object.num_named_views = ReadInt(row, 0, kMaxInt);
    object.num_unnamed_views = ReadInt(row, 0, kMaxInt);
  }
  return object;
}

MapChange ReadChange(TableReader& row) {
  MapChange change;
  ReadRowId(row);
  change.kind =
      static_cast<MapChangeKind>(ReadInt(row, 0, static_cast<int>(MapChangeKind::kReplaced)));
  change.object = ReadId<ObjectId>(row);
  change.new_object = ReadId<ObjectId>(row);
  change.last_seen_there = Stamp{row.Int()};
  change.first_seen_absent = ReadStamp(row);
  change.reported = Stamp{row.Int()};
  change.confidence = ReadFinite(row);
  change.num_absent_views = ReadInt(row, 0, kMaxInt);
  change.num_seen_views = ReadInt(row, 0, kMaxInt);
  change.is_between_sessions = ReadInt(row, 0, 1) != 0;
  return change;
}

}  // namespace

void WriteObjects(TableWriter& row, const MapView& map) {
  for (std::size_t i = 0; i < map.num_object_ids(); ++i)
    WriteObject(row, map.ObjectSlot(i));
}

std::vector<MapObject> ReadObjects(TableReader& row, int version) {
  std::vector<MapObject> objects;
  while (row.NextRow())
    objects.push_back(ReadObject(row, version));
  return objects;
}

void WriteChanges(TableWriter& row, const MapView& map) {
  for (const MapChange& change : map.changes()) {
    row.Int(row.num_rows());
    row.Int(static_cast<std::int64_t>(change.kind));
    WriteId(row, change.object);
    WriteId(row, change.new_object);
    WriteStamp(row, change.last_seen_there);
    WriteStamp(row, change.first_seen_absent);
    WriteStamp(row, change.reported);
    row.Double(change.confidence);
    row.Int(change.num_absent_views);
    row.Int(change.num_seen_views);
    row.Int(change.is_between_sessions ? 1 : 0);
    row.EndRow();
  }
}

std::vector<MapChange> ReadChanges(TableReader& row) {
  std::vector<MapChange> changes;
  while (row.NextRow())
    changes.push_back(ReadChange(row));
  return changes;
}

}  // namespace cslam
