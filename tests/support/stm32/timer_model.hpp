#pragma once
#include "hal/chip/stm32/registers/timer.hpp"
#include "tests/support/stm32/bank.hpp"

/// A general-purpose timer that counts up; compare channels set flags. Slave modes, capture and
/// output pins are not modelled.
namespace verp::hal::stm32::model {

class TimerModel : public Bank {
 public:
  TimerModel(Machine& machine, unsigned number, std::uint32_t base, Gate gate, unsigned irq);

  std::uint32_t updates() const { return updates_; }
  void reset() override;
  void run() override;
  void rebase() override;
  Time next() const override;
  bool interrupt(unsigned irq) const override;

 protected:
  void before_read(std::uint32_t offset) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;

 private:
  bool counts() const { return has(timer::kCr1, timer::kCr1Cen); }
  std::uint32_t top() const;
  std::uint64_t count() const;
  Time when(std::uint64_t count) const;
  void anchor(std::uint64_t count);
  void update(bool by_software);
  void check_modes();

  unsigned irq_;
  std::uint32_t width_mask_;
  Time from_ = 0;
  std::uint64_t from_count_ = 0;
  std::uint64_t matched_ = 0;  ///< handled up to here
  std::uint32_t prescaler_ = 0, reload_ = 0;
  std::uint32_t updates_ = 0;
};

}  // namespace verp::hal::stm32::model
