#pragma once
#include <functional>
#include <vector>

#include "hal/chip/stm32/registers/gpio.hpp"
#include "tests/support/stm32/bank.hpp"

/// The functions of a port's pins, the levels they drive and the levels put on them.
namespace verp::hal::stm32::model {

class GpioModel : public Bank {
 public:
  GpioModel(Machine& machine, char port);

  /// From outside; open: the pull resistor decides (none: low).
  enum class Outside : std::uint8_t { kLow, kHigh, kOpen };
  void drive(unsigned pin, Outside level);
  /// Open-drain outputs at 1 leave it to the outside or the pull.
  bool level(unsigned pin) const;
  std::uint32_t mode(unsigned pin) const;
  /// 16: the pin is in another mode.
  unsigned function(unsigned pin) const;
  bool open_drain(unsigned pin) const;
  void on_change(std::function<void(unsigned, bool)> watcher) {
    watchers_.push_back(std::move(watcher));
  }
  void reset() override;

 protected:
  void before_read(std::uint32_t offset) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;
  bool narrow_ok(std::uint32_t, unsigned) const override { return false; }

 private:
  void watch();
  char port_;
  Outside outside_[16];
  std::uint32_t seen_ = 0;
  std::vector<std::function<void(unsigned, bool)>> watchers_;
};

}  // namespace verp::hal::stm32::model
