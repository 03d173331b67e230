// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/atlas_io/keyframe_blobs.h"

#include "cslam/atlas_io/bytes.h"
#include "cslam/util/check.h"

#include <cmath>
#include <limits>

namespace cslam {
namespace {

constexpr std::size_t kDescriptorBytes = 32;
constexpr std::size_t kSemanticsBytes = 7;
constexpr float kMaxPixel = 1e6F;  // no image is larger, and cells are counted in int

void ExpectElements(std::string_view bytes, std::size_t num_elements, std::size_t element_bytes) {
  if (bytes.size() != num_elements * element_bytes) throw Error("a blob has a wrong length");
}

Eigen::Vector2f NextPixel(ByteReader& reader) {
  const float u = reader.Next<float>();
  const float v = reader.Next<float>();
  if (!(std::abs(u) < kMaxPixel && std::abs(v) < kMaxPixel)) throw Error("a keypoint is nowhere");
  return {u, v};
}

float NextFinite(ByteReader& reader) {
  const float value = reader.Next<float>();
  if (!std::isfinite(value)) throw Error("a keypoint is not finite");
  return value;
}

}  // namespace

std::string PackKeypoints(const std::vector<Keypoint>& keypoints) {
  ByteWriter writer(keypoints.size() * kKeypointBytes);
  for (const Keypoint& keypoint : keypoints) {
    CSLAM_CHECK(keypoint.octave >= 0 && keypoint.octave < 256);
    writer.Add(keypoint.uv_px.x());
    writer.Add(keypoint.uv_px.y());
    writer.Add(keypoint.raw_px.x());
    writer.Add(keypoint.raw_px.y());
    writer.Add(keypoint.depth_m);
    writer.Add(keypoint.disparity_px);
    writer.Add(keypoint.angle_rad);
    writer.Add(static_cast<std::uint8_t>(keypoint.octave));
  }
  return std::move(writer).Take();
}

std::vector<Keypoint> UnpackKeypoints(std::string_view bytes) {
  const std::size_t size = bytes.size() / kKeypointBytes;
  ExpectElements(bytes, size, kKeypointBytes);
  if (size > std::numeric_limits<std::uint16_t>::max()) throw Error("too many keypoints");
  ByteReader reader(bytes);
  std::vector<Keypoint> keypoints(size);
  for (Keypoint& keypoint : keypoints) {
    keypoint.uv_px = NextPixel(reader);
    keypoint.raw_px = NextPixel(reader);
    keypoint.depth_m = NextFinite(reader);
    keypoint.disparity_px = NextFinite(reader);
    keypoint.angle_rad = NextFinite(reader);
    keypoint.octave = reader.Next<std::uint8_t>();
  }
  return keypoints;
}

std::string PackDescriptors(const std::vector<Descriptor>& descriptors) {
  ByteWriter writer(descriptors.size() * kDescriptorBytes);
  for (const Descriptor& descriptor : descriptors) {
    for (const std::uint64_t word : descriptor.words)
      writer.Add(word);
  }
  return std::move(writer).Take();
}

std::vector<Descriptor> UnpackDescriptors(std::string_view bytes, std::size_t num_keypoints) {
  ExpectElements(bytes, num_keypoints, kDescriptorBytes);
  ByteReader reader(bytes);
  std::vector<Descriptor> descriptors(num_keypoints);
  for (Descriptor& descriptor : descriptors) {
    for (std::uint64_t& word : descriptor.words)
      word = reader.Next<std::uint64_t>();
  }
  return descriptors;
}

std::string PackSemantics(const std::vector<KeypointSemantics>& semantics) {
  ByteWriter writer(semantics.size() * kSemanticsBytes);
  for (const KeypointSemantics& s : semantics) {
    writer.Add(static_cast<std::uint8_t>(s.label));
    writer.Add(s.class_id);
    writer.Add(s.track.value());
  }
  return std::move(writer).Take();
}

std::vector<KeypointSemantics> UnpackSemantics(std::string_view bytes, std::size_t num_keypoints) {
  ExpectElements(bytes, num_keypoints, kSemanticsBytes);
  ByteReader reader(bytes);
  std::vector<KeypointSemantics> semantics(num_keypoints);
  for (KeypointSemantics& s : semantics) {
    const auto label = reader.Next<std::uint8_t>();
    if (label > static_cast<std::uint8_t>(KeypointLabel::kDynamic)) {
      throw Error("a keypoint has label {}, which is none", label);
    }
    s.label = static_cast<KeypointLabel>(label);
    s.class_id = reader.Next<std::int16_t>();
    s.track = TrackId(reader.Next<std::uint32_t>());
  }
  return semantics;
}

std::string PackPoints(const std::vector<PointId>& points) {
  ByteWriter writer(points.size() * sizeof(std::uint32_t));
  for (const PointId point : points)
    writer.Add(point.value());
  return std::move(writer).Take();
}

std::vector<PointId> UnpackPoints(std::string_view bytes, std::size_t num_keypoints) {
  ExpectElements(bytes, num_keypoints, sizeof(std::uint32_t));
  ByteReader reader(bytes);
  std::vector<PointId> points(num_keypoints);
  for (PointId& point : points)
    point = PointId(reader.Next<std::uint32_t>());
  return points;
}

std::string PackImage(const cv::Mat& image) {
  std::string bytes;
  const std::size_t row_bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
  bytes.reserve(static_cast<std::size_t>(image.rows) * row_bytes);
  for (int v = 0; v < image.rows; ++v)
    bytes.append(image.ptr<char>(v), row_bytes);
  return bytes;
}

cv::Mat UnpackImage(std::string_view bytes, std::int64_t width_px, std::int64_t height_px,
                    int type) {
  constexpr std::int64_t kMaxSide = std::numeric_limits<std::uint16_t>::max();
  if (width_px < 0 || width_px > kMaxSide || height_px < 0 || height_px > kMaxSide) {
    throw Error("an image of {} x {} px", width_px, height_px);
  }
  const auto pixel_bytes = static_cast<std::size_t>(CV_ELEM_SIZE(type));
  ExpectElements(bytes, static_cast<std::size_t>(width_px * height_px), pixel_bytes);
  if (bytes.empty()) return {};
  cv::Mat image(static_cast<int>(height_px), static_cast<int>(width_px), type);
  std::memcpy(image.data, bytes.data(), bytes.size());
  return image;
}

}  // namespace cslam
