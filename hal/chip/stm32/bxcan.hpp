#pragma once
#include <cstddef>
#include <cstdint>

#include "common/base/can_outbox.hpp"
#include "hal/chip/stm32/bxcan_mailbox.hpp"
#include "hal/chip/stm32/bxcan_timing.hpp"
#include "hal/chip/stm32/interrupts.hpp"
#include "hal/contract/can_bus.hpp"

/// bxCAN as a CanBus. The three mailboxes hold the most urgent waiting frames, only one per
/// identifier, which keeps their order. Interrupts fetch and time-stamp received frames, late by
/// their latency.
///
/// The board calls on_interrupt() from all four vectors, all of one priority. open() requires the
/// crystal: the internal oscillator is too inaccurate for a bit of 1 us.
namespace verp::hal::stm32 {

/// Accepts identifiers that equal `id` in the bits of `mask`.
struct CanFilterRule {
  std::uint32_t id = 0;
  std::uint32_t mask = 0;
  bool extended = false;
};

/// CAN1 also holds CAN2's filters, so CAN1's clock must be on.
struct CanFilterBanks {
  std::uint32_t base = 0;  ///< bxCAN of the filters; 0: this one
  unsigned first = 0;
};
inline constexpr CanFilterBanks kCan2Filters = {.base = base::kCan1, .first = can::kCan2FirstBank};

template <Io Access, class Timer>
class BxCan final : public CanBus {
 public:
  static constexpr std::size_t kInbox = 64;
  static constexpr std::size_t kRules = 14;  ///< filter banks of each bxCAN

  BxCan(std::uint32_t base, Timer& timer, Access io = {}, CanFilterBanks banks = {})
      : io_(io), base_(base), banks_(banks), timer_(timer) {
    if (banks_.base == 0) banks_.base = base;
  }

  /// Clocks and pins are on. Without rules it accepts all frames. False: the clock does not fit,
  /// too many rules, or no answer.
  bool open(const Clocks& clocks, const BxCanTiming& timing, const CanFilterRule* rules = nullptr,
            std::size_t count = 0) {
    if (!clocks.good_enough_for_can() || timing.clock_hz != clocks.apb1_hz) return false;
    if (count > kRules || !initialise()) return false;
    bitrate_ = timing.bitrate;
    write(can::kBtr, timing.btr());
    set_filters(rules, count);
    write(can::kIer, can::kIerTmeie | can::kIerFmpie0 | can::kIerFovie0 | can::kIerBofie |
                         can::kIerLecie | can::kIerErrie);
    expect_next_error();
    opened_us_ = begun_us_ = timer_.now_us();
    // ABOM: rejoin after bus-off. RFLM: a full FIFO keeps its frames.
    write(can::kMcr, can::kMcrDbf | can::kMcrAbom | can::kMcrRflm);
    // bxCAN joins an idle bus; on one that is never idle, send() refuses frames.
    const std::uint64_t deadline_us = opened_us_ + kIdle_us;
    while (!on_bus() && timer_.now_us() < deadline_us) {
    }
    return true;
  }

  // CanBus
  bool send(const CanFrame& frame) override {
    const Masked<Access> masked(io_);
    stands_ = false;
    if (!is_sound(frame) || frame.fd || !on_bus() || outbox_.size() >= kCanQueue) return false;
    outbox_.push(frame);
    begins(timer_.stamp_us());
    pump();
    return true;
  }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    for (;;) {
      const std::uint64_t time_us = timer_.now_us();
      if (take(frame, time_us)) return true;
      const std::uint64_t deadline_us = last_begin_us(time_us) + timeout_us;
      if (time_us >= deadline_us) {
        stands_ = false;
        return false;
      }
      // A frame of ours meanwhile extends the deadline.
      timer_.doze_until(deadline_us, [this] { return arrived_ != taken_; });
    }
  }
  std::uint64_t now_us() override {
    const std::uint64_t time_us = timer_.now_us() - opened_us_;
    if (!stands_ && time_us > last_us_) last_us_ = time_us;
    return last_us_;
  }
  CanErrors errors() const override {
    const Masked<Access> masked(io_);
    return errors_;
  }

  void on_interrupt() {
    note_errors();
    finish_mailboxes();
    fetch();
    pump();
  }

  /// Times the peripheral did not react in time.
  std::uint32_t stuck() const { return stuck_; }

 private:
  // A request takes effect at the end of the frame on the wire: 160 bits at 10 kbit/s take 16 ms.
  static constexpr std::uint64_t kInitialise_us = 20'000;
  static constexpr std::uint64_t kIdle_us = 2000;
  static constexpr int kReleasePolls = 100;  // a few bus clocks

