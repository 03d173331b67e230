// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/gzip.h"

#include "cslam/util/check.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace cslam {
namespace {

constexpr std::size_t kMaxUnpacked = std::size_t{1} << 30;  // bytes; assets are far smaller
constexpr int kGzipWindow = 16 + MAX_WBITS;                 // zlib's code for "a gzip header"

// Ends zlib's state however the function is left.
struct Inflater {
  z_stream stream{};
  ~Inflater() { inflateEnd(&stream); }
};

}  // namespace

bool IsGzip(std::string_view bytes) {
  return bytes.starts_with("\x1f\x8b");
}

std::string Gunzip(std::string_view bytes, std::string_view file) {
  Inflater inflater;
  z_stream& stream = inflater.stream;
  if (inflateInit2(&stream, kGzipWindow) != Z_OK) throw Error("cannot unpack '{}'", file);
  std::string packed(bytes.substr(0, std::numeric_limits<uInt>::max()));
  stream.next_in = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string unpacked;
  std::array<char, 1 << 16> buffer;
  int result = Z_OK;
  while (result == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    result = inflate(&stream, Z_NO_FLUSH);
    unpacked.append(buffer.data(), buffer.size() - stream.avail_out);
    if (unpacked.size() > kMaxUnpacked) throw Error("'{}' unpacks to more than 1 GiB", file);
  }
  if (result != Z_STREAM_END) throw Error("cannot unpack '{}': it is damaged or cut off", file);
  return unpacked;
}

}  // namespace cslam
