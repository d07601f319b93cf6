#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/chip/stm32/interrupts.hpp"
#include "hal/chip/stm32/otg_fs_control.hpp"
#include "hal/chip/stm32/otg_fs_core.hpp"
#include "hal/contract/byte_link.hpp"

/// USB full speed as a ByteLink. `Function` answers requests at the control endpoint
/// (hal/chip/usb/cdc_acm.hpp); this class moves packets between the bulk endpoints and two rings.
/// Connected: a host program has the port open (configured, DTR set, bus awake).
///
/// The host gets NAK while the ring is full, so no byte sent while connected is lost. A loss drops
/// the queued bytes; received bytes are read first.
///
/// The board calls on_interrupt() from OTG_FS's vector; cancelling a transfer there may take a
/// fraction of a millisecond. Every wait ends: a stuck transfer loses its bytes and is counted.
namespace verp::hal::stm32 {

/// `Timer` is a TickTimer.
template <Io Access, class Function, class Timer, std::size_t kRing = 1024>
class OtgFs final : public ByteLink {
 public:
  OtgFs(Family family, Function& function, Timer& timer, Access io = {})
      : io_(io), core_(family, io), control_(core_, function), function_(function), timer_(timer) {}

  /// 48 MHz within 0.25 %, the bus clock `hclk_hz` and pins are on. Takes the 25 ms in which the
  /// core becomes a device. False: it did not.
  bool open(std::uint32_t hclk_hz, bool sense_vbus) {
    if (otg_fs::turnaround(hclk_hz) == 0 || !core_.reset()) return false;
    core_.force_device(hclk_hz);
    const std::uint64_t end_us = timer_.now_us() + otg_fs::kForceModeTime_ms * 1000;
    while (timer_.now_us() < end_us) timer_.doze_until(end_us, [] { return false; });
    if (!core_.is_device()) return false;
    core_.set_up(sense_vbus, kInterrupts);
    core_.connect();
    return true;
  }

  // ByteLink
  std::size_t write(const std::uint8_t* data, std::size_t size, std::uint32_t timeout_us) override {
    const std::uint64_t deadline_us = timer_.now_us() + timeout_us;
    std::size_t queued = 0;
    for (bool lost = false;;) {
      lost = see_loss() || lost;
      if (!lost) see_host();  // the call that saw a loss must not see the reconnection
      queued += queue(data + queued, size - queued);
      if (queued == size || timer_.now_us() >= deadline_us) return queued;
      timer_.doze_until(deadline_us, [&] {
        return lost_ || (connected_ ? queued_ - sent_ < kRing : up_ && !lost);
      });
    }
  }
  std::size_t read(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) override {
    const std::uint64_t deadline_us = timer_.now_us() + timeout_us;
    for (;;) {
      const std::size_t count = take(buffer, capacity);
      if (count > 0 || see_loss()) return count;
      see_host();
      if (timer_.now_us() >= deadline_us) return 0;
      timer_.doze_until(deadline_us,
                        [&] { return received_ != taken_ || lost_ || up_ != connected_; });
    }
  }
  bool connected() const override { return connected_; }
  LinkErrors errors() const override {
    const Masked<Access> masked(io_);
    return {.overruns = overruns_, .framing = function_.breaks(), .noise = 0, .losses = losses_};
  }

  void on_interrupt() {
    const std::uint32_t status = core_.pending();
    const std::uint32_t before = moved_;
    core_.clear(status);
    if ((status & otg_fs::kGintRxflvl) != 0) fetch();
    // The next suspend needs 3 ms of silence.
    if ((status & otg_fs::kGintUsbsusp) != 0) suspended_ = true;
    if ((status & otg_fs::kGintWkup) != 0) suspended_ = false;
    if ((status & otg_fs::kGintOtg) != 0 && (core_.take_otg() & otg_fs::kGotgintSedet) != 0) {
      function_.reset();
    }
    if ((status & otg_fs::kGintUsbrst) != 0) start_over();
    if ((status & otg_fs::kGintIep) != 0) serve_in();
    if ((status & otg_fs::kGintOep) != 0) serve_out();
    follow_host();
    watch_storm(moved_ == before ? core_.pending() & status : 0);
  }

  /// Register bits that did not change in time.
  std::uint32_t stuck() const { return core_.stuck(); }

 private:
  static constexpr std::uint32_t kInterrupts =
      otg_fs::kGintUsbrst | otg_fs::kGintUsbsusp | otg_fs::kGintWkup | otg_fs::kGintOtg |
      otg_fs::kGintRxflvl | otg_fs::kGintIep | otg_fs::kGintOep;
  static constexpr std::uint32_t kPacket = OtgFsCore<Access>::kPacket;
  static constexpr unsigned kData = 1;           ///< number of both bulk endpoints
  static constexpr std::uint32_t kStorm = 1000;  ///< interrupts in a row that no handler cleared
  static_assert((kRing & (kRing - 1)) == 0 && kRing >= 2 * kPacket, "the counters wrap at 2^32");

  // Called by the interrupt.

