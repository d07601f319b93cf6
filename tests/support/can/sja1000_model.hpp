#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "hal/chip/sja1000/registers.hpp"
#include "tests/support/can/wire.hpp"

/// An SJA1000 in PeliCAN mode behind its registers, on a wire.
namespace verp::test {

class Sja1000Model : public CanNode {
 public:
  static constexpr std::uint64_t kAccess_us = 1;

  CanWire wire{*this};

  std::uint8_t read8(std::uint32_t offset);
  void write8(std::uint32_t offset, std::uint8_t value);
  void advance(std::uint64_t microseconds);
  /// Sleeps until the chip's interrupt or until `us`.
  void doze_until(std::uint64_t us);
  bool interrupt() const { return (ir_ & ier_) != 0 || ((ier_ & 1) != 0 && !fifo_.empty()); }

  bool off() const { return off_; }  ///< bus-off
  std::size_t violations() const { return violations_; }
  const std::string& first_violation() const { return first_violation_; }
  std::uint8_t btr(unsigned number) const { return btr_[number]; }
  bool in_reset() const { return (mod_ & hal::sja1000::kModReset) != 0; }
  std::size_t sleeps() const { return sleeps_; }

  const CanFrame* pending() const override { return requested_ && !off_ ? &tx_ : nullptr; }
  void begun() override { on_wire_ = true; }
  void sent() override;
  void failed() override;
  void heard(const CanFrame& frame) override;

 private:
  using Bytes = std::deque<std::uint8_t>;
  void command(std::uint8_t value);
  void mode(std::uint8_t value);
  void violate(const char* what, std::uint32_t offset);
  void leave_bus();
  CanFrame frame_in_buffer() const;
  static Bytes bytes_of(const CanFrame& frame);

  std::uint8_t mod_ = hal::sja1000::kModReset;
  std::uint8_t ir_ = 0, ier_ = 0, cdr_ = 0, ocr_ = 0;
  std::uint8_t btr_[2] = {}, filter_[8] = {}, buffer_[13] = {};
  std::deque<Bytes> fifo_;
  std::size_t fifo_bytes_ = 0;
  CanFrame tx_;
  bool requested_ = false, on_wire_ = false, abort_ = false, complete_ = true, overrun_ = false;
  bool off_ = false, ecc_read_ = true;
  std::uint64_t recovers_us_ = 0;
  ErrorCounter errors_;
  std::size_t violations_ = 0, sleeps_ = 0;
  std::string first_violation_;
};

class Sja1000ModelIo {
 public:
  explicit Sja1000ModelIo(Sja1000Model& model) : model_(&model) {}
  std::uint8_t read8(std::uint32_t offset) { return model_->read8(offset); }
  void write8(std::uint32_t offset, std::uint8_t value) { model_->write8(offset, value); }
  std::uint64_t now_us() { return model_->wire.now_us(); }
  bool mask_interrupts() { return true; }
  void unmask_interrupts() {}
  void doze_until(std::uint64_t us) { model_->doze_until(us); }

 private:
  Sja1000Model* model_;
};

}  // namespace verp::test
