#include "tests/support/stm32/can_model.hpp"

#include <algorithm>
#include <cmath>

#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/rcc_model.hpp"
#include "tests/support/stm32/registers/can_table.hpp"

namespace verp::hal::stm32::model {

using namespace can;

namespace {

constexpr unsigned kPassive = 128, kWarning = 96, kOff = 256;
constexpr unsigned kSequences = 128, kSequenceBits = 11;  // ISO 11898-1: recovery from bus-off
constexpr unsigned kErrorBits = 6 + 8 + 3;                // flag, delimiter, intermission

std::uint32_t identifier_word(const CanFrame& frame) {
  const std::uint32_t id = frame.extended ? (frame.id >> 18) << kIrStidShift |
                                                (frame.id & 0x3FFFFu) << kIrExidShift | kIrIde
                                          : frame.id << kIrStidShift;
  return id | (frame.remote ? kIrRtr : 0);
}

}  // namespace

CanModel::CanModel(Machine& machine, std::uint32_t base, Gate gate, unsigned first_irq,
                   const CanModel* keeper)
    : Bank(machine, "CAN", base, kTable, gate), first_irq_(first_irq), keeper_(keeper) {
  for (unsigned i = 0; i < kMailboxes; ++i) add_registers(kTransmitTable, i * kMailboxStep);
  for (unsigned i = 0; i < kFifos; ++i) add_registers(kReceiveTable, i * kMailboxStep);
  if (keeper != nullptr) return;
  add_registers(kFilterTable, 0);
  for (unsigned i = 0; i < kBanks; ++i) add_registers(kBankTable, i * kBankStep);
}

void CanModel::reset() {
  Bank::reset();
  mode_ = Mode::kSleep;
  mode_at_ = recovered_at_ = kNever;
  pending_ = tec_ = 0;
  if (mailbox_ >= 0) talking_ = false;
  for (auto& each : fifo_) each.clear();
}

double CanModel::bitrate() const {
  const Time bit = bit_time();
  return bit == 0 ? 0 : static_cast<double>(kSecond) / static_cast<double>(bit);
}

double CanModel::sample_point() const {
  const std::uint32_t btr = reg(kBtr);
  const std::uint32_t ts1 = (btr & kBtrTs1) >> kBtrTs1Shift;
  const std::uint32_t ts2 = (btr & kBtrTs2) >> kBtrTs2Shift;
  return static_cast<double>(2 + ts1) / static_cast<double>(3 + ts1 + ts2);
}

Time CanModel::bit_time() const {
  const std::uint32_t btr = reg(kBtr);
  const std::uint32_t quanta =
      3 + ((btr & kBtrTs1) >> kBtrTs1Shift) + ((btr & kBtrTs2) >> kBtrTs2Shift);
  return duration(quanta * ((btr & kBtrBrp) + 1), machine().rcc().bus_hz(base()));
}

/// ISO 11898-1: with a jump width of 1 in 16 quanta, nodes tolerate half a percent.
bool CanModel::right_rate() const {
  return std::abs(bitrate() - bus_bitrate) < 0.005 * bus_bitrate;
}

Time CanModel::frame_time(const CanFrame& frame) const {
  const unsigned bits = (frame.extended ? 67u : 47u) + (frame.remote ? 0u : 8u * frame.size);
  return bits * (kSecond / bus_bitrate);
}

CanFrame CanModel::frame_in(unsigned mailbox) const {
  const std::uint32_t at = mailbox * kMailboxStep;
  const std::uint32_t word = reg(kTir + at);
  CanFrame frame;
  frame.extended = (word & kIrIde) != 0;
  frame.remote = (word & kIrRtr) != 0;
  frame.id = frame.extended ? word >> kIrExidShift : word >> kIrStidShift;
  frame.size = static_cast<std::uint8_t>(std::min<std::uint32_t>(reg(kTdtr + at) & kDtrDlc, 8));
  for (unsigned i = 0; i < frame.size && !frame.remote; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(reg((i < 4 ? kTdlr : kTdhr) + at) >> 8 * (i % 4));
  }
  return frame;
}

std::uint32_t CanModel::wanted_rank(unsigned mailbox) const {
  return has(kMcr, kMcrTxfp) ? order_[mailbox] : can_rank(frame_in(mailbox));
}

void CanModel::send(const CanFrame& frame, Time when) {
  others_.push_back({frame, std::max(when, machine().now())});
  machine().touch();
}

Time CanModel::next() const {
  Time when = std::min(mode_at_, recovered_at_);
  if (talking_) return std::min(when, end_);
  if (line_dominant) return when;
  for (const Waiting& each : others_) when = std::min(when, std::max(each.when, idle_at_));
  const bool sends = mode_ == Mode::kNormal && pending_ != 0 && !has(kEsr, kEsrBoff);
  return sends ? std::min(when, std::max(idle_at_, machine().now())) : when;
}

void CanModel::run() {
  const Time now = machine().now();
  if (mode_at_ <= now) change_mode();
  if (recovered_at_ <= now) {
    recovered_at_ = kNever;
    tec_ = 0;
    clear(kEsr, kEsrBoff);
    show_counters();
  }
  if (talking_ && end_ <= now) end_of_frame();
  if (!talking_ && idle_at_ <= now && !line_dominant) start_next();
}

void CanModel::request_mode() {
  const bool init = has(kMcr, kMcrInrq);
  const bool sleep = has(kMcr, kMcrSleep);
  const Mode wanted = sleep ? Mode::kSleep : init ? Mode::kInit : Mode::kNormal;
  mode_at_ = kNever;
  if (wanted == mode_ || (wanted == Mode::kInit && init_stuck)) return;
  const Time now = machine().now();
  if (wanted == Mode::kNormal) {  // after 11 recessive bits
    if (!line_dominant) mode_at_ = std::max(now, idle_at_) + kSequenceBits * bit_time();
  } else {
    mode_at_ = talking_ && mailbox_ >= 0 ? end_ : now + ns(100);
  }
}

void CanModel::change_mode() {
  mode_at_ = kNever;
  mode_ = has(kMcr, kMcrSleep) ? Mode::kSleep : has(kMcr, kMcrInrq) ? Mode::kInit : Mode::kNormal;
  clear(kMsr, kMsrInak | kMsrSlak);
  if (mode_ == Mode::kInit) set(kMsr, kMsrInak);
  if (mode_ == Mode::kSleep) set(kMsr, kMsrSlak);
  // Without ABOM, leaving initialisation starts recovery.
  if (mode_ == Mode::kNormal && has(kEsr, kEsrBoff)) {
    recovered_at_ = machine().now() + kSequences * kSequenceBits * bit_time();
  }
  machine().touch();
}

void CanModel::start_next() {
  int best = -1;
  if (mode_ == Mode::kNormal && !has(kEsr, kEsrBoff)) {
    for (unsigned i = 0; i < kMailboxes; ++i) {
      if (pending(i) && (best < 0 || wanted_rank(i) < wanted_rank(static_cast<unsigned>(best)))) {
        best = static_cast<int>(i);
      }
    }
  }
  const Time now = machine().now();
  auto other = others_.end();
  for (auto each = others_.begin(); each != others_.end(); ++each) {
    if (each->when > now) continue;
    if (other == others_.end() || can_rank(each->frame) < can_rank(other->frame)) other = each;
  }
  if (best < 0 && other == others_.end()) return;
  if (best >= 0 && other != others_.end()) {
    if (can_rank(other->frame) < can_rank(frame_in(static_cast<unsigned>(best)))) best = -1;
  }
  talking_ = true;
  mailbox_ = best;
  on_wire_ = best >= 0 ? frame_in(static_cast<unsigned>(best)) : other->frame;
  if (best < 0) others_.erase(other);
  start_ = now;
  end_ = now + frame_time(on_wire_);
  machine().touch();
}

void CanModel::end_of_frame() {
  talking_ = false;
  idle_at_ = end_;
  machine().touch();
  const bool broken = breaks(on_wire_);
  if (mailbox_ < 0) {
    if (broken) return break_other();
    if (mode_ == Mode::kNormal && !has(kEsr, kEsrBoff)) receive(on_wire_);
    return;
  }
  const auto mailbox = static_cast<unsigned>(mailbox_);
  if (broken || break_next > 0 || !right_rate()) {
    if (break_next > 0 && !broken) --break_next;
    return fail_transmission(kLecRecessive);
  }
  if (!acknowledged) return fail_transmission(kLecAck);
  if (tec_ > 0) --tec_;
  clear(kEsr, kEsrLec);
  show_counters();
  close_mailbox(mailbox, kTsrRqcp | kTsrTxok);
  sent_.push_back({on_wire_, mailbox, start_, end_});
  if (watcher_) watcher_(sent_.back());
}

void CanModel::break_other() {
  idle_at_ = end_ + kErrorBits * (kSecond / bus_bitrate);
  others_.push_front({on_wire_, idle_at_});
  if (mode_ != Mode::kNormal || has(kEsr, kEsrBoff)) return;
  reg(kEsr) = (reg(kEsr) & ~kEsrLec) | kLecStuff << kEsrLecShift;
  raise(kIerLecie);
}

void CanModel::fail_transmission(std::uint32_t code) {
  idle_at_ = end_ + kErrorBits * bit_time();
  // A passive node without acknowledgement stops counting.
  if (code != kLecAck || tec_ < kPassive) tec_ += 8;
  reg(kEsr) = (reg(kEsr) & ~kEsrLec) | code << kEsrLecShift;
  raise(kIerLecie);
  const auto mailbox = static_cast<unsigned>(mailbox_);
  const bool aborted = has(kTsr, kTsrAbrq << kTsrMailboxBits * mailbox) && !abort_stuck;
  if (aborted || has(kMcr, kMcrNart)) close_mailbox(mailbox, kTsrRqcp | kTsrTerr);
  show_counters();
  if (tec_ < kOff) return;
  set(kEsr, kEsrBoff);
  raise(kIerBofie);
  if (has(kMcr, kMcrAbom) && !line_dominant) {
    recovered_at_ = end_ + kSequences * kSequenceBits * bit_time();
  }
}

void CanModel::show_counters() {
  const std::uint32_t before = reg(kEsr);
  const std::uint32_t shown = std::min(tec_, 255u);
  clear(kEsr, kEsrTec | kEsrEwgf | kEsrEpvf);
  set(kEsr, shown << kEsrTecShift);
  if (tec_ >= kWarning) set(kEsr, kEsrEwgf);
  if (tec_ >= kPassive) set(kEsr, kEsrEpvf);
  const std::uint32_t risen = reg(kEsr) & ~before;
  if ((risen & kEsrEwgf) != 0) raise(kIerEwgie);
  if ((risen & kEsrEpvf) != 0) raise(kIerEpvie);
}

void CanModel::raise(std::uint32_t enable) {
  if (has(kIer, enable)) set(kMsr, kMsrErri);
}

void CanModel::close_mailbox(unsigned mailbox, std::uint32_t how) {
  pending_ &= ~(1u << mailbox);
  clear(kTir + mailbox * kMailboxStep, kIrTxrq);
  clear(kTsr, (kTsrDone | kTsrAbrq) << kTsrMailboxBits * mailbox);
  set(kTsr, how << kTsrMailboxBits * mailbox | kTsrTme << mailbox);
  machine().touch();
}

/// A frame on the wire continues but is not repeated.
void CanModel::abort(unsigned mailbox) {
  if (!pending(mailbox)) clear(kTsr, kTsrAbrq << kTsrMailboxBits * mailbox);
  if (!pending(mailbox) || abort_stuck) return;
  if (talking_ && mailbox_ == static_cast<int>(mailbox)) return;
  close_mailbox(mailbox, kTsrRqcp);
}

bool CanModel::passes(const CanFrame& frame, unsigned& fifo) const {
  const CanModel& keeper = keeper_ != nullptr ? *keeper_ : *this;
  if (keeper.has(kFmr, kFmrFinit)) return false;
  const std::uint32_t word = identifier_word(frame);
  const unsigned split = (keeper.reg(kFmr) & kFmrCan2sb) >> kFmrCan2sbShift;
  const unsigned end = keeper_ != nullptr ? kBanks : split;
  for (unsigned i = keeper_ != nullptr ? split : 0; i < end; ++i) {
    if (!keeper.has(kFa1r, 1u << i)) continue;
    const std::uint32_t first = keeper.reg(kFr1 + i * kBankStep);
    const std::uint32_t second = keeper.reg(kFr2 + i * kBankStep);
    const bool list = keeper.has(kFm1r, 1u << i);
    if (list ? word == first || word == second : ((word ^ first) & second) == 0) {
      fifo = keeper.has(kFfa1r, 1u << i) ? 1 : 0;
      return true;
    }
  }
  return false;
}

void CanModel::receive(const CanFrame& frame) {
  unsigned fifo = 0;
  if (!right_rate()) {
    reg(kEsr) = (reg(kEsr) & ~kEsrLec) | kLecStuff << kEsrLecShift;
    return raise(kIerLecie);
  }
  clear(kEsr, kEsrLec);
  if (!passes(frame, fifo)) return;
  const std::uint32_t status = fifo == 0 ? kRf0r : kRf1r;
  if (fifo_[fifo].size() == kFifoDepth) {
    set(status, kRfrFovr);
    if (!has(kMcr, kMcrRflm)) fifo_[fifo].back() = frame;
    return;
  }
  fifo_[fifo].push_back(frame);
  if (fifo_[fifo].size() == kFifoDepth) set(status, kRfrFull);
  reg(status) = (reg(status) & ~kRfrFmp) | static_cast<std::uint32_t>(fifo_[fifo].size());
}

void CanModel::release(unsigned fifo) {
  const std::uint32_t status = fifo == 0 ? kRf0r : kRf1r;
  clear(status, kRfrRfom);
  if (fifo_[fifo].empty()) return violate("release of an empty FIFO");
  fifo_[fifo].pop_front();
  reg(status) = (reg(status) & ~kRfrFmp) | static_cast<std::uint32_t>(fifo_[fifo].size());
}

void CanModel::before_read(std::uint32_t offset) {
  for (unsigned fifo = 0; fifo < kFifos; ++fifo) {
    const std::uint32_t at = fifo * kMailboxStep;
    if (offset < kRir + at || offset > kRdhr + at) continue;
    if (fifo_[fifo].empty()) return violate("read of an empty FIFO");
    const CanFrame& frame = fifo_[fifo].front();
    const auto word = [&](unsigned from) {
      std::uint32_t value = 0;
      for (unsigned i = 0; i < 4; ++i) value |= std::uint32_t{frame.data[from + i]} << 8 * i;
      return value;
    };
    reg(kRir + at) = identifier_word(frame);
    reg(kRdtr + at) = frame.remote ? 0 : frame.size;
    reg(kRdlr + at) = word(0);
    reg(kRdhr + at) = word(4);
  }
}

bool CanModel::may_write(std::uint32_t offset, std::uint32_t) {
  if (offset == kBtr && mode_ != Mode::kInit) {
    violate("write to BTR outside initialisation");
    return false;
  }
  if (offset >= kTir && offset < kTir + kMailboxes * kMailboxStep &&
      pending((offset - kTir) / kMailboxStep)) {
    violate("write to a mailbox that is not empty");
    return false;
  }
  const bool bank = offset >= kFr1;
  const bool set_up = offset == kFm1r || offset == kFs1r || offset == kFfa1r;
  if ((set_up || bank) && !has(kFmr, kFmrFinit)) {
    if (set_up || has(kFa1r, 1u << (offset - kFr1) / kBankStep)) {
      violate("write to filters in use");
      return false;
    }
  }
  return true;
}

void CanModel::on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) {
  if (offset == kMcr && ((raw ^ old) & (kMcrInrq | kMcrSleep)) != 0) request_mode();
  if (offset == kMcr && (raw & (kMcrReset | kMcrTtcm | kMcrAwum)) != 0) {
    violate("RESET, TTCM and AWUM are not modelled");
  }
  if (offset == kBtr && (raw & (kBtrLbkm | kBtrSilm)) != 0) violate("test modes are not modelled");
  if (offset == kFa1r && (raw & ~reg(kFs1r)) != 0) violate("filters of 16 bits are not modelled");
  if (offset == kRf0r && (raw & kRfrRfom) != 0) release(0);
  if (offset == kRf1r && (raw & kRfrRfom) != 0) release(1);
  for (unsigned i = 0; i < kMailboxes; ++i) {
    const unsigned shift = kTsrMailboxBits * i;
    if (offset == kTsr && (raw & kTsrRqcp << shift) != 0) clear(kTsr, kTsrDone << shift);
    if (offset == kTsr && (raw & kTsrAbrq << shift) != 0) abort(i);
    if (offset != kTir + i * kMailboxStep || (raw & kIrTxrq) == 0) continue;
    pending_ |= 1u << i;
    order_[i] = requests_++;
    clear(kTsr, kTsrTme << i | kTsrDone << shift);
  }
}

bool CanModel::interrupt(unsigned irq) const {
  const std::uint32_t enabled = reg(kIer);
  const auto fifo = [&](std::uint32_t status, unsigned shift) {
    const std::uint32_t flags = reg(status);
    return ((enabled & kIerFmpie0 << shift) != 0 && (flags & kRfrFmp) != 0) ||
           ((enabled & kIerFfie0 << shift) != 0 && (flags & kRfrFull) != 0) ||
           ((enabled & kIerFovie0 << shift) != 0 && (flags & kRfrFovr) != 0);
  };
  if (irq == first_irq_) {
    return (enabled & kIerTmeie) != 0 && has(kTsr, kTsrRqcp * 0x010101);
  }
  if (irq == first_irq_ + 1) return fifo(kRf0r, 0);
  if (irq == first_irq_ + 2) return fifo(kRf1r, 3);
  return irq == first_irq_ + 3 && (enabled & kIerErrie) != 0 && has(kMsr, kMsrErri);
}

}  // namespace verp::hal::stm32::model
