#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>

#include "common/base/can_frame.hpp"

/// A bus at 1 Mbit/s between a controller's model and a far node played by the test. Frames take
/// the time of their bits without stuffing.
namespace verp::test {

class CanNode {
 public:
  virtual ~CanNode() = default;
  /// The next frame, or null.
  virtual const CanFrame* pending() const = 0;
  /// The frame cannot be withdrawn.
  virtual void begun() = 0;
  virtual void sent() = 0;    ///< sent and acknowledged
  virtual void failed() = 0;  ///< an error frame ended it
  virtual void heard(const CanFrame& frame) = 0;
};

class CanWire {
 public:
  static constexpr std::uint32_t kBitsBetween = 3;  ///< intermission

  explicit CanWire(CanNode& node) : node_(node) {}

  std::uint64_t now_us() const { return now_us_; }
  void far_send(const CanFrame& frame) { far_.push_back(frame); }
  bool far_take(CanFrame& frame) {
    if (heard_.empty()) return false;
    frame = heard_.front();
    heard_.pop_front();
    return true;
  }
  /// Another node occupies the bus until it is released.
  void hold(bool yes) { held_ = yes; }
  /// The next `frames` frames end in an error frame.
  void spoil(unsigned frames) { spoiled_ = frames; }
  bool idle() const { return !busy_ && far_.empty() && node_.pending() == nullptr; }

  void advance(std::uint64_t microseconds) {
    for (std::uint64_t i = 0; i < microseconds; ++i) {
      ++now_us_;
      if (busy_ && now_us_ >= end_us_) finish();
      if (!busy_ && !held_ && now_us_ >= end_us_ + kBitsBetween) begin();
    }
  }

  static std::uint32_t bits_of(const CanFrame& frame) {
    return (frame.extended ? 64u : 44u) + (frame.remote ? 0u : 8u * frame.size);
  }

 private:
  void begin() {
    const CanFrame* ours = node_.pending();
    if (ours == nullptr && far_.empty()) return;
    near_ = ours != nullptr && (far_.empty() || can_rank(*ours) < can_rank(far_.front()));
    frame_ = near_ ? *ours : far_.front();
    if (near_) node_.begun();
    busy_ = true;
    end_us_ = now_us_ + bits_of(frame_);
  }
  void finish() {
    busy_ = false;
    if (near_ && spoiled_ > 0) {
      --spoiled_;
      node_.failed();
    } else if (near_) {
      heard_.push_back(frame_);
      node_.sent();
    } else {
      far_.pop_front();
      node_.heard(frame_);
    }
  }

  CanNode& node_;
  std::deque<CanFrame> far_;
  std::deque<CanFrame> heard_;
  CanFrame frame_;
  bool busy_ = false;
  bool near_ = false;
  bool held_ = false;
  unsigned spoiled_ = 0;
  std::uint64_t now_us_ = 0;
  std::uint64_t end_us_ = 0;
};

class ErrorCounter {
 public:
  static constexpr unsigned kBusOff = 256, kPerError = 8;
  static constexpr std::uint64_t kRecovery_us = 128 * 11;

  bool error() { return (count_ += kPerError) >= kBusOff; }
  void good() { count_ -= count_ > 0 ? 1 : 0; }
  void clear() { count_ = 0; }

 private:
  unsigned count_ = 0;
};

}  // namespace verp::test
