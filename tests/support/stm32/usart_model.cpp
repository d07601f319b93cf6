#include "tests/support/stm32/usart_model.hpp"

#include <algorithm>
#include <string>

#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/rcc_model.hpp"
#include "tests/support/stm32/registers/usart_table.hpp"

namespace verp::hal::stm32::model {

// Shared by both kinds: flags 0 to 7, CR1 bits 2 to 15, CR3 bits 0 to 11.
using namespace usart_v1;

UsartModel::UsartModel(Machine& machine, unsigned number, std::uint32_t base, Gate gate,
                       unsigned irq)
    : Bank(machine, "USART" + std::to_string(number), base,
           machine.family() == Family::kF746 ? usart_v2::kTable : usart_v1::kTable, gate),
      number_(number),
      irq_(irq),
      v2_(machine.family() == Family::kF746) {}

void UsartModel::reset() {
  Bank::reset();
  seen_ = rx_data_ = tx_data_ = 0;
  tx_full_ = shifting_ = false;
  idle_at_ = kNever;
}

std::uint32_t UsartModel::clock_hz() const {
  const RccModel& rcc = machine().rcc();
  if (!v2_) return rcc.bus_hz(base());
  switch (rcc.peek(rcc::kDckcfgr2F746) >> rcc::usart_clock_shift(number_) & 3u) {
    case 0:
      return rcc.bus_hz(base());
    case 1:
      return rcc.sysclk_hz();
    case 2:
      return kHsi_hz;
    default:
      return 32768;
  }
}

Time UsartModel::bit_time() const {
  const std::uint32_t value = reg(brr());
  if (!has(cr1(), kCr1Over8)) return duration(value, clock_hz());
  // Oversampling by 8 has 3 fraction bits. The F7 counts half clocks.
  if (v2_) return duration((value & 0xFFF0u) | (value & 7u) << 1, 2 * clock_hz());
  return duration((value >> 4) * 8 + (value & 7u), clock_hz());
}

double UsartModel::baud() const {
  const Time bit = bit_time();
  return bit == 0 ? 0.0 : static_cast<double>(kSecond) / static_cast<double>(bit);
}

Time UsartModel::frame_time() const {
  const unsigned stop = (reg(cr2()) & kCr2Stop) == 0 ? 1 : 2;
  const unsigned data = has(cr1(), kCr1M) ? 9 : 8;
  return bit_time() * (1 + data + stop);
}

bool UsartModel::talking_allowed() const {
  return direction_.port == nullptr || direction_.port->level(direction_.pin) == direction_active_;
}

void UsartModel::direction_pin(GpioModel& port, unsigned pin, bool active) {
  direction_ = {&port, pin, 0};
  direction_active_ = active;
  port.on_change([this, pin](unsigned changed, bool) {
    if (changed == pin && shifting_ && !talking_allowed()) shift_.whole = false;
  });
}

void UsartModel::receive(const std::uint8_t* data, std::size_t size, std::uint32_t baud,
                         Time start) {
  for (std::size_t i = 0; i < size; ++i) receive(data[i], baud, Flaw::kNone, i == 0 ? start : 0);
}

void UsartModel::receive(std::uint8_t data, std::uint32_t baud, Flaw flaw, Time start) {
  const Time bit = kSecond / baud;
  const Time from = std::max({start, line_free_at_, machine().now()});
  line_.push_back({from, from + 10 * bit, bit, data, flaw, false});
  line_free_at_ = from + 10 * bit;
  machine().touch();
}

Time UsartModel::next() const {
  Time when = idle_at_;
  if (!line_.empty()) when = std::min(when, line_.front().end - line_.front().bit / 2);
  if (shifting_ && !tx_stuck) when = std::min(when, shift_.end);
  if (heard_at_ + dma_lag > machine().now()) when = std::min(when, heard_at_ + dma_lag);
  return when;
}

void UsartModel::run() {
  const Time now = machine().now();
  while (!line_.empty() && line_.front().end - line_.front().bit / 2 <= now) {
    const Frame frame = line_.front();
    line_.pop_front();
    hear(frame);
  }
  if (shifting_ && !tx_stuck && shift_.end <= now) end_of_frame();
  if (idle_at_ <= now) {
    idle_at_ = kNever;
    if (listens()) set(status(), kSrIdle);
  }
}

void UsartModel::hear(const Frame& frame) {
  machine().touch();
  if (!frame.own && shifting_ && has(cr3(), kCr3Hdsel)) shift_.whole = false;
  if (!listens() || listens_from_ > frame.start || !rx_pin_.right()) return;
  if (!frame.own && direction_.port != nullptr && talking_allowed()) return;
  const Time own = bit_time();
  const Time drift = 19 * (own > frame.bit ? own - frame.bit : frame.bit - own) / 2;
  const bool collided = !frame.own && shifting_ && has(cr3(), kCr3Hdsel);
  std::uint32_t data = frame.data;
  std::uint32_t flags = 0;
  if (frame.flaw == Flaw::kNoise) flags |= kSrNf;
  if (frame.flaw == Flaw::kFraming) flags |= kSrFe;
  if (frame.flaw == Flaw::kBreak) {
    flags |= kSrFe;
    data = 0;
  }
  // RM0090 30.3.5: the receiver tolerates at best 3.75 % with 10 bits; beyond, the stop bit is
  // missed.
  if (drift * 100 > own * 36 || collided) {
    data = ~data & 0xFFu;
    flags |= kSrNf;
  }
  if (drift * 2 > own || collided) flags |= kSrFe;
  idle_at_ = std::max(machine().now(), frame.end) + frame_time();
  if (has(status(), kSrRxne)) {
    const bool overwrite = v2_ && has(cr3(), usart_v2::kCr3Ovrdis);
    if (!overwrite) {
      set(status(), kSrOre);
      return;
    }
  }
  rx_data_ = data;
  heard_at_ = machine().now();
  set(status(), kSrRxne | flags);
}

void UsartModel::load() {
  if (shifting_ || !tx_full_ || !sends()) return;
  const Time start = std::max(machine().now(), sends_from_);
  shift_ = {static_cast<std::uint8_t>(tx_data_), start, start + frame_time(),
            talking_allowed() && tx_pin_.right()};
  shifting_ = true;
  tx_full_ = false;
  set(status(), kSrTxe);
}

void UsartModel::end_of_frame() {
  shifting_ = false;
  const Sent ended = shift_;
  if (has(cr3(), kCr3Hdsel)) {
    const bool clash = !line_.empty() && line_.front().start < ended.end;
    shift_.whole = shift_.whole && !clash;
    if (listens()) hear({ended.start, ended.end, bit_time(), ended.data, Flaw::kNone, true});
  }
  sent_.push_back(shift_);
  load();
  if (!shifting_) set(status(), kSrTc);
  machine().touch();
  if (watcher_) watcher_(sent_.back());
}

void UsartModel::data_written(std::uint32_t raw) {
  if (!sends()) return violate("data written while UE or TE is 0");
  if (!has(status(), kSrTxe)) violate("data written while TXE is 0: a byte is lost");
  tx_full_ = true;
  tx_data_ = raw;
  clear(status(), kSrTxe);
  // F4: TC clears by a read of SR, then a write of DR. F7: by the write.
  if (v2_ || (seen_ & kSrTc) != 0) clear(status(), kSrTc);
  seen_ &= ~kSrTc;
  load();
}

void UsartModel::before_read(std::uint32_t offset) {
  if (v2_) {
    if (offset == usart_v2::kRdr) reg(usart_v2::kRdr) = rx_data_;
    if (offset == usart_v2::kIsr) {
      clear(usart_v2::kIsr, usart_v2::kIsrTeack | usart_v2::kIsrBusy);
      if (sends()) set(usart_v2::kIsr, usart_v2::kIsrTeack);
      const bool busy = !line_.empty() && line_.front().start <= machine().now();
      if (busy && listens()) set(usart_v2::kIsr, usart_v2::kIsrBusy);
    }
  } else if (offset == kDr) {
    reg(kDr) = rx_data_;
  }
}

void UsartModel::after_read(std::uint32_t offset) {
  if (v2_) {
    if (offset == usart_v2::kRdr) clear(usart_v2::kIsr, kSrRxne);
  } else if (offset == kSr) {
    seen_ = reg(kSr);
  } else if (offset == kDr) {
    constexpr std::uint32_t kByReads = kSrPe | kSrFe | kSrNf | kSrOre | kSrIdle;
    clear(kSr, kSrRxne | (seen_ & kByReads));
    seen_ = 0;
  } else {
    return;
  }
  machine().touch();
}

bool UsartModel::may_write(std::uint32_t offset, std::uint32_t raw) {
  const bool line_busy = shifting_ || (!line_.empty() && line_.front().start <= machine().now());
  if (offset == brr() && on() && (v2_ || line_busy)) {
    violate(v2_ ? "write to BRR while UE is set" : "write to BRR while bytes are on the line");
    return !v2_;
  }
  if (!v2_ || !on()) return true;
  // RM0385 31.8: writable only while UE is 0.
  const std::uint32_t changes = raw ^ peek(offset);
  std::uint32_t fixed = 0;
  if (offset == usart_v2::kCr1) {
    fixed = kCr1Over8 | kCr1Pce | kCr1Ps | kCr1Wake | usart_v2::kCr1M0 | usart_v2::kCr1M1 |
            usart_v2::kCr1Dedt | usart_v2::kCr1Deat;
  }
  if (offset == usart_v2::kCr2) fixed = 0x000FFF30u;  // up to MSBFIRST except LBDIE
  if (offset == usart_v2::kCr3) {
    fixed = kCr3Hdsel | kCr3Onebit | usart_v2::kCr3Ovrdis | usart_v2::kCr3Ddre | usart_v2::kCr3Dem |
            usart_v2::kCr3Dep;
  }
  if ((changes & fixed) != 0) {
    violate("changes a field that must not change while UE is set");
  }
  return true;
}

void UsartModel::control_written(std::uint32_t old) {
  const std::uint32_t ue = v2_ ? usart_v2::kCr1Ue : kCr1Ue;
  const bool was_on = (old & ue) != 0;
  const bool sent_before = was_on && (old & kCr1Te) != 0;
  const bool heard_before = was_on && (old & kCr1Re) != 0;
  if (on() && reg(brr()) < 16) violate("UE set with BRR below 16");
  if (has(cr1(), kCr1Pce)) violate("parity is not modelled");
  if (was_on && !on() && shifting_) {
    violate("UE cleared while a byte leaves");
    shifting_ = false;
  }
  if (sends() && !sent_before) {
    sends_from_ = machine().now() + frame_time();  // an idle frame goes first
    if (!v2_) set(kSr, kSrTc);
  }
  if (!on()) tx_full_ = false;
  if (listens() && !heard_before) listens_from_ = machine().now();
  if (!listens()) idle_at_ = kNever;
  load();
}

void UsartModel::request_written(std::uint32_t raw) {
  if ((raw & usart_v2::kRqrRxfrq) != 0) clear(usart_v2::kIsr, kSrRxne);
  if ((raw & ~usart_v2::kRqrRxfrq) != 0) violate("only RXFRQ is modelled of RQR");
}

void UsartModel::on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) {
  if (offset == cr1()) control_written(old);
  if (offset == (v2_ ? usart_v2::kTdr : kDr)) data_written(raw);
  if (!v2_) return;
  if (offset == usart_v2::kIcr) clear(usart_v2::kIsr, raw);
  if (offset == usart_v2::kRqr) request_written(raw);
}

