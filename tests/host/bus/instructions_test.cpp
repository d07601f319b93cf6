#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "common/protocol/control_table.hpp"
#include "host/twin/bus/virtual_bus.hpp"
#include "tests/host/bus/fake_plant.hpp"

namespace verp {
namespace {

using Bytes = std::vector<std::uint8_t>;
namespace at = dxl::address;
using dxl::Error;
using dxl::Instruction;

struct Reply {
  int id = -1;
  Error error = Error::kNone;
  Bytes data;
};

class BusInstructions : public ::testing::Test {
 protected:
  std::vector<Reply> send(const std::function<std::size_t(std::uint8_t*, std::size_t)>& encode) {
    Bytes frame(256);
    bus.send(frame.data(), encode(frame.data(), frame.size()));
    return replies();
  }
  std::vector<Reply> send(dxl::Encoder& encoder, const Bytes& frame) {
    bus.send(frame.data(), encoder.finish());
    return replies();
  }
  std::vector<Reply> replies() {
    Bytes buffer(4096);
    buffer.resize(bus.poll(buffer.data(), buffer.size(), 100000));
    last_bytes = buffer;
    dxl::Parser parser;
    std::vector<Reply> all;
    for (const std::uint8_t byte : buffer) {
      for (bool found = parser.push(byte); found; found = parser.next()) {
        const dxl::Packet& packet = parser.packet();
        all.push_back({packet.id, static_cast<Error>(packet.error & 0x7F),
                       Bytes(packet.parameters, packet.parameters + packet.size)});
      }
    }
    return all;
  }
  Reply one(const std::vector<Reply>& all) {
    EXPECT_EQ(all.size(), 1u);
    return all.empty() ? Reply{} : all.front();
  }
  Reply read(std::uint8_t id, std::uint16_t address, std::uint16_t length) {
    return one(send([&](std::uint8_t* to, std::size_t size) {
      return dxl::encode_read(to, size, id, address, length);
    }));
  }
  Error write(std::uint8_t id, std::uint16_t address, const Bytes& data) {
    return one(send([&](std::uint8_t* to, std::size_t size) {
             return dxl::encode_write(to, size, id, address, data.data(), data.size());
           }))
        .error;
  }
  Error reg_write(std::uint8_t id, std::uint16_t address, const Bytes& data) {
    return one(send([&](std::uint8_t* to, std::size_t size) {
             return dxl::encode_reg_write(to, size, id, address, data.data(), data.size());
           }))
        .error;
  }
  std::vector<Reply> plain(std::uint8_t id, Instruction instruction) {
    return send([&](std::uint8_t* to, std::size_t size) {
      return dxl::encode_plain(to, size, id, instruction);
    });
  }
  std::vector<Reply> reset(std::uint8_t id, dxl::Reset what) {
    return send([&](std::uint8_t* to, std::size_t size) {
      return dxl::encode_factory_reset(to, size, id, what);
    });
  }

