#pragma once
#include <cstdint>
#include <deque>
#include <vector>

#include "hal/chip/stm32/registers/spi.hpp"
#include "tests/support/stm32/bank.hpp"
#include "tests/support/stm32/gpio_model.hpp"

/// With devices on chip-select pins; 8-bit frames, and the F7's 4-byte FIFOs.
namespace verp::hal::stm32::model {

class SpiDevice {
 public:
  virtual ~SpiDevice() = default;
  virtual void select(bool selected, Time now) = 0;
  /// One byte each way, both complete at `now`.
  virtual std::uint8_t exchange(std::uint8_t out, Time now) = 0;
  /// `mode` is 0 or 3.
  virtual bool takes_mode(unsigned mode) const = 0;
  virtual std::uint32_t max_hz() const = 0;
};

class SpiModel : public Bank {
 public:
  SpiModel(Machine& machine, unsigned number, std::uint32_t base, Gate gate, unsigned irq);

  // Script.
  bool busy_stuck = false;    ///< no RXNE, BSY for ever
  bool overrun_next = false;  ///< the next byte overruns, whatever was fetched
  bool miso_stuck_high = false, miso_stuck_low = false;
  void attach(SpiDevice& device, GpioModel& port, unsigned select_pin);
  /// Nothing passes unless the pin has this alternate function.
  void wire(GpioModel& port, unsigned pin, unsigned function) {
    pins_.push_back({&port, pin, function});
  }

  std::uint32_t clock_hz() const;
  std::uint32_t exchanged() const { return exchanged_; }

  void reset() override;
  void run() override;
  Time next() const override { return shifting_ && !busy_stuck ? done_at_ : kNever; }
  bool dma_request(bool transmit) const override;
  bool interrupt(unsigned irq) const override;

 protected:
  void before_read(std::uint32_t offset) override;
  void after_read(std::uint32_t offset) override;
  bool may_write(std::uint32_t offset, std::uint32_t raw) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;
  bool narrow_ok(std::uint32_t offset, unsigned width) const override;

 private:
  struct Attached {
    SpiDevice* device;
    GpioModel* port;
    unsigned pin;
  };
  struct Pin {
    GpioModel* port;
    unsigned pin, function;
  };
  bool v2() const { return v2_; }
  bool enabled() const { return has(spi::kCr1, spi::kCr1Spe); }
  std::size_t depth() const { return v2_ ? 4 : 1; }
  void data_written(std::uint32_t raw);
  void control_written(std::uint32_t old);
  void load();
  std::uint8_t exchange(std::uint8_t out);
  void update_flags();

  unsigned irq_;
  bool v2_;
  std::deque<std::uint8_t> tx_, rx_;
  std::uint32_t dr_ = 0;
  bool shifting_ = false;
  std::uint8_t shift_ = 0;
  Time done_at_ = kNever;
  bool overrun_seen_data_ = false;  ///< DR was read
  std::vector<Attached> devices_;
  std::vector<Pin> pins_;
  std::uint32_t exchanged_ = 0;
};

}  // namespace verp::hal::stm32::model
