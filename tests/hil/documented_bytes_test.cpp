#include <gtest/gtest.h>

#include "common/protocol/control_table.hpp"
#include "tests/hil/pty_devices.hpp"

// All bytes are the examples of ROBOTIS e-Manual, "DYNAMIXEL Protocol 2.0"; comments name the
// exceptions.
namespace verp::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
namespace at = dxl::address;

/// Status of ID 1 without data.
const Bytes kGood = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x04, 0x00, 0x55, 0x00, 0xA1, 0x0C};
const Bytes kPing = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x01, 0x19, 0x4E};
const Bytes kReboot = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x08, 0x2F, 0x4E};
const Bytes kReadPosition = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x07, 0x00,
                             0x02, 0x84, 0x00, 0x04, 0x00, 0x1D, 0x15};
const Bytes kPositionOf1 = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x08, 0x00, 0x55,
                            0x00, 0xA6, 0x00, 0x00, 0x00, 0x8C, 0xC0};
const Bytes kFactoryReset = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x04, 0x00, 0x06, 0x01, 0xA1, 0xE6};

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
Bytes read_of(std::uint8_t id, std::uint16_t address, std::uint16_t length) {
  Bytes frame(32);
  frame.resize(dxl::encode_read(frame.data(), frame.size(), id, address, length));
  return frame;
}
Bytes write_of(std::uint8_t id, std::uint16_t address, const Bytes& data) {
  Bytes frame(64);
  frame.resize(
      dxl::encode_write(frame.data(), frame.size(), id, address, data.data(), data.size()));
  return frame;
}
Bytes data_of(const Bytes& status) {
  return status.size() < dxl::kStatusBytes ? Bytes{} : Bytes(status.begin() + 9, status.end() - 2);
}

class DocumentedServos : public ::testing::Test {
 protected:
  DocumentedServos() {
    plant.measured[0] = {.position_count = 166, .voltage_v = 11.9};
    plant.measured[1] = {.position_count = 2079, .temperature_c = 36};
    plant.measured[2] = {.position_count = 166};
    plant.measured[3] = {.position_count = 1023, .temperature_c = 31};
    plant.measured[6] = {.position_count = 2079, .duty = 421.0 / dxl::kFullPwm};
    servos = std::make_unique<PtyServos>(params, plant, path);
    master = std::make_unique<SerialMaster>(path);
  }
  Bytes ask(const Bytes& bytes, std::size_t wanted) { return master->exchange(bytes, wanted); }
  Bytes read(std::uint8_t id, std::uint16_t address, std::uint16_t length) {
    return data_of(ask(read_of(id, address, length), dxl::kStatusBytes + length));
  }

  const std::string path = pty_path("servos");
  Params params = bus_params(21);
  FakePlant plant;
  std::unique_ptr<PtyServos> servos;
  std::unique_ptr<SerialMaster> master;
};

// Firmware 38 is 45 here, the first with fast reads: that byte and the CRC differ.
TEST_F(DocumentedServos, Ping) {
  const Bytes status = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x07, 0x00, 0x55, 0x00, 0x06, 0x04};
  Bytes expected = status + Bytes{45};
  const std::uint16_t crc = dxl::crc16(expected.data(), expected.size());
  expected = expected + Bytes{static_cast<std::uint8_t>(crc), static_cast<std::uint8_t>(crc >> 8)};
  EXPECT_EQ(ask(kPing, 14), expected);
}

TEST_F(DocumentedServos, ReadAndWrite) {
  EXPECT_EQ(ask(kReadPosition, kPositionOf1.size()), kPositionOf1);
  const Bytes write = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x09, 0x00, 0x03,
                       0x74, 0x00, 0x00, 0x02, 0x00, 0x00, 0xCA, 0x89};
  EXPECT_EQ(ask(write, kGood.size()), kGood);
  EXPECT_EQ(read(1, at::kGoalPosition, 4), (Bytes{0x00, 0x02, 0x00, 0x00}));
}

