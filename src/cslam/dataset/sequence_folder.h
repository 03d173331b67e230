// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/render_record.h"
#include "cslam/util/stamp.h"

#include <filesystem>
#include <string>

namespace cslam {

enum class ExistingFolder {
  kRefuse,   // a folder that holds anything is an error
  kResume,   // goes on with an interrupted rendering of the same parameters; else as kRefuse
  kReplace,  // removes a rendered sequence, whatever its parameters; other files stay
};

constexpr char kRenderFile[] = "render.json";  // written first: this folder is a rendering
constexpr char kCameraFile[] = "camera.yaml";  // written last: the rendering is complete

// "rgb/1.033333.png"; kind: "rgb", "depth" or "instances".
std::string ImageName(std::string_view kind, Stamp stamp);

// Makes the folder ready for the frames of a rendering: its subfolders and render.json are there,
// nothing of another one is, and it does not look complete. Throws Error, before anything is
// changed, if the folder holds something else or (kResume) a rendering of other parameters.
void PrepareSequenceFolder(const std::filesystem::path& folder, const RenderRecord& record,
                           ExistingFolder existing);

// The same questions, without changing anything.
void CheckSequenceFolder(const std::filesystem::path& folder, const RenderRecord& record,
                         ExistingFolder existing);

// Whether all three images of a frame are there from first to last byte.
bool IsFrameComplete(const std::filesystem::path& folder, Stamp stamp);

// Size of these images.
double FrameBytes(const std::filesystem::path& folder, Stamp stamp);

}  // namespace cslam
