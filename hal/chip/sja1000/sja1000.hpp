#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "common/base/can_frame.hpp"
#include "common/base/can_outbox.hpp"
#include "common/base/can_timing.hpp"
#include "hal/chip/sja1000/registers.hpp"
#include "hal/contract/can_bus.hpp"

/// The SJA1000 in PeliCAN mode as a CanBus.
///
/// The chip holds one frame to send and 64 bytes of received frames; the driver queues the rest.
/// on_interrupt() and every bus call move frames between chip and memory, so a board without
/// interrupts must only call often enough: before 64 bytes of frames arrive. A more urgent frame
/// replaces the chip's unless that is already being sent.
namespace verp::hal::sja1000 {

/// Access to chip and core:
///  - read8(offset), write8(offset, value);
///  - now_us(): microseconds, never decreasing;
///  - mask_interrupts(): true if they were enabled. unmask_interrupts() undoes it;
///  - doze_until(us): called with interrupts masked; returns when one is pending or the time has
///    come, perhaps earlier.
template <class Access>
concept Io = std::copyable<Access> &&
    requires(Access& io, std::uint32_t offset, std::uint8_t value, std::uint64_t us) {
  { io.read8(offset) } -> std::same_as<std::uint8_t>;
  { io.write8(offset, value) } -> std::same_as<void>;
  { io.now_us() } -> std::same_as<std::uint64_t>;
  { io.mask_interrupts() } -> std::same_as<bool>;
  { io.unmask_interrupts() } -> std::same_as<void>;
  { io.doze_until(us) } -> std::same_as<void>;
};

template <Io Access>
class Sja1000 final : public CanBus {
 public:
  static constexpr std::size_t kReceived = 64;  ///< frames that may wait for poll()

  explicit Sja1000(Access io) : io_(io) {}

  /// Check possible() at compile time.
  static constexpr CanTiming timing(std::uint32_t crystal_hz, std::uint32_t bit_rate_hz) {
    return can_timing(crystal_hz / kClockDivider, bit_rate_hz, kMostPrescaler);
  }

  /// Resets the chip and joins the bus. False: no SJA1000, or the timing is impossible.
  bool open(const CanTiming& timing) {
    if (!timing.possible()) return false;
    const Held held(io_);
    io_.write8(kMod, kModReset);
    if ((io_.read8(kMod) & kModReset) == 0) return false;
    io_.write8(kCdr, kPeliCan);
    io_.write8(kIer, 0);
    for (std::uint32_t i = 0; i < 4; ++i) {
      io_.write8(kAcceptance + i, 0);
      io_.write8(kMask + i, 0xFF);  // accepts all frames
    }
    // QEMU does not return the bit timing.
    if (io_.read8(kCdr) != kPeliCan || io_.read8(kMask) != 0xFF) return false;
    const auto btr0 = static_cast<std::uint8_t>((timing.jump - 1) << 6 | (timing.prescaler - 1));
    const auto btr1 = static_cast<std::uint8_t>((timing.after - 1) << 4 | (timing.before - 1));
    io_.write8(kBtr0, btr0);
    io_.write8(kBtr1, btr1);
    io_.write8(kOcr, kOcrPushPull);
    static_cast<void>(io_.read8(kIr));  // clears pending interrupts
    io_.write8(kIer, kIrReceive | kIrTransmit | kIrWarning | kIrOverrun | kIrBusError);
    io_.write8(kMod, 0);
    origin_us_ = io_.now_us();
    open_ = (io_.read8(kMod) & kModReset) == 0;
    return open_;
  }

  bool send(const CanFrame& frame) override {
    if (!open_ || !is_sound(frame) || frame.fd) return false;
    const Held held(io_);
    serve();
    if (off_ || queue_.size() == kCanQueue) return false;
    queue_.push(frame);
    serve();
    return true;
  }

  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    for (;;) {
      const Held held(io_);
      serve();
      if (take(frame)) return true;
      const std::uint64_t now_us = time_us();
      const std::uint64_t until_us = begun_us_ + timeout_us;
      if (now_us >= until_us) {
        if (now_us > now_us_) now_us_ = now_us;
        return false;
      }
      io_.doze_until(origin_us_ + until_us);
    }
  }

  std::uint64_t now_us() override { return now_us_; }
  CanErrors errors() const override { return errors_; }

  void on_interrupt() { serve(); }

 private:
  // Masks interrupts during its lifetime.
  class Held {
   public:
    explicit Held(Access& io) : io_(io), mine_(io.mask_interrupts()) {}
    ~Held() {
      if (mine_) io_.unmask_interrupts();
    }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;

   private:
    Access& io_;
    bool mine_;
  };
  static constexpr std::uint8_t kPeliCan = kCdrPeliCan | kCdrBypass | kCdrClockOff;

  struct Received {
    CanFrame frame;
    std::uint64_t time_us;
  };

