#include <gtest/gtest.h>

#include "tests/host/stm32_model/usb_device.hpp"
#include "tests/support/stm32/registers/otg_fs_table.hpp"

namespace verp::hal::stm32::model {
namespace {

using namespace otg_fs;

constexpr UsbSetup kGetDescriptor = {.type = 0x80, .request = 6, .value = 0x100, .length = 64};

TEST(OtgFs, StuckBitsStay) {
  UsbDevice device(Family::kF746);
  const std::uint32_t grstctl = base::kOtgFs + kGrstctl;
  device.put(kGrstctl, kGrstctlCsrst);
  EXPECT_TRUE(wait_clear(device.machine, grstctl, kGrstctlCsrst, ms(1)));
  device.core.flush_stuck = true;
  device.put(kGrstctl, kGrstctlRxfflsh);
  EXPECT_FALSE(wait_clear(device.machine, grstctl, kGrstctlRxfflsh, ms(1)));
  device.core.core_reset_stuck = true;
  device.put(kGrstctl, kGrstctlCsrst);
  EXPECT_FALSE(wait_clear(device.machine, grstctl, kGrstctlCsrst, ms(1)));
  EXPECT_EQ(device.machine.violations_text(), "");
  device.put(kGahbcfg, kGahbcfgGint);
  EXPECT_TRUE(one_violation(device.machine, "while CSRST is set"));
  UsbDevice busy(Family::kF405);
  busy.core.ahb_busy = true;
  EXPECT_FALSE(wait_set(busy.machine, grstctl, kGrstctlAhbidl, ms(1)));
  busy.put(kGrstctl, kGrstctlCsrst);
  EXPECT_TRUE(one_violation(busy.machine, "AHBIDL"));
}

TEST(OtgFs, DisablingNeedsNakFirstAndTakesItsTime) {
  UsbDevice device(Family::kF405);
  ASSERT_TRUE(device.ready());
  device.send(1, ramp(8));
  device.change(diepctl(1), 0, kEpctlSnak);
  EXPECT_NE(device.get(diepint(1)) & kDiepInepne, 0u);
  device.change(diepctl(1), 0, kEpctlEpdis);
  EXPECT_TRUE(wait_set(device.machine, base::kOtgFs + diepint(1), kDiepEpdisd, ms(1)));
  EXPECT_EQ(device.get(diepctl(1)) & (kEpctlEpena | kEpctlEpdis), 0u);
  device.put(kGrstctl, kGrstctlTxfflsh | 1u << kGrstctlTxfnumShift);
  EXPECT_EQ(device.get(dtxfsts(1)), 64u);
  device.change(kDctl, 0, kDctlSgonak);
  EXPECT_EQ(device.host.out(1, ramp(1)), UsbResult::kNaked);
  device.poll();
  EXPECT_NE(device.get(kGintsts) & kGintGonakeff, 0u);
  device.change(doepctl(1), 0, kEpctlEpdis | kEpctlSnak);
  EXPECT_TRUE(wait_set(device.machine, base::kOtgFs + doepint(1), kDoepEpdisd, ms(1)));
  EXPECT_EQ(device.machine.violations_text(), "");
}

TEST(OtgFs, WhatTheManualForbidsIsSeen) {
  UsbDevice device(Family::kF446);
  ASSERT_TRUE(device.ready());
  Machine& machine = device.machine;
  device.put(fifo(1), 0);
  EXPECT_TRUE(one_violation(machine, "isn't enabled"));
  device.get(fifo(0));
  EXPECT_TRUE(one_violation(machine, "beyond what the last status word"));
  device.get(kGrxstsp);
  EXPECT_TRUE(one_violation(machine, "RXFLVL is 0"));
  device.change(diepctl(2), 0, kEpctlEpena);
  EXPECT_TRUE(one_violation(machine, "without USBAEP"));
  device.change(diepctl(1), 0, kEpctlEpdis);
  EXPECT_TRUE(one_violation(machine, "isn't enabled"));
  device.put(dieptsiz(1), 4 | 2u << kTsizPktcntShift);
  device.change(diepctl(1), 0, kEpctlEpena | kEpctlSnak);
  EXPECT_TRUE(one_violation(machine, "PKTCNT"));
  device.change(diepctl(1), 0, kEpctlEpdis);
  machine.advance(us(10));
  device.put(doeptsiz(0), 24 | 1u << kTsizPktcntShift);
  device.change(doepctl(0), 0, kEpctlEpena);
  EXPECT_TRUE(one_violation(machine, "no multiple"));
  device.send(1, ramp(4));
  device.put(fifo(1), 0);
  EXPECT_TRUE(one_violation(machine, "beyond XFRSIZ"));
  device.put(dieptsiz(1), 0);
  EXPECT_TRUE(one_violation(machine, "while EPENA is set"));
  device.change(diepctl(1), kEpctlMpsiz, 32);
  EXPECT_TRUE(one_violation(machine, "configured while EPENA"));
  device.change(diepctl(1), kEpctlMpsiz, 64);
  machine.forget_violations();
  device.change(diepctl(1), 0, kEpctlEpdis);
  EXPECT_TRUE(one_violation(machine, "without NAK"));
  device.put(dieptxf(1), 192 | 32u << kDieptxfDepthShift);
  EXPECT_TRUE(one_violation(machine, "written while the FIFO has data"));
  device.put(kGrstctl, kGrstctlTxfflsh | kGrstctlAllTxFifos);
  device.put(kGrstctl, kGrstctlRxfflsh);
  machine.forget_violations();
  device.change(doepctl(1), 0, kEpctlEpdis);
  EXPECT_TRUE(one_violation(machine, "without global OUT NAK"));
  device.change(kPcgcctl, 0, kPcgcctlStppclk);
  EXPECT_TRUE(one_violation(machine, "isn't suspended"));
}

TEST(OtgFs, FifosThatOverflowOverlapOrDoNotFitAreSeen) {
  UsbDevice device(Family::kF405);
  ASSERT_TRUE(device.ready());
  Machine& machine = device.machine;
  device.announce(1, 320);
  for (int i = 0; i < 64; ++i) device.put(fifo(1), 0);
  EXPECT_EQ(machine.violations_text(), "");
  device.put(fifo(1), 0);
  EXPECT_TRUE(one_violation(machine, "full: a word is lost"));
  struct {
    std::uint32_t start, depth;
    const char* why;
  } const layouts[] = {{192, 15, "less than 16"},
                       {288, 33, "beyond the memory"},
                       {100, 20, "overlaps the receive"},
                       {180, 64, "overlaps that of"}};
  for (const auto& layout : layouts) {
    UsbDevice other(Family::kF746);
    ASSERT_TRUE(other.ready());
    other.put(dieptxf(1), layout.start | layout.depth << kDieptxfDepthShift);
    other.announce(1, 4);
    EXPECT_TRUE(one_violation(other.machine, layout.why)) << layout.why;
  }
}

TEST(OtgFs, AWrongClockOrTurnaroundIsSeen) {
  UsbDevice device(Family::kF405);
  device.start();
  device.change(kGusbcfg, kGusbcfgTrdt, 5u << kGusbcfgTrdtShift);
  EXPECT_TRUE(device.host.plug());
  device.host.control(kGetDescriptor);
  EXPECT_TRUE(one_violation(device.machine, "TRDT"));
  Machine machine(Family::kF746);
  ModelIo io = machine.io();
  io.write32(base::kOtgFs + kGccfg, kGccfgPwrdwn);
  EXPECT_TRUE(one_violation(machine, "while its clock is off"));
  enable(io, rcc::kAhb2enr, rcc::kAhb2OtgFs);
  io.write32(base::kOtgFs + kGccfg, kGccfgPwrdwn);
  EXPECT_TRUE(one_violation(machine, "not 48 MHz"));
  UsbDevice inexact(Family::kF405, kNever);
  inexact.start();
  EXPECT_TRUE(one_violation(inexact.machine, "internal oscillator"));
}

}  // namespace
}  // namespace verp::hal::stm32::model
