#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/frame_bus.hpp"

/// A FrameBus that plays a script: each exchange names the expected frame, the reply and its delay.
/// Also runs on a microcontroller. Frames take no time.
namespace verp::hal {

class ScriptedBus final : public FrameBus {
 public:
  /// `reply`, if not empty, arrives `delay_us` after `frame`. False: script full.
  bool expect(const std::uint8_t* frame, std::size_t frame_size, const std::uint8_t* reply,
              std::size_t reply_size, std::uint32_t delay_us) {
    if (exchanges_ == kExchanges || used_ + frame_size + reply_size > kBytes) return false;
    Exchange& exchange = script_[exchanges_++];
    exchange = {keep(frame, frame_size), frame_size, keep(reply, reply_size), reply_size, delay_us};
    return true;
  }
  /// Bytes that arrive at `time_us` in any case; call in time order.
  bool inject(const std::uint8_t* data, std::size_t size, std::uint64_t time_us) {
    if (used_ + size > kBytes || arrivals_ == kExchanges) return false;
    arrival_[arrivals_++] = {keep(data, size), size, 0, time_us};
    return true;
  }
  /// Most bytes in one poll; 1 delivers every reply in pieces.
  void set_piece(std::size_t bytes) { piece_ = bytes; }

  /// True if the whole script was played and no other frame was sent.
  bool finished() const { return mismatches_ == 0 && played_ == exchanges_; }
  std::size_t mismatches() const { return mismatches_; }

  bool send(const std::uint8_t* data, std::size_t size) override {
    if (size == 0 || size > kMaxFrameBytes) return false;
    sent_us_ = now_us_;
    if (played_ == exchanges_ || !same(script_[played_], data, size)) {
      ++mismatches_;
      return true;
    }
    const Exchange& exchange = script_[played_++];
    if (exchange.reply_size > 0 && arrivals_ < kExchanges) {
      arrival_[arrivals_++] = {exchange.reply, exchange.reply_size, 0, now_us_ + exchange.delay_us};
    }
    return true;
  }

  std::size_t poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) override {
    std::uint64_t deadline_us = sent_us_ + timeout_us;
    if (deadline_us < now_us_) deadline_us = now_us_;
    if (capacity > piece_) capacity = piece_;
    std::size_t count = 0;
    while (first_ < arrivals_ && arrival_[first_].time_us <= deadline_us && count < capacity) {
      Arrival& arrival = arrival_[first_];
      if (now_us_ < arrival.time_us) now_us_ = arrival.time_us;
      buffer[count++] = bytes_[arrival.start + arrival.taken++];
      if (arrival.taken == arrival.size) ++first_;
    }
    if (count == 0 && capacity > 0) now_us_ = deadline_us;
    return count;
  }

  std::uint64_t now_us() override { return now_us_; }

 private:
  static constexpr std::size_t kExchanges = 32;
  static constexpr std::size_t kBytes = 4096;
  static constexpr std::size_t kMaxFrameBytes = kMaxFrame;
  struct Exchange {
    std::size_t frame;
    std::size_t frame_size;
    std::size_t reply;
    std::size_t reply_size;
    std::uint32_t delay_us;
  };
  struct Arrival {
    std::size_t start;
    std::size_t size;
    std::size_t taken;
    std::uint64_t time_us;
  };

  std::size_t keep(const std::uint8_t* data, std::size_t size) {
    const std::size_t start = used_;
    for (std::size_t i = 0; i < size; ++i) bytes_[used_++] = data[i];
    return start;
  }
  bool same(const Exchange& exchange, const std::uint8_t* data, std::size_t size) const {
    if (exchange.frame_size != size) return false;
    for (std::size_t i = 0; i < size; ++i) {
      if (bytes_[exchange.frame + i] != data[i]) return false;
    }
    return true;
  }

  Exchange script_[kExchanges] = {};
  Arrival arrival_[kExchanges] = {};
  std::uint8_t bytes_[kBytes] = {};
  std::size_t used_ = 0;
  std::size_t exchanges_ = 0;
  std::size_t played_ = 0;
  std::size_t arrivals_ = 0;
  std::size_t first_ = 0;
  std::size_t mismatches_ = 0;
  std::size_t piece_ = kMaxFrameBytes;
  std::uint64_t now_us_ = 0;
  std::uint64_t sent_us_ = 0;
};

}  // namespace verp::hal
