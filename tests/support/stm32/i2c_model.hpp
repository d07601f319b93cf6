#pragma once
#include <cstdint>

#include "hal/chip/stm32/registers/i2c.hpp"
#include "tests/support/stm32/bank.hpp"
#include "tests/support/stm32/i2c_bus.hpp"

/// I2C masters of both kinds, byte by byte, 7-bit addresses, without DMA.
namespace verp::hal::stm32::model {

class I2cModel : public Bank {
 public:
  using Bank::Bank;
  I2cBus& bus() { return bus_; }
  std::uint32_t bytes() const { return bytes_; }
  /// The next so many bytes end with a bus error or a lost arbitration.
  std::uint32_t bus_errors = 0, arbitration_losses = 0;

 protected:
  I2cBus bus_;
  I2cDevice* device_ = nullptr;
  std::uint32_t bytes_ = 0;
};

class I2cV1Model : public I2cModel {
 public:
  I2cV1Model(Machine& machine, unsigned number, std::uint32_t base, Gate gate, unsigned event_irq);
  void reset() override;
  void run() override;
  Time next() const override;
  bool interrupt(unsigned irq) const override;

 protected:
  void before_read(std::uint32_t offset) override;
  void after_read(std::uint32_t offset) override;
  bool may_write(std::uint32_t offset, std::uint32_t raw) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;

 private:
  enum class Doing : std::uint8_t { kNothing, kStart, kAddress, kSend, kReceive, kStop };
  void begin(Doing what, unsigned bits);
  Time bit_time() const;
  void control_written(std::uint32_t old);
  void check_timing();
  void data_written();
  void address_done();
  void receive_next();
  void received();
  void finish_stop();
  bool fault();

  unsigned irq_;
  Doing doing_ = Doing::kNothing;
  Time done_at_ = kNever;
  std::uint32_t seen_ = 0;
  std::uint8_t shift_ = 0, rx_data_ = 0;
  bool tx_waiting_ = false;
  std::uint8_t tx_waiting_data_ = 0;
  bool shift_full_ = false;  ///< a received byte waits behind DR
  bool last_ = false;        ///< not acknowledged: the device sends no more
  bool ack_next_ = true;     ///< with POS: decided one byte before
};

class I2cV2Model : public I2cModel {
 public:
  I2cV2Model(Machine& machine, unsigned number, std::uint32_t base, Gate gate, unsigned event_irq);
  void reset() override;
  void run() override;
  Time next() const override;
  bool interrupt(unsigned irq) const override;

 protected:
  void after_read(std::uint32_t offset) override;
  bool may_write(std::uint32_t offset, std::uint32_t raw) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;

 private:
  enum class Doing : std::uint8_t { kNothing, kAddress, kSend, kReceive, kStop };
  void begin(Doing what, unsigned bits);
  Time bit_time() const;
  void start();
  void go_on();
  void ended();
  bool fault();
  std::uint32_t nbytes() const {
    return (reg(i2c_v2::kCr2) & i2c_v2::kCr2Nbytes) >> i2c_v2::kCr2NbytesShift;
  }

  unsigned irq_;
  unsigned number_;
  Doing doing_ = Doing::kNothing;
  Time done_at_ = kNever;
  std::uint32_t left_ = 0;
  bool reading_ = false;
};

}  // namespace verp::hal::stm32::model
