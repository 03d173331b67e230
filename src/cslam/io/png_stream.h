// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace cslam {

struct PngHeader {
  int width = 0;      // px
  int height = 0;     // px
  int bit_depth = 8;  // per channel: 1, 2, 4, 8 or 16
  int channels = 1;
  bool is_palette = false;
};

// libpng reports errors by longjmp. These two classes keep it inside functions that own nothing:
// the steps return false and problem() says why, and no jump ever crosses a destructor.

// Decodes one PNG that lies in memory; the bytes must outlive the reader.
class PngReader {
 public:
  explicit PngReader(std::string_view bytes);
  ~PngReader();
  PngReader(PngReader&&) noexcept;
  PngReader& operator=(PngReader&&) noexcept;

  bool ReadHeader(int max_side_px);
  PngHeader header() const;

  // What ReadPixels() shall deliver; otherwise the samples as they are in the file.
  void RequestBgr();            // 8 bits, three channels; alpha is dropped
  void RequestHostByteOrder();  // of 16-bit samples

  // Fills height rows that lie stride bytes apart, then checks the rest of the file.
  bool ReadPixels(unsigned char* pixels, std::size_t stride);

  const std::string& problem() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Encodes one PNG into memory. The same pixels give the same bytes with the same zlib.
class PngWriter {
 public:
  PngWriter();
  ~PngWriter();
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  // Pixels: grey (1 channel) or BGR (3 channels), 8 or 16 bits in host byte order.
  bool Encode(const PngHeader& header, const unsigned char* pixels, std::size_t stride,
              int compression);

  const std::string& bytes() const;
  const std::string& problem() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cslam