  struct Arrived {
    CanReceived received;  ///< a quarter of a CanFrame; decoded later
    std::uint32_t stamp_us;
  };

  std::uint32_t read(std::uint32_t offset) const { return io_.read32(base_ + offset); }
  void write(std::uint32_t offset, std::uint32_t value) { io_.write32(base_ + offset, value); }

  bool on_bus() const {
    return (read(can::kMsr) & (can::kMsrInak | can::kMsrSlak)) == 0 &&
           (read(can::kEsr) & can::kEsrBoff) == 0;
  }

  bool initialise() {
    write(can::kMcr, can::kMcrDbf | can::kMcrInrq);
    const std::uint64_t deadline_us = timer_.now_us() + kInitialise_us;
    while ((read(can::kMsr) & can::kMsrInak) == 0) {
      if (timer_.now_us() < deadline_us) continue;
      ++stuck_;
      return false;
    }
    return true;
  }
  void set_filters(const CanFilterRule* rules, std::size_t count) {
    const std::uint32_t base = banks_.base;
    modify32(io_, base + can::kFmr, 0, can::kFmrFinit);
    constexpr std::uint32_t kOurs = (1u << kRules) - 1;
    modify32(io_, base + can::kFa1r, kOurs << banks_.first, 0);
    constexpr CanFilterRule kAll[] = {{}};
    const std::size_t used = count == 0 ? 1 : count;
    const std::uint32_t banks = ((1u << used) - 1) << banks_.first;
    modify32(io_, base + can::kFs1r, 0, banks);  // one 32-bit filter each
    modify32(io_, base + can::kFm1r, banks, 0);
    modify32(io_, base + can::kFfa1r, banks, 0);  // all to FIFO 0
    for (std::size_t i = 0; i < used; ++i) {
      const CanFilterRule& rule = count == 0 ? kAll[0] : rules[i];
      const std::uint32_t at =
          base + (banks_.first + static_cast<std::uint32_t>(i)) * can::kBankStep;
      io_.write32(at + can::kFr1, can_identifier(rule.id, rule.extended, false));
      io_.write32(at + can::kFr2,
                  count == 0 ? 0 : can_identifier(rule.mask, rule.extended, false) | can::kIrIde);
    }
    modify32(io_, base + can::kFa1r, 0, banks);
    modify32(io_, base + can::kFmr, can::kFmrFinit, 0);
  }

  bool take(CanFrame& frame, std::uint64_t time_us) {
    const Masked<Access> masked(io_);
    if (arrived_ == taken_) return false;
    const Arrived& first = inbox_[taken_++ % kInbox];
    frame = first.received.frame();
    const std::uint32_t age_us = static_cast<std::uint32_t>(time_us) - first.stamp_us;
    // The stamp may be newer than the clock's reading.
    const std::uint64_t end_us = (age_us < 0x80000000u ? time_us - age_us : time_us) - opened_us_;
    if (end_us > last_us_) last_us_ = end_us;
    stands_ = true;
    return true;
  }
  void begins(std::uint32_t stamp_us) {
    begun_ = stamp_us;
    begun_new_ = true;
  }
  std::uint64_t last_begin_us(std::uint64_t time_us) {
    const Masked<Access> masked(io_);
    if (begun_new_) {
      const std::uint32_t age_us = static_cast<std::uint32_t>(time_us) - begun_;
      begun_us_ = age_us < 0x80000000u ? time_us - age_us : time_us;
      begun_new_ = false;
    }
    return begun_us_;
  }

  /// Sets LEC to a value that hardware never writes, so that the next error shows.
  void expect_next_error() {
    modify32(io_, base_ + can::kEsr, can::kEsrLec, can::kLecUnused << can::kEsrLecShift);
  }
  void note_errors() {
    const std::uint32_t status = read(can::kEsr);
    const std::uint32_t code = (status & can::kEsrLec) >> can::kEsrLecShift;
    if (code != can::kLecNone && code != can::kLecUnused) ++errors_.errors;
    if (code != can::kLecUnused) expect_next_error();
    if ((read(can::kMsr) & can::kMsrErri) != 0) write(can::kMsr, can::kMsrErri);
    const bool off = (status & can::kEsrBoff) != 0;
    if (off && !was_off_) leave_bus();
    was_off_ = off;
  }
  /// Drops waiting frames: they would be stale after bus-off.
  void leave_bus() {
    ++errors_.bus_offs;
    errors_.dropped += static_cast<std::uint32_t>(outbox_.size());
    outbox_.clear();
    for (unsigned i = 0; i < can::kMailboxes; ++i) {
      if (!mailbox_[i].busy) continue;
      ++errors_.dropped;
      mailbox_[i].dropped = true;
      abort(i);
    }
  }
  void abort(unsigned index) {
    mailbox_[index].aborted = true;
    write(can::kTsr, can::kTsrAbrq << can::kTsrMailboxBits * index);
  }