  Params params = test::bus_params(3);
  test::FakePlant plant;
  bus::VirtualBus bus{params, plant};
  Bytes last_bytes;
};

TEST_F(BusInstructions, RegWriteWaitsForAction) {
  EXPECT_EQ(reg_write(1, at::kPositionPGain, {0x34, 0x12}), Error::kNone);
  EXPECT_EQ(reg_write(2, at::kPositionPGain, {0x34, 0x12}), Error::kNone);
  EXPECT_EQ(read(1, at::kRegisteredInstruction, 1).data, Bytes{1});
  EXPECT_NE(plant.setpoint(0).p_gain, 0x1234);
  EXPECT_TRUE(plain(dxl::kBroadcast, Instruction::kAction).empty()) << "broadcasts get no reply";
  EXPECT_EQ(plant.setpoint(0).p_gain, 0x1234);
  EXPECT_EQ(plant.setpoint(1).p_gain, 0x1234);
  EXPECT_EQ(read(1, at::kRegisteredInstruction, 1).data, Bytes{0});
}

TEST_F(BusInstructions, ActionWithoutRegWriteIsAnInstructionError) {
  EXPECT_EQ(one(plain(1, Instruction::kAction)).error, Error::kInstruction);
  EXPECT_EQ(reg_write(1, at::kPositionPGain, {0x34, 0x12}), Error::kNone);
  EXPECT_EQ(one(plain(1, Instruction::kAction)).error, Error::kNone);
  EXPECT_EQ(one(plain(1, Instruction::kAction)).error, Error::kInstruction) << "once only";
}

TEST_F(BusInstructions, WhatCannotBeWrittenCannotBeRegistered) {
  EXPECT_EQ(reg_write(1, at::kPresentPosition, {0, 0, 0, 0}), Error::kAccess);
  EXPECT_EQ(reg_write(1, at::kPositionPGain, {0xFF, 0xFF}), Error::kDataRange);
  EXPECT_EQ(read(1, at::kRegisteredInstruction, 1).data, Bytes{0});
}

TEST_F(BusInstructions, RebootTakesTorqueAndGainsButKeepsTheEeprom) {
  EXPECT_EQ(write(1, at::kReturnDelay, {7}), Error::kNone);
  EXPECT_EQ(write(1, at::kPositionPGain, {0x34, 0x12}), Error::kNone);
  EXPECT_EQ(write(1, at::kTorqueEnable, {1}), Error::kNone);
  EXPECT_TRUE(plant.setpoint(0).torque_on);
  EXPECT_EQ(one(plain(1, Instruction::kReboot)).error, Error::kNone);
  EXPECT_FALSE(plant.setpoint(0).torque_on);
  EXPECT_EQ(read(1, at::kPositionPGain, 2).data, (Bytes{0x20, 0x03})) << "800, as it began";
  EXPECT_EQ(read(1, at::kReturnDelay, 1).data, Bytes{7});
}

TEST_F(BusInstructions, RebootEndsAHardwareError) {
  plant.measured[0].temperature_c = 90;
  EXPECT_NE(read(1, at::kHardwareError, 1).data, Bytes{0});
  plant.measured[0].temperature_c = 30;
  EXPECT_NE(read(1, at::kHardwareError, 1).data, Bytes{0}) << "it stays until then";
  plain(1, Instruction::kReboot);
  EXPECT_EQ(read(1, at::kHardwareError, 1).data, Bytes{0});
}

TEST_F(BusInstructions, FactoryResetKeepsWhatItIsToldToKeep) {
  EXPECT_EQ(write(2, at::kReturnDelay, {7}), Error::kNone);
  EXPECT_EQ(write(2, at::kPositionPGain, {0x34, 0x12}), Error::kNone);
  EXPECT_EQ(one(reset(2, dxl::Reset::kAllButIdAndBaud)).id, 2);
  EXPECT_EQ(read(2, at::kReturnDelay, 1).data, Bytes{250});
  EXPECT_EQ(read(2, at::kPositionPGain, 2).data, (Bytes{0x20, 0x03}));
  // It now has 57600 baud.
  EXPECT_EQ(one(reset(2, dxl::Reset::kAllButId)).error, Error::kNone);
  EXPECT_TRUE(plain(2, Instruction::kPing).empty());
}

TEST_F(BusInstructions, FactoryResetNeedsTorqueOffAndAKnownOption) {
  EXPECT_EQ(write(2, at::kTorqueEnable, {1}), Error::kNone);
  EXPECT_EQ(one(reset(2, dxl::Reset::kAll)).error, Error::kResultFail);
  EXPECT_EQ(write(2, at::kTorqueEnable, {0}), Error::kNone);
  EXPECT_EQ(one(reset(2, static_cast<dxl::Reset>(0x55))).error, Error::kDataRange);
  EXPECT_EQ(one(plain(2, Instruction::kPing)).id, 2);
}

TEST_F(BusInstructions, NobodyForgetsItsIdByBroadcast) {
  EXPECT_TRUE(reset(dxl::kBroadcast, dxl::Reset::kAll).empty());
  for (std::uint8_t id = 1; id <= 3; ++id) EXPECT_EQ(one(plain(id, Instruction::kPing)).id, id);
}

TEST_F(BusInstructions, ClearIsForServosThatStandStill) {
  const auto clear = [&] {
    return one(send([](std::uint8_t* to, std::size_t size) {
             return dxl::encode_clear_turns(to, size, 1);
           }))
        .error;
  };
  EXPECT_EQ(clear(), Error::kNone);
  plant.measured[0].velocity_rad_s = 2;
  EXPECT_EQ(clear(), Error::kResultFail);
}

TEST_F(BusInstructions, BulkReadAsksEachDeviceForSomethingElse) {
  plant.measured[0].voltage_v = 11.9;
  plant.measured[1].temperature_c = 36;
  for (const Instruction instruction : {Instruction::kBulkRead, Instruction::kFastBulkRead}) {
    Bytes frame(64);
    dxl::Encoder encoder(frame.data(), frame.size());
    dxl::begin_bulk(encoder, instruction);
    dxl::bulk_entry(encoder, 1, at::kPresentVoltage, 2);
    dxl::bulk_entry(encoder, 2, at::kPresentTemperature, 1);
    const std::vector<Reply> all = send(encoder, frame);
    if (instruction == Instruction::kBulkRead) {
      ASSERT_EQ(all.size(), 2u);
      EXPECT_EQ(all[0].data, (Bytes{119, 0}));
      EXPECT_EQ(all[1].data, Bytes{36});
    } else {
      ASSERT_EQ(all.size(), 1u) << "one packet for all";
      dxl::Packet packet;
      packet.id = dxl::kBroadcast;
      packet.instruction = Instruction::kStatus;
      packet.parameters = all[0].data.data();
      packet.size = all[0].data.size();
      dxl::FastBlock block;
      ASSERT_TRUE(dxl::fast_block_at(packet, 0, 2, block));
      EXPECT_EQ(block.id, 1);
      EXPECT_EQ(dxl::get_u16(block.data), 119);
      ASSERT_TRUE(dxl::fast_block_at(packet, 2 + dxl::kFastBlockBytes, 1, block));
      EXPECT_EQ(block.id, 2);
      EXPECT_EQ(block.data[0], 36);
      EXPECT_FALSE(dxl::fast_block_at(packet, 3 + 2 * dxl::kFastBlockBytes, 0, block));
    }
  }
}

TEST_F(BusInstructions, BulkReadOfThePositionBeginsATick) {
  Bytes frame(64);
  dxl::Encoder encoder(frame.data(), frame.size());
  dxl::begin_bulk(encoder, Instruction::kBulkRead);
  dxl::bulk_entry(encoder, 1, at::kPresentVoltage, 2);
  dxl::bulk_entry(encoder, 2, at::kPresentVelocity, 8);
  send(encoder, frame);
  EXPECT_TRUE(bus.ticking());
}

TEST_F(BusInstructions, BulkWriteWritesEachItsOwnAndStopsAtACutEntry) {
  Bytes frame(64);
  dxl::Encoder encoder(frame.data(), frame.size());
  dxl::begin_bulk(encoder, Instruction::kBulkWrite);
  dxl::bulk_entry(encoder, 1, at::kPositionPGain, 2);
  encoder.u16(1000);
  dxl::bulk_entry(encoder, 99, at::kPositionPGain, 2);
  encoder.u16(1);
  dxl::bulk_entry(encoder, 2, at::kPositionDGain, 2);
  encoder.u16(50);
  dxl::bulk_entry(encoder, 3, at::kPositionDGain, 2);
  encoder.u8(9);
  EXPECT_TRUE(send(encoder, frame).empty());
  EXPECT_EQ(plant.setpoint(0).p_gain, 1000);
  EXPECT_EQ(plant.setpoint(1).d_gain, 50);
  EXPECT_EQ(plant.setpoint(2).d_gain, 0);
}

// As in the e-Manual, scattered registers make one block.
TEST_F(BusInstructions, IndirectDataStandsForTheBytesItsAddressesName) {
  plant.measured[0].temperature_c = 41;
  const auto point = [&](std::uint16_t pair, std::uint16_t to) {
    return write(1, static_cast<std::uint16_t>(at::kIndirectAddress1 + 2 * pair),
                 {static_cast<std::uint8_t>(to), static_cast<std::uint8_t>(to >> 8)});
  };
  EXPECT_EQ(point(0, at::kPresentTemperature), Error::kNone);
  EXPECT_EQ(point(1, at::kPositionPGain), Error::kNone);
  EXPECT_EQ(point(2, at::kPositionPGain + 1), Error::kNone);
  EXPECT_EQ(read(1, at::kIndirectData1, 3).data, (Bytes{41, 0x20, 0x03}));
  EXPECT_EQ(write(1, at::kIndirectData1 + 1, {0x34, 0x12}), Error::kNone);
  EXPECT_EQ(plant.setpoint(0).p_gain, 0x1234);
  EXPECT_EQ(write(1, at::kIndirectData1, {1}), Error::kAccess) << "a read-only byte stays one";
  EXPECT_EQ(write(1, at::kIndirectData1, {1, 1, 0}), Error::kAccess) << "nothing by halves";
  EXPECT_EQ(plant.setpoint(0).p_gain, 0x1234);
  EXPECT_EQ(write(1, at::kIndirectData1 + 1, {1}), Error::kDataLength) << "nor half a register";
  EXPECT_EQ(point(3, at::kId), Error::kDataRange) << "no way into the EEPROM";
}

TEST_F(BusInstructions, IndirectDataStoresBytesUntilItPointsElsewhere) {
  EXPECT_EQ(write(1, at::kIndirectData29, {7, 8, 9}), Error::kNone);
  EXPECT_EQ(read(1, at::kIndirectData29, 3).data, (Bytes{7, 8, 9}));
}

TEST_F(BusInstructions, UnknownInstructionIsRefusedByTheOneAskedOnly) {
  const auto unknown = static_cast<Instruction>(0x77);
  EXPECT_EQ(one(plain(1, unknown)).error, Error::kInstruction);
  EXPECT_TRUE(plain(dxl::kBroadcast, unknown).empty());
}

}  // namespace
}  // namespace verp
