// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/orb_kernels.h"

#include "cslam/util/check.h"
#include "cslam/vision/orb_simd.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#if CSLAM_HAS_AVX2
#include <immintrin.h>
#endif

namespace cslam::orb {
namespace {

using Byte = std::uint8_t;
using Word = std::uint16_t;

CSLAM_KERNEL void BlendRows(const Byte* top, const Byte* bottom, int weight, int count,
                            Byte* __restrict out) {
  const auto w1 = static_cast<Word>(weight);
  const auto w0 = static_cast<Word>(128 - weight);
  for (int x = 0; x < count; ++x) {
    out[x] = static_cast<Byte>(static_cast<Word>(top[x] * w0 + bottom[x] * w1 + 64) >> 7);
  }
}

CSLAM_TARGET_AVX2 void BlendRowsAvx2(const Byte* top, const Byte* bottom, int weight, int count,
                                     Byte* __restrict out) {
  BlendRows(top, bottom, weight, count, out);
}

// 32 pixels; where registers are narrower the compiler splits it.
using Pixels = Byte __attribute__((vector_size(32)));
constexpr int kLanes = 32;

CSLAM_KERNEL void Lower(Pixels& a, const Pixels& b) {
  a = a < b ? a : b;
}
CSLAM_KERNEL void Raise(Pixels& a, const Pixels& b) {
  a = a > b ? a : b;
}

// The scores of kLanes pixels from `center` on. `step` is the distance of two rows.
CSLAM_KERNEL void FastScoreGroup(const Byte* center, std::ptrdiff_t step, Byte threshold,
                                 Byte* out) {
  const std::array<std::ptrdiff_t, 16> ring = {
      -3 * step,     -3 * step + 1, -2 * step + 2, -step + 3,    3,        step + 3, 2 * step + 2,
      3 * step + 1,  3 * step,      3 * step - 1,  2 * step - 2, step - 3, -3,       -step - 3,
      -2 * step - 2, -3 * step - 1};
  std::array<Pixels, 16> p;
#pragma GCC unroll 16
  for (std::size_t i = 0; i < 16; ++i)
    std::memcpy(&p[i], center + ring[i], sizeof(Pixels));
  // Extremes of the 4 pixels from 2 k + 1 on. The arcs of 9 that start at 2 k and 2 k + 1 share
  // the 8 pixels from 2 k + 1 on.
  std::array<Pixels, 8> low4, high4;
#pragma GCC unroll 8
  for (std::size_t k = 0; k < 8; ++k) {
    low4[k] = high4[k] = p[2 * k + 1];
#pragma GCC unroll 3
    for (std::size_t i = 2; i < 5; ++i) {
      Lower(low4[k], p[(2 * k + i) % 16]);
      Raise(high4[k], p[(2 * k + i) % 16]);
    }
  }
  Pixels bright = {};
  Pixels dark = ~bright;
#pragma GCC unroll 8
  for (std::size_t k = 0; k < 8; ++k) {
    const Pixels& first = p[2 * k];
    const Pixels& last = p[(2 * k + 9) % 16];
    Pixels low9 = first;
    Raise(low9, last);
    Lower(low9, low4[k]);
    Lower(low9, low4[(k + 2) % 8]);
    Raise(bright, low9);
    Pixels high9 = first;
    Lower(high9, last);
    Raise(high9, high4[k]);
    Raise(high9, high4[(k + 2) % 8]);
    Lower(dark, high9);
  }
  Pixels c;
  std::memcpy(&c, center, sizeof(c));
  Raise(bright, c);
  Lower(dark, c);
  Pixels score = bright - c;
  Raise(score, c - dark);
  score = score > threshold ? score : Pixels{};
  std::memcpy(out, &score, sizeof(score));
}

// The last group may overlap the one before.
CSLAM_KERNEL void FastScoreRow(const Byte* center, std::ptrdiff_t step, int count, Byte threshold,
                               Byte* out) {
  for (int x = 0; x < count; x += kLanes) {
    const int start = std::min(x, count - kLanes);
    FastScoreGroup(center + start, step, threshold, out + start);
  }
}

CSLAM_TARGET_AVX2 void FastScoreRowAvx2(const Byte* center, std::ptrdiff_t step, int count,
                                        Byte threshold, Byte* out) {
  FastScoreRow(center, step, count, threshold, out);
}

// The mean of two bytes, rounded up, as processors have it in one instruction.
CSLAM_KERNEL Byte Mean(Byte a, Byte b) {
  return static_cast<Byte>((a + b + 1) >> 1);
}

// [1 2 1] / 4 down and across. Reads one more on either side of `count` pixels; `columns` has
// room for count + 2.
CSLAM_KERNEL void SmoothRow(const Byte* s, std::ptrdiff_t step, int count, Byte* __restrict columns,
                            Byte* __restrict out) {
  const Byte* left = s - 1;
  for (int x = 0; x < count + 2; ++x) {
    columns[x] = Mean(Mean(left[x - step], left[x + step]), left[x]);
  }
  for (int x = 0; x < count; ++x) {
    out[x] = Mean(Mean(columns[x], columns[x + 2]), columns[x + 1]);
  }
}

CSLAM_TARGET_AVX2 void SmoothRowAvx2(const Byte* s, std::ptrdiff_t step, int count,
                                     Byte* __restrict columns, Byte* __restrict out) {
  SmoothRow(s, step, count, columns, out);
}

CSLAM_KERNEL void SuppressRow(const Byte* s, std::ptrdiff_t step, int count, Byte* __restrict out) {
  const Byte* above = s - step;
  const Byte* below = s + step;
  for (int x = 0; x < count; ++x) {
    const Byte before =
        std::max(std::max(above[x - 1], above[x]), std::max(above[x + 1], s[x - 1]));
    const Byte after = std::max(std::max(below[x - 1], below[x]), std::max(below[x + 1], s[x + 1]));
    // s > after and s >= before, in one comparison of bytes each.
    const Byte kept = s[x] > after ? s[x] : Byte{0};
    out[x] = kept >= before ? kept : Byte{0};
  }
}

CSLAM_TARGET_AVX2 void SuppressRowAvx2(const Byte* s, std::ptrdiff_t step, int count,
                                       Byte* __restrict out) {
  SuppressRow(s, step, count, out);
}

// 16 * 16 * 255 + 128 fits 16 bits, so nothing is rounded before the end.
CSLAM_KERNEL void BlurRow(const Byte* center, std::ptrdiff_t step, int width, Word* __restrict sums,
                          Byte* __restrict out) {
  for (int x = 0; x < width; ++x) {
    const int outer = center[x - 3 * step] + center[x + 3 * step];
    const int middle = center[x - 2 * step] + center[x + 2 * step];
    const int inner = center[x - step] + center[x + step];
    sums[x] = static_cast<Word>(outer + inner + 2 * (middle + inner + 2 * center[x]));
  }
  for (int x = 3; x < width - 3; ++x) {
    const auto outer = static_cast<Word>(sums[x - 3] + sums[x + 3]);
    const auto middle = static_cast<Word>(sums[x - 2] + sums[x + 2]);
    const auto inner = static_cast<Word>(sums[x - 1] + sums[x + 1]);
    const auto sum = static_cast<Word>(outer + inner + 2 * (middle + inner + 2 * sums[x]) + 128);
    out[x] = static_cast<Byte>(sum >> 8);
  }
}

CSLAM_TARGET_AVX2 void BlurRowAvx2(const Byte* center, std::ptrdiff_t step, int width,
                                   Word* __restrict sums, Byte* __restrict out) {
  BlurRow(center, step, width, sums, out);
}

constexpr int kPatchWidth = 32;  // 31 used

// masks[y][x]: all ones inside the disc, row y + kPatchRadius, column x + kPatchRadius.
using DiscMasks = std::array<std::array<Word, kPatchWidth>, 2 * kPatchRadius + 1>;

constexpr DiscMasks MakeDiscMasks() {
  DiscMasks masks{};
  for (int y = -kPatchRadius; y <= kPatchRadius; ++y) {
    for (int x = -kPatchRadius; x <= kPatchRadius; ++x) {
      // The half pixel makes the disc round; it is symmetric under quarter turns and mirroring.
      const bool inside = 4 * (x * x + y * y) <= (2 * kPatchRadius + 1) * (2 * kPatchRadius + 1);
      masks[static_cast<std::size_t>(y + kPatchRadius)]
           [static_cast<std::size_t>(x + kPatchRadius)] = inside ? 0xFFFF : 0;
    }
  }
  return masks;
}

constexpr DiscMasks kDiscMasks = MakeDiscMasks();

// 16-bit sums per column suffice: 31 * 255 and (1 + ... + 15) * 255 are below 2^15.
CSLAM_KERNEL Moments PatchMoments(const Byte* corner, std::ptrdiff_t step) {
  std::array<std::int16_t, kPatchWidth> sums{};
  std::array<std::int16_t, kPatchWidth> sums_y{};
  for (int y = -kPatchRadius; y <= kPatchRadius; ++y) {
    const auto& mask = kDiscMasks[static_cast<std::size_t>(y + kPatchRadius)];
    const Byte* row = corner + y * step - kPatchRadius;
    for (std::size_t x = 0; x < kPatchWidth; ++x) {
      const auto value = static_cast<std::int16_t>(row[x] & mask[x]);
      sums[x] = static_cast<std::int16_t>(sums[x] + value);
      sums_y[x] = static_cast<std::int16_t>(sums_y[x] + value * y);
    }
  }
  Moments moments;
  for (std::size_t x = 0; x < kPatchWidth; ++x) {
    moments.x += (static_cast<int>(x) - kPatchRadius) * sums[x];
    moments.y += sums_y[x];
  }
  return moments;
}

CSLAM_TARGET_AVX2 Moments PatchMomentsAvx2(const Byte* corner, std::ptrdiff_t step) {
  return PatchMoments(corner, step);
}

#if CSLAM_HAS_AVX2
// 16 outputs at once: a shuffle makes pairs of neighbours, a multiply-add blends them.
// shuffles and weights hold 32 bytes for each 16 outputs, starts two source columns.
CSLAM_TARGET_AVX2 void BlendColumnsAvx2(const Byte* row, const int* starts, const Byte* shuffles,
                                        const Byte* weights, int groups, Byte* out) {
  const __m256i half = _mm256_set1_epi16(64);
  for (int g = 0; g < groups; ++g) {
    const __m128i low = _mm_loadu_si128(reinterpret_cast<const __m128i*>(row + starts[2 * g]));
    const __m128i high = _mm_loadu_si128(reinterpret_cast<const __m128i*>(row + starts[2 * g + 1]));
    const __m256i shuffle = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(shuffles + 32 * g));
    const __m256i weight = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(weights + 32 * g));
    const __m256i pairs = _mm256_shuffle_epi8(_mm256_set_m128i(high, low), shuffle);
    const __m256i blend =
        _mm256_srli_epi16(_mm256_add_epi16(_mm256_maddubs_epi16(pairs, weight), half), 7);
    const __m128i bytes =
        _mm_packus_epi16(_mm256_castsi256_si128(blend), _mm256_extracti128_si256(blend, 1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out + 16 * g), bytes);
  }
}
#endif

}  // namespace

