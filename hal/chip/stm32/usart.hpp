#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/chip/stm32/gpio.hpp"
#include "hal/chip/stm32/interrupts.hpp"
#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/dma.hpp"
#include "hal/chip/stm32/usart_kind.hpp"
#include "hal/contract/byte_link.hpp"

/// A USART as a ByteLink. It receives by DMA into a ring, without a working stream by interrupt; an
/// idle line wakes the reader. It sends by interrupt. A direction pin makes the bus half-duplex:
/// high exactly while bytes leave, so the line is free for a servo's answer.
///
/// The board calls on_interrupt() from the USART's and the DMA stream's vectors, both of one
/// priority. No call waits for a flag: a stuck transfer loses its bytes and is counted.
namespace verp::hal::stm32 {

struct UsartWiring {
  std::uint32_t base = 0;
  std::uint32_t dma_base = 0;  ///< 0: no DMA
  std::uint8_t dma_stream = 0;
  std::uint8_t dma_channel = 0;
  Pin direction;  ///< high while sending; none: full duplex
};

/// `Timer` is a TickTimer.
template <Io Access, class Kind, class Timer, std::size_t kRing = 1024>
class Usart final : public ByteLink {
 public:
  Usart(const UsartWiring& wiring, Timer& timer, Access io = {})
      : io_(io), gpio_(io), wiring_(wiring), timer_(timer) {}

  /// Clocks and pins are on. False: no divider makes this baud rate.
  bool open(std::uint32_t clock_hz, std::uint32_t baud) {
    BaudSetting setting;
    if (!choose_baud(clock_hz, baud, setting)) return false;
    gpio_.output(wiring_.direction, false);
    write(Kind::kCr1, 0);
    write(Kind::kCr2, 0);
    write(Kind::kBrr, setting.brr);
    baud_ = baud;
    by_dma_ = start_dma();
    // Without DMA, errors come with their bytes.
    write(Kind::kCr3, by_dma_ ? usart_v1::kCr3Eie | usart_v1::kCr3Dmar : 0);
    write(Kind::kCr1, Kind::kEnable | usart_v1::kCr1Te | usart_v1::kCr1Re |
                          (setting.over8 ? usart_v1::kCr1Over8 : 0) |
                          (by_dma_ ? usart_v1::kCr1Idleie : usart_v1::kCr1Rxneie));
    return true;
  }

  // ByteLink
  std::size_t write(const std::uint8_t* data, std::size_t size, std::uint32_t timeout_us) override {
    const std::uint64_t deadline_us = timer_.now_us() + timeout_us;
    std::size_t queued = 0;
    for (;;) {
      queued += queue(data + queued, size - queued);
      if (queued == size || timer_.now_us() >= deadline_us) return queued;
      timer_.doze_until(deadline_us, [&] { return queued_ - sent_ < kRing; });
    }
  }
  std::size_t read(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) override {
    const std::uint64_t deadline_us = timer_.now_us() + timeout_us;
    for (;;) {
      free_stuck_line();
      const std::size_t count = take(buffer, capacity);
      if (count > 0 || timer_.now_us() >= deadline_us) return count;
      timer_.doze_until(deadline_us, [&] { return track(), received_ != taken_; });
    }
  }
  bool connected() const override { return true; }
  LinkErrors errors() const override {
    const Masked<Access> masked(io_);
    return errors_;
  }

  void on_interrupt() {
    const std::uint32_t status = service();
    const bool again =
        (status & (usart_flag::kErrors | usart_flag::kIdle)) != 0 && received_ == received_before_;
    received_before_ = received_;
    storm_ = again ? storm_ + 1 : 0;
    if (storm_ < kStorm) return;
    // A flag that never clears would block the processor.
    clear_bits(Kind::kCr1, usart_v1::kCr1Idleie);
    clear_bits(Kind::kCr3, usart_v1::kCr3Eie);
    ++stuck_;
    storm_ = 0;
  }

  bool receives_by_dma() const { return by_dma_; }
  /// Times a flag did not clear, or bytes did not leave in time.
  std::uint32_t stuck() const { return stuck_; }

 private:
  static constexpr std::uint32_t kStorm = 1000;         ///< interrupts in a row without a byte
  static constexpr std::uint64_t kSendSlack_us = 2000;  ///< late interrupts, QEMU's ticks
  static constexpr int kDmaPolls = 10'000;  ///< a stream stops after its current transfer
  static_assert((kRing & (kRing - 1)) == 0 && kRing <= 0x8000, "the counters wrap at 2^32");

