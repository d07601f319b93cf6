#include <gtest/gtest.h>

#include "hal/chip/stm32/interrupts.hpp"
#include "hal/chip/stm32/registers/otg_fs_tables.hpp"
#include "tests/host/stm32_model/usb_device.hpp"

namespace verp::hal::stm32::model {
namespace {

using namespace otg_fs;

std::vector<std::uint8_t> ramp(std::size_t count) {
  std::vector<std::uint8_t> bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(3 * i + 1);
  return bytes;
}

constexpr UsbSetup kGetDescriptor = {.type = 0x80, .request = 6, .value = 0x100, .length = 64};

TEST(OtgFs, AHostFindsAddressesAndConfiguresADeviceOfEveryFamily) {
  for (const Family family : kFamilies) {
    UsbDevice device(family);
    EXPECT_TRUE(device.ready());
    EXPECT_EQ(device.host.address(), 7);
    const UsbReply reply = device.host.control(kGetDescriptor);
    EXPECT_EQ(reply.result, UsbResult::kDone);
    EXPECT_EQ(reply.bytes, device.answer);
    EXPECT_EQ(device.machine.violations_text(), "");
  }
}

TEST(OtgFs, ControlDataOfAnyLengthArrivesBothWays) {
  for (const Family family : kFamilies) {
    for (const std::size_t length : {1u, 3u, 8u, 63u, 64u}) {
      UsbDevice device(family);
      ASSERT_TRUE(device.ready());
      device.answer = ramp(length);
      UsbSetup read = kGetDescriptor;
      read.length = static_cast<std::uint16_t>(length);
      EXPECT_EQ(device.host.control(read).bytes, ramp(length));
      const UsbSetup write = {.type = 0x21, .request = 0x20, .length = read.length};
      EXPECT_EQ(device.host.control(write, ramp(length)).result, UsbResult::kDone);
      EXPECT_EQ(device.written, ramp(length));
      EXPECT_EQ(device.machine.violations_text(), "");
    }
  }
}

TEST(OtgFs, BulkDataOfAnyLengthArrivesBothWaysWhenAcknowledgementsGetLost) {
  for (const std::uint32_t lost : {0u, 1u, 2u}) {
    for (const std::size_t length : {0u, 1u, 5u, 64u, 65u, 200u}) {
      UsbDevice device(Family::kF746);
      ASSERT_TRUE(device.ready());
      device.host.lose_acks = lost;
      EXPECT_EQ(device.host.out(1, ramp(length)), UsbResult::kDone);
      device.host.pass(ms(1));
      EXPECT_EQ(device.received, ramp(length));
      device.host.lose_acks = lost;
      device.send(1, ramp(length));
      const UsbReply reply = device.host.in(1, length);
      EXPECT_EQ(reply.result, UsbResult::kDone);
      EXPECT_EQ(reply.bytes, ramp(length));
      // The core keeps a last packet whose ACK got lost: the host had it, and doesn't ask again.
      EXPECT_TRUE(lost != 0 || (device.get(diepint(1)) & kDiepXfrc) != 0);
      EXPECT_EQ(device.machine.violations_text(), "");
    }
  }
}

TEST(OtgFs, TheOldToggleMarksAPacketThatTheHostAlreadyHas) {
  UsbDevice device(Family::kF405);
  ASSERT_TRUE(device.ready());
  device.host.lose_acks = 1;
  device.send(1, ramp(70));
  EXPECT_EQ(device.host.in(1, 70).bytes, ramp(70));
  EXPECT_EQ(device.host.duplicates(), 1u);
}

TEST(OtgFs, NothingToSendAndNoRoomAreNaks) {
  UsbDevice device(Family::kF446);
  ASSERT_TRUE(device.ready());
  EXPECT_EQ(device.host.in(1, 64).result, UsbResult::kNaked);
  EXPECT_NE(device.get(diepint(1)) & kDiepIttxfe, 0u);
  EXPECT_NE(device.get(diepint(1)) & kDiepNak, 0u);  // told by the newer core only
  device.polling = false;  // nobody empties the FIFO: one packet is taken, the next is not
  EXPECT_EQ(device.host.out(1, ramp(64)), UsbResult::kDone);
  EXPECT_EQ(device.host.out(1, ramp(64)), UsbResult::kNaked);
  device.polling = true;
  EXPECT_EQ(device.host.out(1, ramp(64)), UsbResult::kDone);
  EXPECT_EQ(device.machine.violations_text(), "");
}

TEST(OtgFs, TheReceiveFifoTakesWhatItsWordsHold) {
  UsbDevice device(Family::kF405);
  device.window = 640;
  ASSERT_TRUE(device.ready());
  device.polling = false;
  // 128 words; a packet has 16 and its status word, and room is kept for the word of the end.
  for (int packet = 0; packet < 7; ++packet) {
    EXPECT_EQ(device.host.out(1, ramp(64)), UsbResult::kDone);
  }
  EXPECT_EQ(device.host.out(1, ramp(64)), UsbResult::kNaked);
  EXPECT_EQ(device.get(doepctl(1)) & kEpctlNaksts, 0u);
  device.polling = true;
  EXPECT_EQ(device.host.out(1, ramp(64)), UsbResult::kDone);
  device.polling = false;
  EXPECT_EQ(device.host.out(1, ramp(3)), UsbResult::kDone);  // short: the transfer ends early
  EXPECT_NE(device.get(doepctl(1)) & kEpctlNaksts, 0u);
  EXPECT_EQ(device.host.out(1, ramp(3)), UsbResult::kNaked);
  device.polling = true;
  device.poll();
  EXPECT_EQ(device.received.size(), 8 * 64 + 3u);
  EXPECT_EQ(device.machine.violations_text(), "");
}

TEST(OtgFs, AStalledRequestEndsAndTheNextSetupClearsIt) {
  UsbDevice device(Family::kF746);
  ASSERT_TRUE(device.ready());
  device.refuse = true;
  EXPECT_EQ(device.host.control(kGetDescriptor).result, UsbResult::kStalled);
  EXPECT_EQ(device.host.control({.type = 0x21, .request = 9}).result, UsbResult::kStalled);
  device.refuse = false;
  EXPECT_EQ(device.host.control(kGetDescriptor).bytes, device.answer);
}

TEST(OtgFs, AHaltedBulkEndpointStallsUntilSoftwareClearsIt) {
  UsbDevice device(Family::kF405);
  ASSERT_TRUE(device.ready());
  device.change(diepctl(1), 0, kEpctlStall);
  EXPECT_EQ(device.host.in(1, 64).result, UsbResult::kStalled);
  device.change(diepctl(1), kEpctlStall, kEpctlSd0pid);
  device.send(1, ramp(2));
  EXPECT_EQ(device.host.in(1, 64).bytes, ramp(2));
}

TEST(OtgFs, StatusWordsTellSetupDataAndEndsInOrder) {
  UsbDevice device(Family::kF746);
  ASSERT_TRUE(device.ready());
  device.polling = false;
  device.host.patience = us(100);
  device.host.control({.type = 0x80, .request = 6, .value = 0x2211, .length = 4});
  const std::uint32_t peeked = device.get(kGrxstsr);
  const std::uint32_t setup = device.get(kGrxstsp);
  EXPECT_EQ(peeked, setup);
  EXPECT_EQ((setup & kGrxstsPktsts) >> kGrxstsPktstsShift, kPacketSetup);
  EXPECT_EQ((setup & kGrxstsBcnt) >> kGrxstsBcntShift, 8u);
  EXPECT_EQ(device.get(fifo(0)), 0x22110680u);
  EXPECT_EQ(device.get(fifo(3) + 0xFFC), 0x00040000u);  // any window reads the one receive FIFO
  EXPECT_EQ(device.get(doepint(0)) & kDoepStup, 0u);
  const std::uint32_t done = device.get(kGrxstsp);
  EXPECT_EQ((done & kGrxstsPktsts) >> kGrxstsPktstsShift, kPacketSetupDone);
  EXPECT_NE(device.get(doepint(0)) & kDoepStup, 0u);
  EXPECT_EQ(device.get(kGintsts) & kGintRxflvl, 0u);
  EXPECT_EQ(device.machine.violations_text(), "");
}

TEST(OtgFs, TheInterruptNeedsItsMasksAndGint) {
  UsbDevice device(Family::kF746);
  device.start();
  unsigned calls = 0;
  device.machine.attach(irq::kOtgFs, [&] {
    ++calls;
    device.put(kGintsts, kGintSof);
  });
  enable_interrupt(device.io, irq::kOtgFs, 12);
  EXPECT_TRUE(device.host.plug());
  EXPECT_EQ(calls, 0u);
  device.change(kGintmsk, 0, kGintSof);
  device.host.pass(ms(5));
  EXPECT_EQ(calls, 0u);
  device.change(kGahbcfg, 0, kGahbcfgGint);
  calls = 0;
  device.host.pass(ms(5));
  EXPECT_EQ(calls, 5u);  // a frame is a millisecond
}

TEST(OtgFs, EndpointInterruptsPassDaintAndItsMasks) {
  UsbDevice device(Family::kF405);
  ASSERT_TRUE(device.ready());
  device.send(1, ramp(4));
  device.host.in(1, 4);
  EXPECT_EQ(device.get(kDaint), 0u);
  device.put(kDiepmsk, kDiepXfrc);
  EXPECT_NE(device.get(kDaint) & bit(1), 0u);
  EXPECT_EQ(device.get(kGintsts) & kGintIep, 0u);
  device.put(kDaintmsk, bit(1));
  EXPECT_NE(device.get(kGintsts) & kGintIep, 0u);
  device.put(diepint(1), kDiepXfrc);
  EXPECT_EQ(device.get(kGintsts) & kGintIep, 0u);
  device.put(kDiepempmsk, bit(1));  // its FIFO is empty: that goes by a mask of its own
  EXPECT_NE(device.get(kGintsts) & kGintIep, 0u);
}

TEST(OtgFs, SpaceInATransmitFifoIsTold) {
  UsbDevice device(Family::kF446);
  ASSERT_TRUE(device.ready());
  EXPECT_EQ(device.get(dtxfsts(1)), 64u);
  device.announce(1, 160);
  for (int i = 0; i < 33; ++i) device.put(fifo(1), 0);
  EXPECT_EQ(device.get(dtxfsts(1)), 31u);
  EXPECT_EQ(device.get(diepint(1)) & kDiepTxfe, 0u);  // less than half is free
  EXPECT_EQ(device.get(dieptsiz(1)) & kTsizXfrsiz, 160u - 128u);
  device.host.in(1, 64);
  EXPECT_EQ(device.get(dtxfsts(1)), 47u);
  EXPECT_NE(device.get(diepint(1)) & kDiepTxfe, 0u);
  device.change(kGahbcfg, 0, kGahbcfgTxfelvl);  // wholly empty only
  EXPECT_EQ(device.get(diepint(1)) & kDiepTxfe, 0u);
}

TEST(OtgFs, WithoutClockPinsPowerOrConnectionThereIsNoDevice) {
  for (const Family family : kFamilies) {
    UsbDevice device(family);
    EXPECT_FALSE(device.host.plug());
    device.start();
    EXPECT_TRUE(device.core.pulled_up());
    device.change(kDctl, 0, kDctlSdis);
    EXPECT_FALSE(device.core.pulled_up());
    device.change(kDctl, kDctlSdis, 0);
    device.change(kGccfg, kGccfgPwrdwn, 0);
    EXPECT_FALSE(device.core.pulled_up());
    device.change(kGccfg, 0, kGccfgPwrdwn);
    modify32(device.io, base::gpio('A') + gpio::kModer, 0xFu << 22, 0);
    EXPECT_FALSE(device.core.pulled_up());
  }
}

TEST(OtgFs, ACableThatIsPulledIsNoticedByVbusOrElseByIdleness) {
  for (const Family family : kFamilies) {
    UsbDevice device(family);
    ASSERT_TRUE(device.ready());
    EXPECT_NE(device.get(kGotgctl) & kGotgctlBsvld, 0u);
    device.host.unplug();
    EXPECT_EQ(device.get(kGotgctl) & kGotgctlBsvld, 0u);
    EXPECT_NE(device.get(kGotgint) & kGotgintSedet, 0u);
    EXPECT_NE(device.get(kGintsts) & kGintOtg, 0u);
    EXPECT_EQ(device.host.in(1, 64).result, UsbResult::kNoAnswer);
    EXPECT_TRUE(device.host.plug());

    UsbDevice blind(family);
    blind.start(false);
    EXPECT_TRUE(blind.host.plug());
    blind.host.unplug();
    EXPECT_EQ(blind.get(kGotgint), 0u);
    blind.host.pass(ms(7));
    EXPECT_NE(blind.get(kGintsts) & kGintUsbsusp, 0u);
  }
}

TEST(OtgFs, TheBusSuspendsResumesAndMayBeWoken) {
  UsbDevice device(Family::kF746);
  ASSERT_TRUE(device.ready());
  device.host.suspend();
  device.host.pass(ms(4));
  EXPECT_EQ(device.get(kGintsts) & (kGintEsusp | kGintUsbsusp), kGintEsusp);
  device.host.pass(ms(3));
  EXPECT_NE(device.get(kGintsts) & kGintUsbsusp, 0u);
  EXPECT_NE(device.get(kDsts) & kDstsSuspsts, 0u);
  device.change(kPcgcctl, 0, kPcgcctlStppclk);
  device.put(kDctl, kDctlRwusig);
  EXPECT_TRUE(one_violation(device.machine, "stops the core's clock"));
  device.change(kPcgcctl, kPcgcctlStppclk, 0);
  device.change(kDctl, 0, kDctlRwusig);
  EXPECT_TRUE(device.core.wakes_host());
  device.change(kDctl, kDctlRwusig, 0);
  EXPECT_TRUE(one_violation(device.machine, "1 to 15 ms"));
  device.change(kDctl, 0, kDctlRwusig);
  device.machine.advance(ms(5));
  device.change(kDctl, kDctlRwusig, 0);
  device.host.resume();
  EXPECT_NE(device.get(kGintsts) & kGintWkup, 0u);
  EXPECT_EQ(device.get(kDsts) & kDstsSuspsts, 0u);
  EXPECT_EQ(device.host.control(kGetDescriptor).bytes, device.answer);
  EXPECT_EQ(device.machine.violations_text(), "");
}

TEST(OtgFs, ABusResetClosesEndpointsAndSoftwareMustForgetTheAddress) {
  UsbDevice device(Family::kF405);
  ASSERT_TRUE(device.ready());
  device.polling = false;
  EXPECT_TRUE(device.host.reset());
  EXPECT_EQ(device.get(diepctl(1)) & kEpctlUsbaep, 0u);
  EXPECT_EQ(device.get(doepctl(1)) & kEpctlUsbaep, 0u);
  EXPECT_NE(device.get(diepctl(0)) & kEpctlUsbaep, 0u);
  EXPECT_EQ((device.get(kDsts) & kDstsEnumspd) >> kDstsEnumspdShift, kEnumspdFullSpeed);
  EXPECT_EQ(device.host.control(kGetDescriptor).result, UsbResult::kNoAnswer);
  device.polling = true;
  device.host.pass(ms(1));
  EXPECT_EQ(device.host.control(kGetDescriptor).result, UsbResult::kDone);
}

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

TEST(OtgFs, AChipResetTakesTheDeviceFromTheBus) {
  UsbDevice device(Family::kF746);
  ASSERT_TRUE(device.ready());
  device.machine.reset(ResetCause::kPin);
  device.polling = false;
  EXPECT_FALSE(device.core.pulled_up());
  EXPECT_EQ(device.host.control(kGetDescriptor).result, UsbResult::kNoAnswer);
}

}  // namespace
}  // namespace verp::hal::stm32::model
