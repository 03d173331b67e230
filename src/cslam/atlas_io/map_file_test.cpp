// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/atlas_io/map_file.h"

#include "cslam/atlas_io/map_schema.h"
#include "cslam/atlas_io/object_tables.h"
#include "cslam/atlas_io/test_atlas.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

namespace cslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

namespace fs = std::filesystem;

int CountFiles(const fs::path& folder) {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder))
    ++count;
  return count;
}

fs::path SaveAtlas(const TestFolder& folder, const Map& map = test::MakeAtlas()) {
  const fs::path file = folder / "a.map";
  SaveMap(file, map, test::MakeMapFileInfo());
  return file;
}

// Loading must say what is wrong in one line, and nothing but Error may come out.
std::string LoadError(const fs::path& file) {
  try {
    LoadMap(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "loaded";
}

void PutByte(const fs::path& file, std::size_t offset, char byte) {
  std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
  stream.seekp(static_cast<std::streamoff>(offset));
  stream.put(byte);
}

TEST(MapFile, GivesBackWhatWasSaved) {
  const TestFolder folder;
  const Map map = test::MakeAtlas();
  ASSERT_THAT(map.CheckInvariants(), IsEmpty());
  const SavedMap saved = LoadMap(SaveAtlas(folder, map));
  EXPECT_THAT(test::FindDifference(map, saved.map), IsEmpty());
  EXPECT_EQ(saved.map.level_scales(), test::kLevelScales);
  EXPECT_EQ(saved.map.KeyframeSlot(10).map, MapId(3));
  EXPECT_EQ(saved.map.Resolve(PointId(7)), PointId(2));
  EXPECT_EQ(saved.map.Resolve(KeyframeId(8))->keyframe, KeyframeId(2));
  EXPECT_EQ(saved.map.Resolve(KeyframeId(7)), std::nullopt);
  EXPECT_EQ(CountFiles(folder.path()), 1);
}

TEST(MapFile, GivesBackTheInfoItWasSavedWith) {
  const TestFolder folder;
  const MapFileInfo expected = test::MakeMapFileInfo();
  const MapFileInfo info = LoadMap(SaveAtlas(folder)).info;
  EXPECT_EQ(info.program, expected.program);
  EXPECT_EQ(info.created, expected.created);
  EXPECT_EQ(info.camera.camera, expected.camera.camera);
  EXPECT_EQ(info.camera.name, expected.camera.name);
  EXPECT_EQ(info.camera.depth_units_per_m, expected.camera.depth_units_per_m);
  EXPECT_EQ(info.level_scales, expected.level_scales);
  EXPECT_EQ(info.sessions, expected.sessions);
}

TEST(MapFile, IsTheSameByteForByteWhenLoadedAndSavedAgain) {
  const TestFolder folder;
  const fs::path first = SaveAtlas(folder);
  const SavedMap saved = LoadMap(first);
  SaveMap(folder / "b.map", saved.map, saved.info);
  EXPECT_EQ(TestFolder::Read(first), TestFolder::Read(folder / "b.map"));
}

TEST(MapFile, RestoresTheKeypointGrid) {
  const TestFolder folder;
  MapFileInfo info = test::MakeMapFileInfo();
  info.camera.camera = {.fx = 500.0, .fy = 500.0, .cx = 320.0, .cy = 240.0};  // as MakeFeatures()
  const Map map = test::MakeAtlas();
  SaveMap(folder / "a.map", map, info);
  const Map again = LoadMap(folder / "a.map").map;
  EXPECT_TRUE(test::AreEqualGrids(map.FindKeyframe(KeyframeId(2))->data->features,
                                  again.FindKeyframe(KeyframeId(2))->data->features));
}

TEST(MapFile, HoldsAnEmptyMapAndOneThatWasCleared) {
  const TestFolder folder;
  SaveAtlas(folder, Map(test::kLevelScales));
  EXPECT_EQ(LoadMap(folder / "a.map").map.num_keyframe_ids(), 0U);
  Map cleared = test::MakeAtlas();
  cleared.Clear();
  SaveAtlas(folder, cleared);
  EXPECT_THAT(test::FindDifference(cleared, LoadMap(folder / "a.map").map), IsEmpty());
}

TEST(MapFile, IsSavedUnderNamesOfAnyKind) {
  const TestFolder folder;
  const fs::path file = folder / "50% of #1? it's \xC3\xA4 map";
  SaveMap(file, test::MakeAtlas(), test::MakeMapFileInfo());
  EXPECT_EQ(LoadMap(file).map.num_keyframes(), 8U);
}

TEST(MapFile, SaysWhatAForeignFileIsNot) {
  const TestFolder folder;
  EXPECT_THAT(LoadError(folder / "none.map"), HasSubstr("no map file"));
  EXPECT_THAT(LoadError(folder.path()), HasSubstr("no map file"));
  EXPECT_THAT(LoadError(folder.Write("empty.map", "")), HasSubstr("is not a map"));
  EXPECT_THAT(LoadError(folder.Write("text.map", std::string(5000, 'x'))),
              HasSubstr("is not a map"));
  std::string other = TestFolder::Read(SaveAtlas(folder));
  other[68] = 'X';
  EXPECT_THAT(LoadError(folder.Write("other.map", other)), HasSubstr("is not a map"));
}

TEST(MapFile, NamesTheVersionItDoesNotKnow) {
  const TestFolder folder;
  std::string newer = TestFolder::Read(SaveAtlas(folder));
  newer[63] = 5;
  EXPECT_THAT(LoadError(folder.Write("newer.map", newer)),
              AllOf(HasSubstr("map format 5"), HasSubstr("up to 4"), HasSubstr("newer.map")));
  newer[63] = 1;
  EXPECT_THAT(LoadError(folder.Write("older.map", newer)),
              AllOf(HasSubstr("map format 1"), HasSubstr("make it anew"), HasSubstr("older.map")));
}

void UpdateChecksum(SqliteFile& file, const MapTable& table, std::uint32_t crc) {
  file.Execute(fmt::format("UPDATE checksums SET crc32 = {} WHERE name = '{}'", crc, table.name));
}

// As programs of format 3 wrote it: without the last three columns of the keyframes.
void MakeVersion3(const fs::path& path) {
  SqliteFile file = SqliteFile::OpenForWriting(path);
  for (const char* column : {"colours", "colour_height_px", "colour_width_px"})
    file.Execute(fmt::format("ALTER TABLE keyframes DROP COLUMN {}", column));
  TableReader row(file, kKeyframesTable.name, "*", "id");
  while (row.NextRow()) {
    constexpr int kNumColumns = 21;
    for (int i = 0; i < kNumColumns; ++i) {
      if (row.IsNull()) {
        row.SkipNull();
      } else if (i < 7 || i == 18 || i == 19) {
        row.Int();
      } else if (i < 14) {
        row.Double();
      } else {
        row.Blob();
      }
    }
  }
  UpdateChecksum(file, kKeyframesTable, row.crc());
  file.Execute("PRAGMA user_version = 3");
}

// As programs of format 2 wrote it: without the last two columns of the objects, either.
void MakeVersion2(const fs::path& path) {
  MakeVersion3(path);
  SqliteFile file = SqliteFile::OpenForWriting(path);
  file.Execute("ALTER TABLE objects DROP COLUMN num_unnamed_views");
  file.Execute("ALTER TABLE objects DROP COLUMN num_named_views");
  TableReader objects(file, kObjectsTable.name, "*", "id");
  ReadObjects(objects, 2);
  UpdateChecksum(file, kObjectsTable, objects.crc());
  file.Execute("PRAGMA user_version = 2");
}

TEST(MapFile, IsReadThoughItIsOfVersion3) {
  const TestFolder folder;
  const Map map = test::MakeAtlas();
  const fs::path path = SaveAtlas(folder, map);
  MakeVersion3(path);
  const SavedMap old = LoadMap(path);
  EXPECT_EQ(old.info.version, 3);
  ASSERT_EQ(old.map.Keyframes().size(), map.Keyframes().size());
  for (const KeyframeId id : map.Keyframes()) {
    const KeyframeData& data = *old.map.FindKeyframe(id)->data;
    EXPECT_FALSE(map.FindKeyframe(id)->data->bgr_small.empty());
    EXPECT_TRUE(data.bgr_small.empty()) << "nobody had kept it";
    EXPECT_EQ(data.depth_small_mm.size(), map.FindKeyframe(id)->data->depth_small_mm.size());
  }
}

TEST(MapFile, IsReadThoughItIsOfVersion2) {
  const TestFolder folder;
  const Map map = test::MakeAtlas();
  const fs::path path = SaveAtlas(folder, map);
  MakeVersion2(path);
  const SavedMap old = LoadMap(path);
  EXPECT_EQ(old.info.version, 2);
  ASSERT_EQ(old.map.num_object_ids(), map.num_object_ids());
  for (std::size_t i = 0; i < map.num_object_ids(); ++i) {
    MapObject object = map.ObjectSlot(i);
    EXPECT_GT(object.num_named_views, 0);
    object.num_named_views = object.num_unnamed_views = 0;  // nobody had kept them
    EXPECT_TRUE(test::AreEqual(object, old.map.ObjectSlot(i))) << i;
  }
  EXPECT_EQ(old.map.changes(), map.changes());
  EXPECT_EQ(old.map.num_points(), map.num_points());
  SaveMap(folder / "new.map", old.map, old.info);
  EXPECT_EQ(LoadMap(folder / "new.map").info.version, kMapFormatVersion);
}

TEST(MapFile, IsRefusedWhereverItIsCutOff) {
  const TestFolder folder;
  const std::string whole = TestFolder::Read(SaveAtlas(folder));
  const fs::path file = folder / "cut.map";
  std::vector<std::size_t> lengths{whole.size() - 1};
  for (std::size_t length = whole.size() - 1; length > 120; length -= std::min(length, 501UL))
    lengths.push_back(length);
  for (std::size_t length = 120; length > 0; --length)
    lengths.push_back(length - 1);
  folder.Write("cut.map", whole);
  for (const std::size_t length : lengths) {
    fs::resize_file(file, length);
    const std::string message = LoadError(file);
    EXPECT_THAT(message, HasSubstr("cut.map")) << "cut to " << length;
    EXPECT_THAT(message, Not(HasSubstr("\n")));
  }
  folder.Write("cut.map", whole + std::string(16384, '\0'));
  EXPECT_THAT(LoadError(file), HasSubstr("damaged"));
}

// A flipped bit in unused space does no harm; in all other places it is found.
TEST(MapFile, FlippedBitsAreFoundOrHarmless) {
  const TestFolder folder;
  const Map map = test::MakeAtlas();
  const std::string whole = TestFolder::Read(SaveAtlas(folder, map));
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (whole[i] != 0) used.push_back(i);
  }
  Rng rng(5);
  const fs::path file = folder.Write("flipped.map", whole);
  int num_found = 0;
  constexpr int kNumFlips = 800;
  for (int flip = 0; flip < kNumFlips; ++flip) {
    const std::size_t at = flip % 4 == 0 ? rng.Index(whole.size()) : used[rng.Index(used.size())];
    PutByte(file, at, static_cast<char>(whole[at] ^ (1 << rng.Index(8))));
    try {
      EXPECT_THAT(test::FindDifference(map, LoadMap(file).map), IsEmpty()) << "byte " << at;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("flipped.map"), Not(HasSubstr("\n"))));
      ++num_found;
    }
    PutByte(file, at, whole[at]);
  }
  EXPECT_GT(num_found, kNumFlips / 2);
}

