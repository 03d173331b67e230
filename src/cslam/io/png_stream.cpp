// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/png_stream.h"

#include "cslam/util/check.h"

#include <png.h>
#include <zlib.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <utility>
#include <vector>

namespace cslam {
namespace {

constexpr bool kSwapsBytes = std::endian::native == std::endian::little;

// libpng demands that this never returns. The message is copied first: it may live in libpng.
[[noreturn]] void OnError(png_structp png, png_const_charp message) {
  auto* problem = static_cast<std::string*>(png_get_error_ptr(png));
  try {
    *problem = message;
  } catch (...) {
    problem->clear();  // out of memory even for the message; the failure itself still counts
  }
  png_longjmp(png, 1);
}

// Damage that libpng can live with (unknown or broken side chunks) does not concern the pixels.
void OnWarning(png_structp, png_const_charp) {}

}  // namespace

struct PngReader::State {
  std::string_view rest;
  std::string problem;
  std::vector<png_bytep> rows;
  png_structp png = nullptr;
  png_infop info = nullptr;

  ~State() { png_destroy_read_struct(&png, &info, nullptr); }
};

namespace {

void ReadFromMemory(png_structp png, png_bytep destination, std::size_t count) {
  auto* rest = static_cast<std::string_view*>(png_get_io_ptr(png));
  if (count > rest->size()) png_error(png, "the file is truncated");
  std::memcpy(destination, rest->data(), count);
  rest->remove_prefix(count);
}

}  // namespace

PngReader::PngReader(std::string_view bytes) : state_(std::make_unique<State>()) {
  state_->rest = bytes;
  state_->png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state_->problem, OnError, OnWarning);
  if (state_->png != nullptr) state_->info = png_create_info_struct(state_->png);
  CSLAM_CHECK(state_->info != nullptr, "libpng cannot start");
}

PngReader::~PngReader() = default;
PngReader::PngReader(PngReader&&) noexcept = default;
PngReader& PngReader::operator=(PngReader&&) noexcept = default;

bool PngReader::ReadHeader(int max_side_px) {
  if (setjmp(png_jmpbuf(state_->png)) != 0) return false;
  const auto max_side = static_cast<png_uint_32>(max_side_px);
  png_set_user_limits(state_->png, max_side, max_side);
  png_set_read_fn(state_->png, &state_->rest, ReadFromMemory);
  png_read_info(state_->png, state_->info);
  return true;
}

PngHeader PngReader::header() const {
  const png_structp png = state_->png;
  const png_infop info = state_->info;
  return {.width = static_cast<int>(png_get_image_width(png, info)),
          .height = static_cast<int>(png_get_image_height(png, info)),
          .bit_depth = png_get_bit_depth(png, info),
          .channels = png_get_channels(png, info),
          .is_palette = png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE};
}

void PngReader::RequestBgr() {
  png_set_palette_to_rgb(state_->png);  // and grey of fewer than 8 bits to 8; alpha if any
  png_set_gray_to_rgb(state_->png);
  png_set_strip_alpha(state_->png);
  png_set_bgr(state_->png);
}

void PngReader::RequestHostByteOrder() {
  if constexpr (kSwapsBytes) png_set_swap(state_->png);
}

bool PngReader::ReadPixels(unsigned char* pixels, std::size_t stride) {
  state_->rows.resize(png_get_image_height(state_->png, state_->info));
  for (std::size_t y = 0; y < state_->rows.size(); ++y) {
    state_->rows[y] = pixels + y * stride;
  }
  if (setjmp(png_jmpbuf(state_->png)) != 0) return false;
  png_set_interlace_handling(state_->png);
  png_read_update_info(state_->png, state_->info);
  if (png_get_rowbytes(state_->png, state_->info) > stride) {
    png_error(state_->png, "a row is longer than expected");
  }
  png_read_image(state_->png, state_->rows.data());
  png_read_end(state_->png, nullptr);
  return true;
}

const std::string& PngReader::problem() const {
  return state_->problem;
}

struct PngWriter::State {
  std::string bytes;
  std::string problem;
  png_structp png = nullptr;
  png_infop info = nullptr;

  ~State() { png_destroy_write_struct(&png, &info); }
};

namespace {

bool Append(std::string& bytes, const char* data, std::size_t count) noexcept {
  try {
    bytes.append(data, count);
    return true;
  } catch (...) {
    return false;
  }
}

void WriteToMemory(png_structp png, png_bytep data, std::size_t count) {
  auto* bytes = static_cast<std::string*>(png_get_io_ptr(png));
  if (!Append(*bytes, reinterpret_cast<const char*>(data), count)) {
    png_error(png, "out of memory");
  }
}

void FlushNothing(png_structp) {}

}  // namespace

PngWriter::PngWriter() : state_(std::make_unique<State>()) {
  state_->png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &state_->problem, OnError, OnWarning);
  if (state_->png != nullptr) state_->info = png_create_info_struct(state_->png);
  CSLAM_CHECK(state_->info != nullptr, "libpng cannot start");
}

PngWriter::~PngWriter() = default;

bool PngWriter::Encode(const PngHeader& header, const unsigned char* pixels, std::size_t stride,
                       int compression) {
  if (setjmp(png_jmpbuf(state_->png)) != 0) return false;
  const png_structp png = state_->png;
  const png_infop info = state_->info;
  png_set_write_fn(png, &state_->bytes, WriteToMemory, FlushNothing);
  // One fixed filter: libpng's own choice tries five of them and gains nothing. Noisy colours hold
  // no repetition that a search would find, so Huffman codes of the differences alone do better
  // than level 6 in a tenth of its time. Depths and ids are few different values, and repeat.
  const bool is_color = header.channels == 3 && compression != 0;
  png_set_compression_level(png, compression);
  png_set_compression_mem_level(png, 9);
  png_set_compression_strategy(png, is_color ? Z_HUFFMAN_ONLY : Z_DEFAULT_STRATEGY);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, is_color ? PNG_FILTER_PAETH : PNG_FILTER_NONE);
  png_set_IHDR(png, info, static_cast<png_uint_32>(header.width),
               static_cast<png_uint_32>(header.height), header.bit_depth,
               header.channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  if (header.channels == 3) png_set_bgr(png);
  if (kSwapsBytes && header.bit_depth == 16) png_set_swap(png);
  for (int y = 0; y < header.height; ++y) {
    png_write_row(png, pixels + static_cast<std::size_t>(y) * stride);
  }
  png_write_end(png, info);
  return true;
}

const std::string& PngWriter::bytes() const {
  return state_->bytes;
}

const std::string& PngWriter::problem() const {
  return state_->problem;
}

}  // namespace cslam