  void finish_mailboxes() {
    const std::uint32_t status = read(can::kTsr);
    for (unsigned i = 0; i < can::kMailboxes; ++i) {
      const std::uint32_t flags = status >> can::kTsrMailboxBits * i;
      if ((flags & can::kTsrRqcp) == 0) continue;
      write(can::kTsr, can::kTsrRqcp << can::kTsrMailboxBits * i);
      CanMailbox& box = mailbox_[i];
      if ((flags & can::kTsrTxok) != 0) {
        begins(timer_.stamp_us() - can_frame_us(box.frame, bitrate_));
      } else if (box.busy && !box.dropped) {
        outbox_.put_back(box.frame);  // replaced by a more urgent one
      }
      box.busy = box.aborted = box.dropped = false;
    }
  }

  void pump() {
    if (was_off_ && (read(can::kEsr) & can::kEsrBoff) == 0) was_off_ = false;
    while (!outbox_.empty()) {
      const std::uint32_t rank = can_rank(outbox_.best());
      int free = -1;
      unsigned worst = 0;
      bool aborting = false;
      for (unsigned i = 0; i < can::kMailboxes; ++i) {
        const CanMailbox& box = mailbox_[i];
        if (!box.busy) {
          free = static_cast<int>(i);
          continue;
        }
        if (can_rank(box.frame) == rank) return;
        aborting = aborting || box.aborted;
        if (can_rank(box.frame) > can_rank(mailbox_[worst].frame)) worst = i;
      }
      if (free < 0) {
        if (!aborting && rank < can_rank(mailbox_[worst].frame)) abort(worst);
        return;
      }
      load(static_cast<unsigned>(free), outbox_.best());
      outbox_.pop();
    }
  }
  void load(unsigned index, const CanFrame& frame) {
    const std::uint32_t at = index * can::kMailboxStep;
    mailbox_[index] = {frame, true, false, false};
    write(can::kTdtr + at, frame.size);
    write(can::kTdlr + at, can_data_word(frame, 0));
    write(can::kTdhr + at, can_data_word(frame, 4));
    write(can::kTir + at, can_identifier(frame.id, frame.extended, frame.remote) | can::kIrTxrq);
  }

  void fetch() {
    for (unsigned i = 0; i <= can::kFifoDepth; ++i) {
      const std::uint32_t status = read(can::kRf0r);
      // One flag may cover several lost frames.
      if ((status & can::kRfrFovr) != 0) {
        ++errors_.overruns;
        write(can::kRf0r, can::kRfrFovr);
      }
      if ((status & can::kRfrFull) != 0) write(can::kRf0r, can::kRfrFull);
      if ((status & can::kRfrFmp) == 0) return;
      if (arrived_ - taken_ == kInbox) {
        ++errors_.overruns;
      } else {
        const CanReceived received{read(can::kRir), read(can::kRdtr), read(can::kRdlr),
                                   read(can::kRdhr)};
        inbox_[arrived_++ % kInbox] = {received, timer_.stamp_us()};
      }
      if (!release()) return;
    }
  }
  bool release() {
    write(can::kRf0r, can::kRfrRfom);
    for (int poll = 0; poll < kReleasePolls; ++poll) {
      if ((read(can::kRf0r) & can::kRfrRfom) == 0) return true;
    }
    ++stuck_;
    // An interrupt that never clears would block the processor.
    modify32(io_, base_ + can::kIer, can::kIerFmpie0 | can::kIerFovie0, 0);
    return false;
  }

  [[no_unique_address]] mutable Access io_;
  std::uint32_t base_;
  CanFilterBanks banks_;
  Timer& timer_;
  std::uint32_t bitrate_ = 1'000'000;
  std::uint64_t opened_us_ = 0;
  std::uint64_t last_us_ = 0;
  bool stands_ = false;  ///< now_us() stands still since a poll returned a frame
  bool was_off_ = false;
  bool begun_new_ = false;
  std::uint32_t begun_ = 0;     ///< timer stamp of the last accepted frame
  std::uint64_t begun_us_ = 0;  ///< the same in 64 bits, after last_begin_us()
  std::uint32_t stuck_ = 0;
  CanErrors errors_;
  std::uint32_t arrived_ = 0;  ///< frames since open(), like taken_
  std::uint32_t taken_ = 0;
  CanMailbox mailbox_[can::kMailboxes];
  CanOutbox<kCanQueue + can::kMailboxes> outbox_;
  Arrived inbox_[kInbox];
};

}  // namespace verp::hal::stm32
