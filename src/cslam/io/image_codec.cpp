// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/image_codec.h"

#include "cslam/io/png_stream.h"
#include "cslam/io/text_lines.h"
#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"

#include <turbojpeg.h>

#include <memory>
#include <string>
#include <string_view>

namespace cslam {
namespace {

constexpr int kMaxSide = 16384;  // px, as for cameras

bool IsPng(std::string_view bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1a\n");
}

bool IsJpeg(std::string_view bytes) {
  return bytes.starts_with("\xff\xd8\xff");
}

[[noreturn]] void ThrowUnknownType(const std::filesystem::path& path, std::string_view bytes) {
  if (bytes.empty()) throw Error("image '{}' is empty (0 bytes)", path.string());
  throw Error("image '{}' is neither PNG nor JPEG", path.string());
}

struct TurboJpegCloser {
  void operator()(void* handle) const { tjDestroy(handle); }
};

// Decoding goes on after damage with a warning; only this one leaves the pixels as they were.
bool IsHarmless(tjhandle handle) {
  return tjGetErrorCode(handle) == TJERR_WARNING &&
         std::string_view(tjGetErrorStr2(handle)).find("extraneous bytes") !=
             std::string_view::npos;
}

cv::Mat DecodeJpeg(const std::filesystem::path& path, std::string_view bytes) {
  const std::unique_ptr<void, TurboJpegCloser> handle(tjInitDecompress());
  if (!handle) throw Error("cannot start the JPEG decoder: {}", tjGetErrorStr2(nullptr));
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colorspace = 0;
  if (tjDecompressHeader3(handle.get(), data, bytes.size(), &width, &height, &subsampling,
                          &colorspace) != 0) {
    throw Error("cannot decode JPEG image '{}': {}", path.string(), tjGetErrorStr2(handle.get()));
  }
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    throw Error("JPEG image '{}' is {}x{}; at most {} px a side are read", path.string(), width,
                height, kMaxSide);
  }
  cv::Mat image(height, width, CV_8UC3);
  const int result =
      tjDecompress2(handle.get(), data, bytes.size(), image.data, width,
                    static_cast<int>(image.step[0]), height, TJPF_BGR, TJFLAG_ACCURATEDCT);
  if (result != 0 && !IsHarmless(handle.get())) {
    throw Error("cannot decode JPEG image '{}': {}", path.string(), tjGetErrorStr2(handle.get()));
  }
  return image;
}

PngReader OpenPng(const std::filesystem::path& path, std::string_view bytes) {
  PngReader reader(bytes);
  if (!reader.ReadHeader(kMaxSide)) {
    throw Error("cannot decode PNG image '{}': {}", path.string(), reader.problem());
  }
  return reader;
}

cv::Mat FinishPng(const std::filesystem::path& path, PngReader& reader, int type) {
  const PngHeader header = reader.header();
  cv::Mat image(header.height, header.width, type);
  if (!reader.ReadPixels(image.data, image.step[0])) {
    throw Error("cannot decode PNG image '{}': {}", path.string(), reader.problem());
  }
  return image;
}

}  // namespace

cv::Mat ReadColorImage(const std::filesystem::path& path) {
  return DecodeColorImage(ReadBytes(path, "image"), path);
}

cv::Mat DecodeColorImage(std::string_view bytes, const std::filesystem::path& name) {
  if (IsJpeg(bytes)) return DecodeJpeg(name, bytes);
  if (!IsPng(bytes)) ThrowUnknownType(name, bytes);
  PngReader reader = OpenPng(name, bytes);
  if (reader.header().bit_depth == 16) {
    throw Error("colour image '{}' has 16 bits per channel, expected 8 (is it a depth image?)",
                name.string());
  }
  reader.RequestBgr();
  return FinishPng(name, reader, CV_8UC3);
}

cv::Mat ReadDepthImage(const std::filesystem::path& path) {
  const std::string bytes = ReadBytes(path, "image");
  if (IsJpeg(bytes)) {
    throw Error("depth image '{}' is a JPEG, expected a 16-bit single-channel PNG", path.string());
  }
  if (!IsPng(bytes)) ThrowUnknownType(path, bytes);
  PngReader reader = OpenPng(path, bytes);
  const PngHeader header = reader.header();
  if (header.bit_depth != 16 || header.channels != 1) {
    throw Error("depth image '{}' is a {}-bit PNG with {}, expected 16-bit with 1 channel",
                path.string(), header.bit_depth,
                header.is_palette ? "a palette" : fmt::format("{} channel(s)", header.channels));
  }
  reader.RequestHostByteOrder();
  return FinishPng(path, reader, CV_16UC1);
}

void WritePng(const std::filesystem::path& path, const cv::Mat& image, int compression) {
  CSLAM_CHECK(!image.empty() && image.dims == 2, "only two-dimensional images can be PNGs");
  CSLAM_CHECK(compression >= 0 && compression <= 9, "compression {}", compression);
  const bool is_known =
      image.type() == CV_8UC1 || image.type() == CV_8UC3 || image.type() == CV_16UC1;
  CSLAM_CHECK(is_known, "OpenCV type {} cannot be written as PNG", image.type());
  PngWriter writer;
  const bool done = writer.Encode({.width = image.cols,
                                   .height = image.rows,
                                   .bit_depth = image.depth() == CV_16U ? 16 : 8,
                                   .channels = image.channels()},
                                  image.data, image.step[0], compression);
  if (!done) throw Error("cannot encode '{}' as PNG: {}", path.string(), writer.problem());
  WriteFileAtomically(path, writer.bytes(), Durability::kRename);
}

}  // namespace cslam
