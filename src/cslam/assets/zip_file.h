// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cslam {

// A ZIP archive (also .sh3f, .pk3), read member by member: stored and deflated members, up to
// 4 GB. Every failure throws Error with the path and the reason. For one thread at a time.
class ZipFile {
 public:
  explicit ZipFile(std::filesystem::path path);

  // Names of all members (not of folders), in alphabetical order.
  std::vector<std::string> Names() const;
  bool Has(std::string_view name) const { return members_.contains(std::string(name)); }

  // The bytes of a member, checked against its checksum.
  std::string Read(std::string_view name);

 private:
  struct Member {
    std::uint32_t offset = 0;  // of its local header
    std::uint32_t packed_bytes = 0;
    std::uint32_t bytes = 0;
    std::uint32_t crc = 0;
    std::uint16_t method = 0;
  };

  std::string ReadAt(std::uint64_t offset, std::size_t bytes);
  void ReadDirectory();

  std::filesystem::path path_;
  std::ifstream file_;
  std::uint64_t file_bytes_ = 0;
  std::map<std::string, Member> members_;
};

}  // namespace cslam
