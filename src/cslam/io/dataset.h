// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/camera_file.h"
#include "cslam/util/stamp.h"
#include "cslam/vision/rgbd_frame.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace cslam {

enum class FrameFault { kNone, kMissing, kUnreadable, kWrongSize };

// A frame, or why there is none.
struct LoadResult {
  std::optional<RgbdFrame> frame;
  FrameFault fault = FrameFault::kNone;
  std::string problem;  // one line with the path; empty if there is a frame
};

// Recorded RGB-D frames in order of time. Reading changes nothing, so any thread may load.
class DatasetReader {
 public:
  virtual ~DatasetReader() = default;

  virtual std::size_t size() const = 0;

  // Index: 0 to size() - 1; 0 is the frame --from asked for.
  virtual Stamp stamp(std::size_t index) const = 0;  // of the colour image

  // A frame that cannot be read is an expected result; in strict mode it throws Error.
  // The frame's id counts from the first frame of the whole recording, whatever --from says.
  virtual LoadResult Load(std::size_t index) const = 0;

  virtual const CameraConfig& camera() const = 0;

  // A TUM trajectory file, if there is one.
  virtual std::optional<std::filesystem::path> ground_truth() const = 0;
};

struct DatasetOptions {
  CameraChoice camera;
  std::size_t from = 0;               // index of the first frame to play
  std::optional<std::size_t> frames;  // how many to play at most; absent: all
  bool is_strict = false;             // a frame that cannot be read is an Error
};

// Throws Error if folder is not there, is a file, or has no layout we know: then with what was
// looked for.
void CheckIsDataset(const std::filesystem::path& folder);

// Opens the data set in folder, whatever its layout (so far: that of the TUM benchmark), and reads
// its first frame. Throws Error, among others, when there is no such folder, no known layout, no
// camera, a broken list, no readable frame, or images of another size than the camera's.
std::unique_ptr<DatasetReader> OpenDataset(const std::filesystem::path& folder,
                                           const DatasetOptions& options = {});

}  // namespace cslam
