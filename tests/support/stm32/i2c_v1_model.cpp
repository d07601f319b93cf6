#include <string>

#include "tests/support/stm32/i2c_model.hpp"
#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/rcc_model.hpp"

namespace verp::hal::stm32::model {

using namespace i2c_v1;

I2cV1Model::I2cV1Model(Machine& machine, unsigned number, std::uint32_t base, Gate gate,
                       unsigned event_irq)
    : I2cModel(machine, "I2C" + std::to_string(number), base,
               machine.family() == Family::kF405 ? i2c_v1::kTableF405 : i2c_v1::kTableF446, gate),
      irq_(event_irq) {}

void I2cV1Model::reset() {
  Bank::reset();
  doing_ = Doing::kNothing;
  done_at_ = kNever;
  seen_ = 0;
  tx_waiting_ = shift_full_ = last_ = false;
  device_ = nullptr;
}

Time I2cV1Model::bit_time() const {
  const std::uint32_t ccr = reg(kCcr) & kCcrCcr;
  const std::uint32_t factor = !has(kCcr, kCcrFs) ? 2 : has(kCcr, kCcrDuty) ? 25 : 3;
  return duration(std::uint64_t{factor} * ccr, machine().rcc().bus_hz(base()));
}

void I2cV1Model::check_timing() {
  const std::uint32_t freq = reg(kCr2) & kCr2Freq;
  if (freq != machine().rcc().bus_hz(base()) / 1000000) violate("FREQ is not the bus clock in MHz");
  const bool fast = has(kCcr, kCcrFs);
  const std::uint32_t ccr = reg(kCcr) & kCcrCcr;
  if (ccr < (fast ? 1u : 4u)) violate("CCR below its least value");
  const Time shortest = fast ? ns(2500) : us(10);
  if (bit_time() < shortest) violate("SCL faster than its mode allows");
  const std::uint32_t rise = fast ? freq * 300 / 1000 + 1 : freq + 1;
  if (reg(kTrise) > rise) violate("TRISE longer than the mode allows");
}

void I2cV1Model::begin(Doing what, unsigned bits) {
  doing_ = what;
  done_at_ = machine().now() + bit_time() * bits;
  machine().touch();
}

Time I2cV1Model::next() const {
  return bus_.clock_held() || bus_.data_held() ? kNever : done_at_;
}

bool I2cV1Model::fault() {
  if (bus_errors > 0) {
    --bus_errors;
    set(kSr1, kSr1Berr);
  } else if (arbitration_losses > 0) {
    --arbitration_losses;
    set(kSr1, kSr1Arlo);
    clear(kSr2, kSr2Msl);
  } else {
    return false;
  }
  device_ = nullptr;
  return true;
}

void I2cV1Model::run() {
  if (next() > machine().now()) return;
  const Doing done = doing_;
  doing_ = Doing::kNothing;
  done_at_ = kNever;
  machine().touch();
  if (done == Doing::kStart) {
    set(kSr1, kSr1Sb);
    set(kSr2, kSr2Msl | kSr2Busy);
    clear(kCr1, kCr1Start);
    return;
  }
  if (done == Doing::kStop) return finish_stop();
  ++bytes_;
  if (fault()) return;
  if (done == Doing::kAddress) return address_done();
  if (done == Doing::kReceive) return received();
  if (device_ == nullptr || !device_->take(shift_, machine().now())) {
    set(kSr1, kSr1Af);
  } else if (tx_waiting_) {
    tx_waiting_ = false;
    shift_ = tx_waiting_data_;
    set(kSr1, kSr1Txe);
    begin(Doing::kSend, 9);
    return;
  } else {
    set(kSr1, kSr1Txe | kSr1Btf);
  }
  if (has(kCr1, kCr1Stop)) begin(Doing::kStop, 1);
}

void I2cV1Model::address_done() {
  const bool read = (shift_ & 1) != 0;
  device_ = bus_.find(static_cast<std::uint8_t>(shift_ >> 1), read, machine().now());
  if (device_ == nullptr) {
    set(kSr1, kSr1Af);
    if (has(kCr1, kCr1Stop)) begin(Doing::kStop, 1);
    return;
  }
  set(kSr1, kSr1Addr);
  clear(kSr2, kSr2Tra);
  if (!read) set(kSr2, kSr2Tra);
  last_ = shift_full_ = false;
  ack_next_ = has(kCr1, kCr1Ack);
}

void I2cV1Model::receive_next() {
  if (last_ || shift_full_ || doing_ != Doing::kNothing || device_ == nullptr) return;
  begin(Doing::kReceive, 9);
}

void I2cV1Model::received() {
  const std::uint8_t byte = device_->give(machine().now());
  const bool acknowledged = has(kCr1, kCr1Pos) ? ack_next_ : has(kCr1, kCr1Ack);
  ack_next_ = has(kCr1, kCr1Ack);
  last_ = !acknowledged;
  if (has(kSr1, kSr1Rxne)) {
    shift_ = byte;
    shift_full_ = true;
    set(kSr1, kSr1Btf);
  } else {
    rx_data_ = byte;
    set(kSr1, kSr1Rxne);
  }
  if (has(kCr1, kCr1Stop)) {
    if (acknowledged) violate("STOP after a byte that was acknowledged: the device may hold SDA");
    begin(Doing::kStop, 1);
  } else {
    receive_next();
  }
}

void I2cV1Model::finish_stop() {
  if (device_ != nullptr) device_->end(machine().now());
  device_ = nullptr;
  clear(kCr1, kCr1Stop);
  clear(kSr2, kSr2Msl | kSr2Busy | kSr2Tra);
  clear(kSr1, kSr1Txe | kSr1Btf);
  if (has(kCr1, kCr1Start)) begin(Doing::kStart, 1);
}

void I2cV1Model::before_read(std::uint32_t offset) {
  if (offset == kDr) reg(kDr) = rx_data_;
  if (offset == kSr2 && (bus_.data_held() || bus_.clock_held()) && has(kCr1, kCr1Pe)) {
    set(kSr2, kSr2Busy);
  } else if (offset == kSr2 && !has(kSr2, kSr2Msl)) {
    clear(kSr2, kSr2Busy);
  }
}

void I2cV1Model::after_read(std::uint32_t offset) {
  if (offset == kSr1) seen_ = reg(kSr1);
  if (offset == kSr2 && (seen_ & kSr1Addr) != 0 && has(kSr1, kSr1Addr)) {
    clear(kSr1, kSr1Addr);
    seen_ = 0;
    if (has(kSr2, kSr2Tra)) {
      set(kSr1, kSr1Txe);
    } else {
      receive_next();
    }
  }
  if (offset == kDr && has(kSr1, kSr1Rxne)) {
    clear(kSr1, kSr1Rxne | kSr1Btf);
    if (shift_full_) {
      rx_data_ = shift_;
      shift_full_ = false;
      set(kSr1, kSr1Rxne);
    }
    if (has(kSr2, kSr2Msl)) receive_next();
  }
  machine().touch();
}

bool I2cV1Model::may_write(std::uint32_t offset, std::uint32_t raw) {
  if (offset == kOar1 && (raw & kOar1KeepSet) == 0) violate("bit 14 of OAR1 must be kept at 1");
  if ((offset == kCcr || offset == kTrise) && has(kCr1, kCr1Pe)) {
    violate("CCR and TRISE can only be written while PE is 0");
    return false;
  }
  return true;
}

void I2cV1Model::control_written(std::uint32_t old) {
  if (has(kCr1, kCr1Swrst)) {
    const std::uint32_t kept = kCr1Swrst;
    reset();
    set(kCr1, kept);
    return;
  }
  const std::uint32_t rises = reg(kCr1) & ~old;
  if (!has(kCr1, kCr1Pe)) {
    clear(kCr1, kCr1Start | kCr1Stop | kCr1Ack);
    doing_ = Doing::kNothing;
    done_at_ = kNever;
    return;
  }
  if ((rises & kCr1Start) != 0) {
    check_timing();
    if ((reg(kSr1) & kSr1Errors) != 0) violate("START while error flags are set");
    begin(Doing::kStart, 1);
  }
  const bool idle = doing_ == Doing::kNothing;
  if ((rises & kCr1Stop) != 0 && idle && !has(kSr1, kSr1Addr)) begin(Doing::kStop, 1);
}

void I2cV1Model::data_written() {
  const std::uint8_t data = static_cast<std::uint8_t>(reg(kDr));
  if (has(kSr1, kSr1Sb)) {
    if ((seen_ & kSr1Sb) == 0) violate("address written before SB was read");
    clear(kSr1, kSr1Sb);
    shift_ = data;
    return begin(Doing::kAddress, 9);
  }
  if (!has(kSr2, kSr2Tra) || !has(kSr1, kSr1Txe)) return violate("DR written while TXE is 0");
  clear(kSr1, kSr1Btf);
  if (doing_ == Doing::kSend) {
    tx_waiting_ = true;
    tx_waiting_data_ = data;
    clear(kSr1, kSr1Txe);
    return;
  }
  shift_ = data;
  begin(Doing::kSend, 9);
}

void I2cV1Model::on_write(std::uint32_t offset, std::uint32_t, std::uint32_t old) {
  if (offset == kCr1) control_written(old);
  if (offset == kDr) data_written();
  if (offset == kCr2 && has(kCr2, kCr2Dmaen)) violate("DMA is not modelled");
}

bool I2cV1Model::interrupt(unsigned irq) const {
  const std::uint32_t events = kSr1Sb | kSr1Addr | kSr1Btf;
  const std::uint32_t buffers = has(kCr2, kCr2Itbufen) ? kSr1Rxne | kSr1Txe : 0u;
  if (irq == irq_) return has(kCr2, kCr2Itevten) && has(kSr1, events | buffers);
  return irq == irq_ + 1 && has(kCr2, kCr2Iterren) && has(kSr1, kSr1Errors);
}

}  // namespace verp::hal::stm32::model
