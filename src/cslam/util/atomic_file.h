// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/core.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace cslam {

// What a committed file survives. kSync (fsync) outlives a power cut and costs a disk write;
// kRename outlives a crash of the program and suits files that are cheap to make again.
enum class Durability { kSync, kRename };

// Writes a file that appears under its name only when complete. Until Commit() the bytes live in
// "<name>.tmp-<pid>" in the same folder; without Commit() they are removed and an older file of
// that name stays as it was. Every failure (no such folder, no permission, disk full) throws
// Error with the path and the reason. For one thread at a time.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path, Durability durability = Durability::kSync);
  ~AtomicFile();
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void Write(std::string_view bytes);

  template <typename... Args>
  void Print(fmt::format_string<Args...> format, Args&&... args) {
    Write(fmt::format(format, std::forward<Args>(args)...));
  }

  // Gives the file its name. Nothing may be written afterwards.
  void Commit();

  const std::filesystem::path& path() const { return path_; }

  // Where the bytes are until Commit(), for a library that writes the file by itself.
  const std::filesystem::path& temporary_path() const { return temporary_path_; }

 private:
  void Flush();
  void Discard() noexcept;
  // Removes the temporary file and throws Error for errno.
  [[noreturn]] void Fail(const char* action);

  std::filesystem::path path_;
  std::filesystem::path temporary_path_;
  std::string buffer_;
  Durability durability_;
  int descriptor_ = -1;  // -1 once committed, failed or moved from
};

void WriteFileAtomically(const std::filesystem::path& path, std::string_view content,
                         Durability durability = Durability::kSync);

}  // namespace cslam