  std::uint64_t time_us() { return io_.now_us() - origin_us_; }

  void serve() {
    const std::uint8_t why = io_.read8(kIr);
    if ((why & kIrBusError) != 0) {
      ++errors_.errors;
      static_cast<void>(io_.read8(kEcc));
    }
    std::uint8_t status = io_.read8(kSr);
    if ((status & kSrReceived) != 0) {
      const std::uint64_t now_us = time_us();
      do {
        receive(now_us);
        status = io_.read8(kSr);
      } while ((status & kSrReceived) != 0);
    }
    if ((status & kSrOverrun) != 0) {
      ++errors_.overruns;
      io_.write8(kCmr, kCmrClearOverrun);
    }
    follow_bus(status);
    if (!off_) transmit(status);
  }

  /// After 255 errors the chip enters reset mode; released, it waits for the bus as the standard
  /// requires.
  void follow_bus(std::uint8_t status) {
    const bool off = (status & kSrBusOff) != 0;
    if (off && !off_) {
      ++errors_.bus_offs;
      errors_.dropped += static_cast<std::uint32_t>(queue_.size()) + (in_chip_ ? 1u : 0u);
      queue_.clear();
      in_chip_ = false;
      aborting_ = false;
    }
    if (off && (io_.read8(kMod) & kModReset) != 0) io_.write8(kMod, 0);
    off_ = off;
  }

  void transmit(std::uint8_t status) {
    while ((status & kSrBufferFree) != 0) {
      if (in_chip_ && aborting_ && (status & kSrComplete) == 0) queue_.put_back(chip_);
      in_chip_ = false;
      aborting_ = false;
      if (queue_.empty()) return;
      chip_ = queue_.best();
      queue_.pop();
      load(chip_);
      begun_us_ = time_us();
      io_.write8(kCmr, kCmrTransmit);
      in_chip_ = true;
      status = io_.read8(kSr);
    }
    if (in_chip_ && !aborting_ && !queue_.empty() && can_rank(queue_.best()) < can_rank(chip_)) {
      io_.write8(kCmr, kCmrAbort);
      aborting_ = true;
    }
  }

  void load(const CanFrame& frame) {
    std::uint32_t at = kBuffer;
    io_.write8(at++, static_cast<std::uint8_t>((frame.extended ? kFrameExtended : 0) |
                                               (frame.remote ? kFrameRemote : 0) | frame.size));
    const std::uint32_t left = frame.extended ? frame.id << 3 : frame.id << 21;
    for (int shift = 24; shift >= (frame.extended ? 0 : 16); shift -= 8) {
      io_.write8(at++, static_cast<std::uint8_t>(left >> shift));
    }
    for (unsigned i = 0; i < frame.size && !frame.remote; ++i) io_.write8(at++, frame.data[i]);
  }

  void receive(std::uint64_t now_us) {
    CanFrame frame;
    const std::uint8_t first = io_.read8(kBuffer);
    frame.extended = (first & kFrameExtended) != 0;
    frame.remote = (first & kFrameRemote) != 0;
    const auto size = static_cast<std::uint8_t>(first & kFrameLength);
    frame.size = size < kMaxCanData ? size : kMaxCanData;  // a length code may be up to 15
    std::uint32_t at = kBuffer + 1;
    std::uint32_t left = 0;
    for (int shift = 24; shift >= (frame.extended ? 0 : 16); shift -= 8) {
      left |= static_cast<std::uint32_t>(io_.read8(at++)) << shift;
    }
    frame.id = frame.extended ? left >> 3 : left >> 21;
    for (unsigned i = 0; i < frame.size && !frame.remote; ++i) frame.data[i] = io_.read8(at++);
    io_.write8(kCmr, kCmrRelease);
    if (received_ == kReceived) {
      ++errors_.overruns;
      return;
    }
    ring_[(first_ + received_++) % kReceived] = {frame, now_us};
  }

  bool take(CanFrame& frame) {
    if (received_ == 0) return false;
    const Received& next = ring_[first_];
    frame = next.frame;
    if (next.time_us > now_us_) now_us_ = next.time_us;
    first_ = (first_ + 1) % kReceived;
    --received_;
    return true;
  }

  [[no_unique_address]] Access io_;
  CanOutbox<kCanQueue + 1> queue_;  ///< one extra, for a frame that the chip gives back
  CanFrame chip_;                   ///< the frame in the chip, if in_chip_
  Received ring_[kReceived] = {};
  std::size_t first_ = 0;
  std::size_t received_ = 0;
  bool open_ = false;
  bool in_chip_ = false;
  bool aborting_ = false;
  bool off_ = false;
  std::uint64_t origin_us_ = 0;
  std::uint64_t begun_us_ = 0;
  std::uint64_t now_us_ = 0;
  CanErrors errors_;
};

}  // namespace verp::hal::sja1000
