#include "hal/chip/usb/cdc_acm.hpp"

#include <gtest/gtest.h>

namespace verp::hal::usb {
namespace {

constexpr std::uint8_t kChip[kSerialBytes] = {0x00, 0x1A, 0xFF, 3, 4, 5, 6, 7, 8, 9, 10, 0xC0};
constexpr const char* kName = "a robot";
constexpr std::uint8_t kEndpoints[] = {kDataOut, kDataIn, kNotification};

CdcAcm make() {
  return CdcAcm(kName, kChip);
}
Answer ask(CdcAcm& port, unsigned code, unsigned value, unsigned index, unsigned length) {
  const std::uint8_t bytes[CdcAcm::kSetupBytes] = {
      static_cast<std::uint8_t>(code >> 8), static_cast<std::uint8_t>(code),
      static_cast<std::uint8_t>(value),     static_cast<std::uint8_t>(value >> 8),
      static_cast<std::uint8_t>(index),     static_cast<std::uint8_t>(index >> 8),
      static_cast<std::uint8_t>(length),    static_cast<std::uint8_t>(length >> 8)};
  return port.setup(bytes);
}
bool stalls(const Answer& answer) {
  return answer.stage == Stage::kStall && answer.action == Action::kNone;
}
bool done(const Answer& answer, Action action, unsigned value) {
  return answer.stage == Stage::kDone && answer.action == action && answer.value == value;
}
CdcAcm make_configured() {
  CdcAcm port = make();
  EXPECT_TRUE(done(ask(port, 0x0005, 5, 0, 0), Action::kAddress, 5));
  EXPECT_TRUE(done(ask(port, 0x0009, 1, 0, 0), Action::kConfigure, 1));
  return port;
}
/// Answer to GET_STATUS; -1 if refused.
int status(CdcAcm& port, unsigned code, unsigned index) {
  const Answer answer = ask(port, code, 0, index, 2);
  if (answer.stage != Stage::kSend || answer.size != 2) return -1;
  return answer.data[0] | answer.data[1] << 8;
}

// Hosts walk it by its lengths.
TEST(UsbDescriptors, ConfigurationIsAWholeTree) {
  CdcAcm port = make();
  const Answer answer = ask(port, 0x8006, 0x0200, 0, 255);
  ASSERT_EQ(static_cast<int>(answer.stage), static_cast<int>(Stage::kSend));
  const std::uint8_t* bytes = answer.data;
  EXPECT_EQ(bytes[2] | bytes[3] << 8, answer.size);
  int interfaces = 0;
  int endpoints_left = 0;
  unsigned at = 0;
  for (; at + 1 < answer.size && bytes[at] >= 2; at += bytes[at]) {
    if (bytes[at + 1] == type(Descriptor::kInterface)) {
      EXPECT_EQ(bytes[at + 2], interfaces) << "they count from 0";
      EXPECT_EQ(endpoints_left, 0) << "of the interface before";
      ++interfaces;
      endpoints_left = bytes[at + 4];
    }
    if (bytes[at + 1] == type(Descriptor::kEndpoint)) {
      --endpoints_left;
      const int packet = bytes[at + 4] | bytes[at + 5] << 8;
      EXPECT_LE(packet, 64) << "full speed knows no more";
      EXPECT_EQ(bytes[at + 3] == 2, packet == kBulkPacket);
    }
  }
  EXPECT_EQ(at, unsigned{answer.size});
  EXPECT_EQ(endpoints_left, 0);
  EXPECT_EQ(interfaces, bytes[4]);
}

// A host asks for 8, 9, 64, 255 or more bytes.
TEST(UsbDescriptors, AnyLengthGetsThatMuchOfTheBeginning) {
  CdcAcm port = make();
  for (const unsigned value : {0x0100u, 0x0200u, 0x0300u, 0x0301u, 0x0302u, 0x0303u}) {
    const Answer all = ask(port, 0x8006, value, 0, 0xFFFF);
    std::uint8_t whole[kConfigurationBytes] = {};
    ASSERT_LE(all.size, sizeof whole);
    for (unsigned i = 0; i < all.size; ++i) whole[i] = all.data[i];
    EXPECT_EQ(whole[1], value >> 8);
    EXPECT_TRUE(all.shorter);
    EXPECT_EQ(static_cast<int>(ask(port, 0x8006, value, 0, 0).stage),
              static_cast<int>(Stage::kDone));
    for (unsigned length = 1; length < 300; ++length) {
      const Answer part = ask(port, 0x8006, value, 0, length);
      ASSERT_EQ(part.size, length < all.size ? length : all.size) << value;
      ASSERT_EQ(part.shorter, all.size < length) << value;
      for (unsigned i = 0; i < part.size; ++i) ASSERT_EQ(part.data[i], whole[i]) << value;
    }
  }
}

TEST(UsbDescriptors, StringsAreUtf16AndTheSerialNumberIsTheChips) {
  CdcAcm port = make();
  const Answer product = ask(port, 0x8006, 0x0302, kEnglish, 255);
  ASSERT_EQ(product.size, 2 + 2 * 7);
  for (unsigned i = 0; i < 7; ++i) {
    EXPECT_EQ(product.data[2 + 2 * i], kName[i]);
    EXPECT_EQ(product.data[3 + 2 * i], 0);
  }
  constexpr const char* kDigits = "001AFF030405060708090AC0";
  const Answer serial = ask(port, 0x8006, 0x0303, kEnglish, 255);
  ASSERT_EQ(serial.size, kStringBytes);
  for (unsigned i = 0; i < kStringUnits; ++i) EXPECT_EQ(serial.data[2 + 2 * i], kDigits[i]) << i;
}

TEST(UsbDescriptors, ALongNameIsCutAndNotOverrun) {
  CdcAcm port("a name that is much longer than any string descriptor here", kChip);
  EXPECT_EQ(ask(port, 0x8006, 0x0302, kEnglish, 255).size, kStringBytes);
}

// STALL to the device qualifier means no high speed.
TEST(UsbDescriptors, OthersAreRefused) {
  CdcAcm port = make();
  for (unsigned value = 0; value < 0x1'0000; ++value) {
    const bool known = value == 0x0100 || value == 0x0200 || (value >= 0x0300 && value <= 0x0303);
    ASSERT_EQ(stalls(ask(port, 0x8006, value, 0, 64)), !known) << value;
  }
}

TEST(UsbRequests, UnknownOnesAreRefusedAndChangeNothing) {
  constexpr unsigned kKnown[] = {0x8000, 0x8100, 0x8200, 0x0201, 0x0203, 0x0005, 0x8006,
                                 0x8008, 0x0009, 0x810A, 0x2120, 0xA121, 0x2122, 0x2123};
  for (const bool configured : {false, true}) {
    CdcAcm port = configured ? make_configured() : make();
    const std::uint8_t address = port.address();
    for (unsigned code = 0; code < 0x1'0000; ++code) {
      bool known = false;
      for (const unsigned each : kKnown) known = known || each == code;
      if (known) continue;
      ASSERT_TRUE(stalls(ask(port, code, 0, 0, code & 1 ? 7 : 0))) << code;
    }
    EXPECT_EQ(port.configured(), configured);
    EXPECT_EQ(port.address(), address);
    EXPECT_FALSE(port.opened());
    EXPECT_EQ(port.breaks(), 0u);
    for (const std::uint8_t endpoint : kEndpoints) EXPECT_FALSE(port.halted(endpoint));
  }
}

TEST(UsbRequests, KnownOnesWithWrongFieldsAreRefused) {
  CdcAcm port = make_configured();
  constexpr struct {
    unsigned code, value, index, length;
  } kWrong[] = {
      {0x8000, 1, 0, 2},     {0x8000, 0, 1, 2},    {0x8100, 0, 2, 2},     {0x8200, 0, 3, 2},
      {0x8200, 0, 0x181, 2}, {0x0201, 1, 0x81, 0}, {0x0203, 1, 0x81, 0},  {0x0203, 0, 0x83, 0},
      {0x0203, 0, 0, 0},     {0x0203, 0, 0x81, 2}, {0x0005, 128, 0, 0},   {0x0005, 6, 0, 0},
      {0x0005, 6, 1, 0},     {0x0009, 2, 0, 0},    {0x0009, 0x101, 0, 0}, {0x0009, 1, 0, 4},
      {0x8008, 1, 0, 1},     {0x810A, 0, 2, 1},    {0x810A, 1, 0, 1},     {0x2120, 0, 1, 7},
      {0x2120, 0, 0, 6},     {0x2120, 0, 0, 8},    {0xA121, 0, 1, 7},     {0x2122, 1, 1, 0},
      {0x2122, 1, 0, 1},     {0x2123, 1, 1, 0},
  };
  for (const auto& each : kWrong) {
    EXPECT_TRUE(stalls(ask(port, each.code, each.value, each.index, each.length)))
        << each.code << " " << each.value << " " << each.index << " " << each.length;
  }
  EXPECT_EQ(port.address(), 5);
  EXPECT_FALSE(port.opened());
  EXPECT_EQ(port.breaks(), 0u);
  EXPECT_TRUE(port.configured());
}

TEST(UsbRequests, TakesEveryAddressThereIsAndNoOther) {
  for (unsigned address = 0; address < 0x1'0000; ++address) {
    CdcAcm port = make();
    const Answer answer = ask(port, 0x0005, address, 0, 0);
    if (address < 128) {
      ASSERT_TRUE(done(answer, Action::kAddress, address));
    } else {
      ASSERT_TRUE(stalls(answer)) << address;
    }
    ASSERT_EQ(port.address(), address < 128 ? address : 0);
  }
}

TEST(UsbRequests, BeforeAConfigurationThereIsNoPort) {
  CdcAcm port = make();
  EXPECT_EQ(status(port, 0x8000, 0), 0);
  EXPECT_EQ(status(port, 0x8200, 0), 0) << "the control endpoint is always there";
  EXPECT_EQ(status(port, 0x8100, 0), -1);
  for (const std::uint8_t endpoint : kEndpoints) {
    EXPECT_EQ(status(port, 0x8200, endpoint), -1);
    EXPECT_TRUE(stalls(ask(port, 0x0203, 0, endpoint, 0)));
  }
  for (const unsigned code : {0x2120u, 0xA121u}) EXPECT_TRUE(stalls(ask(port, code, 0, 0, 7)));
  for (const unsigned code : {0x2122u, 0x2123u}) EXPECT_TRUE(stalls(ask(port, code, 1, 0, 0)));
  EXPECT_FALSE(port.opened());
}

TEST(UsbRequests, TellsTheConfigurationThatWasSet) {
  CdcAcm port = make_configured();
  EXPECT_EQ(ask(port, 0x8008, 0, 0, 1).data[0], 1);
  EXPECT_EQ(ask(port, 0x810A, 0, 1, 1).data[0], 0);
  EXPECT_TRUE(done(ask(port, 0x0009, 0, 0, 0), Action::kConfigure, 0));
  EXPECT_EQ(ask(port, 0x8008, 0, 0, 1).data[0], 0);
  EXPECT_EQ(port.address(), 5) << "it stays on the bus";
}

TEST(UsbRequests, HaltsAndReleasesEachEndpointAlone) {
  CdcAcm port = make_configured();
  for (const std::uint8_t endpoint : kEndpoints) {
    EXPECT_TRUE(done(ask(port, 0x0203, 0, endpoint, 0), Action::kHalt, endpoint));
    for (const std::uint8_t each : kEndpoints) {
      EXPECT_EQ(status(port, 0x8200, each), each == endpoint ? 1 : 0);
      EXPECT_EQ(port.halted(each), each == endpoint);
    }
    EXPECT_TRUE(done(ask(port, 0x0201, 0, endpoint, 0), Action::kRelease, endpoint));
    EXPECT_EQ(status(port, 0x8200, endpoint), 0);
  }
}

TEST(UsbRequests, ANewConfigurationAndAResetForget) {
  for (const bool by_reset : {false, true}) {
    CdcAcm port = make_configured();
    ask(port, 0x0203, 0, kDataIn, 0);
    ask(port, 0x2122, 3, 0, 0);
    EXPECT_TRUE(port.opened());
    if (by_reset) {
      port.reset();
      EXPECT_EQ(port.address(), 0);
      EXPECT_FALSE(port.configured());
    } else {
      ask(port, 0x0009, 1, 0, 0);
      EXPECT_EQ(port.address(), 5);
    }
    EXPECT_FALSE(port.opened());
    EXPECT_FALSE(port.halted(kDataIn));
  }
}

TEST(UsbSerial, IsOpenWhileTheHostHoldsDtr) {
  CdcAcm port = make_configured();
  for (unsigned lines = 0; lines < 4; ++lines) {
    EXPECT_TRUE(done(ask(port, 0x2122, lines, 0, 0), Action::kNone, 0));
    EXPECT_EQ(port.opened(), (lines & 1) != 0);
  }
}

TEST(UsbSerial, KeepsALineCodingOrRefusesIt) {
  CdcAcm port = make_configured();
  for (unsigned i = 0; i < 4 * 6 * 20; ++i) {
    const auto stop = static_cast<std::uint8_t>(i % 4);
    const auto parity = static_cast<std::uint8_t>(i / 4 % 6);
    const auto data_bits = static_cast<std::uint8_t>(i / 24);
    const std::uint32_t baud = 0x01020304u * i;
    const LineCoding before = port.coding();
    const std::uint8_t bytes[] = {static_cast<std::uint8_t>(baud),
                                  static_cast<std::uint8_t>(baud >> 8),
                                  static_cast<std::uint8_t>(baud >> 16),
                                  static_cast<std::uint8_t>(baud >> 24),
                                  stop,
                                  parity,
                                  data_bits};
    const Answer wanted = ask(port, 0x2120, 0, 0, 7);
    ASSERT_TRUE(wanted.stage == Stage::kReceive && wanted.size == 7);
    const bool known =
        stop < 3 && parity < 5 && ((data_bits > 4 && data_bits < 9) || data_bits == 16);
    ASSERT_EQ(port.received(bytes, sizeof bytes), known) << i;
    ASSERT_EQ(port.coding().baud, known ? baud : before.baud);
    ASSERT_EQ(port.coding().data_bits, known ? data_bits : before.data_bits);
    const Answer back = ask(port, 0xA121, 0, 0, 7);
    ASSERT_EQ(back.size, 7);
    for (unsigned at = 0; known && at < 7; ++at) ASSERT_EQ(back.data[at], bytes[at]) << i;
  }
  const std::uint8_t shorter[6] = {};
  EXPECT_FALSE(port.received(shorter, sizeof shorter));
}

TEST(UsbSerial, CountsBreaks) {
  CdcAcm port = make_configured();
  for (const unsigned length_ms : {10u, 0u, 0xFFFFu, 0u}) ask(port, 0x2123, length_ms, 0, 0);
  EXPECT_EQ(port.breaks(), 2u);
}

}  // namespace
}  // namespace verp::hal::usb
