// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/furniture_catalogue.h"
#include "cslam/assets/mesh_tools.h"
#include "cslam/assets/model_prop.h"
#include "cslam/assets/obj_model.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>

namespace cslam {
namespace {

using testing::HasSubstr;

class ModelFiles : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, const std::string& text) {
    return folder_.Write(name, text);
  }

  std::string ErrorOf(const std::string& obj) {
    try {
      ReadObjModel(Write("bad.obj", obj));
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  TestFolder folder_;
};

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

// A cube from -1 to 1 whose faces look inwards and outwards in turn.
constexpr const char* kMixedCube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 4 3 7 8\nf 1 4 8 5\nf 2 3 7 6\n";

TEST_F(ModelFiles, ReadObjModelTakesPolygonsMaterialsAndNegativeIndices) {
  Write("m.mtl", "newmtl red paint\nKd 1 0 0\nnewmtl picture\nd 0.25\nmap_Kd -s 1 1 1 wood.jpg\n");
  const ObjModel model = ReadObjModel(Write(
      "m.obj", std::string("mtllib m.mtl\n") + kSquare +
                   "vt 0.25 0.25\nvn 0 0 1\nusemtl red paint\nf 1 2 3 4\nusemtl picture\n"
                   "f -4/-1/-1 -3/-1/-1 -2/-1/-1\nusemtl unknown\nf 1//1 2//1 3//1\nl 1 2\n"));
  ASSERT_EQ(model.mesh.triangles.size(), 4U);
  ASSERT_EQ(model.materials.size(), 3U);
  EXPECT_EQ(model.materials[0].diffuse, Eigen::Vector3d(1.0, 0.0, 0.0));
  EXPECT_EQ(model.materials[1].texture, folder_.path() / "wood.jpg");
  EXPECT_DOUBLE_EQ(model.materials[1].opacity, 0.25);
  EXPECT_EQ(model.materials[2].name, "unknown");
  const Triangle& with_uv = model.mesh.triangles[2];
  EXPECT_EQ(with_uv.material, 1);
  EXPECT_EQ(model.mesh.uvs[with_uv.vertices[0]], Eigen::Vector2f(0.25F, 0.75F));
  EXPECT_EQ(model.mesh.normals[with_uv.vertices[0]], Eigen::Vector3f(0.0F, 0.0F, 1.0F));
  EXPECT_EQ(model.mesh.normals[0], Eigen::Vector3f(0.0F, 0.0F, 0.0F));
}

TEST_F(ModelFiles, ReadObjModelNamesFileAndLineOfWhatIsWrong) {
  EXPECT_THAT(ErrorOf("v 0 0\n"), HasSubstr("bad.obj:1: 3 numbers are needed here, not 2"));
  EXPECT_THAT(ErrorOf("\nv 0 0 x\n"), HasSubstr("bad.obj:2: 'x' is not a number"));
  EXPECT_THAT(ErrorOf("v 0 nan 0\n"), HasSubstr("bad.obj:1: 'nan' is not finite"));
  EXPECT_THAT(ErrorOf(std::string(kSquare) + "f 1 2 5\n"),
              HasSubstr("bad.obj:5: index 5 is outside 1 to 4"));
  EXPECT_THAT(ErrorOf(std::string(kSquare) + "f 0 1 2\n"), HasSubstr("bad.obj:5: index 0"));
  EXPECT_THAT(ErrorOf(std::string(kSquare) + "f 1 2\n"), HasSubstr("at least three corners"));
  EXPECT_THAT(ErrorOf(kSquare), HasSubstr("has no faces"));
  EXPECT_THAT(ErrorOf("mtllib nowhere.mtl\n"), HasSubstr("nowhere.mtl"));
}

TEST_F(ModelFiles, FacingOutwardsTurnsTheFacesThatLookInwards) {
  const Mesh mesh =
      WithNormals(FacingOutwards(ReadObjModel(Write("cube.obj", kMixedCube)).mesh), 0.5);
  ASSERT_EQ(mesh.triangles.size(), 12U);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    EXPECT_NEAR(mesh.normals[v].dot(mesh.positions[v]), 1.0F, 1e-5F);
}

TEST_F(ModelFiles, WithNormalsSmoothsOnlyAcrossBluntEdges) {
  const Mesh cube = FacingOutwards(ReadObjModel(Write("cube.obj", kMixedCube)).mesh);
  const auto num_smooth = [&](double crease_rad) {
    int count = 0;
    for (const Eigen::Vector3f& n : WithNormals(cube, crease_rad).normals)
      count += n.cwiseAbs().maxCoeff() < 0.99F ? 1 : 0;
    return count;
  };
  EXPECT_EQ(num_smooth(0.5), 0);
  EXPECT_EQ(num_smooth(1.6), 36);
}

TEST_F(ModelFiles, SubdividedKeepsAreaAndLeavesNoLongSideAndNoGap) {
  const Mesh cube = ReadObjModel(Write("cube.obj", kMixedCube)).mesh;
  const Mesh fine = Subdivided(WithNormals(FacingOutwards(cube), 0.5), 0.5);
  double area_m2 = 0.0;
  std::map<std::array<std::array<float, 3>, 2>, int> sides;
  const auto key = [&](std::uint32_t v) {
    return std::array{fine.positions[v].x(), fine.positions[v].y(), fine.positions[v].z()};
  };
  for (const Triangle& t : fine.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = t.vertices.at(i);
      const std::uint32_t to = t.vertices.at((i + 1) % 3);
      EXPECT_LE((fine.positions[from] - fine.positions[to]).norm(), 0.5F);
      std::array side{key(from), key(to)};
      std::ranges::sort(side);
      ++sides[side];
    }
    const Eigen::Vector3f a = fine.positions[t.vertices[0]];
    area_m2 +=
        0.5 * static_cast<double>((fine.positions[t.vertices[1]] - a)
                                      .cross(Eigen::Vector3f(fine.positions[t.vertices[2]] - a))
                                      .norm());
  }
  EXPECT_NEAR(area_m2, 24.0, 1e-4);
  for (const auto& [side, count] : sides)
    EXPECT_EQ(count, 2);  // a closed surface: every side has two triangles
}

TEST_F(ModelFiles, CleanedDropsSliversAndDoubledFaces) {
  const ObjModel model = ReadObjModel(Write(
      "double.obj", std::string(kSquare) + "v 1 1.00001 0\nf 1 2 3\nf 3 2 1\nf 2 3 1\nf 2 3 5\n"));
  EXPECT_EQ(Cleaned(model.mesh, 1e-4).triangles.size(), 1U);
}

TEST_F(ModelFiles, WeldedSharesEqualVertices) {
  const Mesh square = ReadObjModel(Write("s.obj", std::string(kSquare) + "f 1 2 3 4\n")).mesh;
  EXPECT_EQ(square.positions.size(), 6U);
  EXPECT_EQ(Welded(square).positions.size(), 4U);
}

constexpr const char* kCatalogue =
    "# comment\nlicense=Public domain\n\nid#1=x\nname#1=Chair\nmodel#1=/c/chair.obj\nwidth#1=50\n"
    "depth#1=40\nheight#1=100\ndropOnTopElevation#1=45\ncreator#1=Somebody\n"
    "modelRotation#1=0 0 1 0 1 0 -1 0 0\n";

TEST_F(ModelFiles, FurnitureCatalogueReadsSizesInCentimetres) {
  const FurnitureCatalogue catalogue = FurnitureCatalogue::Read(Write("c.properties", kCatalogue));
  EXPECT_EQ(catalogue.license(), "Public domain");
  const CatalogueEntry& entry = catalogue.Entry("/c/chair.obj");
  EXPECT_EQ(entry.name, "Chair");
  EXPECT_EQ(entry.creator, "Somebody");
  EXPECT_TRUE(entry.size_m.isApprox(Eigen::Vector3d(0.5, 0.4, 1.0)));
  EXPECT_DOUBLE_EQ(entry.top_m.value(), 0.45);
  EXPECT_DOUBLE_EQ(entry.R_upright_model(0, 2), 1.0);
}

TEST_F(ModelFiles, FurnitureCatalogueNamesFileAndLineOfWhatIsWrong) {
  const auto error_of = [&](const std::string& text, std::string_view model) -> std::string {
    try {
      FurnitureCatalogue::Read(Write("c.properties", text)).Entry(model);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(error_of(kCatalogue, "/other.obj"), HasSubstr("does not list model '/other.obj'"));
  EXPECT_THAT(error_of("model#1=a\nwidth#1=wide\n", "a"), HasSubstr("c.properties:2: 'wide'"));
  EXPECT_THAT(error_of("model#1=a\nwidth#1=-3\n", "a"), HasSubstr("must be positive"));
  EXPECT_THAT(error_of("model#1=a\nwidth#1=3\n", "a"), HasSubstr("a model without depth"));
}

TEST_F(ModelFiles, PrepareModelStandsTheModelInItsBoxFrontTowardsMinusY) {
  // Twice as large as a chair, y up; the only thing at its front (z > 0.5) is low.
  const ObjModel model = ReadObjModel(
      Write("chair.obj",
            "v -.5 0 -.5\nv .5 0 -.5\nv .5 2 -.5\nv -.5 2 -.5\nv 0 0 .5\nf 1 2 3 4\nf 1 2 5\n"));
  CatalogueEntry entry;
  entry.size_m = {1.0, 1.0, 2.0};
  entry.top_m = 1.0;
  const PackageModel choice{PropKind::kChair, "", "", 0.0, 1.0};
  const ModelFit fit = FitModel(choice, entry);
  EXPECT_NEAR(fit.top_m, 0.5 * fit.size_m.z(), 1e-9);
  const Eigen::AlignedBox3d bounds = BoundsOf(PrepareModel(model, choice, fit));
  EXPECT_TRUE(bounds.sizes().isApprox(fit.size_m, 1e-5));
  EXPECT_NEAR(bounds.min().z(), 0.0, 1e-6);
  EXPECT_TRUE((fit.size_m.array() <= StandardSizeM(PropKind::kChair).array() + 1e-9).all());
  for (const Eigen::Vector3f& p : PrepareModel(model, choice, fit).positions) {
    if (p.z() > 0.1F) {  // only the back is so high
      EXPECT_GT(p.y(), 0.0F);
    }
  }
}

}  // namespace
}  // namespace cslam
