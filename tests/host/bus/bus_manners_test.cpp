#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "common/protocol/control_table.hpp"
#include "host/twin/bus/collision.hpp"
#include "host/twin/bus/virtual_bus.hpp"
#include "tests/host/bus/fake_plant.hpp"

/// The five servos are those of the e-Manual's example of register 12 (docs/en/dxl/x/xm430-w210).
namespace verp {
namespace {

using Bytes = std::vector<std::uint8_t>;
namespace at = dxl::address;

class BusManners : public ::testing::Test {
 protected:
  static constexpr int kServos = 5;

  /// Returns what arrives within `timeout_us`.
  Bytes exchange(const Bytes& frame, std::uint32_t timeout_us = 100'000) {
    EXPECT_TRUE(bus.send(frame.data(), frame.size()));
    Bytes buffer(4096);
    buffer.resize(bus.poll(buffer.data(), buffer.size(), timeout_us));
    return buffer;
  }
  Bytes write(std::uint8_t id, std::uint16_t address, const Bytes& data) {
    Bytes frame(64);
    frame.resize(
        dxl::encode_write(frame.data(), frame.size(), id, address, data.data(), data.size()));
    return exchange(frame);
  }
  Bytes read(std::uint8_t id, std::uint16_t address, std::uint16_t length) {
    Bytes frame(64);
    frame.resize(dxl::encode_read(frame.data(), frame.size(), id, address, length));
    return exchange(frame);
  }
  Bytes ping(std::uint8_t id, std::uint32_t timeout_us = 100'000) {
    Bytes frame(16);
    frame.resize(dxl::encode_ping(frame.data(), frame.size(), id));
    return exchange(frame, timeout_us);
  }
  /// Ids of complete packets; counts CRC errors.
  std::vector<int> ids_in(const Bytes& bytes) {
    dxl::Parser parser;
    std::vector<int> ids;
    for (const std::uint8_t byte : bytes) {
      for (bool found = parser.push(byte); found; found = parser.next()) {
        ids.push_back(parser.packet().id);
      }
    }
    noise = parser.noise_bytes();
    return ids;
  }
  int error_of(const Bytes& bytes) {
    dxl::Parser parser;
    for (const std::uint8_t byte : bytes) {
      if (parser.push(byte)) return parser.packet().error;
    }
    return -1;
  }
  std::vector<int> lit() {
    std::vector<int> all;
    for (std::uint8_t id = 1; id <= kServos; ++id) {
      const Bytes reply = read(id, at::kLed, 1);
      if (reply.size() > 9 && reply[9] == 1) all.push_back(id);
    }
    return all;
  }

  Params params = test::bus_params(kServos);
  test::FakePlant plant;
  bus::VirtualBus bus{params, plant};
  std::uint32_t noise = 0;
};

TEST_F(BusManners, ASecondaryIdMakesAGroupThatIsWrittenTogether) {
  for (std::uint8_t id = 1; id <= kServos; ++id) {
    EXPECT_EQ(ids_in(write(id, at::kSecondaryId, {5})), std::vector<int>{id});
  }
  EXPECT_EQ(ids_in(write(1, at::kLed, {1})), std::vector<int>{1});
  EXPECT_EQ(lit(), std::vector<int>{1});
  EXPECT_EQ(ids_in(write(5, at::kLed, {1})), std::vector<int>{5}) << "only its own id answers";
  EXPECT_EQ(lit(), (std::vector<int>{1, 2, 3, 4, 5}));
  for (std::uint8_t id = 1; id <= kServos; ++id) write(id, at::kSecondaryId, {77});
  EXPECT_TRUE(write(77, at::kLed, {0}).empty()) << "a group does not answer";
  EXPECT_TRUE(lit().empty());
}

TEST_F(BusManners, ASecondaryIdOpensTheRamOnly) {
  for (std::uint8_t id = 1; id <= kServos; ++id) write(id, at::kSecondaryId, {77});
  EXPECT_TRUE(write(77, at::kReturnDelay, {7}).empty());
  EXPECT_TRUE(read(77, at::kLed, 1).empty());
  EXPECT_TRUE(ping(77).empty());
  for (std::uint8_t id = 1; id <= kServos; ++id) {
    EXPECT_EQ(read(id, at::kReturnDelay, 1)[9], 250);
  }
}

TEST_F(BusManners, ASecondaryIdOf253AndMoreIsNone) {
  for (const std::uint8_t none : {std::uint8_t{253}, std::uint8_t{255}}) {
    write(1, at::kSecondaryId, {none});
    write(none, at::kLed, {1});
    EXPECT_TRUE(lit().empty());
  }
}

// e-Manual, Ping, example 2. Firmware and CRC differ: the manual has firmware 38, here it is 45,
// the first with Fast Sync Read.
TEST_F(BusManners, APingToAllIsAnsweredInTurns) {
  const Bytes ping_all = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x03, 0x00, 0x01, 0x31, 0x42};
  const Bytes first = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x07, 0x00, 0x55, 0x00, 0x06, 0x04};
  const Bytes second = {0xFF, 0xFF, 0xFD, 0x00, 0x02, 0x07, 0x00, 0x55, 0x00, 0x06, 0x04};
  const Bytes heard = exchange(ping_all, 8'000);
  ASSERT_EQ(heard.size(), 28u);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), heard.begin()));
  EXPECT_TRUE(std::equal(second.begin(), second.end(), heard.begin() + 14));
}

