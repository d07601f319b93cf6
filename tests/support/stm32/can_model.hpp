#pragma once
#include <cstdint>
#include <deque>
#include <functional>

#include "common/base/can_frame.hpp"
#include "hal/chip/stm32/registers/can.hpp"
#include "tests/support/stm32/bank.hpp"

/// bxCAN; the test scripts the other nodes. Frames take the time of their bits without stuffing.
/// Modelled: normal mode, classic frames, 32-bit filters, both FIFOs, the transmitter's error
/// counters.
namespace verp::hal::stm32::model {

class CanModel : public Bank {
 public:
  struct Sent {
    CanFrame frame;
    unsigned mailbox;
    Time start, end;
  };

  /// `keeper` holds its filters from that bank on; null: itself.
  CanModel(Machine& machine, std::uint32_t base, Gate gate, unsigned first_irq,
           const CanModel* keeper = nullptr);

  // Script.
  bool init_stuck = false;     ///< INAK never sets
  bool line_dominant = false;  ///< nothing is sent or received
  bool acknowledged = true;    ///< another node receives us
  unsigned break_next = 0;     ///< our next frames with a bit error
  /// Called at a frame's end; true: an error frame destroys it and it is sent again.
  std::function<bool(const CanFrame&)> breaks = [](const CanFrame&) { return false; };
  bool abort_stuck = false;  ///< abort requests have no effect
  std::uint32_t bus_bitrate = 1'000'000;
  /// As soon as possible from `when` on.
  void send(const CanFrame& frame, Time when = 0);
  void on_sent(std::function<void(const Sent&)> watcher) { watcher_ = std::move(watcher); }

  const std::deque<Sent>& sent() const { return sent_; }
  void forget_sent() { sent_.clear(); }
  bool idle() const { return !talking_ && others_.empty(); }
  /// From the registers; 0 if there is no rate.
  double bitrate() const;
  double sample_point() const;

  void reset() override;
  void run() override;
  Time next() const override;
  bool interrupt(unsigned irq) const override;

 protected:
  void before_read(std::uint32_t offset) override;
  bool may_write(std::uint32_t offset, std::uint32_t raw) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;

 private:
  struct Waiting {
    CanFrame frame;
    Time when;
  };
  enum class Mode : std::uint8_t { kSleep, kInit, kNormal };

  bool pending(unsigned mailbox) const { return (pending_ & 1u << mailbox) != 0; }
  CanFrame frame_in(unsigned mailbox) const;
  std::uint32_t wanted_rank(unsigned mailbox) const;
  Time bit_time() const;
  Time frame_time(const CanFrame& frame) const;
  bool right_rate() const;
  void request_mode();
  void change_mode();
  void start_next();
  void end_of_frame();
  void break_other();
  void fail_transmission(std::uint32_t code);
  void close_mailbox(unsigned mailbox, std::uint32_t how);
  void abort(unsigned mailbox);
  void receive(const CanFrame& frame);
  bool passes(const CanFrame& frame, unsigned& fifo) const;
  void raise(std::uint32_t enable);
  void show_counters();
  void release(unsigned fifo);

  unsigned first_irq_;
  const CanModel* keeper_;
  Mode mode_ = Mode::kSleep;
  Time mode_at_ = kNever;
  Time recovered_at_ = kNever;
  std::uint32_t pending_ = 0;
  std::uint32_t order_[can::kMailboxes] = {};
  std::uint32_t requests_ = 0;
  bool talking_ = false;
  int mailbox_ = -1;  ///< -1: another node's frame
  CanFrame on_wire_;
  Time start_ = 0, end_ = 0, idle_at_ = 0;
  unsigned tec_ = 0;
  std::deque<Waiting> others_;
  std::deque<CanFrame> fifo_[can::kFifos];
  std::deque<Sent> sent_;  ///< a vector needs twice the memory
  std::function<void(const Sent&)> watcher_;
};

}  // namespace verp::hal::stm32::model
