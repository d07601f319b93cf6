#include "firmware/app/operator_device.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>

#include "tests/unit/app/operator_bench.hpp"

// "Documented" sequences are the examples of ROBOTIS e-Manual, "DYNAMIXEL Protocol 2.0", which
// address device 1.

namespace verp::app::test {
namespace {

using dxl::Error;
using dxl::Instruction;

template <std::size_t kSize>
Reply send(Bench& bench, const std::uint8_t (&bytes)[kSize]) {
  return bench.send(bytes, kSize);
}

template <std::size_t kSize>
bool answered(const Bench& bench, const std::uint8_t (&bytes)[kSize]) {
  if (bench.raw_size != kSize) return false;
  for (std::size_t i = 0; i < kSize; ++i) {
    if (bench.raw[i] != bytes[i]) return false;
  }
  return true;
}

TEST(OperatorDevice, NeverGivesTheRestOfAReplyToTheNextOperator) {
  Bench& bench = fresh_bench();
  const std::size_t size = dxl::encode_read(bench.frame, sizeof bench.frame, bench.id, 256, 300);
  bench.wire.right().write(bench.frame, size, 0);
  while (bench.device.poll()) {
    if (bench.device.reply_waits()) break;
  }
  ASSERT_TRUE(bench.device.reply_waits());
  bench.wire.cut();
  std::uint8_t sink[64];
  while (bench.wire.right().read(sink, sizeof sink, 0) > 0) {
  }
  bench.device.poll();
  EXPECT_FALSE(bench.device.reply_waits());
  bench.wire.mend();
  bench.device.poll();
  const Reply reply = bench.plain(Instruction::kPing);
  EXPECT_EQ(reply.packets, 1);
  EXPECT_EQ(bench.raw[0], 0xFF) << "begins with a header";
  EXPECT_EQ(bench.raw_size, 14u);
}

TEST(OperatorDevice, TellsAtWhichDeviceTheBringUpEnded) {
  Bench& bench = fresh_bench();
  EXPECT_EQ(bench.value<std::uint8_t>(reg("bring_up")), 0);
  bench.device.brought_up({.status = BringUpStatus::kNotVerified, .device_id = 14, .address = 84});
  EXPECT_EQ(bench.value<std::uint8_t>(reg("bring_up")), 5);
  EXPECT_EQ(bench.value<std::uint8_t>(reg("bring_up_device")), 14);
  EXPECT_EQ(bench.value<std::uint16_t>(reg("bring_up_register")), 84);
  bench.device.brought_up({});
  EXPECT_EQ(bench.value<std::uint8_t>(reg("bring_up")), 1);
}

TEST(OperatorDevice, AnswersTheDocumentedPing) {
  Bench& bench = fresh_bench({.id = 1});
  const std::uint8_t ping[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x01, 0x19, 0x4E};
  const Reply reply = send(bench, ping);
  EXPECT_EQ(reply.packets, 1);
  EXPECT_EQ(reply.id, 1);
  ASSERT_EQ(reply.size, 3u);
  EXPECT_EQ(dxl::get_u16(reply.data), table::kModel);
  EXPECT_EQ(reply.data[2], table::kTableVersion);
  const std::uint8_t all[] = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x03, 0x00, 0x01, 0x31, 0x42};
  EXPECT_EQ(send(bench, all).packets, 1);
}

TEST(OperatorDevice, AnswersTheDocumentedRead) {
  Bench& bench = fresh_bench({.id = 1});
  // The example's register shows 166; at that address the controller has part of the digest.
  bench.state.digest.chain = std::uint64_t{0xA6} << 32;
  bench.record();
  const std::uint8_t read[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x07, 0x00,
                               0x02, 0x84, 0x00, 0x04, 0x00, 0x1D, 0x15};
  send(bench, read);
  const std::uint8_t status[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x08, 0x00, 0x55,
                                 0x00, 0xA6, 0x00, 0x00, 0x00, 0x8C, 0xC0};
  EXPECT_TRUE(answered(bench, status));
}

TEST(OperatorDevice, AcknowledgesAsDocumented) {
  Bench& bench = fresh_bench({.id = 1});
  const std::uint8_t reboot[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x08, 0x2F, 0x4E};
  EXPECT_FALSE(bench.device.reboot_asked());
  send(bench, reboot);
  const std::uint8_t good[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x04, 0x00, 0x55, 0x00, 0xA1, 0x0C};
  EXPECT_TRUE(answered(bench, good));
  EXPECT_TRUE(bench.device.reboot_asked());
}

TEST(OperatorDevice, RefusesWithTheDocumentedErrors) {
  Bench& bench = fresh_bench({.id = 1});
  // Documented Write of 116, read-only here.
  const std::uint8_t write[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x09, 0x00, 0x03,
                                0x74, 0x00, 0x00, 0x02, 0x00, 0x00, 0xCA, 0x89};
  EXPECT_TRUE(send(bench, write).error == Error::kAccess);
  // Documented Reg Write of 104, which is no register.
  const std::uint8_t reg_write[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x09, 0x00, 0x04,
                                    0x68, 0x00, 0xC8, 0x00, 0x00, 0x00, 0xAE, 0x8E};
  EXPECT_TRUE(send(bench, reg_write).error == Error::kAccess);
  // Documented Action.
  const std::uint8_t action[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x05, 0x02, 0xCE};
  EXPECT_TRUE(send(bench, action).error == Error::kInstruction);
  // Documented Factory Reset and Clear.
  const std::uint8_t reset[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x04, 0x00, 0x06, 0x01, 0xA1, 0xE6};
  EXPECT_TRUE(send(bench, reset).error == Error::kInstruction);
  const std::uint8_t clear[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x08, 0x00, 0x10,
                                0x01, 0x44, 0x58, 0x4C, 0x22, 0xB1, 0xDC};
  EXPECT_TRUE(send(bench, clear).error == Error::kInstruction);
  EXPECT_TRUE(bench.write(reg("request"), std::uint8_t{4}) == Error::kDataRange);
  EXPECT_TRUE(bench.write(reg("walk_vx"), std::uint8_t{3}) == Error::kDataLength);
  EXPECT_TRUE(bench.read(table::kTableBytes - 1, 2).error == Error::kAccess);
  EXPECT_TRUE(bench.read(0xFFFF, 0xFFFF).error == Error::kAccess);
  EXPECT_TRUE(bench.write(reg("action_request"), std::uint16_t{1}) == Error::kDataRange)
      << "there are no actions yet";
}

TEST(OperatorDevice, EveryRegisterKeepsItsAccess) {
  Bench& bench = fresh_bench();
  for (const bool armed : {false, true}) {
    bench.arm(armed);
    for (const table::Register& each : table::kTable) {
      if (each.address == reg("window_data") || each.address == reg("parameter_value")) continue;
      std::uint8_t bytes[8] = {};
      const std::size_t size = table::type_bytes(each.type);
      const std::uint16_t address = each.address;
      __builtin_memcpy(bytes, bench.read(address, static_cast<std::uint16_t>(size)).data, size);
      const bool open = each.access == table::Access::kWrite ||
                        (each.access == table::Access::kDisarmed && !armed);
      const Reply reply = bench.write_bytes(address, bytes, size);
      EXPECT_TRUE(reply.error == (open ? Error::kNone : Error::kAccess)) << each.name;
    }
  }
}

TEST(OperatorDevice, ArmedItKeepsIdAndSourceAndDoesNotRestart) {
  Bench& bench = fresh_bench();
  bench.arm(true);
  EXPECT_TRUE(bench.write(reg("id"), std::uint8_t{7}) == Error::kAccess);
  EXPECT_TRUE(bench.plain(Instruction::kReboot).error == Error::kResultFail);
  EXPECT_FALSE(bench.device.reboot_asked());
  bench.arm(false);
  EXPECT_TRUE(bench.write(reg("imu_source"), std::uint8_t{0}) == Error::kDataRange)
      << "this board has no chip";
  const Reply reply = bench.write_bytes(reg("id"), reinterpret_cast<const std::uint8_t*>("\7"), 1);
  EXPECT_TRUE(reply.error == Error::kNone);
  EXPECT_EQ(reply.id, table::kDefaultId) << "the reply bears the id that was asked";
  EXPECT_EQ(bench.device.id(), 7);
  EXPECT_EQ(bench.read(0, 2).packets, 0);
  bench.id = 7;
  EXPECT_EQ(bench.read(0, 2).packets, 1);
}

// A twin that falls silent in mid-walk must not lock out the operator.
TEST(OperatorDevice, WithoutServosItOpensWhatTorqueKeptUntilTheNextTick) {
  Bench& bench = fresh_bench();
  bench.relax();
  bench.device.order(0);
  EXPECT_TRUE(bench.write(reg("request"), std::uint8_t{2}) == Error::kNone);
  bench.arm(true);
  bench.device.servos_gone();
  EXPECT_FALSE(bench.device.armed());
  EXPECT_EQ(bench.value<std::uint8_t>(reg("torque_enable")), 0);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("joints_torque")), 0u);
  EXPECT_TRUE(bench.write(reg("torque_limit"), std::uint8_t{50}) == Error::kNone);
  const OperatorOrder order = bench.device.order(1);
  EXPECT_TRUE(order.command.request == static_cast<Request>(2));
  EXPECT_EQ(order.flags, kCommandFresh);
  bench.record();
  EXPECT_TRUE(bench.device.armed());
  EXPECT_TRUE(bench.write(reg("torque_limit"), std::uint8_t{60}) == Error::kAccess);
  EXPECT_TRUE(bench.plain(Instruction::kReboot).error == Error::kResultFail);
  bench.device.servos_gone();
  EXPECT_TRUE(bench.plain(Instruction::kReboot).error == Error::kNone);
  EXPECT_TRUE(bench.device.reboot_asked());
}

