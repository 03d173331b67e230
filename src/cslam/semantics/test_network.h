// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace cslam::test {

// The few pieces of the protobuf wire format that an ONNX file needs.
inline std::string Varint(std::uint64_t value) {
  std::string bytes;
  for (; value >= 0x80; value >>= 7)
    bytes += static_cast<char>(value | 0x80);
  return bytes + static_cast<char>(value);
}
inline std::string Number(int field, std::uint64_t value) {
  return Varint(static_cast<std::uint64_t>(field) << 3) + Varint(value);
}
inline std::string Bytes(int field, std::string_view content) {
  return Varint(static_cast<std::uint64_t>(field) << 3 | 2) + Varint(content.size()) +
         std::string(content);
}

inline std::string Integers(std::string_view name, const std::vector<int>& values) {
  constexpr int kIntegers = 7;
  std::string attribute = Bytes(1, name) + Number(20, kIntegers);
  for (const int value : values)
    attribute += Number(8, static_cast<std::uint64_t>(value));
  return Bytes(5, attribute);
}

inline std::string Tensor(std::string_view name, const std::vector<int>& shape,
                          const std::vector<float>& values) {
  std::string tensor;
  for (const int extent : shape)
    tensor += Number(1, static_cast<std::uint64_t>(extent));
  std::string raw(values.size() * sizeof(float), '\0');
  std::memcpy(raw.data(), values.data(), raw.size());
  return Bytes(5, tensor + Number(2, 1) + Bytes(8, name) + Bytes(9, raw));
}

inline std::string TensorInfo(std::string_view name, const std::vector<int>& shape) {
  std::string dimensions;
  for (const int extent : shape)
    dimensions += Bytes(1, Number(1, static_cast<std::uint64_t>(extent)));
  return Bytes(1, name) + Bytes(2, Bytes(1, Number(1, 1) + Bytes(2, dimensions)));
}

// The bytes of an ONNX network of one convolution of 8 x 8 px with stride 8 over three channels of
// size x size px. weights: one per output and input channel, the same for all 64 px.
inline std::string ConvolutionOnnx(int size, int num_outputs, const std::vector<float>& weights,
                                   const std::vector<float>& biases) {
  constexpr int kStride = 8;
  std::vector<float> kernel;
  for (const float weight : weights)
    kernel.insert(kernel.end(), kStride * kStride, weight);
  const std::string node = Bytes(1, "data") + Bytes(1, "w") + Bytes(1, "b") + Bytes(2, "out") +
                           Bytes(3, "conv") + Bytes(4, "Conv") +
                           Integers("kernel_shape", {kStride, kStride}) +
                           Integers("strides", {kStride, kStride});
  const int grid = size / kStride;
  const std::string graph =
      Bytes(1, node) + Bytes(2, "test") + Tensor("w", {num_outputs, 3, kStride, kStride}, kernel) +
      Tensor("b", {num_outputs}, biases) + Bytes(11, TensorInfo("data", {1, 3, size, size})) +
      Bytes(12, TensorInfo("out", {1, num_outputs, grid, grid}));
  return Number(1, 6) + Bytes(7, graph) + Bytes(8, Bytes(1, "") + Number(2, 11));
}

// Of kBrightnessSize px, in the layout of NanoDet-Plus: sees a person wherever one channel of an
// 8 x 8 cell is bright, one cell in size. With the mean 0 and the deviation 255, 64 px of
// brightness v give the logit 64 * v / 255 * 0.25 - 9.
constexpr int kBrightnessSize = 32;
inline std::string BrightnessNetwork(std::size_t channel) {
  constexpr int kNumChannels = 80 + 4 * 8;
  std::vector<float> weights(kNumChannels * 3, 0.0F);
  weights[channel] = 0.25F;
  std::vector<float> biases(kNumChannels, -20.0F);
  biases[0] = -9.0F;
  const std::array<std::size_t, 4> bins{0, 0, 1, 1};  // left, top, right, bottom in cells
  for (std::size_t side = 0; side < 4; ++side)
    biases[80 + side * 8 + bins[side]] = 20.0F;
  return ConvolutionOnnx(kBrightnessSize, kNumChannels, weights, biases);
}
constexpr const char* kBrightnessYaml =
    "decoder: nanodet-plus\nwidth: 32\nheight: 32\nstrides: \"8\"\n"
    "deviation: {first: 255, second: 255, third: 255}\n";
constexpr const char* kBrightnessMean = "mean: {first: 0, second: 0, third: 0}\n";

}  // namespace cslam::test