std::vector<Downscaler::Tap> Downscaler::Taps(int from, int to) {
  std::vector<Tap> taps;
  const double ratio = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    const double position = std::clamp((i + 0.5) * ratio - 0.5, 0.0, from - 1.0);
    const int index = std::min(static_cast<int>(position), from - 2);
    const long weight = std::lround(128.0 * (position - index));
    taps.push_back({index, static_cast<Byte>(std::clamp(weight, 1L, 127L))});
  }
  return taps;
}

Downscaler::Downscaler(cv::Size from, cv::Size to)
    : from_(from),
      to_(to),
      rows_(Taps(from.height, to.height)),
      columns_(Taps(from.width, to.width)) {
  CSLAM_CHECK(from.width >= to.width && from.height >= to.height && to.width > 1 && to.height > 1);
  row_.resize(static_cast<std::size_t>(from.width) + kPadding);
  fits_shuffle_ = true;
  for (std::size_t x = 0; x < columns_.size(); ++x) {
    const std::size_t first = x / 8 * 8;
    const int offset = columns_[x].index - columns_[first].index;
    fits_shuffle_ = fits_shuffle_ && offset < 15;
    if (x == first) starts_.push_back(columns_[x].index);
    shuffles_.insert(shuffles_.end(), {static_cast<Byte>(offset), static_cast<Byte>(offset + 1)});
    weights_.insert(weights_.end(),
                    {static_cast<Byte>(128 - columns_[x].weight), columns_[x].weight});
  }
}