// Dynamixel2Arduino, issue 106: id 5 is found within 50 ms, not within 10. The vendor's SDK allows
// 3 ms per id.
TEST_F(BusManners, ThePlaceOfAnIdInAPingToAllIsItsNumber) {
  EXPECT_EQ(ids_in(ping(dxl::kBroadcast, 10'000)), (std::vector<int>{1, 2, 3}));
  Bytes rest(256);
  rest.resize(bus.poll(rest.data(), rest.size(), 50'000));
  EXPECT_EQ(ids_in(rest), (std::vector<int>{4, 5}));
  const std::uint64_t begun_us = bus.now_us();
  rest.resize(256);
  rest.resize(bus.poll(rest.data(), rest.size(), 253 * 3000));
  EXPECT_EQ(ids_in(rest), (std::vector<int>{test::kImuId, test::kLeftFootId, test::kRightFootId}));
  EXPECT_GE(bus.now_us(), begun_us + 3000u * (test::kRightFootId - 20));
}

TEST_F(BusManners, TwoServosOfOneIdGarbleEachOther) {
  EXPECT_EQ(ids_in(write(2, at::kId, {3})), std::vector<int>{2});
  EXPECT_TRUE(ids_in(ping(3)).empty());
  EXPECT_GT(noise, 0u) << "something is on the line, but no packet";
  EXPECT_TRUE(ids_in(read(3, at::kPresentTemperature, 1)).empty());
  EXPECT_GT(noise, 0u);
  EXPECT_TRUE(ids_in(write(3, at::kLed, {1})).empty()) << "both do it";
  EXPECT_TRUE(ids_in(ping(2)).empty());
  EXPECT_EQ(noise, 0u) << "nobody has that id";
  EXPECT_EQ(ids_in(ping(4)), std::vector<int>{4});
  EXPECT_EQ(ids_in(ping(dxl::kBroadcast, 50'000)), (std::vector<int>{1, 4, 5}));
}

TEST_F(BusManners, ADoubleIdSpoilsOnlyItsPartOfASyncRead) {
  write(2, at::kId, {3});
  Bytes frame(64);
  const Bytes ids = {1, 3, 4};
  frame.resize(dxl::encode_sync_read(frame.data(), frame.size(), dxl::Instruction::kSyncRead,
                                     at::kPresentTemperature, 1, ids.data(), ids.size()));
  EXPECT_EQ(ids_in(exchange(frame)), (std::vector<int>{1, 4}));
}

TEST_F(BusManners, AMasterSeesADoubleIdAsDamage) {
  write(2, at::kId, {3});
  dxl::Parser parser;
  for (int i = 0; i < 20; ++i) {
    for (const std::uint8_t byte : read(3, at::kPresentPosition, 4))
      EXPECT_FALSE(parser.push(byte));
  }
  EXPECT_GT(parser.crc_errors() + parser.noise_bytes(), 100u);
}

TEST_F(BusManners, AServoAtAnotherBaudRateIsSilentUntilTheBusHasIt) {
  constexpr std::uint8_t k1Mbaud = 3;
  EXPECT_EQ(error_of(write(2, at::kBaudRate, {k1Mbaud})), 0);
  EXPECT_TRUE(ping(2).empty());
  EXPECT_TRUE(read(2, at::kPresentTemperature, 1).empty());
  EXPECT_EQ(ids_in(ping(1)), std::vector<int>{1});
  EXPECT_EQ(ids_in(ping(dxl::kBroadcast, 20'000)), (std::vector<int>{1, 3, 4, 5}));
}

// A delay of one bit changes everything.
TEST(Collision, LowLevelsWin) {
  const Bytes one = {0xF0, 0x55}, other = {0x0F, 0xAA};
  EXPECT_EQ(bus::heard({{one, 0}}), one);
  EXPECT_EQ(bus::heard({{one, 0}, {other, 0}}), (Bytes{0x00, 0x00}));
  EXPECT_EQ(bus::heard({{one, 0}, {one, 0}}), one) << "the same at the same time";
  EXPECT_EQ(bus::heard({{one, 0}, {other, 20}}), (Bytes{0xF0, 0x55, 0x0F, 0xAA}));
  EXPECT_NE(bus::heard({{one, 0}, {one, 1}}), one);
}

}  // namespace
}  // namespace verp