  std::uint32_t read(std::uint32_t offset) { return io_.read32(wiring_.base + offset); }
  void write(std::uint32_t offset, std::uint32_t value) {
    io_.write32(wiring_.base + offset, value);
  }
  void set_bits(std::uint32_t offset, std::uint32_t mask) {
    modify32(io_, wiring_.base + offset, 0, mask);
  }
  void clear_bits(std::uint32_t offset, std::uint32_t mask) {
    modify32(io_, wiring_.base + offset, mask, 0);
  }
  std::uint32_t stream(std::uint32_t offset) const {
    return wiring_.dma_base + wiring_.dma_stream * dma::kStreamStep + offset;
  }

  bool start_dma() {
    if (wiring_.dma_base == 0) return false;
    modify32(io_, stream(dma::kCr), dma::kCrEn, 0);
    for (int poll = 0; (io_.read32(stream(dma::kCr)) & dma::kCrEn) != 0; ++poll) {
      if (poll == kDmaPolls) return false;
    }
    clear_dma_flags();
    io_.write32(stream(dma::kPar), wiring_.base + Kind::kReceive);
    io_.write32(stream(dma::kM0ar), io_.bus_address(ring_, sizeof ring_));
    io_.write32(stream(dma::kNdtr), kRing);
    io_.write32(stream(dma::kFcr), kFcrReset & ~dma::kFcrDmdis & ~dma::kFcrFeie);
    const std::uint32_t setting = std::uint32_t{wiring_.dma_channel} << dma::kCrChselShift |
                                  dma::kCrMinc | dma::kCrCirc | dma::kCrHtie | dma::kCrTcie |
                                  dma::kCrPl;
    io_.write32(stream(dma::kCr), setting);
    io_.write32(stream(dma::kCr), setting | dma::kCrEn);
    position_ = 0;
    return (io_.read32(stream(dma::kCr)) & dma::kCrEn) != 0;
  }
  void clear_dma_flags() {
    io_.write32(wiring_.dma_base + dma::clear_offset(wiring_.dma_stream),
                dma::kFlagAll << dma::flag_shift(wiring_.dma_stream));
  }

  /// Serves every interrupt source. Returns the status before.
  std::uint32_t service() {
    track();
    const std::uint32_t status = read(Kind::kStatus);
    if ((status & usart_flag::kOverrun) != 0) ++errors_.overruns;
    if ((status & usart_flag::kFraming) != 0) ++errors_.framing;
    if ((status & (usart_flag::kNoise | usart_flag::kParity)) != 0) ++errors_.noise;
    if (!by_dma_ && (status & usart_flag::kReceived) != 0) receive_byte();
    if ((status & (usart_flag::kErrors | usart_flag::kIdle)) != 0) {
      clear_flags(status);
    }
    if (by_dma_) clear_dma_flags();
    track();
    pump(status);
    return status;
  }
  /// Counts a byte that was read here and not by the DMA, unless it equals its neighbour.
  void clear_flags(std::uint32_t status) {
    const std::uint32_t before = received_;
    const int last = Kind::clear(io_, wiring_.base, status);
    track();
    const auto is_last = [&](std::uint32_t end) { return last == ring_[(end - 1) % kRing]; };
    if (!by_dma_ || last == kNoByte || lost_after_ == received_) return;
    if (is_last(before) || is_last(received_)) return;
    ++errors_.overruns;
    lost_after_ = received_;  // the register keeps that byte
  }
  // A full ring leaves the next byte in the USART: an emulator waits, real hardware sets its
  // overrun flag. QEMU lowers the interrupt when a byte is read, so the driver disables RXNEIE
  // before it reads the byte that fills the ring.
  void receive_byte() {
    if (received_ - taken_ == kRing) return;
    if (received_ - taken_ + 1 == kRing) clear_bits(Kind::kCr1, usart_v1::kCr1Rxneie);
    ring_[received_++ % kRing] = static_cast<std::uint8_t>(read(Kind::kReceive));
  }
  /// Counts the bytes that the DMA stored. Its interrupts call this at least twice per ring turn.
  void track() {
    if (!by_dma_) return;
    const std::uint32_t left = io_.read32(stream(dma::kNdtr)) & 0xFFFF;
    const auto position = static_cast<std::uint32_t>((kRing - left) % kRing);
    received_ += (position - position_) % kRing;
    position_ = position;
  }