TEST_F(DocumentedServos, RegWriteAndAction) {
  const Bytes reg_write = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x09, 0x00, 0x04,
                           0x68, 0x00, 0xC8, 0x00, 0x00, 0x00, 0xAE, 0x8E};
  const Bytes action = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x05, 0x02, 0xCE};
  EXPECT_EQ(ask(reg_write, kGood.size()), kGood);
  EXPECT_EQ(read(1, at::kGoalVelocity, 4), (Bytes{0, 0, 0, 0})) << "it waits";
  EXPECT_EQ(read(1, at::kRegisteredInstruction, 1), Bytes{1});
  EXPECT_EQ(ask(action, kGood.size()), kGood);
  EXPECT_EQ(read(1, at::kGoalVelocity, 4), (Bytes{0xC8, 0, 0, 0}));
  EXPECT_EQ(read(1, at::kRegisteredInstruction, 1), Bytes{0});
}

TEST_F(DocumentedServos, SyncReadAndSyncWrite) {
  const Bytes sync_read = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x09, 0x00, 0x82,
                           0x84, 0x00, 0x04, 0x00, 0x01, 0x02, 0xCE, 0xFA};
  const Bytes position_of_2 = {0xFF, 0xFF, 0xFD, 0x00, 0x02, 0x08, 0x00, 0x55,
                               0x00, 0x1F, 0x08, 0x00, 0x00, 0xBA, 0xBE};
  EXPECT_EQ(ask(sync_read, 30), kPositionOf1 + position_of_2);
  const Bytes sync_write = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x11, 0x00, 0x83, 0x74, 0x00, 0x04, 0x00,
                            0x01, 0x96, 0x00, 0x00, 0x00, 0x02, 0xAA, 0x00, 0x00, 0x00, 0x82, 0x87};
  EXPECT_TRUE(master->expect_silence(sync_write).empty());
  EXPECT_EQ(read(1, at::kGoalPosition, 4), (Bytes{0x96, 0, 0, 0}));
  EXPECT_EQ(read(2, at::kGoalPosition, 4), (Bytes{0xAA, 0, 0, 0}));
}

TEST_F(DocumentedServos, FastSyncRead) {
  const Bytes request = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x0A, 0x00, 0x8A, 0x84,
                         0x00, 0x04, 0x00, 0x03, 0x07, 0x04, 0x20, 0xF2};
  const Bytes of_3 = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x19, 0x00, 0x55,
                      0x00, 0x03, 0xA6, 0x00, 0x00, 0x00, 0x84, 0x08};
  const Bytes of_7 = {0x00, 0x07, 0x1F, 0x08, 0x00, 0x00, 0x16, 0xCA};
  const Bytes of_4 = {0x00, 0x04, 0xFF, 0x03, 0x00, 0x00, 0xD1, 0x9E};
  EXPECT_EQ(ask(request, 32), of_3 + of_7 + of_4);
}

TEST_F(DocumentedServos, BulkReadAndBulkWrite) {
  const Bytes bulk_read = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x0D, 0x00, 0x92, 0x01, 0x90,
                           0x00, 0x02, 0x00, 0x02, 0x92, 0x00, 0x01, 0x00, 0x1A, 0x05};
  const Bytes voltage_of_1 = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x06, 0x00,
                              0x55, 0x00, 0x77, 0x00, 0xC3, 0x69};
  const Bytes temperature_of_2 = {0xFF, 0xFF, 0xFD, 0x00, 0x02, 0x05,
                                  0x00, 0x55, 0x00, 0x24, 0x8B, 0xA9};
  EXPECT_EQ(ask(bulk_read, 25), voltage_of_1 + temperature_of_2);
  // The factory sets both limits.
  EXPECT_EQ(ask(write_of(1, at::kMaxVoltageLimit, {150, 0}), 11).size(), 11u);
  EXPECT_EQ(ask(write_of(2, at::kTemperatureLimit, {70}), 11).size(), 11u);
  const Bytes bulk_write = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x10, 0x00, 0x93, 0x01, 0x20, 0x00, 0x02,
                            0x00, 0xA0, 0x00, 0x02, 0x1F, 0x00, 0x01, 0x00, 0x50, 0xB7, 0x68};
  EXPECT_TRUE(master->expect_silence(bulk_write).empty());
  EXPECT_EQ(read(1, at::kMaxVoltageLimit, 2), (Bytes{160, 0}));
  EXPECT_EQ(read(2, at::kTemperatureLimit, 1), Bytes{80});
}

