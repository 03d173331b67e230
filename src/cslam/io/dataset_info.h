// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/tum_dataset.h"

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

// A pause between a frame and the next.
struct FrameGap {
  std::size_t frame = 0;  // index of the frame before it
  double length_s = 0.0;
};

// Pauses longer than this are worth a word: three frames of a 30 Hz camera.
inline constexpr double kLongGapS = 0.1;

std::vector<FrameGap> FindGaps(const std::vector<TumPair>& pairs, double longer_than_s = kLongGapS);

// At most count indices below total, evenly spread, the first and the last among them.
std::vector<std::size_t> EvenSample(std::size_t total, std::size_t count);

// What depth images of some frames hold, gathered one by one.
class DepthStatistics {
 public:
  void Add(const cv::Mat& depth_m);

  std::size_t num_frames() const { return shares_.size(); }
  double valid_share() const;  // mean share of pixels with a reading, 0 to 1; 0 without frames
  double median_m() const;     // of a regular sample of the readings; 0 if there are none
  // Whether the last frame added had no reading at all.
  bool is_last_empty() const { return !shares_.empty() && shares_.back() == 0.0; }

 private:
  std::vector<double> shares_;
  std::vector<float> sample_m_;
};

struct GroundTruthInfo {
  std::filesystem::path path;
  std::size_t num_poses = 0;
  std::size_t num_covered_frames = 0;  // frames with a pose within 0.02 s
  double path_length_m = 0.0;          // from covered frame to covered frame, as SLAM can see it
  std::string problem;                 // why the file cannot be used; empty if it can
};

GroundTruthInfo InspectGroundTruth(const std::filesystem::path& path,
                                   const std::vector<TumPair>& pairs);

// What `changing-slam dataset info` tells.
struct DatasetInfo {
  std::filesystem::path folder;
  std::string pair_source;
  std::size_t num_frames = 0;
  std::size_t num_unmatched_color = 0;
  std::size_t num_unmatched_depth = 0;
  Stamp first_stamp;
  double duration_s = 0.0;
  double rate_hz = 0.0;  // of the median interval; 0 for one frame
  std::vector<FrameGap> gaps;
  double mean_pair_difference_s = 0.0;  // between the stamps of colour and depth
  double max_pair_difference_s = 0.0;
  int width_px = 0;  // of the first colour image that can be read; 0 if none of the sample can
  int height_px = 0;
  std::string color_format;            // ".png", ".jpg": of the first file
  std::optional<CameraConfig> camera;  // absent if none is known
  std::string camera_problem;          // why
  std::optional<GroundTruthInfo> ground_truth;
  std::size_t num_sampled = 0;  // frames that were decoded for the lines below
  std::size_t num_unreadable = 0;
  std::string first_problem;
  double depth_valid_share = 0.0;
  double median_depth_m = 0.0;
};

// Reads the lists, the ground truth and num_samples frames. Throws Error if folder is no data set,
// its lists are broken, or choice or camera.yaml name no valid camera; not knowing a camera is
// fine.
DatasetInfo InspectDataset(const std::filesystem::path& folder, const CameraChoice& choice,
                           std::size_t num_samples);

// The camera to inspect a folder with: the one that run would use; where none is known, a stand-in
// of the images' own size, so that they can still be compared with each other.
struct InspectionCamera {
  CameraConfig config;
  bool is_known = false;
  std::string problem;  // why it is not
};
InspectionCamera FindInspectionCamera(const TumIndex& index, const CameraChoice& choice);

}  // namespace cslam
