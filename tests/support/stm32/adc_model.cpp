#include "tests/support/stm32/adc_model.hpp"

#include <string>

#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/rcc_model.hpp"
#include "tests/support/stm32/registers/adc_table.hpp"

namespace verp::hal::stm32::model {

using namespace adc;

namespace {

/// DS8626 table "ADC characteristics": power-up takes 3 us.
constexpr std::uint32_t kClockMax_hz = 36000000;
constexpr Time kPowerUp = us(3);

}  // namespace

AdcModel::AdcModel(Machine& machine, unsigned number, std::uint32_t base, Gate gate)
    : Bank(machine, "ADC" + std::to_string(number), base, adc::kTable, gate) {}

AdcCommonModel::AdcCommonModel(Machine& machine)
    : Bank(machine, "ADC common", base::kAdcCommon, adc::kCommonTable,
           {rcc::kApb2enr, rcc::kApb2Adc1 | rcc::kApb2Adc2 | rcc::kApb2Adc3, rcc::kApb2Adc1}) {}

void AdcModel::reset() {
  Bank::reset();
  done_at_ = kNever;
}

void AdcModel::start() {
  if (!has(kCr2, kCr2Adon)) return violate("SWSTART while ADON is 0");
  if (machine().now() < stable_at_) violate("SWSTART sooner than 3 us after ADON");
  if ((reg(kSqr1) >> 20 & 15u) != 0 || has(kCr1, bit(8)) || has(kCr2, kCr2Cont)) {
    violate("only single conversions of one channel are modelled");
  }
  if (channel() > 18) return violate("no such channel");
  const std::uint32_t prescaler =
      machine().bus_read(base::kAdcCommon + kCommonCcr, 4) >> kCcrAdcpreShift & 3u;
  const std::uint32_t clock = machine().rcc().bus_hz(base()) / (2 * (prescaler + 1));
  if (clock > kClockMax_hz) violate("ADC clock of " + std::to_string(clock) + " Hz");
  constexpr std::uint32_t kSampling[] = {3, 15, 28, 56, 84, 112, 144, 480};
  const std::uint32_t which = channel() < 10 ? reg(kSmpr2) >> (3 * channel()) & 7u
                                             : reg(kSmpr1) >> (3 * (channel() - 10)) & 7u;
  set(kSr, kSrStrt);
  done_at_ = machine().now() + duration(kSampling[which] + 12, clock);
}

void AdcModel::run() {
  if (next() > machine().now()) return;
  done_at_ = kNever;
  reg(kDr) = input[channel()];
  set(kSr, kSrEoc);
}

void AdcModel::after_read(std::uint32_t offset) {
  if (offset == kDr) clear(kSr, kSrEoc);
}

void AdcModel::on_write(std::uint32_t offset, std::uint32_t, std::uint32_t old) {
  if (offset != kCr2) return;
  if (has(kCr2, kCr2Adon) && (old & kCr2Adon) == 0) stable_at_ = machine().now() + kPowerUp;
  if (has(kCr2, kCr2Swstart)) {
    clear(kCr2, kCr2Swstart);
    start();
  }
}

bool AdcModel::interrupt(unsigned irq) const {
  return irq == irq::kAdc && has(kCr1, bit(5)) && has(kSr, kSrEoc);
}

}  // namespace verp::hal::stm32::model