void Downscaler::Run(const cv::Mat& image, Simd simd, cv::Mat& smaller) {
  CSLAM_CHECK(image.size() == from_ && image.type() == CV_8UC1);
  smaller.create(to_, CV_8UC1);
  const auto blend_rows = simd == Simd::kAvx2 ? BlendRowsAvx2 : BlendRows;
  const int groups = simd == Simd::kAvx2 && fits_shuffle_ ? to_.width / 16 : 0;
  for (int y = 0; y < to_.height; ++y) {
    const Tap& tap = rows_[static_cast<std::size_t>(y)];
    blend_rows(image.ptr<Byte>(tap.index), image.ptr<Byte>(tap.index + 1), tap.weight, from_.width,
               row_.data());
    auto* out = smaller.ptr<Byte>(y);
#if CSLAM_HAS_AVX2
    BlendColumnsAvx2(row_.data(), starts_.data(), shuffles_.data(), weights_.data(), groups, out);
#endif
    for (int x = 16 * groups; x < to_.width; ++x) {
      const Tap& column = columns_[static_cast<std::size_t>(x)];
      const Byte* pair = row_.data() + column.index;
      out[x] =
          static_cast<Byte>((pair[0] * (128 - column.weight) + pair[1] * column.weight + 64) >> 7);
    }
  }
}

