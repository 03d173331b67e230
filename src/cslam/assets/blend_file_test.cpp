// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/blend_file.h"

#include "cslam/assets/blend_file_contents.h"
#include "cslam/assets/test_blend.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <zlib.h>

#include <array>

namespace cslam {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

void DescribeBasics(TestBlend& blend) {
  blend.Describe("ID", {{"char", "name[24]"}});
  blend.Describe("ListBase", {{"void", "*first"}, {"void", "*last"}});
  blend.Describe("Thing", {{"ID", "id"},
                           {"int", "count"},
                           {"short", "step[2]"},
                           {"float", "rows[2][2]"},
                           {"ListBase", "links"},
                           {"Thing", "*twin"},
                           {"Thing", "**many"}});
  blend.Describe("Link", {{"Link", "*next"}, {"int", "number"}});
}

// One thing with a list of three links.
std::string ThingFile() {
  TestBlend blend;
  DescribeBasics(blend);
  const std::uint64_t thing = blend.Add("TH", "Thing");
  blend.SetText(thing, "id", "THcup");
  blend.Set(thing, "count", -7);
  blend.Set(thing, "step", short{-3}, 1);
  blend.Set(thing, "rows", 2.5F, 3);
  blend.Set(thing, "twin", thing);
  const std::array<std::uint64_t, 3> links{blend.Add("DATA", "Link"), blend.Add("DATA", "Link"),
                                           blend.Add("DATA", "Link")};
  for (std::size_t i = 0; i < 3; ++i) {
    blend.Set(links[i], "number", static_cast<int>(10 + i));
    if (i < 2) blend.Set(links[i], "next", links[i + 1]);
  }
  blend.Set(thing, "links", links[0]);
  return blend.Bytes();
}

class BlendFileTest : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& bytes) {
    return folder_.Write("test.blend", bytes);
  }

  TestFolder folder_;
};

std::string Gzipped(std::string bytes) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

void ExpectThing(const BlendFile& file) {
  ASSERT_EQ(file.Blocks("TH").size(), 1U);
  const BlendStruct thing = file.Blocks("TH").front();
  EXPECT_EQ(thing.type(), "Thing");
  EXPECT_EQ(thing.Member("id").Text("name"), "THcup");
  EXPECT_EQ(thing.Integer("count"), -7);
  EXPECT_EQ(thing.Integer("step", 1), -3);
  EXPECT_EQ(thing.Number("rows", 3), 2.5);
  EXPECT_EQ(thing.Follow("twin")->Integer("count"), -7);
  EXPECT_FALSE(thing.Follow("many").has_value());
  const std::vector<BlendStruct> links = thing.List("links");
  ASSERT_EQ(links.size(), 3U);
  EXPECT_EQ(links[2].Integer("number"), 12);
}

TEST_F(BlendFileTest, ReadsFieldsByTheirNames) {
  const BlendFile file(Write(ThingFile()));
  EXPECT_EQ(file.version(), 274);
  ExpectThing(file);
}

TEST_F(BlendFileTest, ReadsCompressedFiles) {
  const BlendFile file(Write(Gzipped(ThingFile())));
  ExpectThing(file);
}

TEST_F(BlendFileTest, NamesTheFieldThatIsNotThere) {
  const BlendFile file(Write(ThingFile()));
  const BlendStruct thing = file.Blocks("TH").front();
  EXPECT_THAT([&] { thing.Number("colour"); }, ThrowsMessage<Error>(HasSubstr("no field colour")));
  EXPECT_THAT([&] { thing.Number("twin"); }, ThrowsMessage<Error>(HasSubstr("is no number")));
  EXPECT_THAT([&] { thing.Number("step", 2); }, ThrowsMessage<Error>(HasSubstr("is no number")));
  EXPECT_THAT([&] { thing.Array("twin", 2); }, ThrowsMessage<Error>(HasSubstr("damaged")));
}

TEST_F(BlendFileTest, RefusesWhatIsNoBlenderFile) {
  EXPECT_THAT([&] { BlendFile(Write("hello, this is text")); },
              ThrowsMessage<Error>(HasSubstr("is not a Blender file")));
  EXPECT_THAT([&] { BlendFile(folder_.path() / "absent.blend"); },
              ThrowsMessage<Error>(HasSubstr("absent.blend")));
}

TEST_F(BlendFileTest, ReportsDamageWhereverTheFileIsCutOff) {
  const std::string bytes = ThingFile();
  for (std::size_t size = 12; size + 30 < bytes.size(); size += 7) {
    const std::filesystem::path path = Write(bytes.substr(0, size));
    EXPECT_THROW(BlendFile{path}, Error) << size;
  }
  const std::string packed = Gzipped(bytes);
  EXPECT_THAT([&] { BlendFile(Write(packed.substr(0, packed.size() / 2))); },
              ThrowsMessage<Error>(HasSubstr("damaged or cut off")));
}