TEST(MapFile, PagesFullOfRubbishAreRefused) {
  const TestFolder folder;
  const std::string whole = TestFolder::Read(SaveAtlas(folder));
  Rng rng(6);
  for (int round = 0; round < 100; ++round) {
    std::string damaged = whole;
    const std::size_t begin = 100 + rng.Index(whole.size() - 100);
    const std::size_t end = std::min(whole.size(), begin + 1 + rng.Index(20'000));
    for (std::size_t i = begin; i < end; ++i)
      damaged[i] = static_cast<char>(rng.NextUint64());
    const fs::path file = folder.Write("rubbish.map", damaged);
    const std::string message = LoadError(file);
    EXPECT_TRUE(message == "loaded" || message.find("rubbish.map") != std::string::npos) << message;
  }
}

TEST(MapFile, StaysAsItWasWhenTheDiskIsFull) {
  const TestFolder folder;
  const fs::path file = SaveAtlas(folder);
  const std::string before = TestFolder::Read(file);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old_limit{};
  getrlimit(RLIMIT_FSIZE, &old_limit);
  rlimit limit = old_limit;
  std::string message;
  for (const rlim_t bytes :
       {std::size_t{0}, std::size_t{1000}, before.size() / 2, before.size() - 1}) {
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
    message = MessageOf([&] { SaveAtlas(folder); });
    setrlimit(RLIMIT_FSIZE, &old_limit);
    EXPECT_THAT(message, AllOf(HasSubstr("cannot save"), HasSubstr("a.map"))) << bytes;
  }
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(TestFolder::Read(file), before);
  EXPECT_EQ(CountFiles(folder.path()), 1);
}

TEST(MapFile, SaysThatAFolderIsMissing) {
  const TestFolder folder;
  const fs::path file = folder / "none" / "a.map";
  EXPECT_THAT(MessageOf([&] { SaveMap(file, test::MakeAtlas(), test::MakeMapFileInfo()); }),
              AllOf(HasSubstr("cannot create"), HasSubstr(file.string())));
}

TEST(MapView, NextMapIdComesAfterAllMaps) {
  EXPECT_EQ(Map(test::kLevelScales).NextMapId(), MapId(0));
  EXPECT_EQ(test::MakeAtlas().NextMapId(), MapId(4));
}

TEST(MapFile, IsRefusedWithAnotherCamera) {
  const MapFileInfo info = test::MakeMapFileInfo();
  Camera camera = info.camera.camera;
  RequireSameCamera("a.map", info, camera);
  camera.fx += 1.0;
  EXPECT_THAT(MessageOf([&] { RequireSameCamera("a.map", info, camera); }),
              AllOf(HasSubstr("another camera"), HasSubstr(": fx 518.3 instead of 517.3;")));
}

// A child that saves the map again and again until it is killed.
pid_t StartSaving(const fs::path& file, const Map& map) {
  const pid_t child = fork();
  if (child != 0) return child;
  while (true)
    SaveMap(file, map, test::MakeMapFileInfo());
}

TEST(MapFile, IsWholeWheneverItsWriterIsKilled) {
  const TestFolder folder;
  Map map(test::kLevelScales);
  test::AddRowOfKeyframes(map, MapId(0), 10, 100);
  const fs::path file = SaveAtlas(folder, map);
  Rng rng(7);
  for (int round = 0; round < 50; ++round) {
    const pid_t child = StartSaving(file, map);
    ASSERT_GT(child, 0);
    poll(nullptr, 0, static_cast<int>(rng.Index(30)));
    kill(child, SIGKILL);
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    ASSERT_THAT(test::FindDifference(map, LoadMap(file).map), IsEmpty()) << "round " << round;
  }
  SaveAtlas(folder, map);
  EXPECT_EQ(CountFiles(folder.path()), 1) << "what the killed have left is not removed";
}

}  // namespace
}  // namespace cslam
