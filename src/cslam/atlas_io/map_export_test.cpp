// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/atlas_io/map_export.h"

#include "cslam/atlas_io/map_summary.h"
#include "cslam/atlas_io/test_atlas.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cslam {
namespace {

using testing::HasSubstr;

const Camera kCamera{.fx = 500.0, .fy = 500.0, .cx = 320.0, .cy = 240.0};

// One keyframe at x metres whose reduced depth image shows a wall at depth_mm.
Map MakeWallMap(double x, int depth_mm) {
  Map map(test::kLevelScales);
  Keyframe keyframe = test::MakeKeyframe(0, 5, x);
  auto data = std::make_shared<KeyframeData>(*keyframe.data);
  data->depth_small_mm = cv::Mat(120, 160, CV_16UC1, cv::Scalar(depth_mm));
  keyframe.data = std::move(data);
  map.AddKeyframe(keyframe);
  return map;
}

TEST(SummariseMaps, CountsEachMapByItself) {
  const Map map = test::MakeAtlas();
  const std::vector<MapSummary> maps = SummariseMaps(map);
  ASSERT_EQ(maps.size(), 2U);
  EXPECT_EQ(maps[0].map, MapId(0));
  EXPECT_EQ(maps[0].num_keyframes, 5U);
  EXPECT_EQ(maps[1].map, MapId(3));
  EXPECT_EQ(maps[1].num_keyframes, 3U);
  EXPECT_EQ(maps[0].num_points + maps[1].num_points, map.num_points());
  EXPECT_NEAR(maps[1].keyframes_box.max().x(), 0.2, 1e-12);
  EXPECT_EQ(maps[1].first.ns, 9'000'000);
  EXPECT_EQ(LargestMapOf(maps), MapId(0));
  EXPECT_THAT(MessageOf([] { LargestMapOf({}); }), HasSubstr("empty"));
}

TEST(SparseCloud, HoldsThePointsOfOneMap) {
  const Map map = test::MakeAtlas();
  const std::vector<MapSummary> maps = SummariseMaps(map);
  EXPECT_EQ(SparseCloud(map, MapId(3)).size(), maps[1].num_points);
  EXPECT_EQ(SparseCloud(map, MapId(1)).size(), 0U);
}

TEST(DenseCloud, PutsTheWallWhereItIs) {
  const Map map = MakeWallMap(5.0, 2000);
  const auto cloud = DenseCloud(map, MapId(0), kCamera, {.voxel_m = 0.1, .max_depth_m = 4.0});
  Eigen::AlignedBox3f box;
  for (const ColoredPoint& point : cloud)
    box.extend(point.position_m);
  EXPECT_NEAR(static_cast<double>(box.min().z()), 2.0, 1e-6);
  EXPECT_NEAR(static_cast<double>(box.max().z()), 2.0, 1e-6);
  // The image is 640 / 500 * 2 m = 2.56 m wide at the wall; voxels are averaged.
  EXPECT_NEAR(static_cast<double>(box.min().x()), 5.0 - 1.28, 0.06);
  EXPECT_NEAR(static_cast<double>(box.max().x()), 5.0 + 1.28, 0.06);
  EXPECT_GT(cloud.size(), 400U);
  EXPECT_LT(cloud.size(), 600U) << "26 x 20 voxels";
}

TEST(DenseCloud, LeavesOutWhatIsMissingOrFar) {
  EXPECT_TRUE(DenseCloud(MakeWallMap(0.0, 0), MapId(0), kCamera).empty());
  EXPECT_TRUE(DenseCloud(MakeWallMap(0.0, 4100), MapId(0), kCamera).empty());
  EXPECT_TRUE(DenseCloud(MakeWallMap(0.0, 2000), MapId(1), kCamera).empty());
  Map without_depth(test::kLevelScales);
  without_depth.AddKeyframe(test::MakeKeyframe(0, 5));
  EXPECT_TRUE(DenseCloud(without_depth, MapId(0), kCamera).empty());
}

TEST(KeyframeTrajectory, IsInOrderOfTimeWithoutRepetition) {
  Map map(test::kLevelScales);
  map.AddKeyframe(test::MakeKeyframe(0, 5, 0.0));
  for (const std::uint32_t id : {1U, 2U, 3U}) {
    Keyframe keyframe = test::MakeKeyframe(id, 5, 1.0 * id, KeyframeId(0));
    auto data = std::make_shared<KeyframeData>(*keyframe.data);
    data->stamp = Stamp{id == 3 ? 1 : 9 - std::int64_t{id}};
    keyframe.data = std::move(data);
    map.AddKeyframe(keyframe);
  }
  Keyframe again = test::MakeKeyframe(4, 5, 7.0, KeyframeId(0));
  auto data = std::make_shared<KeyframeData>(*again.data);
  data->stamp = Stamp{7};
  again.data = std::move(data);
  map.AddKeyframe(again);
  const Trajectory trajectory = KeyframeTrajectory(map, MapId(0));
  ASSERT_EQ(trajectory.size(), 4U);
  EXPECT_EQ(trajectory[1].stamp.ns, 1);
  EXPECT_EQ(trajectory[2].stamp.ns, 7);
  EXPECT_EQ(trajectory[2].T_world_camera.translation.x(), 2.0);
}

TEST(FormatMapInfo, IsCompleteAndTakesAnyName) {
  SavedMap saved{.info = test::MakeMapFileInfo(), .map = test::MakeAtlas()};
  saved.info.camera.name = "a\"b\xFF";
  const std::string text = FormatMapInfo(saved, 1234);
  EXPECT_THAT(text, HasSubstr("\"size_bytes\": 1234"));
  EXPECT_THAT(text, HasSubstr("\"first_stamp\": \"0.009000\""));
  EXPECT_THAT(text, HasSubstr("a\\\"b"));
}

TEST(SummariseSessions, TellsWhoMadeWhichKeyframes) {
  SavedMap saved{.info = test::MakeMapFileInfo(), .map = test::MakeAtlas()};
  test::AddRowOfKeyframes(saved.map, MapId(5), 2, 8);
  const auto sessions = SummariseSessions(saved);
  ASSERT_EQ(sessions.size(), 2U);
  EXPECT_EQ(sessions[0].name, "morning");
  EXPECT_EQ(sessions[0].num_keyframes, 8U);
  EXPECT_EQ(sessions[1].name, "noon");
  EXPECT_EQ(sessions[1].num_keyframes, 2U);
  EXPECT_LT(sessions[1].first, sessions[1].last);
}

TEST(WriteMapJson, WritesOneLineForEachKeyframeAndPoint) {
  const TestFolder folder;
  const SavedMap saved{.info = test::MakeMapFileInfo(), .map = test::MakeAtlas()};
  WriteMapJson(folder / "a.json", saved);
  const std::string text = TestFolder::Read(folder / "a.json");
  const auto count = [&](std::string_view part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++n;
    return n;
  };
  EXPECT_EQ(count("\"pose\":["), saved.map.num_keyframes());
  EXPECT_EQ(count("\"position_m\":["), saved.map.num_points());
  EXPECT_EQ(text.substr(text.size() - 4), "]\n}\n");
}

}  // namespace
}  // namespace cslam
