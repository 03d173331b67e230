// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/place_index.h"

#include "cslam/util/check.h"
#include "cslam/util/options.h"
#include "cslam/util/random.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace cslam {
namespace {

constexpr std::size_t kDescriptorBits = 256;
constexpr std::size_t kSignatureBits = 64;
constexpr std::size_t kAlwaysRead = 500;  // postings; a small map is one place, whose keys repeat

bool BitOf(const Descriptor& descriptor, std::size_t bit) {
  return ((descriptor.words[bit / 64] >> (bit % 64)) & 1U) != 0;
}

// The same shuffle everywhere, so that a saved map finds the same places again.
std::array<std::uint8_t, kDescriptorBits> ShuffledBits() {
  std::array<std::uint8_t, kDescriptorBits> bits{};
  std::iota(bits.begin(), bits.end(), std::uint8_t{0});
  Rng rng(0x706C616365ULL);
  for (std::size_t i = bits.size() - 1; i > 0; --i)
    std::swap(bits[i], bits[rng.Index(i + 1)]);
  return bits;
}

}  // namespace

void Describe(OptionList& list, PlaceIndexOptions& o) {
  list.Add("num_tables", o.num_tables, {1, 12}, "",
           "Hash tables a descriptor is filed in: more find more, at the cost of memory and time.");
  list.Add("key_bits", o.key_bits, {6, 16}, "bits",
           "Bits of a table's key: more make queries faster and miss more.");
  list.Add(
      "max_signature_distance", o.max_signature_distance, {0, 32}, "bits",
      "Descriptors with the same key are taken for neighbours if at most so many of 64 further "
      "bits differ.");
  list.Add("max_key_share", o.max_key_share, {0.001, 1000.0}, "",
           "Keys that occur more often than in this share of the keyframes are skipped: corners of "
           "pictures cluster, and what is everywhere costs time and tells nothing.");
}

PlaceIndex::PlaceIndex(const PlaceIndexOptions& options) : options_(options) {
  const auto num_key_bits = static_cast<std::size_t>(options.num_tables * options.key_bits);
  CSLAM_CHECK(options.key_bits <= 16 && num_key_bits + kSignatureBits <= kDescriptorBits,
              "{} tables of {} bits", options.num_tables, options.key_bits);
  const auto bits = ShuffledBits();
  std::copy_n(bits.begin(), kSignatureBits, signature_bits_.begin());
  key_bits_.assign(bits.begin() + kSignatureBits,
                   bits.begin() + static_cast<std::ptrdiff_t>(kSignatureBits + num_key_bits));
  buckets_.resize(static_cast<std::size_t>(options.num_tables) << options.key_bits);
}

std::uint64_t PlaceIndex::SignatureOf(const Descriptor& descriptor) const {
  std::uint64_t signature = 0;
  for (const std::uint8_t bit : signature_bits_)
    signature = (signature << 1U) | (BitOf(descriptor, bit) ? 1U : 0U);
  return signature;
}

std::uint16_t PlaceIndex::KeyOf(const Descriptor& descriptor, std::size_t table) const {
  const auto width = static_cast<std::size_t>(options_.key_bits);
  std::uint32_t key = 0;
  for (std::size_t i = table * width; i < (table + 1) * width; ++i)
    key = (key << 1U) | (BitOf(descriptor, key_bits_[i]) ? 1U : 0U);
  return static_cast<std::uint16_t>(key);
}

PlaceIndex::Bucket& PlaceIndex::BucketOf(std::size_t table, std::uint16_t key) {
  return buckets_[(table << options_.key_bits) + key];
}

const PlaceIndex::Bucket& PlaceIndex::BucketOf(std::size_t table, std::uint16_t key) const {
  return buckets_[(table << options_.key_bits) + key];
}

bool PlaceIndex::Contains(KeyframeId keyframe) const {
  return keyframe.index() < entries_.size() && entries_[keyframe.index()].is_in;
}

void PlaceIndex::Add(KeyframeId keyframe, std::span<const Descriptor> descriptors) {
  CSLAM_CHECK(keyframe.valid());
  Remove(keyframe);
  if (keyframe.index() >= entries_.size()) entries_.resize(keyframe.index() + 1);
  Entry& entry = entries_[keyframe.index()];
  entry.is_in = true;
  entry.num_descriptors = static_cast<std::int32_t>(descriptors.size());
  const auto num_tables = static_cast<std::size_t>(options_.num_tables);
  entry.keys.reserve(descriptors.size() * num_tables);
  for (const Descriptor& descriptor : descriptors) {
    const std::uint64_t signature = SignatureOf(descriptor);
    const Posting posting{
        {static_cast<std::uint32_t>(signature), static_cast<std::uint32_t>(signature >> 32U)},
        keyframe.value()};
    for (std::size_t table = 0; table < num_tables; ++table) {
      entry.keys.push_back(KeyOf(descriptor, table));
      Bucket& bucket = BucketOf(table, entry.keys.back());
      // By a quarter instead of twice: there are many buckets, and what they reserve adds up.
      if (bucket.size() == bucket.capacity()) bucket.reserve(bucket.size() + bucket.size() / 4 + 2);
      bucket.push_back(posting);
    }
  }
  ++num_keyframes_;
}

