#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "hal/chip/zynqmp_can/registers.hpp"
#include "hal/chip/zynqmp_can/zynqmp_can.hpp"
#include "tests/support/can/wire.hpp"

/// A CAN controller of Zynq UltraScale+ on a wire.
namespace verp::test {

class ZynqmpCanRegisters : public CanNode {
 public:
  static constexpr std::uint64_t kAccess_us = 1;

  /// `as_qemu`: FIFOs as in QEMU 7.2.
  explicit ZynqmpCanRegisters(bool as_qemu) : as_qemu_(as_qemu) {}

  CanWire wire{*this};

  std::uint32_t read32(std::uint32_t offset);
  void write32(std::uint32_t offset, std::uint32_t value);
  void advance(std::uint64_t microseconds) { wire.advance(microseconds); }

  bool off() const { return off_; }  ///< bus-off
  std::size_t violations() const { return violations_; }
  const std::string& first_violation() const { return first_violation_; }
  std::uint32_t brpr() const { return brpr_; }
  std::uint32_t btr() const { return btr_; }
  bool joined() const { return (srr_ & hal::zynqmp_can::kSrrEnable) != 0; }

  const CanFrame* pending() const override {
    return joined() && !off_ && !tx_.empty() ? &tx_.front() : nullptr;
  }
  void begun() override {}
  void sent() override;
  void failed() override;
  void heard(const CanFrame& frame) override;

 private:
  void violate(const char* what, std::uint32_t offset);
  void reset();
  void queue_transmission();
  CanFrame from_words();
  std::uint32_t received_word(std::uint32_t offset) const;

  bool as_qemu_;
  std::uint32_t srr_ = 0, brpr_ = 0, btr_ = 0, isr_ = 0, ier_ = 0, esr_ = 0, out_[4] = {};
  std::deque<CanFrame> tx_;
  std::deque<CanFrame> rx_;
  bool off_ = false;
  ErrorCounter errors_;
  std::size_t violations_ = 0;
  std::string first_violation_;
};

template <hal::zynqmp_can::Layout kLayout>
class ZynqmpCanModel : public ZynqmpCanRegisters {
 public:
  ZynqmpCanModel() : ZynqmpCanRegisters(kLayout == hal::zynqmp_can::Layout::kQemu) {}
};

/// It never sleeps, as on the emulated board.
template <hal::zynqmp_can::Layout kLayout>
class ZynqmpCanModelIo {
 public:
  explicit ZynqmpCanModelIo(ZynqmpCanModel<kLayout>& model) : model_(&model) {}
  std::uint32_t read32(std::uint32_t offset) { return model_->read32(offset); }
  void write32(std::uint32_t offset, std::uint32_t value) { model_->write32(offset, value); }
  std::uint64_t now_us() { return model_->wire.now_us(); }
  void doze_until(std::uint64_t) {}

 private:
  ZynqmpCanModel<kLayout>* model_;
};

}  // namespace verp::test
