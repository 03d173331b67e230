// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/ply_points.h"

#include "cslam/util/check.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <string_view>

namespace cslam {
namespace {

struct Property {
  std::string type;
  std::size_t offset = 0;  // bytes from the vertex's start
};

struct Layout {
  std::size_t num_vertices = 0;
  std::size_t vertex_bytes = 0;
  std::size_t header_bytes = 0;
  std::map<std::string, Property> properties;
};

std::size_t SizeOf(const std::string& type) {
  static const std::map<std::string, std::size_t> kSizes{
      {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
      {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
      {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = kSizes.find(type);
  return found == kSizes.end() ? 0 : found->second;
}

[[noreturn]] void Fail(const std::filesystem::path& file, std::string_view problem) {
  throw Error("{}: {}; expected a point cloud as 'run' writes it (map.ply)", file.string(),
              problem);
}

// Reads what stands before end_header.
class HeaderReader {
 public:
  HeaderReader(const std::filesystem::path& file, const std::string& bytes)
      : file_(file), bytes_(bytes) {}

  Layout Read() {
    if (!bytes_.starts_with("ply\n")) Fail(file_, "is no PLY file");
    const std::size_t end = bytes_.find("end_header\n");
    if (end == std::string::npos) Fail(file_, "has no end of its header");
    std::istringstream lines(bytes_.substr(0, end));
    for (std::string line; std::getline(lines, line);)
      ReadLine(line);
    layout_.header_bytes = end + std::string_view("end_header\n").size();
    if (!is_little_endian_) Fail(file_, "is not binary_little_endian");
    return layout_;
  }

 private:
  void ReadLine(const std::string& line) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "format") {
      std::string format;
      words >> format;
      is_little_endian_ = format == "binary_little_endian";
    } else if (keyword == "element") {
      std::string name;
      std::size_t count = 0;
      words >> name >> count;
      if (!has_element_ && name != "vertex") Fail(file_, "does not begin with vertices");
      is_vertex_ = !has_element_;
      if (is_vertex_) layout_.num_vertices = count;
      has_element_ = true;
    } else if (keyword == "property" && is_vertex_) {
      std::string type;
      std::string name;
      words >> type >> name;
      const std::size_t size = SizeOf(type);
      if (size == 0) Fail(file_, "has a property of type '" + type + "'");
      layout_.properties[name] = {type, layout_.vertex_bytes};
      layout_.vertex_bytes += size;
    }
  }

  const std::filesystem::path& file_;
  const std::string& bytes_;
  Layout layout_;
  bool is_little_endian_ = false;
  bool has_element_ = false;
  bool is_vertex_ = false;
};

double ValueAt(const char* vertex, const Property& property) {
  static_assert(std::endian::native == std::endian::little, "floats are read as they are");
  if (SizeOf(property.type) == sizeof(double)) {
    double value = 0.0;
    std::memcpy(&value, vertex + property.offset, sizeof value);
    return value;
  }
  float value = 0.0F;
  std::memcpy(&value, vertex + property.offset, sizeof value);
  return static_cast<double>(value);
}

std::array<Property, 3> Axes(const std::filesystem::path& file, const Layout& layout) {
  std::array<Property, 3> axes;
  const std::array<const char*, 3> names{"x", "y", "z"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = layout.properties.find(names[i]);
    const bool is_real =
        found != layout.properties.end() &&
        (found->second.type.starts_with("float") || found->second.type == "double");
    if (!is_real) Fail(file, std::string("has no real property ") + names[i]);
    axes[i] = found->second;
  }
  return axes;
}

}  // namespace

std::vector<Eigen::Vector3d> ReadPlyPoints(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error("cannot read '{}'", file.string());
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const Layout layout = HeaderReader(file, bytes).Read();
  const std::array<Property, 3> axes = Axes(file, layout);
  if ((bytes.size() - layout.header_bytes) / layout.vertex_bytes < layout.num_vertices)
    Fail(file, "ends before its last point");
  std::vector<Eigen::Vector3d> points;
  points.reserve(layout.num_vertices);
  for (std::size_t i = 0; i < layout.num_vertices; ++i) {
    const char* vertex = bytes.data() + layout.header_bytes + i * layout.vertex_bytes;
    points.emplace_back(ValueAt(vertex, axes[0]), ValueAt(vertex, axes[1]),
                        ValueAt(vertex, axes[2]));
  }
  return points;
}

}  // namespace cslam
