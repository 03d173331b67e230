// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/sequence_folder.h"

#include "cslam/util/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <system_error>
#include <vector>

namespace cslam {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kImageKinds{"rgb", "depth", "instances"};

// Beside the images and render.json, which goes last when a sequence is removed.
constexpr std::array<std::string_view, 11> kFiles{
    kCameraFile,        "rgb.txt",           "depth.txt",       "instances.txt",
    "associations.txt", "groundtruth.txt",   "detections.json", "objects.json",
    "changes.json",     "contact_sheet.png", "README.txt"};

// The end of every PNG file: the last chunk, which holds nothing.
constexpr std::string_view kPngEnd("\0\0\0\0IEND\xae\x42\x60\x82", 12);

bool IsWholePng(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(-static_cast<std::streamoff>(kPngEnd.size()), std::ios::end);
  std::array<char, kPngEnd.size()> end{};
  stream.read(end.data(), end.size());
  return stream && std::string_view(end.data(), end.size()) == kPngEnd;
}

void Remove(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw Error("cannot remove '{}': {}", file.string(), error.message());
}

// Half-written files of renderings that were killed.
bool IsTemporary(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::string_view meant = std::string_view(name).substr(0, name.find(".tmp-"));
  return meant.size() < name.size() && (meant == kRenderFile || meant.ends_with(".png") ||
                                        std::ranges::find(kFiles, meant) != kFiles.end());
}

template <typename Predicate>
void RemoveFiles(const fs::path& folder, const Predicate& is_ours) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file(error) && is_ours(entry.path())) files.push_back(entry.path());
  }
  std::ranges::for_each(files, Remove);
}

void RemoveSequence(const fs::path& folder) {
  for (const std::string_view file : kFiles)
    Remove(folder / file);
  for (const std::string_view kind : kImageKinds) {
    RemoveFiles(folder / kind, [](const fs::path& file) {
      return file.extension() == ".png" || IsTemporary(file);
    });
    std::error_code not_empty;
    fs::remove(folder / kind, not_empty);
  }
  RemoveFiles(folder, IsTemporary);
  Remove(folder / kRenderFile);
}

// Whether there is nothing at all; throws Error for what is no folder.
bool IsFree(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return true;
  if (!fs::is_directory(folder, error))
    throw Error("'{}' is not a folder; choose another name", folder.string());
  const bool is_empty = fs::is_empty(folder, error);
  if (error) throw Error("cannot look into '{}': {}", folder.string(), error.message());
  return is_empty;
}

}  // namespace

std::string ImageName(std::string_view kind, Stamp stamp) {
  return fmt::format("{}/{}.png", kind, FormatStamp(stamp));
}

void CheckSequenceFolder(const fs::path& folder, const RenderRecord& record,
                         ExistingFolder existing) {
  if (IsFree(folder)) return;
  std::error_code error;
  const bool is_rendering = fs::exists(folder / kRenderFile, error);
  if (existing == ExistingFolder::kRefuse) {
    throw Error("'{}' is not empty; choose another folder{}", folder.string(),
                is_rendering
                    ? ", or go on with the rendering in it (--resume) or replace it (--force)"
                    : "");
  }
  if (!is_rendering) {
    throw Error("'{}' holds files but no {}, so it is no rendered sequence; choose another folder",
                folder.string(), kRenderFile);
  }
  if (existing == ExistingFolder::kReplace) return;
  const auto differences = Differences(ReadRenderRecord(folder / kRenderFile), record);
  if (!differences.empty()) {
    throw Error("cannot go on with the rendering in '{}': {}; replace it with --force",
                folder.string(), fmt::join(differences, ", "));
  }
}

void PrepareSequenceFolder(const fs::path& folder, const RenderRecord& record,
                           ExistingFolder existing) {
  CheckSequenceFolder(folder, record, existing);
  if (!IsFree(folder)) {
    if (existing == ExistingFolder::kReplace) RemoveSequence(folder);
    RemoveFiles(folder, IsTemporary);
    Remove(folder / kCameraFile);
  }
  for (const std::string_view kind : kImageKinds) {
    std::error_code error;
    fs::create_directories(folder / kind, error);
    if (error) throw Error("cannot create '{}': {}", (folder / kind).string(), error.message());
    RemoveFiles(folder / kind, IsTemporary);
  }
  WriteRenderRecord(folder / kRenderFile, record);
}

bool IsFrameComplete(const fs::path& folder, Stamp stamp) {
  return std::ranges::all_of(kImageKinds, [&](std::string_view kind) {
    return IsWholePng(folder / ImageName(kind, stamp));
  });
}

double FrameBytes(const fs::path& folder, Stamp stamp) {
  double bytes = 0.0;
  for (const std::string_view kind : kImageKinds)
    bytes += static_cast<double>(fs::file_size(folder / ImageName(kind, stamp)));
  return bytes;
}

}  // namespace cslam
