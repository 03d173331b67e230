// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/check.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace cslam {

// A growing array whose copies cost one pointer per chunk. The owner edits its array, hands out
// immutable copies with Share(), and goes on editing: a chunk that a copy may still see is cloned
// on the first edit after Share(). Copies may be read and dropped by other threads freely.
template <typename T, std::size_t kChunkSize = 64>
class CowArray {
 public:
  std::size_t size() const { return size_; }

  const T& operator[](std::size_t index) const {
    return (*chunks_[index / kChunkSize])[index % kChunkSize];
  }

  // For the owner only.
  T& Edit(std::size_t index) {
    CSLAM_CHECK(index < size_, "index {} of {}", index, size_);
    const std::size_t c = index / kChunkSize;
    if (is_shared_[c] != 0) {
      chunks_[c] = std::make_shared<Chunk>(*chunks_[c]);
      is_shared_[c] = 0;
    }
    return (*chunks_[c])[index % kChunkSize];
  }

  // For the owner only.
  void PushBack(T value) {
    if (size_ % kChunkSize == 0) {
      chunks_.push_back(std::make_shared<Chunk>());
      chunks_.back()->reserve(kChunkSize);
      is_shared_.push_back(0);
    } else if (is_shared_.back() != 0) {
      auto clone = std::make_shared<Chunk>();
      clone->reserve(kChunkSize);
      clone->assign(chunks_.back()->begin(), chunks_.back()->end());
      chunks_.back() = std::move(clone);
      is_shared_.back() = 0;
    }
    chunks_.back()->push_back(std::move(value));
    ++size_;
  }

  // A copy that never changes, whatever the owner does afterwards.
  CowArray Share() {
    is_shared_.assign(is_shared_.size(), 1);
    return *this;
  }

 private:
  using Chunk = std::vector<T>;

  std::vector<std::shared_ptr<Chunk>> chunks_;
  std::vector<std::uint8_t> is_shared_;  // one per chunk: a copy may see it
  std::size_t size_ = 0;
};

}  // namespace cslam