bool UsartModel::narrow_ok(std::uint32_t offset, unsigned) const {
  return v2_ ? offset == usart_v2::kRdr || offset == usart_v2::kTdr : offset == kDr;
}

bool UsartModel::dma_request(bool transmit) const {
  if (transmit) return has(cr3(), kCr3Dmat) && sends() && has(status(), kSrTxe);
  const bool blocked = v2_ && has(cr3(), usart_v2::kCr3Ddre) && has(status(), bits(0, 4));
  const bool late = machine().now() < heard_at_ + dma_lag;
  return has(cr3(), kCr3Dmar) && has(status(), kSrRxne) && !blocked && !late;
}

bool UsartModel::interrupt(unsigned irq) const {
  if (irq != irq_ || !on()) return false;
  const std::uint32_t flags = reg(status());
  const std::uint32_t enables = reg(cr1());
  const std::uint32_t errors = kSrFe | kSrNf | kSrOre;
  const bool error_enabled = has(cr3(), kCr3Eie) && (v2_ || has(cr3(), kCr3Dmar));
  return ((enables & kCr1Rxneie) != 0 && (flags & (kSrRxne | kSrOre)) != 0) ||
         ((enables & kCr1Txeie) != 0 && (flags & kSrTxe) != 0) ||
         ((enables & kCr1Tcie) != 0 && (flags & kSrTc) != 0) ||
         ((enables & kCr1Idleie) != 0 && (flags & kSrIdle) != 0) ||
         ((enables & kCr1Peie) != 0 && (flags & kSrPe) != 0) ||
         (error_enabled && (flags & errors) != 0);
}

}  // namespace verp::hal::stm32::model