TEST(OperatorDevice, CalibratesTheChipThatSteersAndNoOther) {
  using Order = table::ImuCalibrationOrder;
  Bench& bench = fresh_bench({.imu_sources = 3});
  EXPECT_TRUE(bench.write(reg("imu_calibrate"), std::uint8_t{1}) == Error::kResultFail);
  EXPECT_TRUE(bench.device.take_calibration_order() == Order::kNone);
  ASSERT_TRUE(bench.write(reg("imu_source"), std::uint8_t{0}) == Error::kNone);
  for (const std::uint8_t order : {std::uint8_t{1}, std::uint8_t{2}}) {
    EXPECT_TRUE(bench.write(reg("imu_calibrate"), order) == Error::kNone);
    EXPECT_EQ(bench.value<std::uint8_t>(reg("imu_calibrate")), 0);
    EXPECT_TRUE(bench.device.take_calibration_order() == static_cast<Order>(order));
    EXPECT_TRUE(bench.device.take_calibration_order() == Order::kNone) << "once";
  }
  bench.arm(true);
  EXPECT_TRUE(bench.write(reg("imu_calibrate"), std::uint8_t{1}) == Error::kAccess);
  bench.device.show(table::ImuCalibrationState::kMoved);
  EXPECT_EQ(bench.value<std::uint8_t>(reg("imu_calibration")), 3);
}

