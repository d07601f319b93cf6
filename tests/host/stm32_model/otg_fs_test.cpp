#include <gtest/gtest.h>

#include "hal/chip/stm32/interrupts.hpp"
#include "tests/host/stm32_model/usb_device.hpp"
#include "tests/support/stm32/registers/otg_fs_table.hpp"

namespace verp::hal::stm32::model {
namespace {

using namespace otg_fs;

constexpr UsbSetup kGetDescriptor = {.type = 0x80, .request = 6, .value = 0x100, .length = 64};

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
  EXPECT_EQ(device.get(fifo(3) + 0xFFC), 0x00040000u);  // any window reads the one FIFO
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
  EXPECT_EQ(calls, 5u);  // one a millisecond
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
  device.put(kDiepempmsk, bit(1));  // empty has its own mask
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
  device.change(kGahbcfg, 0, kGahbcfgTxfelvl);  // only when wholly empty
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
