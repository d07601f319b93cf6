#pragma once
#include <cstddef>
#include <cstdint>

#include "common/base/can_frame.hpp"

namespace verp {

/// Frames that wait for the wire, in order of arbitration; first in, first out for one identifier.
template <std::size_t kCapacity>
class CanOutbox {
 public:
  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == kCapacity; }
  std::size_t size() const { return size_; }

  /// False if the outbox is full.
  bool push(const CanFrame& frame) {
    if (full()) return false;
    frames_[size_++] = frame;
    return true;
  }

  /// The outbox must not be empty.
  const CanFrame& best() const { return frames_[best_index()]; }
  void pop() {
    const std::size_t gone = best_index();
    --size_;
    // Keeps the oldest of equal frames first.
    for (std::size_t i = gone; i < size_; ++i) frames_[i] = frames_[i + 1];
  }
  /// A frame that could not be sent goes ahead of others of its identifier. False if full.
  bool put_back(const CanFrame& frame) {
    if (full()) return false;
    for (std::size_t i = size_; i > 0; --i) frames_[i] = frames_[i - 1];
    frames_[0] = frame;
    ++size_;
    return true;
  }
  void clear() { size_ = 0; }

 private:
  std::size_t best_index() const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < size_; ++i) {
      if (can_rank(frames_[i]) < can_rank(frames_[best])) best = i;
    }
    return best;
  }

  CanFrame frames_[kCapacity];
  std::size_t size_ = 0;
};

}  // namespace verp
