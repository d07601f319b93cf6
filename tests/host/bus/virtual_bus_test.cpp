#include "host/twin/bus/virtual_bus.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "common/protocol/control_table.hpp"
#include "host/twin/bus/servo_device.hpp"
#include "tests/host/bus/fake_plant.hpp"

namespace verp {
namespace {

using Bytes = std::vector<std::uint8_t>;
namespace at = dxl::address;

struct Reply {
  std::uint8_t id = 0;
  std::uint8_t error = 0;
  Bytes data;
};

class VirtualBus : public ::testing::Test {
 protected:
  Bytes poll(std::uint32_t timeout_us = 100000) {
    Bytes buffer(4096);
    buffer.resize(bus.poll(buffer.data(), buffer.size(), timeout_us));
    return buffer;
  }
  std::vector<Reply> replies(std::uint32_t timeout_us = 100000) {
    dxl::Parser parser;
    std::vector<Reply> all;
    for (const std::uint8_t byte : poll(timeout_us)) {
      for (bool found = parser.push(byte); found; found = parser.next()) {
        const dxl::Packet& packet = parser.packet();
        all.push_back(
            {packet.id, packet.error, Bytes(packet.parameters, packet.parameters + packet.size)});
      }
    }
    return all;
  }
  Reply reply() {
    const auto all = replies();
    EXPECT_EQ(all.size(), 1u);
    return all.empty() ? Reply{} : all.front();
  }
  Reply read(std::uint8_t id, std::uint16_t address, std::uint16_t length) {
    Bytes frame(64);
    bus.send(frame.data(), dxl::encode_read(frame.data(), frame.size(), id, address, length));
    return reply();
  }
  std::uint8_t write(std::uint8_t id, std::uint16_t address, const Bytes& data) {
    Bytes frame(64);
    bus.send(frame.data(),
             dxl::encode_write(frame.data(), frame.size(), id, address, data.data(), data.size()));
    return reply().error;
  }
  void sync_read(dxl::Instruction instruction, std::uint16_t address, std::uint16_t length,
                 const Bytes& ids) {
    Bytes frame(128);
    bus.send(frame.data(), dxl::encode_sync_read(frame.data(), frame.size(), instruction, address,
                                                 length, ids.data(), ids.size()));
  }
  static std::uint8_t code(dxl::Error error) { return static_cast<std::uint8_t>(error); }

