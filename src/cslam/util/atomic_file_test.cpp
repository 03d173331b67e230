// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/atomic_file.h"

#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <string>
#include <utility>

namespace cslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

int CountFiles(const std::filesystem::path& folder) {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder))
    ++count;
  return count;
}

// While it lives, no file of this process may grow beyond the limit: write() fails in the middle
// as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    rlimit limit = old_limit_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_limit_{};
  void (*old_handler_)(int);
};

TEST(AtomicFile, AppearsUnderItsNameOnlyWithCommit) {
  const TestFolder folder;
  AtomicFile file(folder / "a.txt");
  file.Print("{} {}\n", 1, "x");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  file.Commit();
  EXPECT_EQ(TestFolder::Read(folder / "a.txt"), "1 x\n");
  EXPECT_EQ(CountFiles(folder.path()), 1) << "the temporary file was left behind";
}

TEST(AtomicFile, KeepsTheOldFileWhenDroppedWithoutCommit) {
  const TestFolder folder;
  folder.Write("a.txt", "old");
  {
    AtomicFile file(folder / "a.txt");
    file.Write("new");
  }
  EXPECT_EQ(TestFolder::Read(folder / "a.txt"), "old");
  EXPECT_EQ(CountFiles(folder.path()), 1);
}

TEST(AtomicFile, WritesMoreThanItsBufferInOrder) {
  const TestFolder folder;
  std::string expected;
  AtomicFile file(folder / "long.txt", Durability::kRename);
  for (int i = 0; i < 40'000; ++i) {
    file.Print("{}\n", i);
    expected += fmt::format("{}\n", i);
  }
  file.Commit();
  EXPECT_EQ(TestFolder::Read(folder / "long.txt"), expected);
}

TEST(AtomicFile, TwoWritersOfOneNameDoNotMix) {
  const TestFolder folder;
  AtomicFile first(folder / "a.txt");
  AtomicFile second(folder / "a.txt");
  first.Write("first");
  second.Write("second");
  first.Commit();
  second.Commit();
  EXPECT_EQ(TestFolder::Read(folder / "a.txt"), "second");
  EXPECT_EQ(CountFiles(folder.path()), 1);
}

TEST(AtomicFile, MovesItsFileWithIt) {
  const TestFolder folder;
  AtomicFile file(folder / "a.txt");
  file.Write("a");
  AtomicFile moved = std::move(file);
  moved.Write("b");
  moved.Commit();
  EXPECT_EQ(TestFolder::Read(folder / "a.txt"), "ab");
}

TEST(AtomicFile, NamesFileAndReasonWhenItsFolderIsMissing) {
  const TestFolder folder;
  EXPECT_THAT(MessageOf([&] { AtomicFile file(folder / "none/a.txt"); }),
              AllOf(HasSubstr("none/a.txt"), HasSubstr("No such file or directory")));
}

TEST(AtomicFile, NamesFileAndReasonWhenItsFolderMayNotBeWritten) {
  // /proc refuses new files even to root, for whom permissions mean nothing.
  EXPECT_THAT(MessageOf([] { AtomicFile file("/proc/cslam.txt"); }),
              HasSubstr("cannot create '/proc/cslam.txt'"));
}

TEST(AtomicFile, LeavesNothingBehindWhenTheDiskIsFull) {
  const TestFolder folder;
  folder.Write("a.txt", "old");
  const std::string content(300'000, 'x');
  {
    const FileSizeLimit limit(100'000);
    EXPECT_THAT(MessageOf([&] { WriteFileAtomically(folder / "a.txt", content); }),
                AllOf(HasSubstr("cannot write"), HasSubstr("a.txt"), HasSubstr("too large")));
  }
  EXPECT_EQ(TestFolder::Read(folder / "a.txt"), "old");
  EXPECT_EQ(CountFiles(folder.path()), 1) << "the half-written file was left behind";
}

TEST(AtomicFile, FailsWhenTheNameIsAFolder) {
  const TestFolder folder;
  std::filesystem::create_directories(folder / "name/inside");
  EXPECT_THROW(WriteFileAtomically(folder / "name", "x"), Error);
  EXPECT_EQ(CountFiles(folder.path()), 1);
}

TEST(AtomicFile, RefusesToWriteAfterCommit) {
  const TestFolder folder;
  AtomicFile file(folder / "a.txt");
  file.Commit();
  EXPECT_THROW(file.Write("x"), InternalError);
  EXPECT_THROW(file.Commit(), InternalError);
}

}  // namespace
}  // namespace cslam