  /// Fetches packets; bounded by the FIFO's size in case its flag is stuck.
  void fetch() {
    for (std::uint32_t i = 0; i < otg_fs::kFifoWords; ++i) {
      const auto arrival = core_.arrival();
      if (arrival.what == 0) return;
      fetch(arrival);
    }
  }
  void fetch(const typename OtgFsCore<Access>::Arrival& arrival) {
    if (arrival.what == otg_fs::kPacketSetup) {
      control_.fetch_setup(arrival.size);
    } else if (arrival.what == otg_fs::kPacketOut && arrival.endpoint == 0) {
      control_.fetch_data(arrival.size);
    } else if (arrival.what == otg_fs::kPacketOut) {
      core_.take(arrival.size, [this](std::uint8_t byte) { store(byte); });
    } else if (arrival.what != otg_fs::kPacketSetupDone && arrival.what != otg_fs::kPacketOutDone) {
      return;
    }
    suspended_ = false;
    ++moved_;
  }
  void store(std::uint8_t byte) {
    if (received_ - taken_ == kRing) {
      ++overruns_;
      return;
    }
    ring_[received_++ % kRing] = byte;
  }

  void start_over() {
    function_.reset();
    control_.start_over();
    core_.start_over();
    suspended_ = false;
  }

  void serve_in() {
    if (control_.serve_in()) ++moved_;
    if (core_.take_in(kData) == 0) return;
    ++moved_;
    sending_ = false;
    pump();
  }
  void serve_out() {
    if (control_.serve_out()) {
      ++moved_;
      follow_host();
      pump();  // an endpoint may be free
    }
    if (core_.take_out(kData) == 0) return;
    ++moved_;
    expecting_ = false;
    listen();
  }

  void follow_host() {
    const bool up = function_.opened() && !suspended_;
    if (up == up_) return;
    up_ = up;
    if (up) return listen();
    lost_ = true;
    lost_at_ = received_;
    sent_ = queued_;
    full_ = false;
    if (sending_) core_.cancel_send(kData);
    sending_ = false;
    expecting_ = false;  // listen() must not request a packet twice
  }

  // Also called by read() and write() with interrupts masked.

  /// Allows the next packet if there is room.
  void listen() {
    if (!up_ || expecting_ || kRing - (received_ - taken_) < kPacket) return;
    expecting_ = true;
    core_.expect(kData);
  }
  /// Sends the next packet. An empty packet marks the end after a full one.
  void pump() {
    const std::uint32_t waiting = queued_ - sent_;
    if (!up_ || sending_ || (waiting == 0 && !full_)) return;
    const std::uint32_t size = waiting < kPacket ? waiting : kPacket;
    const std::uint32_t from = sent_;
    sending_ =
        core_.send(kData, size, [&](std::uint32_t i) { return outbox_[(from + i) % kRing]; });
    if (!sending_) return;
    sent_ += size;
    full_ = size == kPacket;
  }

  void watch_storm(std::uint32_t left) {
    storm_ = left != 0 ? storm_ + 1 : 0;
    if (storm_ < kStorm) return;
    // A flag that never clears would block the processor.
    core_.ignore(left);
    core_.count_stuck();
    storm_ = 0;
  }

  // Called by read() and write().

  std::size_t take(std::uint8_t* buffer, std::size_t capacity) {
    std::size_t count = arrived();
    if (count > capacity) count = capacity;
    for (std::size_t i = 0; i < count; ++i) buffer[i] = ring_[(taken_ + i) % kRing];
    const Masked<Access> masked(io_);
    taken_ += static_cast<std::uint32_t>(count);
    listen();
    return count;
  }
  std::uint32_t arrived() {
    const Masked<Access> masked(io_);
    return (lost_ ? lost_at_ : received_) - taken_;
  }
  std::size_t queue(const std::uint8_t* data, std::size_t size) {
    const Masked<Access> masked(io_);
    if (!connected_ || !up_ || lost_) return 0;
    std::size_t count = 0;
    for (; count < size && queued_ - sent_ < kRing; ++count) {
      outbox_[queued_++ % kRing] = data[count];
    }
    pump();
    return count;
  }
  bool see_loss() {
    const Masked<Access> masked(io_);
    const bool seen = lost_ && connected_;  // else the caller never saw that connection
    lost_ = false;
    if (!seen) return false;
    connected_ = false;
    ++losses_;
    return true;
  }
  void see_host() {
    const Masked<Access> masked(io_);
    connected_ = up_ && !lost_;
  }

  [[no_unique_address]] mutable Access io_;
  OtgFsCore<Access> core_;
  OtgFsControl<Access, Function> control_;
  Function& function_;
  Timer& timer_;
  bool suspended_ = false;
  bool up_ = false;
  bool connected_ = false;  ///< `up_` as the caller saw it
  bool lost_ = false;       ///< a loss that the caller has not seen
  bool sending_ = false;
  bool full_ = false;  ///< the last packet was full and the end is not marked
  bool expecting_ = false;
  std::uint32_t lost_at_ = 0;
  std::uint32_t losses_ = 0;
  std::uint32_t overruns_ = 0;
  std::uint32_t moved_ = 0;  ///< packets and stages; no interrupt storm while it grows
  std::uint32_t storm_ = 0;
  std::uint32_t received_ = 0;  ///< bytes since open(), like the next three
  std::uint32_t taken_ = 0;
  std::uint32_t queued_ = 0;
  std::uint32_t sent_ = 0;
  std::uint8_t ring_[kRing];
  std::uint8_t outbox_[kRing];
};

}  // namespace verp::hal::stm32
