#include "tests/support/stm32/timer_model.hpp"

#include <algorithm>
#include <string>

#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/rcc_model.hpp"
#include "tests/support/stm32/registers/timer_table.hpp"

namespace verp::hal::stm32::model {

using namespace timer;

TimerModel::TimerModel(Machine& machine, unsigned number, std::uint32_t base, Gate gate,
                       unsigned irq)
    : Bank(machine, "TIM" + std::to_string(number), base,
           machine.family() == Family::kF746 ? timer::kTableF7 : timer::kTable, gate),
      irq_(irq),
      width_mask_(number == 2 || number == 5 ? 0xFFFFFFFFu : 0xFFFFu) {
  TimerModel::reset();
}

void TimerModel::reset() {
  Bank::reset();
  reg(kArr) &= width_mask_;
  reload_ = reg(kArr);
  prescaler_ = 0;
  from_count_ = matched_ = 0;
  from_ = machine().now();
}

std::uint32_t TimerModel::top() const {
  return has(kCr1, kCr1Arpe) ? reload_ : reg(kArr) & width_mask_;
}

std::uint64_t TimerModel::count() const {
  if (!counts()) return from_count_;
  const std::uint64_t clocks = periods(machine().now() - from_, machine().rcc().timer_hz(base()));
  return from_count_ + clocks / (prescaler_ + 1);
}

Time TimerModel::when(std::uint64_t count) const {
  const std::uint64_t clocks = (count - from_count_) * (prescaler_ + 1);
  return from_ + duration(clocks, machine().rcc().timer_hz(base()));
}

void TimerModel::anchor(std::uint64_t count) {
  from_ = machine().now();
  from_count_ = count;
  matched_ = count;
}

void TimerModel::rebase() {
  const std::uint64_t matched = matched_;
  anchor(count());
  matched_ = std::max(matched, matched_);
}

Time TimerModel::next() const {
  if (!counts() || top() == 0) return kNever;  // ARR 0 stops the counter
  const std::uint64_t end =
      from_count_ > top() ? std::uint64_t{width_mask_} + 1 : std::uint64_t{top()} + 1;
  Time first = when(end);
  for (const std::uint32_t offset : {kCcr1, kCcr2, kCcr3, kCcr4}) {
    const std::uint32_t compare = reg(offset);
    if (compare > matched_ && compare < end) first = std::min(first, when(compare));
  }
  return first;
}

void TimerModel::run() {
  if (next() > machine().now()) return;
  const std::uint64_t end =
      from_count_ > top() ? std::uint64_t{width_mask_} + 1 : std::uint64_t{top()} + 1;
  const std::uint64_t now = std::min(count(), end);
  std::uint32_t flag = kSrCc1if;
  for (const std::uint32_t offset : {kCcr1, kCcr2, kCcr3, kCcr4}) {
    const std::uint32_t compare = reg(offset);
    if (compare > matched_ && compare <= now) set(kSr, flag);
    if (now == end && compare == 0) set(kSr, flag);
    flag <<= 1;
  }
  matched_ = now;
  if (now == end) {
    const Time at = when(end);
    update(false);
    from_ = at;
    from_count_ = matched_ = 0;
  }
  machine().touch();
}

void TimerModel::update(bool by_software) {
  if (has(kCr1, kCr1Udis)) return;
  ++updates_;
  prescaler_ = reg(kPsc);
  reload_ = reg(kArr) & width_mask_;
  if (!by_software || !has(kCr1, kCr1Urs)) set(kSr, kSrUif);
  if (!by_software && has(kCr1, kCr1Opm)) clear(kCr1, kCr1Cen);
}

void TimerModel::before_read(std::uint32_t offset) {
  if (offset == kCnt) reg(kCnt) = static_cast<std::uint32_t>(count()) & width_mask_;
}

void TimerModel::check_modes() {
  if (has(kCr1, kCr1Dir | kCr1Cms)) violate("only counting up is modelled");
  if (has(kSmcr, bits(0, 3))) violate("slave modes are not modelled");
}

void TimerModel::on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) {
  if (offset == kCr1) {
    check_modes();
    const bool was = (old & kCr1Cen) != 0;
    if (was && !counts()) {
      set(kCr1, kCr1Cen);
      const std::uint64_t stopped = count();
      clear(kCr1, kCr1Cen);
      anchor(stopped);
    }
    if (!was && counts()) anchor(from_count_);
  }
  if (offset == kSmcr) check_modes();
  if (offset == kCnt) anchor(raw & width_mask_);
  if (offset == kEgr && (raw & kEgrUg) != 0) {
    update(true);
    anchor(0);
  }
  if (offset == kEgr && (raw & ~kEgrUg) != 0) violate("only UG is modelled of EGR");
}

bool TimerModel::interrupt(unsigned irq) const {
  return irq == irq_ && (reg(kSr) & reg(kDier) & (bits(0, 5) | kSrTif)) != 0;
}

}  // namespace verp::hal::stm32::model