// As in Blender, as far as the reader looks.
void DescribeMeshes(TestBlend& blend) {
  blend.Describe("ID", {{"char", "name[24]"}});
  blend.Describe("ListBase", {{"void", "*first"}, {"void", "*last"}});
  blend.Describe("Object", {{"ID", "id"},
                            {"short", "type"},
                            {"void", "*data"},
                            {"float", "obmat[4][4]"},
                            {"ListBase", "defbase"}});
  blend.Describe("MVert", {{"float", "co[3]"}});
  blend.Describe("MPoly", {{"int", "loopstart"}, {"int", "totloop"}, {"short", "mat_nr"}});
  blend.Describe("MLoop", {{"int", "v"}, {"int", "e"}});
  blend.Describe("MLoopUV", {{"float", "uv[2]"}, {"int", "flag"}});
  blend.Describe("MDeformWeight", {{"int", "def_nr"}, {"float", "weight"}});
  blend.Describe("MDeformVert", {{"MDeformWeight", "*dw"}, {"int", "totweight"}});
  blend.Describe("bDeformGroup", {{"bDeformGroup", "*next"}, {"char", "name[16]"}});
  blend.Describe("Mesh", {{"ID", "id"},
                          {"Material", "**mat"},
                          {"MPoly", "*mpoly"},
                          {"MLoop", "*mloop"},
                          {"MLoopUV", "*mloopuv"},
                          {"MVert", "*mvert"},
                          {"MDeformVert", "*dvert"},
                          {"int", "totvert"},
                          {"int", "totpoly"},
                          {"int", "totloop"},
                          {"short", "totcol"}});
  blend.Describe(
      "Material",
      {{"ID", "id"}, {"float", "r"}, {"float", "g"}, {"float", "b"}, {"MTex", "*mtex[18]"}});
  blend.Describe("MTex", {{"Tex", "*tex"}});
  blend.Describe("Tex", {{"ID", "id"}, {"Image", "*ima"}});
  blend.Describe("PackedFile", {{"int", "size"}, {"void", "*data"}});
  blend.Describe("Image", {{"ID", "id"}, {"char", "name[32]"}, {"PackedFile", "*packedfile"}});
  blend.Describe("Bone", {{"Bone", "*next"},
                          {"ListBase", "childbase"},
                          {"char", "name[16]"},
                          {"float", "arm_head[3]"},
                          {"float", "arm_tail[3]"}});
  blend.Describe("bArmature", {{"ID", "id"}, {"ListBase", "bonebase"}});
}

// A material with a packed picture; its address.
std::uint64_t AddMaterial(TestBlend& blend) {
  const std::uint64_t image = blend.Add("IM", "Image");
  blend.SetText(image, "id", "IMcloth.png");
  blend.SetText(image, "name", "//textures/cloth.png");
  const std::uint64_t packed = blend.Add("DATA", "PackedFile");
  blend.Set(packed, "size", 5);
  blend.Set(packed, "data", blend.AddBytes("bytes"));
  blend.Set(image, "packedfile", packed);
  const std::uint64_t texture = blend.Add("TE", "Tex");
  blend.Set(texture, "ima", image);
  const std::uint64_t use = blend.Add("DATA", "MTex");
  blend.Set(use, "tex", texture);
  const std::uint64_t material = blend.Add("MA", "Material");
  blend.SetText(material, "id", "MAcloth");
  blend.Set(material, "g", 0.5F);
  blend.Set(material, "mtex", use, 1);
  return material;
}

// A unit square with weights on one corner; its address.
std::uint64_t AddSquare(TestBlend& blend) {
  const std::uint64_t vertices = blend.Add("DATA", "MVert", 4);
  const std::uint64_t loops = blend.Add("DATA", "MLoop", 4);
  const std::uint64_t uvs = blend.Add("DATA", "MLoopUV", 4);
  const std::uint64_t weighted = blend.Add("DATA", "MDeformVert", 4);
  const std::uint64_t weight = blend.Add("DATA", "MDeformWeight");
  blend.Set(weight, "weight", 0.75F);
  for (std::size_t i = 0; i < 4; ++i) {
    const float x = i == 1 || i == 2 ? 1.0F : 0.0F;
    const float y = i >= 2 ? 1.0F : 0.0F;
    blend.Set(vertices, "co", x, 0, i);
    blend.Set(vertices, "co", y, 1, i);
    blend.Set(loops, "v", static_cast<int>(i), 0, i);
    blend.Set(uvs, "uv", x, 0, i);
    blend.Set(uvs, "uv", y, 1, i);
  }
  blend.Set(weighted, "dw", weight, 0, 2);
  blend.Set(weighted, "totweight", 1, 0, 2);
  const std::uint64_t polygon = blend.Add("DATA", "MPoly");
  blend.Set(polygon, "totloop", 4);

  const std::uint64_t material = AddMaterial(blend);
  const std::uint64_t mesh = blend.Add("ME", "Mesh");
  blend.Set(mesh, "mat", blend.AddBytes(std::string(reinterpret_cast<const char*>(&material), 8)));
  blend.Set(mesh, "mpoly", polygon);
  blend.Set(mesh, "mloop", loops);
  blend.Set(mesh, "mloopuv", uvs);
  blend.Set(mesh, "mvert", vertices);
  blend.Set(mesh, "dvert", weighted);
  blend.Set(mesh, "totvert", 4);
  blend.Set(mesh, "totpoly", 1);
  blend.Set(mesh, "totloop", 4);
  blend.Set(mesh, "totcol", short{1});
  return mesh;
}

