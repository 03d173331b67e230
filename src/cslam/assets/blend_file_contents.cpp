// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/blend_file_contents.h"

#include "cslam/assets/blend_file.h"
#include "cslam/util/check.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <map>
#include <optional>
#include <string_view>

namespace cslam {
namespace {

constexpr int kMeshObject = 1;
constexpr int kArmatureObject = 25;
constexpr std::size_t kTextureSlots = 18;

Eigen::Vector3f Vector(const BlendStruct& from, std::string_view field) {
  return Eigen::Vector3d(from.Number(field, 0), from.Number(field, 1), from.Number(field, 2))
      .cast<float>();
}

// The file stores matrices column by column.
Eigen::Affine3f WorldOf(const BlendStruct& object) {
  Eigen::Affine3f T_world_object;
  for (int i = 0; i < 16; ++i) {
    T_world_object.matrix()(i % 4, i / 4) =
        static_cast<float>(object.Number("obmat", static_cast<std::size_t>(i)));
  }
  return T_world_object;
}

// Data-block names begin with their two-letter code.
std::string NameOfBlock(const BlendStruct& block) {
  return block.Member("id").Text("name").substr(2);
}

class ContentsReader {
 public:
  explicit ContentsReader(const BlendFile& file) : file_(file) {}

  BlendContents Read() {
    for (const BlendStruct& object : file_.Blocks("OB")) {
      const int type = object.Integer("type");
      if (type == kMeshObject) ReadMesh(object);
      if (type == kArmatureObject) ReadArmature(object);
    }
    return std::move(contents_);
  }

 private:
  int ImageOf(const BlendStruct& image, std::uint64_t address) {
    if (const auto known = images_.find(address); known != images_.end()) return known->second;
    BlendImage result;
    result.name = NameOfBlock(image);
    result.path = image.Text("name");
    if (const auto packed = image.Follow("packedfile")) {
      const int size = packed->Integer("size");
      if (size > 0) {
        result.bytes = file_.BytesAt(packed->Address("data"), static_cast<std::size_t>(size));
      }
    }
    contents_.images.push_back(std::move(result));
    return images_[address] = static_cast<int>(contents_.images.size()) - 1;
  }

  // The first image among a material's textures.
  int FirstImage(const BlendStruct& material) {
    if (!material.Has("mtex")) return -1;
    for (std::size_t slot = 0; slot < kTextureSlots; ++slot) {
      const auto use = material.Follow("mtex", slot);
      const auto texture = use ? use->Follow("tex") : std::nullopt;
      const auto image = texture ? texture->Follow("ima") : std::nullopt;
      if (image) return ImageOf(*image, texture->Address("ima"));
    }
    return -1;
  }

  int MaterialAt(std::uint64_t address) {
    if (const auto known = materials_.find(address); known != materials_.end())
      return known->second;
    const auto block = file_.At(address);
    if (!block) return -1;
    BlendMaterial material;
    material.name = NameOfBlock(*block);
    for (int c = 0; c < 3; ++c) {
      constexpr std::array<std::string_view, 3> kChannels{"r", "g", "b"};
      material.rgb[c] = static_cast<float>(block->Number(kChannels[static_cast<std::size_t>(c)]));
    }
    material.image = FirstImage(*block);
    contents_.materials.push_back(std::move(material));
    return materials_[address] = static_cast<int>(contents_.materials.size()) - 1;
  }

  void ReadMesh(const BlendStruct& object) {
    const auto data = object.Follow("data");
    if (!data || data->type() != "Mesh") return;
    BlendMesh mesh;
    mesh.name = NameOfBlock(object);
    if (!data->Has("mpoly") || !data->Has("mvert")) {
      throw Error("Blender file '{}' is of version {}; meshes of 263 to 279 can be read",
                  file_.name(), file_.version());
    }
    const Eigen::Affine3f T_world_object = WorldOf(object);
    for (const BlendStruct& vertex : data->Array("mvert", data->Integer("totvert")))
      mesh.positions.push_back(T_world_object * Vector(vertex, "co"));
    ReadPolygons(*data, mesh);
    ReadWeights(object, *data, mesh);
    contents_.meshes.push_back(std::move(mesh));
  }

