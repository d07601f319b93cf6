#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "hal/chip/stm32/registers/otg_fs.hpp"
#include "tests/support/stm32/bank.hpp"

/// A USB full-speed device: registers on one side, the host's tokens on the other (usb_host.hpp).
///
/// Modelled: control, bulk and interrupt endpoints by FIFO and status words, NAK, STALL, toggles,
/// global NAKs, flushes, disabling, core reset, VBUS, bus reset, suspend, resume, remote wakeup.
/// Not modelled: host mode, isochronous transfers, LPM, battery charging, test modes, the wakeup's
/// EXTI line, STSPHSRX of the newer core. TXFNUM must be the endpoint's number.
namespace verp::hal::stm32::model {

enum class UsbAnswer : std::uint8_t { kAck, kNak, kStall, kNone };

/// Answer to an IN token; kAck stands for data.
struct UsbPacket {
  UsbAnswer answer = UsbAnswer::kNone;
  bool data1 = false;
  std::vector<std::uint8_t> bytes;
};

class OtgFsModel : public Bank {
 public:
  explicit OtgFsModel(Machine& machine);

  // Script.
  Time core_reset_time = us(1);
  Time flush_time = ns(500);
  Time disable_time = us(2);      ///< from EPDIS to EPDISD
  bool core_reset_stuck = false;  ///< CSRST stays set
  bool ahb_busy = false;          ///< AHBIDL stays 0
  bool flush_stuck = false;       ///< RXFFLSH and TXFFLSH stay set
  bool disable_stuck = false;     ///< EPDISD never comes

  void set_vbus(bool on);
  bool vbus() const { return vbus_; }
  bool pulled_up() const;
  void begin_reset();  ///< SE0 begins
  void end_reset();    ///< a full-speed device is found, frames start
  UsbAnswer setup(unsigned address, const std::uint8_t (&request)[8]);
  UsbAnswer out(unsigned address, unsigned endpoint, bool data1, const std::uint8_t* bytes,
                std::size_t count);
  UsbPacket in(unsigned address, unsigned endpoint, bool acknowledged);
  void idle();    ///< no frames: suspend follows
  void resume();  ///< frames start again
  bool wakes_host() const;

  void reset() override;
  void run() override;
  Time next() const override;
  bool interrupt(unsigned irq) const override;

 protected:
  std::uint32_t fold(std::uint32_t offset) const override;
  void before_read(std::uint32_t offset) override;
  void after_read(std::uint32_t offset) override;
  bool may_write(std::uint32_t offset, std::uint32_t raw) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;

 private:
  struct In {
    std::deque<std::uint32_t> fifo;
    bool data1 = false;
    std::uint32_t total = 0, pushed = 0, sent = 0;
  };
  struct Out {
    bool data1 = false;
  };
  struct Received {
    bool status;
    std::uint32_t word;
  };
  static constexpr unsigned kEndpointsMax = 6;

  // otg_fs_model.cpp
  void add_tables();
  void later(Time delay, std::function<void()> what);
  void reset_core();
  bool awake(std::uint32_t offset, const char* what) const;
  bool session_valid() const;
  void refresh();
  void refresh_endpoints();
  void pop_status();
  void pop_data();

  // otg_fs_control.cpp
  void reset_written(std::uint32_t raw, std::uint32_t old);
  void flush_transmit(std::uint32_t number);
  void device_control_written(std::uint32_t raw, std::uint32_t old);
  void power_written();
  void check_clocks();

  // otg_fs_endpoints.cpp
  bool may_write_endpoint(std::uint32_t offset, std::uint32_t raw);
  void in_written(unsigned endpoint, std::uint32_t raw, std::uint32_t old);
  void out_written(unsigned endpoint, std::uint32_t raw, std::uint32_t old);
  void nak_written(std::uint32_t control, std::uint32_t raw);
  void start_in(unsigned endpoint);
  void start_out(unsigned endpoint);
  void check_fifo(unsigned endpoint);
  void disable(unsigned endpoint, bool in, std::uint32_t old);
  void push(unsigned endpoint, std::uint32_t word);
  std::uint32_t max_packet(unsigned endpoint, bool in) const;
  std::string named(bool in, unsigned endpoint) const;

  // otg_fs_wire.cpp
  void run_wire();
  void changed();
  bool listens(unsigned address) const;
  void take_address();
  bool active(unsigned endpoint, bool in) const;
  void end_setup();
  void check_ready();
  void receive(std::uint32_t status, unsigned endpoint, bool data1, const std::uint8_t* bytes,
               std::size_t count);
  bool has_room(std::size_t bytes) const;
  std::uint32_t depth(unsigned endpoint) const;
  void packet_sent(unsigned endpoint, std::uint32_t bytes);
  void packet_taken(unsigned endpoint, std::size_t bytes);

  bool v2_;
  unsigned endpoints_;
  In in_[kEndpointsMax];
  Out out_[kEndpointsMax];
  std::deque<Received> received_;
  std::vector<std::pair<Time, std::function<void()>>> due_;
  bool vbus_ = false, session_ = false;
  Time frame_at_ = kNever, early_suspend_at_ = kNever, suspend_at_ = kNever;
  std::uint32_t frame_ = 0;
  bool enumerated_ = false, setup_open_ = false, global_out_nak_ = false, checked_ = false;
  /// Within 0.25 % (USB 2.0, 7.1.11); HSI is within 1 %.
  static constexpr bool usb_clock_ok(std::uint32_t hz) {
    return hz >= 47'880'000 && hz <= 48'120'000;
  }

  /// A DAD written during a control transfer takes effect at its end.
  unsigned address_ = 0;
  bool control_open_ = false;
  Time device_from_ = 0;
  Time wakeup_from_ = 0;
};

}  // namespace verp::hal::stm32::model
