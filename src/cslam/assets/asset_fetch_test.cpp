// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/asset_fetch.h"

#include "cslam/assets/run_command.h"
#include "cslam/assets/zip_file.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace cslam {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

std::string Little(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i)
    text += static_cast<char>((value >> (8 * i)) & 0xFFU);
  return text;
}

// "hello hello hello hello" as raw deflate (zlib level 9) and its CRC-32.
const std::string kPacked("\xcb\x48\xcd\xc9\xc9\x57\xc8\x40\x27\x01", 10);
constexpr std::string_view kUnpacked = "hello hello hello hello";
constexpr std::uint32_t kUnpackedCrc = 0x8d3d51e3;

// An archive with one member.
std::string Zip(const std::string& name, int method, const std::string& data, std::uint32_t crc,
                std::uint32_t bytes) {
  const std::string facts = Little(static_cast<std::uint32_t>(method), 2) + Little(0, 4) +
                            Little(crc, 4) + Little(static_cast<std::uint32_t>(data.size()), 4) +
                            Little(bytes, 4) + Little(static_cast<std::uint32_t>(name.size()), 2);
  const std::string local =
      "PK\x03\x04" + Little(20, 2) + Little(0, 2) + facts + Little(0, 2) + name + data;
  const std::string entry = "PK\x01\x02" + Little(20, 2) + Little(20, 2) + Little(0, 2) + facts +
                            Little(0, 2) + Little(0, 2) + Little(0, 2) + Little(0, 2) +
                            Little(0, 4) + Little(0, 4) + name;
  return local + entry + "PK\x05\x06" + Little(0, 4) + Little(1, 2) + Little(1, 2) +
         Little(static_cast<std::uint32_t>(entry.size()), 4) +
         Little(static_cast<std::uint32_t>(local.size()), 4) + Little(0, 2);
}

std::string DeflatedZip(const std::string& name) {
  return Zip(name, 8, kPacked, kUnpackedCrc, static_cast<std::uint32_t>(kUnpacked.size()));
}

class Assets : public testing::Test {
 protected:
  fs::path Write(const std::string& name, const std::string& bytes) {
    return folder_.Write(name, bytes);
  }
  FetchPlaces Places() const {
    return {folder_.path() / "data" / "assets", folder_.path() / "share", false};
  }

  TestFolder folder_;
};