TEST(OperatorDevice, StatusReturnLevelIsKept) {
  Bench& bench = fresh_bench();
  const std::uint8_t level_at[] = {0, 1, 2};
  for (const std::uint8_t level : level_at) {
    bench.write_bytes(reg("status_return_level"), &level, 1);
    EXPECT_EQ(bench.plain(Instruction::kPing).packets, 1);
    EXPECT_EQ(bench.read(0, 2).packets, level >= 1 ? 1 : 0);
    const std::uint8_t relax = 0;
    EXPECT_EQ(bench.write_bytes(reg("request"), &relax, 1).packets, level >= 2 ? 1 : 0);
  }
}

TEST(OperatorDevice, RegisteredWritesWaitForTheirAction) {
  Bench& bench = relaxed_bench();
  const std::uint8_t stand = 1;
  EXPECT_TRUE(bench
                  .send(dxl::encode_reg_write(bench.frame, sizeof bench.frame, bench.id,
                                              reg("request"), &stand, 1))
                  .error == Error::kNone);
  EXPECT_EQ(bench.value<std::uint8_t>(reg("registered_instruction")), 1);
  EXPECT_TRUE(bench.device.order(0).command.request == Request::kRelax);
  EXPECT_TRUE(bench.plain(Instruction::kAction).error == Error::kNone);
  EXPECT_TRUE(bench.device.order(1).command.request == Request::kStand);
  EXPECT_EQ(bench.value<std::uint8_t>(reg("registered_instruction")), 0);
}

// The link takes 256 bytes at a time.
TEST(OperatorDevice, LongRepliesGoOutInPiecesWithoutWaiting) {
  Bench& bench = fresh_bench();
  constexpr std::uint16_t kLength = 400;
  const Reply reply = bench.read(reg("device_kind"), kLength);
  EXPECT_EQ(reply.packets, 1);
  EXPECT_EQ(reply.size, kLength);
  EXPECT_EQ(bench.wire.now_us(), 0u) << "no call waited";
  EXPECT_TRUE(bench.read(0, 800).error == Error::kDataLimit) << "more than a packet holds";
}

