// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/zip_file.h"

#include "cslam/util/check.h"

#include <zlib.h>

#include <algorithm>
#include <utility>

namespace cslam {
namespace {

// From the ZIP application note: signatures, sizes of the fixed parts, places of fields in them.
constexpr std::string_view kEndSignature{"PK\x05\x06", 4};
constexpr std::string_view kEntrySignature{"PK\x01\x02", 4};
constexpr std::string_view kLocalSignature{"PK\x03\x04", 4};
constexpr std::size_t kEndBytes = 22;
constexpr std::size_t kEntryBytes = 46;
constexpr std::size_t kLocalBytes = 30;
constexpr std::size_t kMaxCommentBytes = 65535;
constexpr std::uint16_t kStored = 0;
constexpr std::uint16_t kDeflated = 8;
constexpr std::uint16_t kEncryptedFlag = 1;

std::uint32_t Number(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i)
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return value;
}

std::uint16_t Number16(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint16_t>(Number(bytes, at, 2));
}

std::uint32_t Number32(std::string_view bytes, std::size_t at) {
  return Number(bytes, at, 4);
}

// Empty if packed is damaged. zlib wants writable and unsigned bytes.
std::string Inflated(std::string packed, std::size_t bytes) {
  std::string result(bytes, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) return {};
  stream.next_in = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  const int status = inflate(&stream, Z_FINISH);
  const bool is_complete = status == Z_STREAM_END && stream.avail_out == 0;
  inflateEnd(&stream);
  return is_complete ? result : std::string();
}

std::uint32_t Checksum(const std::string& bytes) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

}  // namespace

ZipFile::ZipFile(std::filesystem::path path)
    : path_(std::move(path)), file_(path_, std::ios::binary | std::ios::ate) {
  if (!file_)
    throw Error("cannot read archive '{}': no such file or no permission", path_.string());
  file_bytes_ = static_cast<std::uint64_t>(file_.tellg());
  ReadDirectory();
}

std::string ZipFile::ReadAt(std::uint64_t offset, std::size_t bytes) {
  if (offset + bytes > file_bytes_)
    throw Error("cannot read archive '{}': it is damaged or cut off", path_.string());
  std::string result(bytes, '\0');
  file_.seekg(static_cast<std::streamoff>(offset));
  file_.read(result.data(), static_cast<std::streamsize>(bytes));
  if (!file_) throw Error("cannot read archive '{}': read error", path_.string());
  return result;
}

void ZipFile::ReadDirectory() {
  const std::size_t tail_bytes = std::min<std::uint64_t>(file_bytes_, kEndBytes + kMaxCommentBytes);
  const std::string tail = ReadAt(file_bytes_ - tail_bytes, tail_bytes);
  const std::size_t end = tail.rfind(kEndSignature);
  if (end == std::string::npos || end + kEndBytes > tail.size())
    throw Error("cannot read archive '{}': not a ZIP file, or cut off", path_.string());
  const std::uint16_t count = Number16(tail, end + 10);
  const std::string directory = ReadAt(Number32(tail, end + 16), Number32(tail, end + 12));
  std::size_t at = 0;
  for (std::uint16_t i = 0; i < count; ++i) {
    if (at + kEntryBytes > directory.size() ||
        std::string_view(directory).substr(at, 4) != kEntrySignature)
      throw Error("cannot read archive '{}': its directory is damaged", path_.string());
    const std::size_t name_bytes = Number16(directory, at + 28);
    const std::size_t rest_bytes =
        std::size_t{Number16(directory, at + 30)} + Number16(directory, at + 32);
    if (at + kEntryBytes + name_bytes > directory.size())
      throw Error("cannot read archive '{}': its directory is damaged", path_.string());
    std::string name = directory.substr(at + kEntryBytes, name_bytes);
    if (!name.ends_with('/') && (Number16(directory, at + 8) & kEncryptedFlag) == 0) {
      members_[std::move(name)] = {Number32(directory, at + 42), Number32(directory, at + 20),
                                   Number32(directory, at + 24), Number32(directory, at + 16),
                                   Number16(directory, at + 10)};
    }
    at += kEntryBytes + name_bytes + rest_bytes;
  }
}

std::vector<std::string> ZipFile::Names() const {
  std::vector<std::string> names;
  names.reserve(members_.size());
  for (const auto& [name, member] : members_)
    names.push_back(name);
  return names;
}

std::string ZipFile::Read(std::string_view name) {
  const auto found = members_.find(std::string(name));
  if (found == members_.end()) throw Error("archive '{}' has no member '{}'", path_.string(), name);
  const Member& member = found->second;
  const std::string local = ReadAt(member.offset, kLocalBytes);
  if (std::string_view(local).substr(0, 4) != kLocalSignature)
    throw Error("cannot read archive '{}': member '{}' is damaged", path_.string(), name);
  const std::uint64_t start =
      std::uint64_t{member.offset} + kLocalBytes + Number16(local, 26) + Number16(local, 28);
  std::string packed = ReadAt(start, member.packed_bytes);
  if (member.method != kStored && member.method != kDeflated)
    throw Error("cannot read archive '{}': member '{}' is packed in an unknown way ({})",
                path_.string(), name, member.method);
  std::string bytes =
      member.method == kStored ? std::move(packed) : Inflated(std::move(packed), member.bytes);
  if (bytes.size() != member.bytes || Checksum(bytes) != member.crc)
    throw Error("cannot read archive '{}': member '{}' is damaged", path_.string(), name);
  return bytes;
}

}  // namespace cslam
