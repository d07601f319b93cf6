#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "hal/contract/byte_link.hpp"
#include "hal/contract/frame_bus.hpp"

namespace verp::app {

template <class Source>
concept Clock = requires(const Source& clock) {
  { clock.now_us() } -> std::same_as<std::uint64_t>;
};

/// A FrameBus over a byte stream to real devices, such as a serial port. Bus time is the clock's,
/// from construction. While the link is lost, polls wait out their timeout.
template <std::derived_from<hal::ByteLink> Link, Clock Source>
class LinkBus final : public hal::FrameBus {
 public:
  /// `held_us`: how long the link may delay bytes, both directions together; 0 for a wire.
  LinkBus(Link& link, const Source& clock, std::uint32_t held_us = 0)
      : link_(link), clock_(clock), opened_us_(clock.now_us()), held_us_(held_us) {}

  void set_held(std::uint32_t held_us) { held_us_ = held_us; }

  bool send(const std::uint8_t* data, std::size_t size) override {
    if (size == 0 || size > hal::kMaxFrame) return false;
    push();
    if (left_ > 0) return false;
    __builtin_memcpy(outbox_, data, size);
    sent_ = 0;
    left_ = size;
    sent_us_ = now_us();
    push();
    return true;
  }

  std::size_t poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) override {
    const std::uint64_t deadline_us = sent_us_ + timeout_us + held_us_;
    for (;;) {
      push();
      const std::uint64_t time_us = now_us();
      const std::uint64_t wait_us = time_us < deadline_us ? deadline_us - time_us : 0;
      // Retries while part of a frame has no room yet.
      const std::uint64_t most_us = left_ > 0 ? kPush_us : wait_us;
      const std::size_t count = link_.read(
          buffer, capacity, static_cast<std::uint32_t>(wait_us < most_us ? wait_us : most_us));
      if (count > 0 || now_us() >= deadline_us) return count;
    }
  }

  std::uint64_t now_us() override { return clock_.now_us() - opened_us_; }

 private:
  static constexpr std::uint64_t kPush_us = 1000;

  // Drops the rest of a frame that a loss cut in two: it would be noise.
  void push() {
    if (left_ == 0) return;
    const std::size_t count = link_.write(outbox_ + sent_, left_, 0);
    sent_ += count;
    left_ = link_.connected() ? left_ - count : 0;
  }

  Link& link_;
  const Source& clock_;
  std::uint64_t opened_us_;
  std::uint32_t held_us_;
  std::uint64_t sent_us_ = 0;
  std::size_t sent_ = 0;
  std::size_t left_ = 0;  ///< bytes of outbox_ not yet taken
  std::uint8_t outbox_[hal::kMaxFrame];
};

}  // namespace verp::app