TEST(OperatorDevice, ForeignAndBadPacketsGetNoAnswer) {
  Bench& bench = fresh_bench();
  bench.send(dxl::encode_ping(bench.frame, sizeof bench.frame, 3));
  EXPECT_EQ(bench.raw_size, 0u);
  const std::size_t size = dxl::encode_ping(bench.frame, sizeof bench.frame, bench.id);
  bench.frame[size - 1] ^= 1;
  EXPECT_EQ(bench.send(size).packets, 0);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("link_crc_errors")), 1u);
}

// A false header hides requests until its CRC fails.
TEST(OperatorDevice, AnswersAllRequestsThatComeOutTogether) {
  Bench& bench = fresh_bench();
  std::uint8_t bytes[64] = {0xFF, 0xFF, 0xFD, 0x00, bench.id, 35, 0x00};
  const std::uint8_t relax = 0;
  std::size_t size = 7;
  for (int i = 0; i < 2; ++i) {
    size +=
        dxl::encode_write(bytes + size, sizeof bytes - size, bench.id, reg("request"), &relax, 1);
    size += dxl::encode_ping(bytes + size, sizeof bytes - size, bench.id);
  }
  EXPECT_EQ(bench.send(bytes, size).packets, 4);
}

/// Requests that lie whole in the link before the device looks.
struct Together {
  explicit Together(Bench& to) : bench(to) {}
  Together& ping() { return add(dxl::encode_ping(end(), room(), bench.id)); }
  Together& read(std::uint16_t length) {
    return add(dxl::encode_read(end(), room(), bench.id, 0, length));
  }
  Together& write(std::uint16_t address, std::uint8_t value) {
    return add(dxl::encode_write(end(), room(), bench.id, address, &value, 1));
  }
  /// Data bytes of each answer in order, a digit each.
  unsigned answers() {
    const std::size_t fits = bench.wire.right().write(bytes, size, 0);
    EXPECT_EQ(fits, size);
    unsigned sizes = 0;
    dxl::Parser parser;
    std::uint8_t some[64];
    for (int idle = 0; idle < 2;) {
      idle = bench.device.poll() ? 0 : idle + 1;
      const std::size_t count = bench.wire.right().read(some, sizeof some, 0);
      for (std::size_t i = 0; i < count; ++i) {
        if (parser.push(some[i])) sizes = sizes * 10 + static_cast<unsigned>(parser.packet().size);
      }
    }
    return sizes;
  }

  Bench& bench;
  std::uint8_t bytes[256] = {};
  std::size_t size = 0;

 private:
  std::uint8_t* end() { return bytes + size; }
  std::size_t room() const { return sizeof bytes - size; }
  Together& add(std::size_t count) {
    size += count;
    return *this;
  }
};

TEST(OperatorDevice, OfReadsInARowAnswersTheNewest) {
  EXPECT_EQ(Together(fresh_bench()).read(2).read(3).read(4).answers(), 4u);
  EXPECT_EQ(Together(fresh_bench()).ping().read(4).answers(), 4u);
  EXPECT_EQ(Together(fresh_bench()).read(4).ping().answers(), 3u);
  // More than the device takes at once.
  Bench& bench = fresh_bench();
  Together many(bench);
  for (int i = 0; i < 12; ++i) many.read(2);
  EXPECT_EQ(many.read(4).answers(), 4u);
}

// TickPort sends a write and a read of each block together, OperatorPort an order and a read.
TEST(OperatorDevice, ExecutesEveryWriteAndAnswersTheReadsAroundItInOrder) {
  Bench& bench = relaxed_bench();
  Together requests(bench);
  requests.read(3).read(4).write(reg("request"), 1).read(5).write(reg("torque_limit"), 50);
  requests.write(reg("request"), 2).read(6).read(7);
  EXPECT_EQ(requests.answers(), 405007u);
  EXPECT_TRUE(bench.device.order(1).command.request == static_cast<Request>(2));
  EXPECT_EQ(bench.device.torque_limit_percent(), 50);
}

TEST(OperatorDevice, FinishesTheAnswerThatBeganToLeave) {
  Bench& bench = fresh_bench();
  const std::size_t size =
      dxl::encode_read(bench.frame, sizeof bench.frame, bench.id, reg("device_kind"), 400);
  bench.wire.right().write(bench.frame, size, 0);
  while (bench.device.poll() && !bench.device.reply_waits()) {
  }
  ASSERT_TRUE(bench.device.reply_waits()) << "part of it has left";
  const Reply reply = bench.plain(Instruction::kPing);
  EXPECT_EQ(reply.packets, 2);
  EXPECT_EQ(reply.size, 3u);
}

