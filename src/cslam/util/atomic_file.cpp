// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/atomic_file.h"

#include "cslam/util/check.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <system_error>

namespace cslam {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 16;

std::string Reason(int error_number) {
  return std::generic_category().message(error_number);
}

struct OpenedFile {
  std::filesystem::path path;
  int descriptor = -1;
};

// A new file beside path, with the permissions of any new file of this user.
OpenedFile OpenBeside(const std::filesystem::path& path) {
  constexpr int kMaxAttempts = 1000;  // names left behind by killed runs or used by other threads
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    std::filesystem::path name = path;
    name += fmt::format(".tmp-{}{}", getpid(), attempt == 0 ? "" : fmt::format("-{}", attempt));
    const int descriptor = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return {.path = name, .descriptor = descriptor};
    if (errno != EEXIST) {
      throw Error("cannot create '{}': {} (does its folder exist and may you write there?)",
                  path.string(), Reason(errno));
    }
  }
  throw Error("cannot create '{}': its folder is full of '.tmp-' files, remove them",
              path.string());
}

// Makes the new name itself durable; not every file system can, and none needs to.
void SyncFolderOf(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path, Durability durability)
    : path_(std::move(path)), durability_(durability) {
  OpenedFile file = OpenBeside(path_);
  temporary_path_ = std::move(file.path);
  descriptor_ = file.descriptor;
}

AtomicFile::~AtomicFile() {
  Discard();
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_path_(std::move(other.temporary_path_)),
      buffer_(std::move(other.buffer_)),
      durability_(other.durability_),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  if (this == &other) return *this;
  Discard();
  path_ = std::move(other.path_);
  temporary_path_ = std::move(other.temporary_path_);
  buffer_ = std::move(other.buffer_);
  durability_ = other.durability_;
  descriptor_ = std::exchange(other.descriptor_, -1);
  return *this;
}

void AtomicFile::Write(std::string_view bytes) {
  CSLAM_CHECK(descriptor_ >= 0, "'{}' is no longer open", path_.string());
  buffer_ += bytes;
  if (buffer_.size() >= kBufferBytes) Flush();
}

void AtomicFile::Commit() {
  CSLAM_CHECK(descriptor_ >= 0, "'{}' is no longer open", path_.string());
  Flush();
  if (durability_ == Durability::kSync && fsync(descriptor_) != 0) Fail("write");
  if (close(std::exchange(descriptor_, -1)) != 0) Fail("write");
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0) Fail("replace");
  if (durability_ == Durability::kSync) SyncFolderOf(path_);
}

void AtomicFile::Flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t written = write(descriptor_, rest.data(), rest.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      Fail("write");
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
}

void AtomicFile::Discard() noexcept {
  if (descriptor_ < 0) return;
  close(std::exchange(descriptor_, -1));
  unlink(temporary_path_.c_str());
}

void AtomicFile::Fail(const char* action) {
  const int error_number = errno;
  if (descriptor_ >= 0) close(std::exchange(descriptor_, -1));
  unlink(temporary_path_.c_str());
  throw Error("cannot {} '{}': {}", action, path_.string(), Reason(error_number));
}

void WriteFileAtomically(const std::filesystem::path& path, std::string_view content,
                         Durability durability) {
  AtomicFile file(path, durability);
  file.Write(content);
  file.Commit();
}

}  // namespace cslam