  Params params = test::bus_params(3);
  test::FakePlant plant;
  bus::VirtualBus bus{params, plant};
};

TEST_F(VirtualBus, AnswersPingWithModelAndFirmware) {
  Bytes frame(16);
  bus.send(frame.data(), dxl::encode_ping(frame.data(), frame.size(), 2));
  const Reply pong = reply();
  EXPECT_EQ(pong.id, 2);
  ASSERT_EQ(pong.data.size(), 3u);
  EXPECT_EQ(dxl::get_u16(pong.data.data()), dxl::kModelXm430W210);
}

TEST_F(VirtualBus, BroadcastPingIsAnsweredByAllInOrderOfId) {
  Bytes frame(16);
  bus.send(frame.data(), dxl::encode_ping(frame.data(), frame.size(), dxl::kBroadcast));
  std::vector<int> ids;
  for (const Reply& each : replies(253 * 3000)) ids.push_back(each.id);
  EXPECT_EQ(ids, (std::vector<int>{1, 2, 3, test::kImuId, test::kLeftFootId, test::kRightFootId}));
}

TEST_F(VirtualBus, BytesAndReturnDelayTakeTheirTime) {
  // 14 bytes out, 250 * 2 us, 15 back, 5 us each.
  read(1, at::kHomingOffset, 4);
  EXPECT_EQ(bus.now_us(), 14u * 5 + 500 + 15 * 5);
  EXPECT_EQ(write(1, at::kReturnDelay, {0}), 0);
  const std::uint64_t before_us = bus.now_us();
  read(1, at::kHomingOffset, 4);
  EXPECT_EQ(bus.now_us() - before_us, 14u * 5 + 15 * 5);
}

TEST_F(VirtualBus, OnlyTheReadOfPresentPositionBeginsATick) {
  sync_read(dxl::Instruction::kSyncRead, dxl::sensor_block::kAddress, dxl::sensor_block::kBytes,
            {1, 2});
  EXPECT_EQ(replies().size(), 2u);
  EXPECT_FALSE(bus.ticking());
  EXPECT_LT(bus.now_us(), params.period_us);

  sync_read(dxl::Instruction::kFastSyncRead, at::kPresentPosition, 4, {1, 2, 3});
  EXPECT_EQ(bus.now_us(), params.period_us);
  EXPECT_TRUE(bus.ticking());
  EXPECT_EQ(bus.tick(), 0u);
  poll();
  sync_read(dxl::Instruction::kSyncRead, at::kPresentVelocity, 8, {1, 2, 3});
  EXPECT_EQ(bus.now_us() % params.period_us, 0u);
  EXPECT_EQ(bus.tick(), 1u);
}

TEST_F(VirtualBus, TicksThatTookTooLongSkipPeriods) {
  sync_read(dxl::Instruction::kSyncRead, at::kPresentPosition, 4, {99});
  poll(2 * params.period_us + 1);
  sync_read(dxl::Instruction::kSyncRead, at::kPresentPosition, 4, {99});
  EXPECT_EQ(bus.tick(), 3u);
}

TEST_F(VirtualBus, SamplesEachJointWhenItsReplyBegins) {
  for (std::uint8_t id = 1; id <= 3; ++id) write(id, at::kReturnDelay, {0});
  sync_read(dxl::Instruction::kSyncRead, at::kPresentPosition, 4, {1, 2, 3});
  const std::uint64_t asked_us = bus.now_us() + 17 * 5;
  for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(plant.sampled_us[j], asked_us + j * 15 * 5);
  EXPECT_FALSE(plant.went_back);
}

TEST_F(VirtualBus, FastSyncReadNeedsEveryServoToKnowIt) {
  sync_read(dxl::Instruction::kFastSyncRead, at::kPresentPosition, 4, {1, 2, 3});
  EXPECT_EQ(replies().size(), 1u);
  params.servo[0] = {.model_number = dxl::kModelMx28, .fast_sync_read = 0};
  test::FakePlant mx_plant;
  bus::VirtualBus mx(params, mx_plant);
  Bytes frame(64);
  const Bytes ids = {1, 2, 3};
  mx.send(frame.data(),
          dxl::encode_sync_read(frame.data(), frame.size(), dxl::Instruction::kFastSyncRead,
                                at::kPresentPosition, 4, ids.data(), ids.size()));
  EXPECT_EQ(mx.poll(frame.data(), frame.size(), 100000), 0u);
}

TEST_F(VirtualBus, ASilentServoSilencesThoseBehindIt) {
  bus.set_connected(2, false);
  sync_read(dxl::Instruction::kSyncRead, at::kPresentPosition, 4, {1, 2, 3});
  EXPECT_EQ(replies().size(), 1u);
}

TEST_F(VirtualBus, SyncWriteReachesThePlantWhenItArrives) {
  Bytes frame(64);
  dxl::Encoder encoder(frame.data(), frame.size());
  dxl::begin_sync_write(encoder, at::kGoalPosition, 4);
  for (std::uint8_t id = 1; id <= 3; ++id) {
    encoder.u8(id);
    encoder.u32(1000u + id);
  }
  const std::size_t size = encoder.finish();
  ASSERT_TRUE(bus.send(frame.data(), size));
  EXPECT_EQ(plant.now_us(), size * 5);
  for (int j = 0; j < 3; ++j) EXPECT_EQ(plant.setpoint(j).goal_count, 1001 + j);
}

TEST_F(VirtualBus, TorqueLocksTheEeprom) {
  EXPECT_EQ(write(1, at::kOperatingMode, {4}), 0);
  EXPECT_EQ(write(1, at::kTorqueEnable, {1}), 0);
  EXPECT_TRUE(plant.setpoint(0).torque_on);
  EXPECT_EQ(write(1, at::kOperatingMode, {3}), code(dxl::Error::kAccess));
  EXPECT_EQ(write(1, at::kTorqueEnable, {0}), 0);
  EXPECT_FALSE(plant.setpoint(0).torque_on);
  EXPECT_EQ(write(1, at::kOperatingMode, {3}), 0);
}

TEST_F(VirtualBus, RefusesWritesAsTheProtocolSays) {
  EXPECT_EQ(write(1, at::kPresentPosition, {0, 0, 0, 0}), code(dxl::Error::kAccess));
  EXPECT_EQ(write(1, 14, {0}), code(dxl::Error::kAccess));
  EXPECT_EQ(write(1, at::kGoalPosition, {0, 0}), code(dxl::Error::kDataLength));
  EXPECT_EQ(write(1, at::kTorqueEnable, {2}), code(dxl::Error::kDataRange));
  EXPECT_EQ(write(1, at::kGoalPosition, {0, 0x10, 0, 0}), code(dxl::Error::kDataLimit));
  EXPECT_EQ(write(1, at::kPwmLimit, {0x90, 1}), 0);
  EXPECT_EQ(write(1, at::kGoalPwm, {0x91, 1}), code(dxl::Error::kDataLimit));
  EXPECT_EQ(write(1, at::kGoalPwm, {0x6F, 0xFE}), code(dxl::Error::kDataLimit)) << "-401";
  EXPECT_EQ(write(1, at::kGoalPwm, {0x90, 1}), 0);
  Bytes reboot = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x7F};
  const std::uint16_t crc = dxl::crc16(reboot.data(), reboot.size());
  reboot.push_back(static_cast<std::uint8_t>(crc));
  reboot.push_back(static_cast<std::uint8_t>(crc >> 8));
  bus.send(reboot.data(), reboot.size());
  EXPECT_EQ(reply().error, code(dxl::Error::kInstruction));
}

TEST_F(VirtualBus, ARefusedWriteChangesNothing) {
  // The operating mode is invalid.
  EXPECT_EQ(write(1, at::kReturnDelay, {0, 4, 99}), code(dxl::Error::kDataRange));
  EXPECT_EQ(read(1, at::kReturnDelay, 3).data, (Bytes{250, 0, 3}));
}

TEST_F(VirtualBus, GainsAndTimeBasedProfileReachThePlant) {
  EXPECT_EQ(write(2, at::kDriveMode, {dxl::kTimeBasedProfile}), 0);
  EXPECT_EQ(write(2, at::kPositionDGain, {20, 0, 10, 0, 0xAC, 0x0D}), 0);
  EXPECT_EQ(write(2, at::kProfileAcceleration, {0, 0, 0, 0, 12, 0, 0, 0}), 0);
  EXPECT_EQ(plant.setpoint(1).d_gain, 20);
  EXPECT_EQ(plant.setpoint(1).i_gain, 10);
  EXPECT_EQ(plant.setpoint(1).p_gain, 3500);
  EXPECT_EQ(plant.setpoint(1).profile_ms, 12u);
}

TEST_F(VirtualBus, ANewOperatingModeResetsGainsAndProfile) {
  EXPECT_EQ(write(1, at::kPositionPGain, {0xAC, 0x0D}), 0);
  EXPECT_EQ(write(1, at::kOperatingMode, {4}), 0);
  EXPECT_EQ(read(1, at::kPositionPGain, 2).data, (Bytes{0x20, 0x03}));
}

TEST_F(VirtualBus, TorqueWithoutAGoalHoldsThePoseFound) {
  plant.measured[0].position_count = 1234;
  EXPECT_EQ(write(1, at::kTorqueEnable, {1}), 0);
  EXPECT_EQ(plant.setpoint(0).goal_count, 1234);
}

TEST_F(VirtualBus, PresentValuesAreInTheTablesUnits) {
  plant.measured[0] = {.position_count = -5,
                       .velocity_rad_s = -0.229 * 2 * 3.14159265358979 / 60 * 10,
                       .duty = -0.5,
                       .current_a = 0.269,
                       .temperature_c = 41,
                       .voltage_v = 11.9};
  const Bytes data = read(1, at::kPresentPwm, 23).data;
  ASSERT_EQ(data.size(), 23u);
  EXPECT_EQ(static_cast<std::int16_t>(dxl::get_u16(&data[0])), -443);
  EXPECT_EQ(dxl::get_u16(&data[2]), 100);
  EXPECT_EQ(static_cast<std::int32_t>(dxl::get_u32(&data[4])), -10);
  EXPECT_EQ(static_cast<std::int32_t>(dxl::get_u32(&data[8])), -5);
  EXPECT_EQ(dxl::get_u16(&data[20]), 119);
  EXPECT_EQ(data[22], 41);
}

TEST_F(VirtualBus, OverheatingRaisesTheAlertAndTakesTheTorque) {
  EXPECT_EQ(write(1, at::kTorqueEnable, {1}), 0);
  plant.measured[0].temperature_c = 90;
  const Reply hot = read(1, at::kPresentTemperature, 1);
  EXPECT_EQ(hot.error, dxl::kAlert);
  EXPECT_FALSE(plant.setpoint(0).torque_on);
  EXPECT_EQ(read(1, at::kHardwareError, 1).data, Bytes{dxl::kOverheatingError});
  write(1, at::kTorqueEnable, {1});
  EXPECT_FALSE(plant.setpoint(0).torque_on);
}

TEST(VirtualServo, TellsAVoltageOutsideWhatItIsMadeForAndNoOther) {
  struct Case {
    double nominal_v, least_v, most_v;
  };
  for (const Case& is : {Case{12, 9.5, 16}, Case{24, 19, 32}, Case{5, 4, 6.7}}) {
    SCOPED_TRACE(is.nominal_v);
    test::FakePlant plant;
    bus::ServoDevice servo({.rating = {.nominal_v = is.nominal_v}}, plant, 0);
    const auto error_at = [&](double volts) {
      plant.measured[0].voltage_v = volts;
      servo.refresh(at::kHardwareError, 1);
      const auto error = servo.read(at::kHardwareError, 1);
      return error.empty() ? 255 : int{error[0]};
    };
    EXPECT_EQ(dxl::get_u16(servo.read(at::kMaxVoltageLimit, 2).data()),
              std::lround(10 * is.most_v));
    EXPECT_EQ(dxl::get_u16(servo.read(at::kMinVoltageLimit, 2).data()),
              std::lround(10 * is.least_v));
    EXPECT_EQ(error_at(is.nominal_v), 0);
    EXPECT_EQ(error_at(is.least_v), 0);
    EXPECT_EQ(error_at(is.most_v), 0);
    EXPECT_EQ(error_at(is.nominal_v < 12 ? is.least_v - 0.1 : is.most_v + 0.1),
              int{dxl::kInputVoltageError});
  }
}

TEST_F(VirtualBus, SensorsStandInOneBlockWithAServosHealth) {
  sync_read(dxl::Instruction::kSyncRead, dxl::sensor_block::kAddress, dxl::sensor_block::kBytes,
            {test::kImuId, test::kLeftFootId, test::kRightFootId, 1});
  const auto all = replies();
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].data, (Bytes{1, 0, 0xFE, 0xFF, 3, 0, 0xFC, 0xFF, 5, 0, 0, 0x10}));
  EXPECT_EQ(all[1].data, (Bytes{100, 0, 101, 0, 102, 0, 103, 0, 0, 0, 0, 0}));
  EXPECT_EQ(dxl::get_u16(&all[3].data[8]), 120);
}

