#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "common/base/can_frame.hpp"
#include "common/base/can_outbox.hpp"
#include "common/base/can_timing.hpp"
#include "hal/chip/zynqmp_can/registers.hpp"
#include "hal/contract/can_bus.hpp"

/// A Zynq UltraScale+ CAN controller as a polled CanBus: send() and poll() move the frames. The
/// chip buffers 64 received frames. It gets one frame to send at a time, so that the most urgent
/// goes next; it cannot be taken back.
namespace verp::hal::zynqmp_can {

/// Access to the controller:
///  - read32(offset), write32(offset, value);
///  - now_us(): microseconds, never decreasing;
///  - doze_until(us): may sleep until that time or an interrupt; may return at once.
template <class Access>
concept Io = std::copyable<Access> && requires(Access& io, std::uint32_t word, std::uint64_t us) {
  { io.read32(word) } -> std::same_as<std::uint32_t>;
  { io.write32(word, word) } -> std::same_as<void>;
  { io.now_us() } -> std::same_as<std::uint64_t>;
  { io.doze_until(us) } -> std::same_as<void>;
};

/// Frame layout in the FIFOs.
enum class Layout : std::uint8_t {
  kSilicon,  ///< identifier as the wire arbitrates; first data byte highest
  /// QEMU 7.2: identifier as SocketCAN's can_id; first data byte lowest.
  kQemu,
};

template <Io Access, Layout kLayout = Layout::kSilicon>
class ZynqmpCan final : public CanBus {
 public:
  explicit ZynqmpCan(Access io) : io_(io) {}

  /// Check possible() at compile time.
  static constexpr CanTiming timing(std::uint32_t clock_hz, std::uint32_t bit_rate_hz) {
    return can_timing(clock_hz, bit_rate_hz, kMostPrescaler);
  }

  /// Resets the controller and joins the bus. False: no controller, or the timing is impossible.
  /// `bit_rate_hz` determines how long a bus-off lasts.
  bool open(const CanTiming& timing, std::uint32_t bit_rate_hz) {
    if (!timing.possible() || bit_rate_hz == 0) return false;
    timing_ = timing;
    bus_off_us_ = (kRecessiveBits * 1'000'000 + bit_rate_hz - 1) / bit_rate_hz;
    if (!configure()) return false;
    origin_us_ = io_.now_us();
    open_ = join();
    return open_;
  }

  bool send(const CanFrame& frame) override {
    if (!open_ || !is_sound(frame) || frame.fd) return false;
    follow_bus();
    if (off_ || queue_.size() == kCanQueue) return false;
    queue_.push(frame);
    transmit();
    return true;
  }

  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    for (;;) {
      follow_bus();
      if (receive(frame)) {
        advance(time_us());
        return true;
      }
      transmit();
      const std::uint64_t now_us = time_us();
      const std::uint64_t until_us = begun_us_ + timeout_us;
      if (now_us >= until_us) {
        advance(now_us);
        return false;
      }
      io_.doze_until(origin_us_ + until_us);
    }
  }

  std::uint64_t now_us() override { return now_us_; }
  CanErrors errors() const override { return errors_; }

 private:
  static constexpr std::uint64_t kRecessiveBits = 128 * 11;  ///< ISO 11898-1, 12.1.4.4
  static constexpr std::uint32_t kCanIdExtended = 1u << 31;  ///< linux/can.h, CAN_EFF_FLAG
  static constexpr std::uint32_t kCanIdRemote = 1u << 30;    ///< CAN_RTR_FLAG

  std::uint64_t time_us() { return io_.now_us() - origin_us_; }
  void advance(std::uint64_t now_us) {
    if (now_us > now_us_) now_us_ = now_us;
  }

  bool configure() {
    io_.write32(kSrr, kSrrReset);  // clears itself
    if ((io_.read32(kSr) & kSrConfig) == 0) return false;
    io_.write32(kMsr, 0);
    io_.write32(kBrpr, timing_.prescaler - 1);
    io_.write32(kBtr, (timing_.jump - 1) << kBtrJumpShift | (timing_.after - 1) << kBtrAfterShift |
                          (timing_.before - 1));
    io_.write32(kAfr, 0);
    io_.write32(kIer, kIsrNotEmpty | kIsrSent | kIsrBusOff);
    return io_.read32(kBrpr) == timing_.prescaler - 1;
  }
  bool join() {
    io_.write32(kSrr, kSrrEnable);
    return (io_.read32(kSrr) & kSrrEnable) != 0;
  }

