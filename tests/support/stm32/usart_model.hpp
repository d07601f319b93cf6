#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "hal/chip/stm32/registers/usart.hpp"
#include "tests/support/stm32/bank.hpp"
#include "tests/support/stm32/gpio_model.hpp"

/// A USART with the line at its pins. Received bytes come at the sender's baud rate. Modelled: 8
/// data bits without parity (9 bits as 8 with one more on the line), half duplex.
namespace verp::hal::stm32::model {

class UsartModel : public Bank {
 public:
  enum class Flaw : std::uint8_t { kNone, kNoise, kFraming, kBreak };
  struct Sent {
    std::uint8_t data;
    Time start, end;
    bool whole;  ///< direction pin always active, no other sender
  };

  UsartModel(Machine& machine, unsigned number, std::uint32_t base, Gate gate, unsigned irq);

  // Script.
  bool tx_stuck = false;  ///< TXE and TC stay 0
  Time dma_lag = 0;       ///< a busy DMA: a received byte may be read before its request is served
  /// The first byte at `start` or after earlier ones.
  void receive(const std::uint8_t* data, std::size_t size, std::uint32_t baud, Time start = 0);
  void receive(std::uint8_t data, std::uint32_t baud, Flaw flaw = Flaw::kNone, Time start = 0);
  /// An external half-duplex driver: sends only while the pin is `active`.
  void direction_pin(GpioModel& port, unsigned pin, bool active);
  /// Bytes pass only if the pin has this alternate function.
  void transmit_pin(GpioModel& port, unsigned pin, unsigned function) {
    tx_pin_ = {&port, pin, function};
  }
  void receive_pin(GpioModel& port, unsigned pin, unsigned function) {
    rx_pin_ = {&port, pin, function};
  }
  /// At each byte's stop bit.
  void on_sent(std::function<void(const Sent&)> watcher) { watcher_ = std::move(watcher); }

  const std::vector<Sent>& sent() const { return sent_; }
  void forget_sent() { sent_.clear(); }
  Time line_free_at() const { return line_free_at_; }
  double baud() const;  ///< from the registers

  void reset() override;
  void run() override;
  Time next() const override;
  bool dma_request(bool transmit) const override;
  bool interrupt(unsigned irq) const override;

 protected:
  void before_read(std::uint32_t offset) override;
  void after_read(std::uint32_t offset) override;
  bool may_write(std::uint32_t offset, std::uint32_t raw) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;
  bool narrow_ok(std::uint32_t offset, unsigned width) const override;

 private:
  struct Frame {
    Time start, end, bit;
    std::uint8_t data;
    Flaw flaw;
    bool own;  ///< its own echo
  };
  struct Pin {
    GpioModel* port = nullptr;
    unsigned pin = 0, function = 0;
    bool right() const { return port == nullptr || port->function(pin) == function; }
  };

  bool v2() const { return v2_; }
  std::uint32_t status() const { return v2_ ? usart_v2::kIsr : usart_v1::kSr; }
  std::uint32_t cr1() const { return v2_ ? usart_v2::kCr1 : usart_v1::kCr1; }
  std::uint32_t cr2() const { return v2_ ? usart_v2::kCr2 : usart_v1::kCr2; }
  std::uint32_t cr3() const { return v2_ ? usart_v2::kCr3 : usart_v1::kCr3; }
  std::uint32_t brr() const { return v2_ ? usart_v2::kBrr : usart_v1::kBrr; }
  bool on() const { return has(cr1(), v2_ ? usart_v2::kCr1Ue : usart_v1::kCr1Ue); }
  bool sends() const { return on() && has(cr1(), usart_v1::kCr1Te); }
  bool listens() const { return on() && has(cr1(), usart_v1::kCr1Re); }
  bool talking_allowed() const;
  std::uint32_t clock_hz() const;
  Time bit_time() const;
  Time frame_time() const;
  void data_written(std::uint32_t raw);
  void load();
  void end_of_frame();
  void control_written(std::uint32_t old);
  void request_written(std::uint32_t raw);
  void hear(const Frame& frame);

  unsigned number_;
  unsigned irq_;
  bool v2_;
  std::uint32_t seen_ = 0;  ///< by a read of SR
  std::uint32_t rx_data_ = 0;
  Time heard_at_ = 0;
  bool tx_full_ = false;
  std::uint32_t tx_data_ = 0;
  bool shifting_ = false;
  Sent shift_ = {};
  Time sends_from_ = 0, listens_from_ = 0;
  std::deque<Frame> line_;
  Time line_free_at_ = 0;
  Time idle_at_ = kNever;
  Pin tx_pin_, rx_pin_, direction_;
  bool direction_active_ = true;
  std::vector<Sent> sent_;
  std::function<void(const Sent&)> watcher_;
};

}  // namespace verp::hal::stm32::model