TEST_F(VirtualBus, StatusLevelOneAnswersReadsButNotWrites) {
  Bytes frame(64);
  const std::uint8_t one = 1;
  for (const std::uint16_t address : {at::kStatusReturnLevel, at::kLed}) {
    bus.send(frame.data(), dxl::encode_write(frame.data(), frame.size(), 1, address, &one, 1));
    EXPECT_TRUE(replies().empty());
  }
  EXPECT_EQ(read(1, at::kLed, 1).data, Bytes{1});
}

// Counted from power-up, the wait would be over.
TEST_F(VirtualBus, AWaitForNobodysAnswerEndsItsTimeAfterTheRequest) {
  for (const bool real_time : {false, true}) {
    bus::VirtualBus line{params, plant};
    line.set_real_time(real_time);
    Bytes byte(1), frame(16);
    line.bring_until(5'000, byte.data(), byte.size());
    line.send(frame.data(), dxl::encode_ping(frame.data(), frame.size(), 77));
    EXPECT_EQ(line.poll(byte.data(), byte.size(), 800), 0u);
    EXPECT_EQ(line.now_us(), 5'800u) << (real_time ? "in real time" : "in lockstep");
  }
}

TEST_F(VirtualBus, PowerBeginsAServoAnewOnlyWhereItWasGone) {
  ASSERT_EQ(write(1, at::kLed, {1}), 0);
  bus.set_powered(1, true);
  EXPECT_EQ(read(1, at::kLed, 1).data, Bytes{1}) << "it had power";
  bus.set_powered(1, false);
  Bytes frame(16);
  bus.send(frame.data(), dxl::encode_ping(frame.data(), frame.size(), 1));
  EXPECT_TRUE(poll().empty());
  bus.set_powered(1, true);
  EXPECT_EQ(read(1, at::kLed, 1).data, Bytes{0});
}

TEST_F(VirtualBus, IgnoresFramesWithABadCrc) {
  Bytes frame(16);
  const std::size_t size = dxl::encode_ping(frame.data(), frame.size(), 1);
  frame[size - 1] ^= 1;
  ASSERT_TRUE(bus.send(frame.data(), size));
  EXPECT_TRUE(poll().empty());
}

}  // namespace
}  // namespace verp
