#pragma once
#include "hal/chip/stm32/registers/pwr.hpp"
#include "tests/support/stm32/bank.hpp"
#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/registers/rcc_table.hpp"

/// Oscillators and PLL need time or never start, as scripted. A setting outside the chip's limits
/// is a violation when it takes effect.
namespace verp::hal::stm32::model {

class RccModel : public Bank {
 public:
  explicit RccModel(Machine& machine);

  // From switching on to ready; kNever: it does not start or lock.
  Time hse_start = ms(2);
  Time pll_lock = us(100);
  Time lsi_start = us(40);
  Time switch_time = ns(500);  ///< from SW to SWS
  bool sws_stuck = false;

  std::uint32_t sysclk_hz() const;
  std::uint32_t hclk_hz() const;
  std::uint32_t apb1_hz() const;
  std::uint32_t apb2_hz() const;
  std::uint32_t bus_hz(std::uint32_t base) const;
  std::uint32_t timer_hz(std::uint32_t base) const;
  std::uint32_t pll_hz() const;
  /// From the main PLL; 0 while that is off. PLLSAI is not modelled.
  std::uint32_t usb_hz() const;

  bool enabled(const Gate& gate) const { return (peek(gate.enable_offset) & gate.enable_bit) != 0; }
  /// The last access set the enable bit: no clock yet.
  bool settling(const Gate& gate) const {
    return gate.enable_offset == fresh_offset_ && (gate.enable_bit & fresh_bits_) != 0;
  }
  void clocks_settled() { fresh_bits_ = 0; }
  void flag_reset(ResetCause cause);
  void check_limits();

  void reset() override;
  void run() override;
  Time next() const override;

 protected:
  bool may_write(std::uint32_t offset, std::uint32_t raw) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;

 private:
  void control_written(std::uint32_t old);
  void oscillator(std::uint32_t old, std::uint32_t on, std::uint32_t ready, Time& at, Time takes);
  std::uint32_t source_hz(std::uint32_t source) const;
  std::uint32_t pll_input_hz() const;
  bool ready(std::uint32_t source) const;
  void configuration_written();
  void check_pll();

  Time hse_at_ = kNever, hsi_at_ = kNever, pll_at_ = kNever, lsi_at_ = kNever, switch_at_ = kNever;
  std::uint32_t fresh_offset_ = 0, fresh_bits_ = 0;
};

class PwrModel : public Bank {
 public:
  explicit PwrModel(Machine& machine);
  Time overdrive_time = us(100);
  bool overdrive_stuck = false;  ///< ODRDY and ODSWRDY never come

  bool backup_unlocked() const { return (peek(pwr::kCr) & pwr::kCrDbp) != 0; }
  bool overdrive() const;
  /// At this voltage scale.
  std::uint32_t hclk_max_hz() const;
  void run() override;
  Time next() const override { return at_; }
  void reset() override;

 protected:
  bool may_write(std::uint32_t offset, std::uint32_t raw) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;

 private:
  Time at_ = kNever;
};

}  // namespace verp::hal::stm32::model