// The e-Manual prints CRC 20 F2, that of its Fast Sync Read example; these bytes have DA 2D.
TEST_F(DocumentedServos, FastBulkRead) {
  const Bytes request = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x12, 0x00, 0x9A, 0x03,
                         0x84, 0x00, 0x04, 0x00, 0x07, 0x7C, 0x00, 0x02, 0x00,
                         0x04, 0x92, 0x00, 0x01, 0x00, 0xDA, 0x2D};
  const Bytes of_3 = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x14, 0x00, 0x55,
                      0x00, 0x03, 0xA6, 0x00, 0x00, 0x00, 0x67, 0xA4};
  const Bytes of_7 = {0x00, 0x07, 0xA5, 0x01, 0x24, 0x74};
  const Bytes of_4 = {0x00, 0x04, 0x1F, 0xD9, 0xC1};
  EXPECT_EQ(ask(request, 27), of_3 + of_7 + of_4);
}

// e-Manual XM430-W210, Indirect Address, example 1: LED (65) at Indirect Data 1 (224).
TEST_F(DocumentedServos, IndirectAddressing) {
  EXPECT_EQ(ask(write_of(1, 168, {65, 0}), kGood.size()), kGood);
  EXPECT_EQ(ask(write_of(1, 224, {1}), kGood.size()), kGood);
  EXPECT_EQ(read(1, 65, 1), Bytes{1});
  // Example 2: Goal Position at Indirect Data 2 to 5.
  for (std::uint8_t i = 0; i < 4; ++i) {
    const auto pointer = static_cast<std::uint16_t>(170 + 2 * i);
    EXPECT_EQ(ask(write_of(1, pointer, {static_cast<std::uint8_t>(116 + i), 0}), 11), kGood);
  }
  EXPECT_EQ(ask(write_of(1, 225, {0x00, 0x04, 0, 0}), kGood.size()), kGood);
  EXPECT_EQ(read(1, at::kGoalPosition, 4), (Bytes{0x00, 0x04, 0, 0}));
}

TEST_F(DocumentedServos, RebootAndClear) {
  EXPECT_EQ(ask(write_of(1, at::kTorqueEnable, {1}), kGood.size()), kGood);
  EXPECT_EQ(read(1, at::kTorqueEnable, 1), Bytes{1});
  EXPECT_EQ(ask(kReboot, kGood.size()), kGood);
  EXPECT_EQ(read(1, at::kTorqueEnable, 1), Bytes{0});
  const Bytes clear = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x08, 0x00, 0x10,
                       0x01, 0x44, 0x58, 0x4C, 0x22, 0xB1, 0xDC};
  EXPECT_EQ(ask(clear, kGood.size()), kGood);
}

// Option 1 keeps the id but not the baud rate: at 57600 the servo leaves this bus.
TEST_F(DocumentedServos, FactoryReset) {
  EXPECT_EQ(ask(kFactoryReset, kGood.size()), kGood);
  EXPECT_TRUE(master->expect_silence(kPing).empty());
}

TEST_F(DocumentedServos, All21Answer) {
  for (std::uint8_t id = 1; id <= 21; ++id) {
    const Bytes reply = read(id, at::kId, 1);
    EXPECT_EQ(reply, Bytes{id});
  }
}