// A square with one bone, one weight group and a packed picture.
std::string SquareFile() {
  TestBlend blend;
  DescribeMeshes(blend);
  const std::uint64_t mesh = AddSquare(blend);
  const std::uint64_t group = blend.Add("DATA", "bDeformGroup");
  blend.SetText(group, "name", "arm");
  const std::uint64_t bone = blend.Add("DATA", "Bone");
  blend.SetText(bone, "name", "arm");
  blend.Set(bone, "arm_tail", 0.5F, 2);
  const std::uint64_t child = blend.Add("DATA", "Bone");
  blend.SetText(child, "name", "hand");
  blend.Set(child, "arm_head", 0.5F, 2);
  blend.Set(bone, "childbase", child);
  const std::uint64_t armature = blend.Add("AR", "bArmature");
  blend.Set(armature, "bonebase", bone);
  for (const bool is_mesh : {true, false}) {
    const std::uint64_t object = blend.Add("OB", "Object");
    blend.SetText(object, "id", is_mesh ? "OBsquare" : "OBrig");
    blend.Set(object, "type", is_mesh ? short{1} : short{25});
    blend.Set(object, "data", is_mesh ? mesh : armature);
    for (std::size_t i = 0; i < 4; ++i)
      blend.Set(object, "obmat", 1.0F, 5 * i);
    blend.Set(object, "obmat", 2.0F, 14);  // 2 m up
    if (is_mesh) blend.Set(object, "defbase", group);
  }
  return blend.Bytes();
}

class ReadBlendContentsTest : public BlendFileTest {};

TEST_F(ReadBlendContentsTest, ReadsMeshBonesAndPicture) {
  const BlendContents contents = ReadBlendContents(Write(SquareFile()));
  ASSERT_EQ(contents.meshes.size(), 1U);
  const BlendMesh& mesh = contents.meshes[0];
  EXPECT_EQ(mesh.name, "square");
  ASSERT_EQ(mesh.positions.size(), 4U);
  EXPECT_EQ(mesh.positions[2], Eigen::Vector3f(1.0F, 1.0F, 2.0F));
  ASSERT_EQ(mesh.polygons.size(), 1U);
  ASSERT_EQ(mesh.polygons[0].corners.size(), 4U);
  EXPECT_EQ(mesh.polygons[0].corners[2].vertex, 2U);
  EXPECT_EQ(mesh.polygons[0].corners[2].uv, Eigen::Vector2f(1.0F, 1.0F));
  ASSERT_EQ(mesh.groups, std::vector<std::string>{"arm"});
  ASSERT_EQ(mesh.weights.size(), 4U);
  EXPECT_TRUE(mesh.weights[0].empty());
  ASSERT_EQ(mesh.weights[2].size(), 1U);
  EXPECT_EQ(mesh.weights[2][0].weight, 0.75F);
  ASSERT_EQ(contents.materials.size(), 1U);
  EXPECT_EQ(contents.materials[0].name, "cloth");
  EXPECT_EQ(contents.materials[0].rgb.y(), 0.5F);
  ASSERT_EQ(contents.materials[0].image, 0);
  EXPECT_EQ(contents.images[0].name, "cloth.png");
  EXPECT_EQ(contents.images[0].path, "//textures/cloth.png");
  EXPECT_EQ(contents.images[0].bytes, "bytes");
  ASSERT_EQ(contents.bones.size(), 2U);
  EXPECT_EQ(contents.bones[1].name, "hand");
  EXPECT_EQ(contents.bones[1].parent, 0);
  EXPECT_EQ(contents.bones[1].head, Eigen::Vector3f(0.0F, 0.0F, 2.5F));
}

}  // namespace
}  // namespace cslam
