#pragma once
#include <algorithm>
#include <cstdint>

#include "tests/hil/can_faults.hpp"
#include "tests/support/stm32/can_rig.hpp"

namespace verp::test {

/// bxCAN's driver on its register model; the other nodes are on a VirtualCan in the chip's time.
/// Seeds alternate between the chips.
class ChipLine final : public hal::CanBus {
 public:
  ChipLine(can::VirtualCan& bus, std::uint32_t seed)
      : trouble(bus, seed), bus_(bus), board_(static_cast<hal::stm32::Family>(seed % 3)) {
    board_.can.on_sent([this](const hal::stm32::model::CanModel::Sent& sent) {
      const CanFrame frame = sent.frame;
      board_.can.forget_sent();
      bus_.crossed(frame, now_ns());
      load();
    });
    board_.can.breaks = [this](const CanFrame&) {
      const bool broken = trouble.chance(trouble.faults.broken);
      trouble.damage().broken += broken ? 1 : 0;
      return broken;
    };
    work();
  }

  bool send(const CanFrame& frame) override { return board_.driver.send(frame); }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    return board_.driver.poll(frame, timeout_us);
  }
  std::uint64_t now_us() override { return board_.driver.now_us(); }
  hal::CanErrors errors() const override { return board_.driver.errors(); }

  std::uint64_t time_us() const { return board_.rig.timer.now_us(); }
  void wait_until(std::uint64_t until_us) {
    const std::uint64_t now = time_us();
    if (now < until_us) board_.rig.machine.advance(hal::stm32::model::us(until_us - now));
  }
  /// An error at each attempt, for `frames` frames.
  void break_own(unsigned frames) { board_.can.break_next = frames; }
  void short_circuit(bool yes) {
    board_.can.line_dominant = yes;
    board_.rig.machine.touch();
  }

  CanTrouble trouble;

 private:
  std::uint64_t now_ns() const { return board_.rig.machine.now() / 1000; }
  void load() {
    for (CanFrame frame; bus_.take_said(frame);) board_.can.send(frame);
  }
  void work() {
    bus_.work_until(now_ns());
    load();
    board_.rig.machine.at(board_.rig.machine.now() + hal::stm32::model::ms(1), [this] { work(); });
  }

  can::VirtualCan& bus_;
  hal::stm32::test::CanRig board_;
};

}  // namespace verp::test