TEST(OperatorDevice, AWriteBehindAnAnswerWithoutRoomWaitsForIt) {
  Bench& bench = relaxed_bench();
  std::uint8_t sink[256];
  for (std::size_t full = 0; full < 256; full += 11) bench.wire.left().write(sink, 11, 0);
  Together requests(bench);
  requests.read(4).write(reg("request"), 1);
  ASSERT_EQ(bench.wire.right().write(requests.bytes, requests.size, 0), requests.size);
  for (int i = 0; i < 4; ++i) bench.device.poll();
  EXPECT_TRUE(bench.device.reply_waits());
  EXPECT_TRUE(bench.device.order(1).command.request == Request::kRelax);
  bench.wire.right().read(sink, sizeof sink, 0);
  const Reply reply = bench.send(nullptr, 0);
  EXPECT_EQ(reply.packets, 2);
  EXPECT_TRUE(bench.device.order(2).command.request == Request::kStand);
}

bool in_bounds(Bench& bench) {
  for (const table::Register& each : table::kTable) {
    if (!each.writable()) continue;
    const unsigned size = table::type_bytes(each.type);
    const Reply reply = bench.read(each.address, static_cast<std::uint16_t>(size));
    if (reply.packets != 1 || reply.size != size) return false;
    const std::int64_t value = dxl::register_value(reply.data, size, each.minimum < 0);
    const std::int64_t maximum = each.minimum < 0
                                     ? std::int64_t{static_cast<std::int32_t>(each.maximum)}
                                     : std::int64_t{each.maximum};
    if (value < each.minimum || value > maximum) return false;
  }
  const auto parameter = bench.value<float>(reg("parameter_value"));
  return in_range(bench.value<std::uint16_t>(reg("parameter_id")), parameter);
}

TEST(OperatorDevice, NoBytesLeaveItsRegistersOutOfRange) {
  verp::test::Random random(3);
  const Instruction all[] = {
      Instruction::kPing,         Instruction::kRead,         Instruction::kWrite,
      Instruction::kRegWrite,     Instruction::kAction,       Instruction::kSyncRead,
      Instruction::kSyncWrite,    Instruction::kBulkRead,     Instruction::kBulkWrite,
      Instruction::kFastSyncRead, Instruction::kFastBulkRead, Instruction::kStatus,
      Instruction::kFactoryReset, Instruction::kClear};
  Bench& bench = fresh_bench();
  for (int round = 0; round < 1500; ++round) {
    dxl::Encoder encoder(bench.frame, sizeof bench.frame);
    bench.id = bench.device.id();
    const bool broad = random.below(3) == 0;
    encoder.begin(broad ? dxl::kBroadcast : bench.id, all[random.below(14)]);
    const table::Register& target = table::kTable[random.below(table::kRegisters)];
    if (random.below(4) != 0) encoder.u16(target.address + random.bits() % 3 / 2);
    for (int i = random.below(random.below(8) == 0 ? 150 : 9); i > 0; --i) {
      encoder.u8(static_cast<std::uint8_t>(random.below(3) == 0 ? random.bits() : bench.id));
    }
    std::size_t size = encoder.finish();
    if (random.below(8) == 0) bench.frame[random.below(static_cast<int>(size))] ^= 0x10;
    if (random.below(8) == 0) size -= static_cast<std::size_t>(random.below(4));
    bench.send(size);
    const OperatorOrder order = bench.device.order(0);
    ASSERT_LE(static_cast<int>(order.command.request), static_cast<int>(Request::kWalk));
    if ((order.flags & kParameterWrite) != 0) {
      float value;
      __builtin_memcpy(&value, &order.parameter_bits, 4);
      ASSERT_TRUE(in_range(order.parameter_id, value));
    }
  }
  for (int i = 0; i < 2; ++i) {
    const std::uint8_t zeros[dxl::kMaxPacket] = {};
    bench.send(zeros, sizeof zeros);
  }
  bench.id = bench.device.id();
  const std::uint8_t answer_all = 2;
  bench.write_bytes(reg("status_return_level"), &answer_all, 1);
  EXPECT_TRUE(in_bounds(bench));
  EXPECT_EQ(bench.value<std::uint16_t>(0), table::kModel);
}

}  // namespace
}  // namespace verp::app::test