template <typename Action>
std::string ErrorOf(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(Assets, ZipFileReadsStoredAndDeflatedMembers) {
  ZipFile deflated(Write("a.zip", DeflatedZip("x/hello.txt")));
  EXPECT_THAT(deflated.Names(), ElementsAre("x/hello.txt"));
  EXPECT_EQ(deflated.Read("x/hello.txt"), kUnpacked);
  const std::string text(kUnpacked);
  ZipFile stored(
      Write("b.zip", Zip("t", 0, text, kUnpackedCrc, static_cast<std::uint32_t>(text.size()))));
  EXPECT_EQ(stored.Read("t"), kUnpacked);
}

TEST_F(Assets, ZipFileNamesTheArchiveAndWhatIsWrong) {
  EXPECT_THAT(ErrorOf([&] { ZipFile(folder_.path() / "none.zip"); }), HasSubstr("none.zip"));
  EXPECT_THAT(ErrorOf([&] { ZipFile(Write("t.zip", "no archive at all")); }),
              HasSubstr("not a ZIP file, or cut off"));
  const std::string whole = DeflatedZip("h");
  EXPECT_THAT(ErrorOf([&] { ZipFile(Write("c.zip", whole.substr(0, whole.size() - 30))); }),
              HasSubstr("c.zip"));
  std::string broken = whole;
  broken[33] = static_cast<char>(broken[33] ^ 0x55);
  EXPECT_THAT(ErrorOf([&] { ZipFile(Write("d.zip", broken)).Read("h"); }),
              HasSubstr("member 'h' is damaged"));
  EXPECT_THAT(ErrorOf([&] { ZipFile(Write("e.zip", whole)).Read("other"); }),
              HasSubstr("has no member 'other'"));
}

TEST_F(Assets, FetchAssetsCopiesFilesAndMembersOfInstalledPackages) {
  Write("share/models/a.sh3f", DeflatedZip("chairs/one/chair.obj"));
  Write("share/rig.blend", "rig");
  const std::vector<AssetSource> sources{{"furniture", "models/a.sh3f", "chairs/one/", "m/one/"},
                                         {"people", "rig.blend", "", "people/rig.blend"}};
  EXPECT_FALSE(AssetsAreComplete(Places().root, sources));
  const AssetFolder folder = FetchAssets(Places(), sources);
  EXPECT_TRUE(AssetsAreComplete(Places().root, sources));
  EXPECT_TRUE(fs::is_regular_file(folder.File("m/one/chair.obj")));
  EXPECT_TRUE(fs::is_regular_file(folder.File("people/rig.blend")));
  const std::vector<AssetSource> others{sources[1]};
  EXPECT_FALSE(AssetsAreComplete(Places().root, others)) << "made for another list";
  FetchAssets(Places(), others);
  EXPECT_FALSE(fs::exists(Places().root / "m"));
}

TEST_F(Assets, FetchAssetsLeavesNothingBehindWhenAPackageIsMissing) {
  Write("share/rig.blend", "rig");
  const std::vector<AssetSource> sources{{"a-people", "rig.blend", "", "people/rig.blend"},
                                         {"furniture", "models/a.sh3f", "x/", "m/x/"}};
  const std::string error = ErrorOf([&] { FetchAssets(Places(), sources); });
  EXPECT_THAT(error, HasSubstr("Debian package 'furniture'"));
  EXPECT_THAT(error, HasSubstr("apt-get install furniture"));
  EXPECT_EQ(error.find('\n'), std::string::npos);
  EXPECT_FALSE(fs::exists(Places().root));
  EXPECT_TRUE(fs::is_empty(Places().root.parent_path()));
}

TEST_F(Assets, LoadOrFetchAssetsFallsBackOnlyIfItMay) {
  const AssetStatus automatic = LoadOrFetchAssets(Look::kAuto, Places());
  EXPECT_EQ(automatic.props->look(), "procedural");
  EXPECT_FALSE(automatic.folder.has_value());
  EXPECT_THAT(automatic.note, HasSubstr("cannot get the Debian package"));
  EXPECT_THROW(LoadOrFetchAssets(Look::kPackages, Places()), Error);
  const AssetStatus plain = LoadOrFetchAssets(Look::kProcedural, Places());
  EXPECT_EQ(plain.props->look(), "procedural");
  EXPECT_TRUE(plain.note.empty());
}

TEST_F(Assets, AssetFolderNamesThePackageOfAMissingFile) {
  const AssetFolder folder(folder_.path());
  EXPECT_THAT(ErrorOf([&] { folder.File("textures/brick.png"); }), HasSubstr("ufoai-textures"));
  EXPECT_THAT(ErrorOf([&] { folder.File("people/human_rig.blend"); }),
              HasSubstr("apt-get install morse-simulator-data"));
}

TEST_F(Assets, AllAssetSourcesHaveTargetsOfTheirOwn) {
  std::set<std::string> targets;
  for (const AssetSource& source : AllAssetSources()) {
    EXPECT_TRUE(targets.insert(source.target).second) << source.target;
    EXPECT_EQ(source.member.ends_with('/'), source.target.ends_with('/')) << source.target;
  }
}

TEST_F(Assets, ParseLookListsTheLooks) {
  EXPECT_EQ(ParseLook("packages"), Look::kPackages);
  EXPECT_THAT(ErrorOf([] { ParseLook("pretty"); }), HasSubstr("auto, packages or procedural"));
}

TEST_F(Assets, RunCommandGivesOutputAndExitCode) {
  const CommandResult result =
      RunCommand({"sh", "-c", "echo out; echo err >&2; pwd; exit 3"}, folder_.path());
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.output, HasSubstr("out\nerr\n"));
  EXPECT_EQ(RunCommand({"no-such-program-here"}, folder_.path()).exit_code, 127);
}

}  // namespace
}  // namespace cslam