  void ReadPolygons(const BlendStruct& data, BlendMesh& mesh) {
    std::vector<int> materials;
    for (int i = 0; i < data.Integer("totcol"); ++i) {
      materials.push_back(
          MaterialAt(file_.PointerAt(data.Address("mat"), static_cast<std::size_t>(i))));
    }
    const int num_loops = data.Integer("totloop");
    std::vector<BlendCorner> corners;
    for (const BlendStruct& loop : data.Array("mloop", num_loops)) {
      const int vertex = loop.Integer("v");
      if (vertex < 0 || static_cast<std::size_t>(vertex) >= mesh.positions.size())
        ThrowBroken(mesh);
      corners.push_back({static_cast<std::uint32_t>(vertex), Eigen::Vector2f::Zero()});
    }
    if (data.Address("mloopuv") != 0) {
      const std::vector<BlendStruct> uvs = data.Array("mloopuv", num_loops);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i].uv = {static_cast<float>(uvs[i].Number("uv", 0)),
                         static_cast<float>(uvs[i].Number("uv", 1))};
      }
    }
    for (const BlendStruct& poly : data.Array("mpoly", data.Integer("totpoly"))) {
      const int start = poly.Integer("loopstart");
      const int count = poly.Integer("totloop");
      if (start < 0 || count < 3 || start > num_loops - count) ThrowBroken(mesh);
      BlendPolygon polygon;
      polygon.corners.assign(corners.begin() + start, corners.begin() + start + count);
      const auto slot = static_cast<std::size_t>(poly.Integer("mat_nr"));
      polygon.material = slot < materials.size() ? materials[slot] : -1;
      mesh.polygons.push_back(std::move(polygon));
    }
  }

  void ReadWeights(const BlendStruct& object, const BlendStruct& data, BlendMesh& mesh) {
    if (!object.Has("defbase")) return;
    for (const BlendStruct& group : object.List("defbase"))
      mesh.groups.push_back(group.Text("name"));
    if (mesh.groups.empty() || data.Address("dvert") == 0) return;
    for (const BlendStruct& vertex : data.Array("dvert", data.Integer("totvert"))) {
      std::vector<BlendWeight> weights;
      for (const BlendStruct& weight : vertex.Array("dw", vertex.Integer("totweight"))) {
        const int group = weight.Integer("def_nr");
        if (group < 0 || static_cast<std::size_t>(group) >= mesh.groups.size()) continue;
        weights.push_back({group, static_cast<float>(weight.Number("weight"))});
      }
      mesh.weights.push_back(std::move(weights));
    }
  }

  void ReadArmature(const BlendStruct& object) {
    const auto data = object.Follow("data");
    if (!data || data->type() != "bArmature") return;
    for (const BlendStruct& bone : data->List("bonebase"))
      ReadBone(bone, -1, WorldOf(object), 0);
  }

  void ReadBone(const BlendStruct& bone, int parent, const Eigen::Affine3f& T_world_armature,
                int depth) {
    constexpr int kMaxDepth = 256;
    if (depth > kMaxDepth) throw Error("Blender file '{}' has bones in a circle", file_.name());
    BlendBone result;
    result.name = bone.Text("name");
    result.parent = parent;
    result.head = T_world_armature * Vector(bone, "arm_head");
    result.tail = T_world_armature * Vector(bone, "arm_tail");
    contents_.bones.push_back(std::move(result));
    const int self = static_cast<int>(contents_.bones.size()) - 1;
    for (const BlendStruct& child : bone.List("childbase"))
      ReadBone(child, self, T_world_armature, depth + 1);
  }

  [[noreturn]] void ThrowBroken(const BlendMesh& mesh) const {
    throw Error("Blender file '{}' is damaged: faces of mesh '{}' cannot be read; fetch it again",
                file_.name(), mesh.name);
  }

  const BlendFile& file_;
  BlendContents contents_;
  std::map<std::uint64_t, int> materials_;  // by address
  std::map<std::uint64_t, int> images_;
};

}  // namespace

BlendContents ReadBlendContents(const std::filesystem::path& path) {
  const BlendFile file(path);
  return ContentsReader(file).Read();
}

}  // namespace cslam
