// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/render_record.h"
#include "cslam/io/truth_files.h"
#include "cslam/util/test_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace cslam {
namespace {

// The example of that format in docs/formats.md, as a file. The readers take exactly the keys the
// writers write (see their tests), so an example they take has the keys of real files.
std::filesystem::path Example(const TestFolder& folder, const std::string& format) {
  const std::string docs = TestFolder::Read(CSLAM_SOURCE_DIR "/docs/formats.md");
  const std::string fence = "```";
  const std::size_t start = docs.find(fence + "json\n{\n  \"format\": \"" + format + "\"");
  if (start == std::string::npos) return folder / "no example in docs/formats.md";
  const std::size_t text = docs.find('\n', start) + 1;
  return folder.Write(format + ".json", docs.substr(text, docs.find(fence, text) - text));
}

TEST(FormatsDocumentation, DescribesDetections) {
  const TestFolder folder;
  const DetectionRecord record = ReadDetections(Example(folder, "detections"));
  ASSERT_EQ(record.frames.size(), 2U);
  EXPECT_EQ(record.frames[1].detections.at(0).box, (Box{212, 40, 377, 480}));
}

TEST(FormatsDocumentation, DescribesObjects) {
  const TestFolder folder;
  const TrueObjects objects = ReadTrueObjects(Example(folder, "objects"));
  ASSERT_EQ(objects.objects.size(), 1U);
  EXPECT_EQ(objects.objects[0].intervals.size(), 2U);
}

TEST(FormatsDocumentation, DescribesChanges) {
  const TestFolder folder;
  const TrueChanges changes = ReadTrueChanges(Example(folder, "changes"));
  ASSERT_EQ(changes.changes.size(), 2U);
  EXPECT_EQ(changes.changes[0].kind, ChangeKind::kReplaced);
}

TEST(FormatsDocumentation, DescribesTheRecordOfARendering) {
  const TestFolder folder;
  EXPECT_EQ(ReadRenderRecord(Example(folder, "render")).num_frames, 840);
}

}  // namespace
}  // namespace cslam