  /// After bus-off it resets the controller, which empties the FIFOs, and rejoins when the bus may
  /// have been silent as long as the standard requires.
  void follow_bus() {
    const std::uint32_t why = io_.read32(kIsr) & (kIsrError | kIsrOverrun | kIsrBusOff);
    if (why != 0) io_.write32(kIcr, why);
    if ((why & kIsrError) != 0) {
      ++errors_.errors;
      io_.write32(kEsr, io_.read32(kEsr));
    }
    if ((why & kIsrOverrun) != 0) ++errors_.overruns;
    if ((why & kIsrBusOff) != 0) {
      ++errors_.bus_offs;
      errors_.dropped += static_cast<std::uint32_t>(queue_.size()) + (in_chip_ ? 1u : 0u);
      queue_.clear();
      in_chip_ = false;
      off_ = true;
      off_until_us_ = time_us() + bus_off_us_;
      configure();
    }
    if (off_ && time_us() >= off_until_us_) off_ = !join();
  }

  void transmit() {
    if (in_chip_ && (io_.read32(kIsr) & kIsrSent) != 0) in_chip_ = false;
    while (!in_chip_ && !off_ && !queue_.empty()) {
      io_.write32(kIcr, kIsrSent);
      load(queue_.best());
      queue_.pop();
      begun_us_ = time_us();
      in_chip_ = (io_.read32(kIsr) & kIsrSent) == 0;
    }
  }

  void load(const CanFrame& frame) {
    std::uint32_t words[2] = {};
    for (unsigned i = 0; i < frame.size; ++i) {
      words[i / 4] |= static_cast<std::uint32_t>(frame.data[i]) << byte_shift(i);
    }
    io_.write32(kTxId, id_word(frame));
    io_.write32(kTxDlc, static_cast<std::uint32_t>(frame.size) << kDlcShift);
    io_.write32(kTxData1, words[0]);
    io_.write32(kTxData2, words[1]);
  }

  bool receive(CanFrame& frame) {
    if ((io_.read32(kIsr) & kIsrNotEmpty) == 0) return false;
    frame = named_by(io_.read32(kRxId));
    const std::uint32_t size = io_.read32(kRxDlc) >> kDlcShift;
    frame.size = static_cast<std::uint8_t>(size < kMaxCanData ? size : kMaxCanData);
    const std::uint32_t words[2] = {io_.read32(kRxData1), io_.read32(kRxData2)};
    for (unsigned i = 0; i < frame.size && !frame.remote; ++i) {
      frame.data[i] = static_cast<std::uint8_t>(words[i / 4] >> byte_shift(i));
    }
    io_.write32(kIcr, kIsrNotEmpty | kIsrReceived);  // set again while more wait
    return true;
  }

  static constexpr unsigned byte_shift(unsigned index) {
    const unsigned place = index % 4;
    return 8 * (kLayout == Layout::kSilicon ? 3 - place : place);
  }
  /// Silicon's word orders frames as the wire arbitrates.
  static constexpr std::uint32_t id_word(const CanFrame& frame) {
    if constexpr (kLayout == Layout::kSilicon) return can_rank(frame);
    return frame.id | (frame.extended ? kCanIdExtended : 0) | (frame.remote ? kCanIdRemote : 0);
  }
  static constexpr CanFrame named_by(std::uint32_t word) {
    CanFrame frame;
    if constexpr (kLayout == Layout::kSilicon) {
      frame.extended = (word & kIdExtended) != 0;
      frame.remote = (word & (frame.extended ? kIdRemoteExtended : kIdRemote)) != 0;
      frame.id = frame.extended ? (word >> 21) << 18 | (word >> 1 & 0x3FFFFu) : word >> 21;
    } else {
      frame.extended = (word & kCanIdExtended) != 0;
      frame.remote = (word & kCanIdRemote) != 0;
      frame.id = word & (frame.extended ? 0x1FFFFFFFu : 0x7FFu);
    }
    return frame;
  }

  [[no_unique_address]] Access io_;
  CanTiming timing_;
  CanOutbox<kCanQueue> queue_;
  bool open_ = false;
  bool in_chip_ = false;
  bool off_ = false;
  std::uint64_t bus_off_us_ = 0;
  std::uint64_t off_until_us_ = 0;
  std::uint64_t origin_us_ = 0;
  std::uint64_t begun_us_ = 0;
  std::uint64_t now_us_ = 0;
  CanErrors errors_;
};

}  // namespace verp::hal::zynqmp_can
