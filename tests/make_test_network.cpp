// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes a network that takes what is bright for people, with its description beside it:
//   cslam_make_test_network FILE.onnx
#include "cslam/semantics/test_network.h"

#include <filesystem>
#include <fstream>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path onnx = argv[1];
  std::filesystem::path yaml = onnx;
  yaml.replace_extension(".yaml");
  std::ofstream(onnx, std::ios::binary) << cslam::test::BrightnessNetwork(0);
  std::ofstream(yaml) << cslam::test::kBrightnessYaml << cslam::test::kBrightnessMean;
  return 0;
}
