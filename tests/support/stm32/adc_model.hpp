#pragma once
#include <cstdint>

#include "hal/chip/stm32/registers/adc.hpp"
#include "tests/support/stm32/bank.hpp"

/// Single conversions of the first regular channel, started by software.
namespace verp::hal::stm32::model {

class AdcModel : public Bank {
 public:
  AdcModel(Machine& machine, unsigned number, std::uint32_t base, Gate gate);

  // Script.
  std::uint16_t input[19] = {};   ///< 12 bits, per channel
  bool conversion_stuck = false;  ///< EOC never comes

  void reset() override;
  void run() override;
  Time next() const override { return conversion_stuck ? kNever : done_at_; }
  bool interrupt(unsigned irq) const override;

 protected:
  void after_read(std::uint32_t offset) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;

 private:
  void start();
  unsigned channel() const { return reg(adc::kSqr3) & 31u; }
  Time done_at_ = kNever;
  Time stable_at_ = 0;
};

class AdcCommonModel : public Bank {
 public:
  explicit AdcCommonModel(Machine& machine);
};

}  // namespace verp::hal::stm32::model
