// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_view.h"
#include "cslam/vision/features.h"
#include "cslam/vision/frame_features.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace cslam {

class OptionList;

struct PlaceIndexOptions {
  int num_tables = 4;
  int key_bits = 14;
  int max_signature_distance = 8;
  double max_key_share = 0.25;
};
void Describe(OptionList& list, PlaceIndexOptions& options);

// A keyframe that looks like the query.
struct PlaceCandidate {
  KeyframeId keyframe;
  double score = 0.0;      // weighted votes over the root of the keyframe's size
  std::int32_t votes = 0;  // query features found in it
};

// Finds keyframes that show what a frame shows, without a vocabulary: descriptors are filed in
// several hash tables by different random bits of theirs (multi-index hashing), and 64 further bits
// tell true neighbours from those that only share a key (Hamming embedding). A descriptor votes
// for every keyframe that holds a neighbour of it, the more the fewer those are.
//
// Ready when constructed; results depend only on what it holds, not on the order it came in. A
// keyframe of 400 descriptors takes 24 KB; a query of 1000 at 10,000 keyframes 5 to 7 ms of CPU
// (bench/bench_place.cpp).
class PlaceIndex {
 public:
  explicit PlaceIndex(const PlaceIndexOptions& options = {});

  // A keyframe that is in already is replaced.
  void Add(KeyframeId keyframe, std::span<const Descriptor> descriptors);

  // Does nothing if the keyframe is not in.
  void Remove(KeyframeId keyframe);

  bool Contains(KeyframeId keyframe) const;
  std::size_t num_keyframes() const { return num_keyframes_; }
  std::size_t MemoryBytes() const;

  // Best first, equal ones by id. is_excluded may be empty.
  std::vector<PlaceCandidate> Query(std::span<const Descriptor> descriptors,
                                    const std::function<bool(KeyframeId)>& is_excluded,
                                    std::size_t max_results) const;

 private:
  struct Posting {
    std::array<std::uint32_t, 2> signature;
    std::uint32_t keyframe;
  };
  using Bucket = std::vector<Posting>;
  struct Entry {
    bool is_in = false;
    std::int32_t num_descriptors = 0;
    std::vector<std::uint16_t> keys;  // num_tables for each descriptor
  };

  std::uint64_t SignatureOf(const Descriptor& descriptor) const;
  std::uint16_t KeyOf(const Descriptor& descriptor, std::size_t table) const;
  Bucket& BucketOf(std::size_t table, std::uint16_t key);
  const Bucket& BucketOf(std::size_t table, std::uint16_t key) const;

  PlaceIndexOptions options_;
  std::vector<std::uint8_t> key_bits_;             // num_tables * key_bits positions
  std::array<std::uint8_t, 64> signature_bits_{};  // positions
  std::vector<Bucket> buckets_;                    // table by table
  std::vector<Entry> entries_;                     // by keyframe id
  std::size_t num_keyframes_ = 0;
};

// The features by which a place may be recognised: none of people, of things that may be moved, or
// of points that may not be used.
std::vector<int> PlaceKeypoints(const FrameFeatures& features);
std::vector<int> PlaceKeypoints(const MapView& map, const Keyframe& keyframe);  // with a map point

std::vector<Descriptor> SelectDescriptors(const FrameFeatures& features,
                                          std::span<const int> keypoints);

}  // namespace cslam