void FastScores(const cv::Mat& image, int threshold, Simd simd, cv::Mat& scores) {
  constexpr int kMargin = kBorder - 2;
  scores.create(image.size(), CV_8UC1);
  const auto score_row = simd == Simd::kAvx2 ? FastScoreRowAvx2 : FastScoreRow;
  const auto step = static_cast<std::ptrdiff_t>(image.step[0]);
  for (int y = kMargin; y < image.rows - kMargin; ++y) {
    score_row(image.ptr<Byte>(y) + kMargin, step, image.cols - 2 * kMargin,
              static_cast<Byte>(threshold), scores.ptr<Byte>(y) + kMargin);
  }
}

void SmoothScores(const cv::Mat& scores, Simd simd, cv::Mat& smoothed) {
  constexpr int kMargin = kBorder - 1;
  smoothed.create(scores.size(), CV_8UC1);
  std::vector<Byte> columns(static_cast<std::size_t>(scores.cols));
  const auto smooth_row = simd == Simd::kAvx2 ? SmoothRowAvx2 : SmoothRow;
  const auto step = static_cast<std::ptrdiff_t>(scores.step[0]);
  for (int y = kMargin; y < scores.rows - kMargin; ++y) {
    smooth_row(scores.ptr<Byte>(y) + kMargin, step, scores.cols - 2 * kMargin, columns.data(),
               smoothed.ptr<Byte>(y) + kMargin);
  }
}

std::vector<Candidate> LocalMaxima(const cv::Mat& scores, const cv::Mat& smoothed, Simd simd) {
  std::vector<Candidate> maxima;
  const int count = scores.cols - 2 * kBorder;
  std::vector<Byte> kept((static_cast<std::size_t>(count) + 7) / 8 * 8);
  const auto suppress_row = simd == Simd::kAvx2 ? SuppressRowAvx2 : SuppressRow;
  const auto step = static_cast<std::ptrdiff_t>(smoothed.step[0]);
  for (int y = kBorder; y < scores.rows - kBorder; ++y) {
    suppress_row(smoothed.ptr<Byte>(y) + kBorder, step, count, kept.data());
    const Byte* row = scores.ptr<Byte>(y) + kBorder;
    for (std::size_t x8 = 0; x8 < kept.size(); x8 += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, kept.data() + x8, 8);
      if (word == 0) continue;
      for (std::size_t x = x8; x < x8 + 8; ++x) {
        if (kept[x] == 0 || row[x] == 0) continue;
        maxima.push_back(
            {static_cast<std::int16_t>(x + kBorder), static_cast<std::int16_t>(y), row[x]});
      }
    }
  }
  return maxima;
}

void Blur(const cv::Mat& image, Simd simd, cv::Mat& blurred) {
  blurred.create(image.size(), CV_8UC1);
  std::vector<Word> sums(static_cast<std::size_t>(image.cols));
  const auto blur_row = simd == Simd::kAvx2 ? BlurRowAvx2 : BlurRow;
  const auto step = static_cast<std::ptrdiff_t>(image.step[0]);
  for (int y = 3; y < image.rows - 3; ++y) {
    blur_row(image.ptr<Byte>(y), step, image.cols, sums.data(), blurred.ptr<Byte>(y));
  }
}

Moments DiscMoments(const cv::Mat& image, int x, int y, Simd simd) {
  const auto step = static_cast<std::ptrdiff_t>(image.step[0]);
  const Byte* corner = image.ptr<Byte>(y) + x;
  return simd == Simd::kAvx2 ? PatchMomentsAvx2(corner, step) : PatchMoments(corner, step);
}

}  // namespace cslam::orb