void PlaceIndex::Remove(KeyframeId keyframe) {
  if (!Contains(keyframe)) return;
  Entry& entry = entries_[keyframe.index()];
  for (std::size_t i = 0; i < entry.keys.size(); ++i) {
    const std::size_t table = i % static_cast<std::size_t>(options_.num_tables);
    std::erase_if(BucketOf(table, entry.keys[i]),
                  [&](const Posting& posting) { return posting.keyframe == keyframe.value(); });
  }
  entry = Entry{};
  --num_keyframes_;
}

std::size_t PlaceIndex::MemoryBytes() const {
  std::size_t bytes = buckets_.capacity() * sizeof(Bucket) + entries_.capacity() * sizeof(Entry);
  for (const Bucket& bucket : buckets_)
    bytes += bucket.capacity() * sizeof(Posting);
  for (const Entry& entry : entries_)
    bytes += entry.keys.capacity() * sizeof(std::uint16_t);
  return bytes;
}

std::vector<PlaceCandidate> PlaceIndex::Query(std::span<const Descriptor> descriptors,
                                              const std::function<bool(KeyframeId)>& is_excluded,
                                              std::size_t max_results) const {
  std::vector<PlaceCandidate> tally(entries_.size());
  std::vector<std::uint32_t> last_voter(entries_.size(), 0);
  std::vector<std::uint32_t> found;
  std::uint32_t voter = 0;
  const auto max_bucket = std::max(
      kAlwaysRead,
      static_cast<std::size_t>(options_.max_key_share * static_cast<double>(num_keyframes_)));
  for (const Descriptor& descriptor : descriptors) {
    ++voter;
    found.clear();
    const std::uint64_t signature = SignatureOf(descriptor);
    const auto low = static_cast<std::uint32_t>(signature);
    const auto high = static_cast<std::uint32_t>(signature >> 32U);
    for (std::size_t t = 0; t < static_cast<std::size_t>(options_.num_tables); ++t) {
      const Bucket& bucket = BucketOf(t, KeyOf(descriptor, t));
      if (bucket.size() > max_bucket) continue;
      for (const Posting& posting : bucket) {
        const int distance = std::popcount((std::uint64_t{posting.signature[1] ^ high} << 32U) |
                                           (posting.signature[0] ^ low));
        if (distance > options_.max_signature_distance) continue;
        if (last_voter[posting.keyframe] == voter) continue;
        last_voter[posting.keyframe] = voter;
        found.push_back(posting.keyframe);
      }
    }
    const double rarity =
        std::log(1.0 + static_cast<double>(num_keyframes_) /
                           static_cast<double>(std::max<std::size_t>(found.size(), 1)));
    for (const std::uint32_t keyframe : found) {
      tally[keyframe].score += rarity;
      ++tally[keyframe].votes;
    }
  }

  std::vector<PlaceCandidate> candidates;
  for (std::size_t i = 0; i < tally.size(); ++i) {
    if (tally[i].votes == 0) continue;
    const KeyframeId id(static_cast<std::uint32_t>(i));
    if (is_excluded && is_excluded(id)) continue;
    const double size = std::sqrt(static_cast<double>(entries_[i].num_descriptors));
    candidates.push_back({id, tally[i].score / size, tally[i].votes});
  }
  const auto last =
      candidates.begin() + static_cast<std::ptrdiff_t>(std::min(max_results, candidates.size()));
  std::partial_sort(candidates.begin(), last, candidates.end(), [](const auto& a, const auto& b) {
    return a.score != b.score ? a.score > b.score : a.keyframe < b.keyframe;
  });
  candidates.erase(last, candidates.end());
  return candidates;
}

std::vector<int> PlaceKeypoints(const FrameFeatures& features) {
  std::vector<int> keypoints;
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (features.semantics[i].label == KeypointLabel::kStatic) {
      keypoints.push_back(static_cast<int>(i));
    }
  }
  return keypoints;
}

std::vector<int> PlaceKeypoints(const MapView& map, const Keyframe& keyframe) {
  CSLAM_CHECK(keyframe.IsAlive(), "keyframe {} is culled", keyframe.id.value());
  std::vector<int> keypoints;
  for (const int i : PlaceKeypoints(keyframe.data->features)) {
    const PointId id = keyframe.points[static_cast<std::size_t>(i)];
    const MapPoint* point = id.valid() ? map.FindPoint(id) : nullptr;
    if (point != nullptr && IsUsable(*point)) keypoints.push_back(i);
  }
  return keypoints;
}

std::vector<Descriptor> SelectDescriptors(const FrameFeatures& features,
                                          std::span<const int> keypoints) {
  std::vector<Descriptor> descriptors;
  descriptors.reserve(keypoints.size());
  for (const int i : keypoints)
    descriptors.push_back(features.descriptors[static_cast<std::size_t>(i)]);
  return descriptors;
}

}  // namespace cslam