  std::size_t take(std::uint8_t* buffer, std::size_t capacity) {
    const std::uint32_t end = refresh();
    std::size_t count = end - taken_;
    if (count > capacity) count = capacity;
    for (std::size_t i = 0; i < count; ++i) buffer[i] = ring_[(taken_ + i) % kRing];
    const Masked<Access> masked(io_);
    track();
    if (received_ - taken_ > kRing) {  // the DMA lapped the reader, perhaps during the copy
      ++errors_.overruns;
      taken_ = received_;
      return 0;
    }
    taken_ += static_cast<std::uint32_t>(count);
    if (!by_dma_ && count > 0) set_bits(Kind::kCr1, usart_v1::kCr1Rxneie);
    return count;
  }
  std::uint32_t refresh() {
    const Masked<Access> masked(io_);
    track();
    pump(read(Kind::kStatus));
    if (received_ - taken_ > kRing) {
      ++errors_.overruns;
      taken_ = received_;
    }
    return received_;
  }

  std::size_t queue(const std::uint8_t* data, std::size_t size) {
    const std::size_t room = kRing - (queued_ - sent_);  // interrupts add to it
    const std::size_t count = size < room ? size : room;
    for (std::size_t i = 0; i < count; ++i) outbox_[(queued_ + i) % kRing] = data[i];
    if (count == 0) return 0;
    const std::uint64_t now_us = timer_.now_us();
    const Masked<Access> masked(io_);
    queued_ += static_cast<std::uint32_t>(count);
    if (gone_us_ < now_us) gone_us_ = now_us;
    gone_us_ += std::uint64_t{count} * 10 * 1'000'000 / baud_ + 1;  // 10 bits a byte
    if (!sending_) gpio_.write(wiring_.direction, true);
    sending_ = true;
    pump(read(Kind::kStatus));
    return count;
  }
  /// Sends while there is room. After the last byte it enables the transmission-complete interrupt.
  void pump(std::uint32_t status) {
    if (!sending_) return;
    while (sent_ != queued_ && (status & usart_flag::kRoom) != 0) {
      write(Kind::kTransmit, outbox_[sent_++ % kRing]);
      status = read(Kind::kStatus);
    }
    if (sent_ != queued_) {
      set_bits(Kind::kCr1, usart_v1::kCr1Txeie);
    } else if ((status & usart_flag::kSent) != 0) {
      end_sending();
    } else {
      modify32(io_, wiring_.base + Kind::kCr1, usart_v1::kCr1Txeie, usart_v1::kCr1Tcie);
    }
  }
  void end_sending() {
    clear_bits(Kind::kCr1, usart_v1::kCr1Txeie | usart_v1::kCr1Tcie);
    gpio_.write(wiring_.direction, false);
    sending_ = false;
  }
  void free_stuck_line() {
    const Masked<Access> masked(io_);
    if (!sending_ || timer_.now_us() < gone_us_ + kSendSlack_us) return;
    pump(read(Kind::kStatus));
    if (!sending_) return;
    sent_ = queued_;
    end_sending();
    ++stuck_;
  }

  static constexpr std::uint32_t kFcrReset = 0x21;  ///< RM0090 10.5.10; FS is read-only

  [[no_unique_address]] mutable Access io_;
  Gpio<Access> gpio_;
  UsartWiring wiring_;
  Timer& timer_;
  LinkErrors errors_;
  std::uint32_t baud_ = 1;
  std::uint32_t stuck_ = 0;
  std::uint32_t storm_ = 0;
  std::uint32_t received_ = 0;  ///< bytes since open(), like the next five
  std::uint32_t received_before_ = 0;
  std::uint32_t lost_after_ = 0;
  std::uint32_t taken_ = 0;
  std::uint32_t queued_ = 0;
  std::uint32_t sent_ = 0;
  std::uint32_t position_ = 0;  ///< of the DMA in the ring
  std::uint64_t gone_us_ = 0;   ///< when all queued bytes should have left
  bool by_dma_ = false;
  bool sending_ = false;
  std::uint8_t ring_[kRing];
  std::uint8_t outbox_[kRing];
};

}  // namespace verp::hal::stm32
