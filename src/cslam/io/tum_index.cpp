// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/association.h"
#include "cslam/io/text_lines.h"
#include "cslam/io/tum_dataset.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

namespace cslam {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMaxDifferenceNs = 20'000'000;  // as the TUM tools

struct StampedFile {
  Stamp stamp;
  fs::path path;
};

struct ImageList {
  std::vector<StampedFile> files;  // stamps strictly increasing
  std::string source;
  std::size_t num_ignored_files = 0;
};

bool IsFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool IsFolder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

bool HasImages(const fs::path& folder, const std::string& kind) {
  return IsFile(folder / (kind + ".txt")) || IsFolder(folder / kind);
}

bool HasImageExtension(const fs::path& path) {
  constexpr std::array<std::string_view, 6> kExtensions{".png", ".jpg", ".jpeg",
                                                        ".PNG", ".JPG", ".JPEG"};
  return std::find(kExtensions.begin(), kExtensions.end(), path.extension().string()) !=
         kExtensions.end();
}

Stamp ParseStampAt(const std::string& text, const std::string& where) {
  const std::optional<Stamp> stamp = ParseStamp(text);
  if (!stamp) throw Error("{}: '{}' is not a timestamp in seconds", where, Excerpt(text));
  return *stamp;
}

// Refuses a colour or depth stamp that does not come after the one before it.
void CheckOrder(const fs::path& list, const TextLine& line, Stamp stamp,
                const TextLine& previous_line, Stamp previous) {
  if (stamp > previous) return;
  throw Error("{}:{}: timestamp {} {} line {}; sort the list and remove duplicates", list.string(),
              line.number, FormatStamp(stamp),
              stamp == previous ? "repeats that of" : "is earlier than that of",
              previous_line.number);
}

ImageList ReadImageList(const fs::path& folder, const std::string& kind) {
  const fs::path list = folder / (kind + ".txt");
  const std::vector<TextLine> lines = ReadTextLines(list);
  ImageList images{.files = {}, .source = list.filename().string()};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const TextLine& line = lines[i];
    const std::string where = fmt::format("{}:{}", list.string(), line.number);
    if (line.fields.size() != 2) {
      throw Error("{}: expected 'timestamp file', found {} field(s)", where, line.fields.size());
    }
    const Stamp stamp = ParseStampAt(line.fields[0], where);
    if (i > 0) CheckOrder(list, line, stamp, lines[i - 1], images.files.back().stamp);
    images.files.push_back({.stamp = stamp, .path = folder / line.fields[1]});
  }
  if (images.files.empty()) throw Error("'{}' names no image", list.string());
  return images;
}

ImageList ListImageFolder(const fs::path& folder, const std::string& kind) {
  ImageList images{.files = {}, .source = kind + "/"};
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / kind)) {
    if (!HasImageExtension(entry.path())) continue;
    if (const std::optional<Stamp> stamp = ParseStamp(entry.path().stem().string())) {
      images.files.push_back({.stamp = *stamp, .path = entry.path()});
    } else {
      ++images.num_ignored_files;
    }
  }
  std::sort(images.files.begin(), images.files.end(), [](const auto& a, const auto& b) {
    return std::pair(a.stamp, a.path.native()) < std::pair(b.stamp, b.path.native());
  });
  const auto twin =
      std::adjacent_find(images.files.begin(), images.files.end(),
                         [](const auto& a, const auto& b) { return a.stamp == b.stamp; });
  if (twin != images.files.end()) {
    throw Error("'{}' and '{}' have the same timestamp; remove one of them", twin->path.string(),
                std::next(twin)->path.filename().string());
  }
  if (images.files.empty()) {
    throw Error("'{}' has no PNG or JPEG image whose name is a timestamp",
                (folder / kind).string());
  }
  return images;
}

ImageList FindImages(const fs::path& folder, const std::string& kind) {
  return IsFile(folder / (kind + ".txt")) ? ReadImageList(folder, kind)
                                          : ListImageFolder(folder, kind);
}

std::vector<Stamp> StampsOf(const ImageList& images) {
  std::vector<Stamp> stamps;
  stamps.reserve(images.files.size());
  for (const StampedFile& file : images.files)
    stamps.push_back(file.stamp);
  return stamps;
}

TumIndex AssociateImages(const fs::path& folder) {
  const ImageList color = FindImages(folder, "rgb");
  const ImageList depth = FindImages(folder, "depth");
  const std::vector<StampPair> pairs =
      AssociateNearest(StampsOf(color), StampsOf(depth), kMaxDifferenceNs);
  if (pairs.empty()) {
    throw Error(
        "'{}': no colour image has a depth image within 0.02 s (colour starts at {}, depth at {})",
        folder.string(), FormatStamp(color.files[0].stamp), FormatStamp(depth.files[0].stamp));
  }
  TumIndex index;
  index.source = fmt::format("nearest stamps of {} and {}", color.source, depth.source);
  index.num_unmatched_color = color.files.size() - pairs.size();
  index.num_unmatched_depth = depth.files.size() - pairs.size();
  index.num_ignored_files = color.num_ignored_files + depth.num_ignored_files;
  for (const StampPair& pair : pairs) {
    const StampedFile& c = color.files[pair.first];
    const StampedFile& d = depth.files[pair.second];
    index.pairs.push_back({c.stamp, c.path, d.stamp, d.path});
  }
  return index;
}

// Some tools write the depth image first; the folder's name tells.
bool IsDepthFirst(const TextLine& line) {
  return line.fields[1].starts_with("depth/") && !line.fields[3].starts_with("depth/");
}

TumIndex ReadAssociations(const fs::path& folder) {
  const fs::path list = folder / "associations.txt";
  const std::vector<TextLine> lines = ReadTextLines(list);
  TumIndex index;
  index.source = list.filename().string();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const TextLine& line = lines[i];
    const std::string where = fmt::format("{}:{}", list.string(), line.number);
    if (line.fields.size() != 4) {
      throw Error("{}: expected 'timestamp colour-file timestamp depth-file', found {} field(s)",
                  where, line.fields.size());
    }
    TumPair pair{.color_stamp = ParseStampAt(line.fields[0], where),
                 .color = folder / line.fields[1],
                 .depth_stamp = ParseStampAt(line.fields[2], where),
                 .depth = folder / line.fields[3]};
    if (IsDepthFirst(line)) {
      std::swap(pair.color_stamp, pair.depth_stamp);
      std::swap(pair.color, pair.depth);
    }
    if (i > 0)
      CheckOrder(list, line, pair.color_stamp, lines[i - 1], index.pairs.back().color_stamp);
    index.pairs.push_back(std::move(pair));
  }
  if (index.pairs.empty()) throw Error("'{}' names no image pair", list.string());
  return index;
}

std::optional<fs::path> FileIfThere(const fs::path& path) {
  return IsFile(path) ? std::optional(path) : std::nullopt;
}

}  // namespace

bool LooksLikeTum(const fs::path& folder) {
  return IsFile(folder / "associations.txt") ||
         (HasImages(folder, "rgb") && HasImages(folder, "depth"));
}

TumIndex ReadTumIndex(const fs::path& folder) {
  TumIndex index =
      IsFile(folder / "associations.txt") ? ReadAssociations(folder) : AssociateImages(folder);
  index.folder = folder;
  index.ground_truth = FileIfThere(folder / "groundtruth.txt");
  index.ground_truth_camera = FileIfThere(folder / "groundtruth_camera.txt");
  return index;
}

}  // namespace cslam
