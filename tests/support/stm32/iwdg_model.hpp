#pragma once
#include "hal/chip/stm32/registers/iwdg.hpp"
#include "hal/chip/stm32/registers/memory_map.hpp"
#include "tests/support/stm32/bank.hpp"

/// Resets the machine unless reloaded in time. Only a reset stops it.
namespace verp::hal::stm32::model {

class IwdgModel : public Bank {
 public:
  explicit IwdgModel(Machine& machine);

  // Script.
  std::uint32_t lsi_hz = kLsi_hz;  ///< 17 to 47 kHz
  bool busy_stuck = false;         ///< PVU and RVU never fall

  bool started() const { return started_; }
  Time bites_at() const { return started_ ? bites_at_ : kNever; }

  void reset() override;
  void run() override;
  Time next() const override;

 protected:
  void before_read(std::uint32_t offset) override;
  bool may_write(std::uint32_t offset, std::uint32_t raw) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;

 private:
  void reload();
  Time step() const;

  bool unlocked_ = false, started_ = false;
  Time bites_at_ = kNever;
  Time prescaler_done_ = 0, reload_done_ = 0, window_done_ = 0;
};

}  // namespace verp::hal::stm32::model
