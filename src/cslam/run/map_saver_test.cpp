// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/map_saver.h"

#include "cslam/map/test_map.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cslam {
namespace {

using testing::HasSubstr;

MapUpdate UpdateOf(int num_keyframes) {
  Map map(test::kLevelScales);
  for (int i = 0; i < num_keyframes; ++i) {
    const auto id = static_cast<std::uint32_t>(i);
    map.AddKeyframe(test::MakeKeyframe(id, 5, 0.1 * i, i == 0 ? KeyframeId() : KeyframeId(id - 1)));
  }
  auto snapshot = std::make_shared<MapSnapshot>();
  snapshot->map = map.Snapshot();
  MapUpdate update;
  update.snapshot = std::move(snapshot);
  return update;
}

TrackingResult FrameAt(double time_s) {
  TrackingResult result;
  result.stamp = Stamp{static_cast<std::int64_t>(1e9 * time_s)};
  return result;
}

class MapSaverTest : public testing::TestWithParam<Execution> {
 protected:
  MapSaver MakeSaver() const {
    MapFileInfo info;
    info.camera.camera = {.fx = 500.0, .fy = 500.0, .cx = 320.0, .cy = 240.0};
    info.level_scales = test::kLevelScales;
    return MapSaver(
        {.path = file_, .info = std::move(info), .every_s = 2.0, .execution = GetParam()});
  }
  std::size_t NumSaved() const { return LoadMap(file_).map.num_keyframes(); }

  const TestFolder folder_;
  const std::filesystem::path file_ = folder_ / "a.map";
};

std::string NameOf(const testing::TestParamInfo<Execution>& param) {
  return param.param == Execution::kInline ? "Inline" : "Threaded";
}
INSTANTIATE_TEST_SUITE_P(Executions, MapSaverTest,
                         testing::Values(Execution::kInline, Execution::kThreaded), NameOf);

TEST_P(MapSaverTest, SavesWhatIsThereEverySoOften) {
  {
    MapSaver saver = MakeSaver();
    saver.OnFrame(FrameAt(10.0));
    saver.OnMap(UpdateOf(1));
    saver.OnFrame(FrameAt(11.9));
    EXPECT_FALSE(std::filesystem::exists(file_));
    saver.OnMap(UpdateOf(3));
    saver.OnFrame(FrameAt(12.0));
    saver.OnMap(UpdateOf(4));
    saver.OnFrame(FrameAt(13.9));
  }  // as if the run had died: nothing is saved at its end
  EXPECT_EQ(NumSaved(), 3U);
}

TEST_P(MapSaverTest, SavesTheLastMapAtTheEnd) {
  MapSaver saver = MakeSaver();
  const MapUpdate update = UpdateOf(5);
  saver.OnFrame(FrameAt(0.0));
  saver.OnMap(update);
  EXPECT_TRUE(saver.SaveFinal(*update.snapshot));
  EXPECT_EQ(NumSaved(), 5U);
  EXPECT_TRUE(saver.problems().empty());
}

TEST_P(MapSaverTest, LeavesAnOlderFileAloneWhenThereIsNothingToSave) {
  MapSaver saver = MakeSaver();
  folder_.Write("a.map", "older");
  saver.OnFrame(FrameAt(0.0));
  saver.OnMap(UpdateOf(0));
  saver.OnFrame(FrameAt(10.0));
  EXPECT_FALSE(saver.SaveFinal(MapSnapshot{}));
  EXPECT_EQ(TestFolder::Read(file_), "older");
}

TEST_P(MapSaverTest, GoesOnAfterASaveThatFailed) {
  MapSaver saver = MakeSaver();
  std::filesystem::create_directory(file_);  // a folder cannot be replaced
  std::filesystem::create_directory(file_ / "full");
  saver.OnFrame(FrameAt(0.0));
  saver.OnMap(UpdateOf(1));
  saver.OnFrame(FrameAt(10.0));
  EXPECT_THROW(saver.SaveFinal(*UpdateOf(2).snapshot), Error);
  ASSERT_EQ(saver.problems().size(), 1U);
  EXPECT_THAT(saver.problems()[0], HasSubstr("a.map"));
}

TEST(MapSaver, RefusesAPlaceWhereNothingCanBeWrittenBeforeTheRun) {
  const TestFolder folder;
  EXPECT_THAT(MessageOf([&] {
                MapSaver({.path = folder / "none" / "a.map",
                          .info = {},
                          .every_s = 1.0,
                          .execution = Execution::kInline});
              }),
              HasSubstr("none"));
}

}  // namespace
}  // namespace cslam
