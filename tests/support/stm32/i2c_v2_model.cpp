#include <string>

#include "tests/support/stm32/i2c_model.hpp"
#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/rcc_model.hpp"

namespace verp::hal::stm32::model {

using namespace i2c_v2;

I2cV2Model::I2cV2Model(Machine& machine, unsigned number, std::uint32_t base, Gate gate,
                       unsigned event_irq)
    : I2cModel(machine, "I2C" + std::to_string(number), base, i2c_v2::kTable, gate),
      irq_(event_irq),
      number_(number) {}

void I2cV2Model::reset() {
  Bank::reset();
  doing_ = Doing::kNothing;
  done_at_ = kNever;
  device_ = nullptr;
  left_ = 0;
}

Time I2cV2Model::bit_time() const {
  const RccModel& rcc = machine().rcc();
  const std::uint32_t source = rcc.peek(rcc::kDckcfgr2F746) >> rcc::i2c_clock_shift(number_) & 3u;
  const std::uint32_t hz = source == 1   ? rcc.sysclk_hz()
                           : source == 2 ? kHsi_hz
                                         : rcc.bus_hz(base());
  const std::uint32_t timing = reg(kTimingr);
  const std::uint32_t low = (timing & 0xFF) + 1, high = (timing >> 8 & 0xFF) + 1;
  return duration(std::uint64_t{low + high} * ((timing >> 28) + 1), hz);
}

void I2cV2Model::begin(Doing what, unsigned bits) {
  doing_ = what;
  done_at_ = machine().now() + bit_time() * bits;
  machine().touch();
}

Time I2cV2Model::next() const {
  return bus_.clock_held() || bus_.data_held() ? kNever : done_at_;
}

bool I2cV2Model::fault() {
  if (bus_errors > 0) {
    --bus_errors;
    set(kIsr, kIsrBerr);
  } else if (arbitration_losses > 0) {
    --arbitration_losses;
    set(kIsr, kIsrArlo);
  } else {
    return false;
  }
  device_ = nullptr;
  clear(kIsr, kIsrBusy);
  clear(kCr2, kCr2Start | kCr2Stop);
  return true;
}

void I2cV2Model::start() {
  if (!has(kCr1, kCr1Pe)) return violate("START while PE is 0");
  if (bit_time() < ns(950)) violate("SCL faster than 1 MHz");
  if (has(kIsr, kIsrNackf | kIsrBerr | kIsrArlo)) violate("START while error flags are set");
  left_ = nbytes();
  reading_ = has(kCr2, kCr2RdWrn);
  clear(kIsr, kIsrTc | kIsrTcr);
  set(kIsr, kIsrBusy);
  begin(Doing::kAddress, 10);
}

void I2cV2Model::run() {
  if (next() > machine().now()) return;
  const Doing done = doing_;
  doing_ = Doing::kNothing;
  done_at_ = kNever;
  machine().touch();
  const Time now = machine().now();
  if (done == Doing::kStop) {
    if (device_ != nullptr) device_->end(now);
    device_ = nullptr;
    clear(kCr2, kCr2Stop);
    clear(kIsr, kIsrBusy | kIsrTc | kIsrTxis);
    set(kIsr, kIsrStopf | kIsrTxe);
    return;
  }
  ++bytes_;
  if (fault()) return;
  bool acknowledged = true;
  if (done == Doing::kAddress) {
    const auto address = static_cast<std::uint8_t>(reg(kCr2) >> 1 & 0x7F);
    clear(kCr2, kCr2Start);
    device_ = bus_.find(address, reading_, now);
    acknowledged = device_ != nullptr;
  } else if (done == Doing::kSend) {
    acknowledged = device_ != nullptr && device_->take(static_cast<std::uint8_t>(reg(kTxdr)), now);
    --left_;
  } else if (device_ != nullptr) {
    reg(kRxdr) = device_->give(now);
    set(kIsr, kIsrRxne);
    --left_;
    if (left_ > 0) return;  // the next byte comes when this one was read
  }
  if (!acknowledged) {
    set(kIsr, kIsrNackf);
    return begin(Doing::kStop, 1);  // the hardware sends STOP by itself
  }
  go_on();
}

void I2cV2Model::go_on() {
  if (left_ == 0) return ended();
  if (!reading_) {
    set(kIsr, kIsrTxis | kIsrTxe);
  } else if (!has(kIsr, kIsrRxne)) {
    begin(Doing::kReceive, 9);
  }
}

void I2cV2Model::ended() {
  if (has(kCr2, kCr2Reload)) {
    set(kIsr, kIsrTcr);
  } else if (has(kCr2, kCr2Autoend) || has(kCr2, kCr2Stop)) {
    begin(Doing::kStop, 1);
  } else {
    set(kIsr, kIsrTc);
  }
}

void I2cV2Model::after_read(std::uint32_t offset) {
  if (offset != kRxdr || !has(kIsr, kIsrRxne)) return;
  clear(kIsr, kIsrRxne);
  if (left_ > 0 && doing_ == Doing::kNothing) begin(Doing::kReceive, 9);
  machine().touch();
}

bool I2cV2Model::may_write(std::uint32_t offset, std::uint32_t raw) {
  if (offset == kTimingr && has(kCr1, kCr1Pe)) {
    violate("TIMINGR can only be written while PE is 0");
    return false;
  }
  const std::uint32_t fixed = kCr2Sadd | kCr2RdWrn;
  if (offset == kCr2 && has(kCr2, kCr2Start) && ((raw ^ reg(kCr2)) & fixed) != 0) {
    violate("address changed while START is set");
  }
  return true;
}

void I2cV2Model::on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) {
  if (offset == kIcr) clear(kIsr, raw & kIcrAll);
  if (offset == kCr1 && !has(kCr1, kCr1Pe)) {
    // RM0385 30.4.6: PE at 0 resets the communication; settings stay.
    doing_ = Doing::kNothing;
    done_at_ = kNever;
    device_ = nullptr;
    clear(kCr2, kCr2Start | kCr2Stop | kCr2Nack);
    reg(kIsr) = kIsrTxe;
  }
  if (offset == kTxdr) {
    if (!has(kIsr, kIsrTxis)) return violate("TXDR written while TXIS is 0");
    clear(kIsr, kIsrTxis | kIsrTxe);
    begin(Doing::kSend, 9);
  }
  if (offset != kCr2) return;
  const std::uint32_t rises = reg(kCr2) & ~old;
  if ((rises & kCr2Start) != 0) {
    start();
  } else if (has(kIsr, kIsrTcr) && nbytes() > 0) {
    clear(kIsr, kIsrTcr);
    left_ = nbytes();
    go_on();
  }
  if ((rises & kCr2Stop) != 0 && doing_ == Doing::kNothing) begin(Doing::kStop, 1);
}

bool I2cV2Model::interrupt(unsigned irq) const {
  if (irq == irq_) {
    const std::uint32_t enabled = reg(kCr1);
    return ((enabled & bit(1)) != 0 && has(kIsr, kIsrTxis)) ||
           ((enabled & bit(2)) != 0 && has(kIsr, kIsrRxne)) ||
           ((enabled & bit(4)) != 0 && has(kIsr, kIsrNackf)) ||
           ((enabled & bit(5)) != 0 && has(kIsr, kIsrStopf)) ||
           ((enabled & bit(6)) != 0 && has(kIsr, kIsrTc | kIsrTcr));
  }
  return irq == irq_ + 1 && has(kCr1, bit(7)) && has(kIsr, kIsrBerr | kIsrArlo | kIsrOvr);
}

}  // namespace verp::hal::stm32::model
