#include <gtest/gtest.h>

#include "tests/host/stm32_model/usb_device.hpp"
#include "tests/support/stm32/registers/otg_fs_table.hpp"

namespace verp::hal::stm32::model {
namespace {

using namespace otg_fs;

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
      // After a lost last ACK the core keeps the packet, but the host does not ask again.
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
  EXPECT_NE(device.get(diepint(1)) & kDiepNak, 0u);  // newer core only
  device.polling = false;                            // the FIFO takes one packet, not the next
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
  // 128 words: 16 a packet and a status word; one stays free.
  for (int packet = 0; packet < 7; ++packet) {
    EXPECT_EQ(device.host.out(1, ramp(64)), UsbResult::kDone);
  }
  EXPECT_EQ(device.host.out(1, ramp(64)), UsbResult::kNaked);
  EXPECT_EQ(device.get(doepctl(1)) & kEpctlNaksts, 0u);
  device.polling = true;
  EXPECT_EQ(device.host.out(1, ramp(64)), UsbResult::kDone);
  device.polling = false;
  EXPECT_EQ(device.host.out(1, ramp(3)), UsbResult::kDone);  // short: an early end
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

}  // namespace
}  // namespace verp::hal::stm32::model
