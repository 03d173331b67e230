// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/dataset.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

// A colour and a depth image that belong together.
struct TumPair {
  Stamp color_stamp;
  std::filesystem::path color;
  Stamp depth_stamp;
  std::filesystem::path depth;
};

// What the lists of a TUM-layout folder say; no image has been opened.
struct TumIndex {
  std::filesystem::path folder;
  std::string source;          // which files told the pairs, for people
  std::vector<TumPair> pairs;  // colour stamps strictly increasing
  std::size_t num_unmatched_color = 0;
  std::size_t num_unmatched_depth = 0;
  std::size_t num_ignored_files = 0;  // images in rgb/ or depth/ whose name is no timestamp
  std::optional<std::filesystem::path> ground_truth;         // groundtruth.txt
  std::optional<std::filesystem::path> ground_truth_camera;  // groundtruth_camera.txt
};

// Whether folder has associations.txt, or for colour and for depth a list or a folder of images.
bool LooksLikeTum(const std::filesystem::path& folder);

// Pairs come from associations.txt, else from the nearest stamps within 0.02 s of rgb.txt (or the
// file names in rgb/) and depth.txt (or depth/). Throws Error with file:line for a broken line and
// for colour timestamps that repeat or decrease, and Error when nothing is left.
TumIndex ReadTumIndex(const std::filesystem::path& folder);

// One pair from disk. camera: the size both images must have, and the depth unit.
LoadResult LoadTumPair(const TumPair& pair, FrameId id, const CameraConfig& camera);

class TumDataset : public DatasetReader {
 public:
  // Plays the part of the index that options ask for. Throws Error if that part is empty.
  TumDataset(TumIndex index, CameraConfig camera, const DatasetOptions& options);

  std::size_t size() const override { return count_; }
  Stamp stamp(std::size_t index) const override;
  LoadResult Load(std::size_t index) const override;
  const CameraConfig& camera() const override { return camera_; }
  std::optional<std::filesystem::path> ground_truth() const override;
  const TumPair& pair(std::size_t index) const;

 private:
  TumIndex index_;
  CameraConfig camera_;
  std::size_t from_ = 0;
  std::size_t count_ = 0;
  bool is_strict_ = false;
};

}  // namespace cslam
