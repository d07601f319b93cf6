#pragma once
#include "boards/stm32/hardware.hpp"
#include "common/control/boot_check.hpp"
#include "firmware/app/operator_registers.hpp"
#include "firmware/boot/crash.hpp"

namespace verp::board {

/// Takes the crash record: call once.
inline app::OperatorSetup operator_setup(const Start& start,
                                         const control::BootReport& boot_check) {
  using dxl::controller::BrownOut;
  using dxl::controller::ClockSource;
  using dxl::controller::ResetCause;
  using dxl::controller::SelfTest;
  // Values equal those of boot check and chip; self-test and clock are one higher.
  static_assert(static_cast<int>(SelfTest::kControl) ==
                static_cast<int>(control::BootVerdict::kControl) + 1);
  static_assert(static_cast<int>(ClockSource::kAbsent) ==
                static_cast<int>(stm32::ClockSource::kAbsent) + 1);
  static_assert(static_cast<int>(ResetCause::kLowPower) ==
                static_cast<int>(stm32::ResetCause::kLowPower));
  static_assert(static_cast<int>(BrownOut::kRefused) ==
                static_cast<int>(stm32::BrownOut::kRefused));
  app::OperatorSetup setup;
  setup.self_test = static_cast<SelfTest>(static_cast<int>(boot_check.verdict) + 1);
  setup.bad_field = boot_check.bad_field;
  setup.clock_source = static_cast<ClockSource>(static_cast<int>(start.clocks.source) + 1);
  setup.reset_cause = static_cast<ResetCause>(start.cause);
  setup.brown_out = static_cast<BrownOut>(start.brown_out);
  boot::CrashRecord crash;
  if (boot::take_crash(crash)) {
    setup.reset_cause = ResetCause::kFault;
    setup.crash = {
        .pc = crash.pc, .cause = crash.cause, .tick = crash.tick, .count = crash.crashes};
  }
  return setup;
}

}  // namespace verp::board
