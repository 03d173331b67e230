// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/atlas_io/map_summary.h"

#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace cslam {
namespace {

using Json = nlohmann::ordered_json;

Json CameraJson(const CameraConfig& config) {
  const Camera& c = config.camera;
  return {{"name", config.name}, {"is_approximate", config.approximate},
          {"width_px", c.width}, {"height_px", c.height},
          {"fx_px", c.fx},       {"fy_px", c.fy},
          {"cx_px", c.cx},       {"cy_px", c.cy},
          {"k1", c.k1},          {"k2", c.k2},
          {"p1", c.p1},          {"p2", c.p2},
          {"k3", c.k3},          {"depth_units_per_m", config.depth_units_per_m}};
}

Json BoxJson(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return nullptr;
  const auto corner = [](const Eigen::Vector3d& p) { return Json{p.x(), p.y(), p.z()}; };
  return {{"min_m", corner(box.min())}, {"max_m", corner(box.max())}};
}

Json MapJson(const MapSummary& map) {
  return {{"map", map.map.value()},
          {"keyframes", map.num_keyframes},
          {"points", map.num_points},
          {"first_stamp", FormatStamp(map.first)},
          {"last_stamp", FormatStamp(map.last)},
          {"keyframes_box", BoxJson(map.keyframes_box)},
          {"points_box", BoxJson(map.points_box)}};
}

Json SessionJson(const SessionSummary& session) {
  const bool has_stamps = session.num_keyframes > 0;
  return {{"name", session.name},
          {"keyframes", session.num_keyframes},
          {"first_stamp", has_stamps ? Json(FormatStamp(session.first)) : Json(nullptr)},
          {"last_stamp", has_stamps ? Json(FormatStamp(session.last)) : Json(nullptr)}};
}

Json HeadJson(const MapFileInfo& info) {
  return {{"format", "map"},
          {"version", info.version},
          {"program", info.program},
          {"created", info.created},
          {"camera", CameraJson(info.camera)}};
}

// Names may hold anything; what is no UTF-8 is replaced instead of refused.
std::string Dump(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string KeyframeLine(const Keyframe& keyframe) {
  const Se3& T = keyframe.T_world_camera;
  const Eigen::Quaterniond& q = T.rotation;
  const auto num_seen = std::count_if(keyframe.points.begin(), keyframe.points.end(),
                                      [](PointId point) { return point.valid(); });
  const Json line = {
      {"id", keyframe.id.value()},
      {"map", keyframe.map.value()},
      {"parent", keyframe.parent.valid() ? Json(keyframe.parent.value()) : Json(nullptr)},
      {"stamp", FormatStamp(keyframe.data->stamp)},
      {"pose",
       {T.translation.x(), T.translation.y(), T.translation.z(), q.x(), q.y(), q.z(), q.w()}},
      {"keypoints", keyframe.points.size()},
      {"points", num_seen}};
  return Dump(line, -1);
}

std::string PointLine(const MapPoint& point) {
  const Eigen::Vector3d& p = point.p_world;
  const Json line = {{"id", point.id.value()},
                     {"map", point.map.value()},
                     {"position_m", {p.x(), p.y(), p.z()}},
                     {"observations", point.observations.size()}};
  return Dump(line, -1);
}

// Writes "key": [line, line, ...], one element a line.
class JsonArray {
 public:
  JsonArray(AtomicFile& file, const char* key) : file_(file) { file_.Print(",\n  \"{}\": [", key); }
  void Add(const std::string& line) {
    file_.Print("{}\n    {}", is_first_ ? "" : ",", line);
    is_first_ = false;
  }
  void End() { file_.Write(is_first_ ? "]" : "\n  ]"); }

 private:
  AtomicFile& file_;
  bool is_first_ = true;
};

}  // namespace

std::vector<MapSummary> SummariseMaps(const MapView& map) {
  std::map<MapId, MapSummary> summaries;
  for (const KeyframeId id : map.Keyframes()) {
    const Keyframe& keyframe = *map.FindKeyframe(id);
    const Stamp stamp = keyframe.data->stamp;
    const auto [it, is_new] = summaries.try_emplace(keyframe.map);
    MapSummary& summary = it->second;
    if (is_new) {
      summary.map = keyframe.map;
      summary.first = summary.last = stamp;
    }
    ++summary.num_keyframes;
    summary.first = std::min(summary.first, stamp);
    summary.last = std::max(summary.last, stamp);
    summary.keyframes_box.extend(keyframe.T_world_camera.translation);
  }
  for (std::size_t i = 0; i < map.num_point_ids(); ++i) {
    const MapPoint* point = map.FindPoint(PointId(static_cast<std::uint32_t>(i)));
    if (point == nullptr) continue;
    MapSummary& summary = summaries.at(point->map);
    ++summary.num_points;
    summary.points_box.extend(point->p_world);
  }
  std::vector<MapSummary> list;
  list.reserve(summaries.size());
  for (const auto& [id, summary] : summaries)
    list.push_back(summary);
  return list;
}

MapId LargestMapOf(const std::vector<MapSummary>& maps) {
  const auto largest = std::max_element(maps.begin(), maps.end(), [](const auto& a, const auto& b) {
    return a.num_keyframes < b.num_keyframes;
  });
  if (largest == maps.end()) throw Error("the map is empty: nothing was tracked when it was saved");
  return largest->map;
}

std::vector<SessionSummary> SummariseSessions(const SavedMap& saved) {
  const std::vector<std::string>& names = saved.info.sessions;
  std::vector<SessionSummary> sessions(saved.map.sessions().size());
  for (std::size_t i = 0; i < sessions.size(); ++i)
    sessions[i].name = i < names.size() ? names[i] : "";
  for (const KeyframeId id : saved.map.Keyframes()) {
    SessionSummary& session = sessions[saved.map.SessionOf(id)];
    const Stamp stamp = saved.map.FindKeyframe(id)->data->stamp;
    const bool is_first = session.num_keyframes++ == 0;
    session.first = is_first ? stamp : std::min(session.first, stamp);
    session.last = is_first ? stamp : std::max(session.last, stamp);
  }
  return sessions;
}

std::string FormatMapInfo(const SavedMap& saved, std::uintmax_t size_bytes) {
  Json json = HeadJson(saved.info);
  json["size_bytes"] = size_bytes;
  json["levels"] = saved.info.level_scales;
  json["maps"] = Json::array();
  for (const MapSummary& map : SummariseMaps(saved.map))
    json["maps"].push_back(MapJson(map));
  json["sessions"] = Json::array();
  for (const SessionSummary& session : SummariseSessions(saved))
    json["sessions"].push_back(SessionJson(session));
  json["loops"] = saved.map.loops().size();
  json["objects"] = saved.map.Objects().size();
  json["changes"] = saved.map.changes().size();
  return Dump(json, 2) + "\n";
}

void WriteMapJson(const std::filesystem::path& path, const SavedMap& saved) {
  AtomicFile file(path);
  std::string head = Dump(HeadJson(saved.info), 2);
  head.resize(head.rfind('\n'));  // without the closing brace
  file.Write(head);
  JsonArray keyframes(file, "keyframes");
  for (const KeyframeId id : saved.map.Keyframes())
    keyframes.Add(KeyframeLine(*saved.map.FindKeyframe(id)));
  keyframes.End();
  JsonArray points(file, "points");
  for (std::size_t i = 0; i < saved.map.num_point_ids(); ++i) {
    const MapPoint* point = saved.map.FindPoint(PointId(static_cast<std::uint32_t>(i)));
    if (point != nullptr) points.Add(PointLine(*point));
  }
  points.End();
  file.Write("\n}\n");
  file.Commit();
}

}  // namespace cslam
