// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/obj_model.h"

#include "cslam/io/text_lines.h"
#include "cslam/util/check.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <span>
#include <string_view>
#include <utility>

namespace cslam {
namespace {

using Fields = std::span<const std::string>;

// Where a reader stands, for its complaints.
struct Place {
  const std::filesystem::path& path;
  int line;
};

template <typename Number>
Number Parse(std::string_view text, const Place& at) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw Error("{}:{}: '{}' is not a number", at.path.string(), at.line, Excerpt(text));
  return value;
}

template <int kCount>
Eigen::Matrix<double, kCount, 1> ParseVector(Fields fields, const Place& at) {
  if (fields.size() < kCount)
    throw Error("{}:{}: {} numbers are needed here, not {}", at.path.string(), at.line, kCount,
                fields.size());
  Eigen::Matrix<double, kCount, 1> result;
  for (int i = 0; i < kCount; ++i) {
    result[i] = Parse<double>(fields[static_cast<std::size_t>(i)], at);
    if (!std::isfinite(result[i]))
      throw Error("{}:{}: '{}' is not finite", at.path.string(), at.line,
                  fields[static_cast<std::size_t>(i)]);
  }
  return result;
}

// Names of materials and files may have blanks in them.
std::string Joined(Fields fields) {
  std::string result;
  for (const std::string& field : fields)
    result += (result.empty() ? "" : " ") + field;
  return result;
}

// A face's corner: indices from 0, or -1 where there is none.
struct Corner {
  int position = -1;
  int uv = -1;
  int normal = -1;
};

class ObjReader {
 public:
  explicit ObjReader(std::filesystem::path path) : path_(std::move(path)) {}

  ObjModel Read() {
    for (const TextLine& line : ReadTextLines(path_))
      ReadLine(line);
    if (model_.mesh.triangles.empty()) throw Error("model '{}' has no faces", path_.string());
    return std::move(model_);
  }

 private:
  void ReadLine(const TextLine& line) {
    const Place at{path_, line.number};
    const std::string& keyword = line.fields.front();
    const Fields rest = Fields(line.fields).subspan(1);
    if (keyword == "v") {
      positions_.push_back(ParseVector<3>(rest, at).cast<float>());
    } else if (keyword == "vn") {
      normals_.push_back(ParseVector<3>(rest, at).cast<float>());
    } else if (keyword == "vt") {
      uvs_.push_back(ParseVector<2>(rest, at).cast<float>());
    } else if (keyword == "f") {
      AddFace(rest, at);
    } else if (keyword == "usemtl") {
      material_ = MaterialIndex(Joined(rest));
    } else if (keyword == "mtllib") {
      for (ObjMaterial& material : ReadMtl(path_.parent_path() / Joined(rest)))
        library_[material.name] = std::move(material);
    }
  }

  int MaterialIndex(const std::string& name) {
    const auto [entry, is_new] =
        indices_.try_emplace(name, static_cast<int>(model_.materials.size()));
    if (is_new) {
      const auto known = library_.find(name);
      model_.materials.push_back(known != library_.end() ? known->second : ObjMaterial{});
      model_.materials.back().name = name;
    }
    return entry->second;
  }

  // From 1 up, or from -1 down, counted from the last one read.
  static int Resolve(std::string_view text, std::size_t count, const Place& at) {
    if (text.empty()) return -1;
    const int index = Parse<int>(text, at);
    const int size = static_cast<int>(count);
    const int resolved = index > 0 ? index - 1 : size + index;
    if (index == 0 || resolved < 0 || resolved >= size)
      throw Error("{}:{}: index {} is outside 1 to {}", at.path.string(), at.line, index, size);
    return resolved;
  }

  Corner ParseCorner(std::string_view text, const Place& at) const {
    std::array<std::string_view, 3> parts;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t slash = text.find('/');
      parts.at(i) = text.substr(0, slash);
      text = slash == std::string_view::npos ? std::string_view() : text.substr(slash + 1);
    }
    const Corner corner{Resolve(parts[0], positions_.size(), at),
                        Resolve(parts[1], uvs_.size(), at), Resolve(parts[2], normals_.size(), at)};
    if (corner.position < 0)
      throw Error("{}:{}: a face's corner names no vertex", at.path.string(), at.line);
    return corner;
  }

  void AddFace(Fields fields, const Place& at) {
    if (fields.size() < 3)
      throw Error("{}:{}: a face needs at least three corners", at.path.string(), at.line);
    if (material_ < 0) material_ = MaterialIndex("");
    std::vector<Corner> corners;
    for (const std::string& field : fields)
      corners.push_back(ParseCorner(field, at));
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      AddTriangle({corners[0], corners[i], corners[i + 1]});
  }

  void AddTriangle(const std::array<Corner, 3>& corners) {
    Mesh& mesh = model_.mesh;
    const auto at = [](const auto& values, int index) {
      return values[static_cast<std::size_t>(index)];
    };
    const Eigen::Vector3f a = at(positions_, corners[0].position);
    const Eigen::Vector3f cross =
        (at(positions_, corners[1].position) - a)
            .cross(Eigen::Vector3f(at(positions_, corners[2].position) - a));
    if (cross.norm() == 0.0F) return;  // no area, no normal
    Triangle triangle{{}, material_};
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner& corner = corners.at(i);
      triangle.vertices.at(i) = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(at(positions_, corner.position));
      mesh.normals.push_back(corner.normal < 0 ? Eigen::Vector3f::Zero().eval()
                                               : at(normals_, corner.normal));
      const Eigen::Vector2f uv =
          corner.uv < 0 ? Eigen::Vector2f::Zero().eval() : at(uvs_, corner.uv);
      mesh.uvs.emplace_back(uv.x(), corner.uv < 0 ? 0.0F : 1.0F - uv.y());
    }
    mesh.triangles.push_back(triangle);
  }

  std::filesystem::path path_;
  ObjModel model_;
  std::vector<Eigen::Vector3f> positions_;
  std::vector<Eigen::Vector3f> normals_;
  std::vector<Eigen::Vector2f> uvs_;
  std::map<std::string, ObjMaterial> library_;
  std::map<std::string, int> indices_;
  int material_ = -1;
};

}  // namespace

std::vector<ObjMaterial> ReadMtl(const std::filesystem::path& path) {
  std::vector<ObjMaterial> materials;
  for (const TextLine& line : ReadTextLines(path)) {
    const Place at{path, line.number};
    const std::string& keyword = line.fields.front();
    const Fields rest = Fields(line.fields).subspan(1);
    if (keyword == "newmtl") {
      materials.emplace_back().name = Joined(rest);
      continue;
    }
    const bool is_used =
        keyword == "Kd" || keyword == "d" || keyword == "Tr" || keyword == "map_Kd";
    if (!is_used) continue;
    if (materials.empty())
      throw Error("{}:{}: '{}' comes before any 'newmtl'", path.string(), line.number, keyword);
    ObjMaterial& material = materials.back();
    if (keyword == "Kd") {
      material.diffuse = ParseVector<3>(rest, at);
    } else if (keyword == "d") {
      material.opacity = ParseVector<1>(rest, at)[0];
    } else if (keyword == "Tr") {
      material.opacity = 1.0 - ParseVector<1>(rest, at)[0];
    } else if (!rest.empty()) {  // options, if any, come first
      const bool has_options = rest.front().starts_with('-');
      material.texture = path.parent_path() / (has_options ? rest.back() : Joined(rest));
    }
  }
  return materials;
}

ObjModel ReadObjModel(const std::filesystem::path& path) {
  return ObjReader(path).Read();
}

}  // namespace cslam
