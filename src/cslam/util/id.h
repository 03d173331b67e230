// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

namespace cslam {

// A small integer that only compares with its own kind: a KeyframeId is not a PointId.
// Default-constructed ids are invalid. Ids are handed out from 0 upwards and never reused.
template <typename Tag>
class Id {
 public:
  constexpr Id() = default;
  explicit constexpr Id(std::uint32_t value) : value_(value) {}

  constexpr bool valid() const { return value_ != kInvalid; }
  constexpr std::uint32_t value() const { return value_; }
  constexpr std::size_t index() const { return value_; }
  constexpr auto operator<=>(const Id&) const = default;

 private:
  static constexpr std::uint32_t kInvalid = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t value_ = kInvalid;
};

using FrameId = Id<struct FrameTag>;        // one input image pair, counted from the first
using KeyframeId = Id<struct KeyframeTag>;  // a frame kept in the map
using PointId = Id<struct PointTag>;        // a map point
using MapId = Id<struct MapTag>;            // one connected map of the atlas
using TrackId = Id<struct TrackTag>;        // an object followed from frame to frame
using ObjectId = Id<struct ObjectTag>;      // an object of the map

}  // namespace cslam

template <typename Tag>
struct std::hash<cslam::Id<Tag>> {
  std::size_t operator()(cslam::Id<Tag> id) const noexcept { return id.value(); }
};