// The operator can make device 200 ID 1.
class DocumentedController : public ::testing::Test {
 protected:
  DocumentedController() {
    // The examples' position 166 is the digest's upper half.
    state.digest.chain = std::uint64_t{0xA6} << 32;
    controller = std::make_unique<PtyController>(params, state, path);
    master = std::make_unique<SerialMaster>(path);
  }
  Bytes ask(const Bytes& bytes, std::size_t wanted) { return master->exchange(bytes, wanted); }
  /// The answer has the old id.
  void become_1() { EXPECT_EQ(ask(write_of(200, at::kId, {1}), 11).size(), 11u); }

  const std::string path = pty_path("controller");
  Params params = bus_params(21);
  State state;
  std::unique_ptr<PtyController> controller;
  std::unique_ptr<SerialMaster> master;
};

TEST_F(DocumentedController, AnswersAsDevice200) {
  Bytes ping(16);
  ping.resize(dxl::encode_ping(ping.data(), ping.size(), 200));
  const Bytes reply = ask(ping, 14);
  ASSERT_EQ(reply.size(), 14u);
  EXPECT_EQ(reply[4], 200);
  EXPECT_EQ(data_of(reply), (Bytes{0x00, 0x76, dxl::controller::kTableVersion}));
  EXPECT_TRUE(master->expect_silence(kPing).empty()) << "that is for somebody else";
}

TEST_F(DocumentedController, PingAndRead) {
  become_1();
  const Bytes pong = ask(kPing, 14);
  EXPECT_EQ(Bytes(pong.begin(), pong.begin() + 9),
            (Bytes{0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x07, 0x00, 0x55, 0x00}));
  EXPECT_EQ(ask(kReadPosition, kPositionOf1.size()), kPositionOf1);
}

// The controller is the first device; the second is missing.
TEST_F(DocumentedController, SyncFastSyncAndBulkRead) {
  become_1();
  const Bytes sync_read = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x09, 0x00, 0x82,
                           0x84, 0x00, 0x04, 0x00, 0x01, 0x02, 0xCE, 0xFA};
  EXPECT_EQ(ask(sync_read, kPositionOf1.size()), kPositionOf1);
  // The example asks 3, 7 and 4. Device 3's part announces all three.
  EXPECT_EQ(ask(write_of(1, at::kId, {3}), 11).size(), 11u);
  const Bytes fast = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x0A, 0x00, 0x8A, 0x84,
                      0x00, 0x04, 0x00, 0x03, 0x07, 0x04, 0x20, 0xF2};
  EXPECT_EQ(ask(fast, 16), (Bytes{0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x19, 0x00, 0x55, 0x00, 0x03, 0xA6,
                                  0x00, 0x00, 0x00, 0x84, 0x08}));
  EXPECT_EQ(ask(write_of(3, at::kId, {1}), 11).size(), 11u);
  const Bytes bulk_read = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x0D, 0x00, 0x92, 0x01, 0x90,
                           0x00, 0x02, 0x00, 0x02, 0x92, 0x00, 0x01, 0x00, 0x1A, 0x05};
  const Bytes reply = ask(bulk_read, 13);
  ASSERT_EQ(reply.size(), 13u);
  EXPECT_EQ(Bytes(reply.begin(), reply.begin() + 9),
            (Bytes{0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x06, 0x00, 0x55, 0x00}));
}

// A controller refuses Factory Reset with Instruction Error (2).
TEST_F(DocumentedController, RebootAndFactoryReset) {
  become_1();
  const Bytes refused = ask(kFactoryReset, 11);
  ASSERT_EQ(refused.size(), 11u);
  EXPECT_EQ(refused[8], 2);
  EXPECT_FALSE(controller->reboot_asked);
  EXPECT_EQ(ask(kReboot, kGood.size()), kGood);
  for (int i = 0; i < 200 && !controller->reboot_asked; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(controller->reboot_asked);
}

}  // namespace
}  // namespace verp::test
