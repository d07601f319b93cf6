#include "host/twin/can/virtual_can.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/host/can/can_bench.hpp"

namespace verp {
namespace {

using test::CanBench;
namespace plan = canopen::plan;
namespace object = canopen::cia402::object;

CanFrame frame_of(std::uint32_t id, std::uint8_t size, std::uint8_t fill = 0x55) {
  CanFrame frame = canopen::classic_frame(id, size);
  for (unsigned i = 0; i < size; ++i) frame.data[i] = fill;
  return frame;
}

TEST(VirtualCan, BootsAllNodesInTheOrderOfTheirIdentifiers) {
  CanBench bench(3);
  std::vector<std::uint32_t> ids;
  for (const CanFrame& frame : bench.listen(5000)) {
    EXPECT_EQ(frame.size, 1);
    EXPECT_EQ(frame.data[0], 0) << "the boot-up message";
    ids.push_back(frame.id);
  }
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{0x701, 0x702, 0x703, 0x764, 0x765, 0x766}));
}

TEST(VirtualCan, FramesTakeExactlyTheirBits) {
  CanBench bench(1);
  bench.let_pass(5000);
  struct Seen {
    CanFrame frame;
    std::uint64_t begin_ns, end_ns;
  };
  std::vector<Seen> seen;
  bench.bus.set_listener([&](const CanFrame& frame, std::uint64_t begin_ns, std::uint64_t end_ns) {
    seen.push_back({frame, begin_ns, end_ns});
  });
  const std::uint64_t bits = bench.bus.bits_on_wire();
  const CanFrame frames[] = {frame_of(0x123, 8, 0), frame_of(0x124, 8, 0xFF), frame_of(0x125, 0)};
  for (const CanFrame& each : frames) ASSERT_TRUE(bench.bus.send(each));
  bench.let_pass(5000);
  ASSERT_EQ(seen.size(), 3u);
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint64_t own = canopen::exact_bits(frames[i]).all();
    sum += own;
    EXPECT_TRUE(seen[i].frame == frames[i]);
    EXPECT_EQ(seen[i].end_ns - seen[i].begin_ns, (own - canopen::kIntermissionBits) * 1000);
    if (i > 0) {
      EXPECT_EQ(seen[i].begin_ns, seen[i - 1].end_ns + 3000) << "the intermission";
    }
  }
  EXPECT_EQ(bench.bus.bits_on_wire() - bits, sum);
}

TEST(VirtualCan, TheLowestIdentifierOfThoseThatWaitGoesFirst) {
  CanBench bench(1);
  bench.let_pass(5000);
  std::vector<std::uint32_t> ids;
  bench.bus.set_listener(
      [&](const CanFrame& frame, std::uint64_t, std::uint64_t) { ids.push_back(frame.id); });
  for (const std::uint32_t id : {0x500u, 0x300u, 0x700u, 0x301u}) {
    ASSERT_TRUE(bench.bus.send(frame_of(id, 8)));
  }
  CanFrame extended = frame_of(0x300u << 18, 1);
  extended.extended = true;
  ASSERT_TRUE(bench.bus.send(extended));
  bench.let_pass(5000);
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{0x300, 0x300u << 18, 0x301, 0x500, 0x700}));
}

TEST(VirtualCan, OnlySyncOneWaitsForThePeriod) {
  CanBench bench(1);
  bench.let_pass(12'345);
  std::vector<std::uint64_t> begins_us;
  bench.bus.set_listener([&](const CanFrame& frame, std::uint64_t begin_ns, std::uint64_t) {
    if (frame.id == canopen::kSyncId) begins_us.push_back(begin_ns / 1000);
  });
  EXPECT_FALSE(bench.bus.ticking());
  bench.sync(1);
  bench.sync(2);
  bench.let_pass(1000);
  EXPECT_TRUE(bench.bus.ticking());
  EXPECT_EQ(bench.bus.tick(), 0u);
  bench.sync(1);
  bench.let_pass(25'000);
  EXPECT_EQ(bench.bus.tick(), 1u);
  bench.sync(1);
  bench.let_pass(1000);
  EXPECT_EQ(bench.bus.tick(), 4u) << "a period that is missed is skipped";
  ASSERT_EQ(begins_us.size(), 4u);
  EXPECT_EQ(begins_us[0], 20'000u);
  EXPECT_LT(begins_us[1], 20'200u);
  EXPECT_EQ(begins_us[2], 30'000u);
  EXPECT_EQ(begins_us[3], 60'000u);
  EXPECT_FALSE(bench.plant.went_back);
}

TEST(VirtualCan, WhatWasSentBeforeATickIsOnTheWireBeforeIt) {
  CanBench bench(1);
  bench.let_pass(5000);
  std::vector<std::uint64_t> ends_us;
  bench.bus.set_listener([&](const CanFrame& frame, std::uint64_t, std::uint64_t end_ns) {
    const bool ours = frame.id == canopen::kSyncId || frame.id == 0x7F0;
    if (ours) ends_us.push_back(end_ns / 1000);
  });
  for (unsigned i = 0; i < 47; ++i) ASSERT_TRUE(bench.bus.send(frame_of(0x7F0, 8)));
  bench.sync(1);
  bench.let_pass(1000);
  ASSERT_EQ(ends_us.size(), 48u);
  EXPECT_LT(ends_us[46], 20'000u);
  EXPECT_GE(ends_us[47], 20'000u) << "they took longer than the first period left";
}

TEST(VirtualCan, SamplesWhenTheSyncEnds) {
  CanBench bench(2);
  bench.let_pass(5000);
  for (const std::uint8_t node : {test::kImuId, test::kLeftFootId, test::kRightFootId}) {
    bench.write(node, plan::kSyncOverflow, 2, 1);
  }
  for (std::uint8_t node = 1; node <= 2; ++node) {
    const std::uint16_t comm = 0x1801;
    bench.write(node, plan::kSyncOverflow, 2, 1);
    bench.write(node, {comm, 2}, 1, 1);
    bench.write(node, {comm, 1}, 0x40000280 + node, 4);
  }
  bench.nmt(canopen::NmtCommand::kStart);
  CanFrame frame;
  while (bench.bus.bring_until(bench.bus.now_us() + 1000, frame)) {
  }
  bench.plant.measured[0].position_count = 1111;
  bench.plant.measured[1].position_count = 2222;
  bench.sync(2);
  const std::vector<CanFrame> answers = bench.listen(2000);
  std::vector<std::uint32_t> ids;
  for (const CanFrame& each : answers) {
    ids.push_back(each.id);
    if (each.id == 0x281) {
      EXPECT_EQ(canopen::get_le(each.data + 2, 4), 1111u);
    }
    if (each.id == 0x282) {
      EXPECT_EQ(canopen::get_le(each.data + 2, 4), 2222u);
    }
  }
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{0x1E4, 0x1E5, 0x1E6, 0x281, 0x282, 0x2E4}));
}

TEST(VirtualCan, AnswersTheSameToTheSame) {
  const auto run = [] {
    CanBench bench(5);
    std::vector<std::uint64_t> log;
    bench.bus.set_listener([&](const CanFrame& frame, std::uint64_t begin_ns, std::uint64_t) {
      log.push_back(frame.id);
      log.push_back(begin_ns);
      log.push_back(canopen::get_le(frame.data, 8));
    });
    bench.enable(3);
    bench.nmt(canopen::NmtCommand::kStart);
    for (std::uint8_t counter = 1; counter < 5; ++counter) bench.sync(counter);
    bench.let_pass(5000);
    return log;
  };
  const auto first = run();
  EXPECT_GT(first.size(), 60u);
  EXPECT_EQ(first, run());
}

TEST(VirtualCan, CountsFramesThatFindNoRoom) {
  CanBench bench(3);
  std::uint32_t answers = 0;
  bench.bus.set_listener([&](const CanFrame& frame, std::uint64_t, std::uint64_t) {
    const bool ours = frame.id == canopen::kSyncId || frame.id == canopen::sdo_request_id(1);
    if (!ours) ++answers;
  });
  CanFrame request = frame_of(canopen::sdo_request_id(1), 8, 0);
  request.data[0] = 0x40;  // upload 1000h
  request.data[2] = 0x10;
  for (unsigned round = 0; round < 4; ++round) {
    for (unsigned i = 2; i < hal::kCanQueue; ++i) ASSERT_TRUE(bench.bus.send(request));
    bench.sync(1);  // sends all that waits
  }
  unsigned read = 0;
  for (CanFrame frame; bench.bus.poll(frame, 1000);) ++read;
  EXPECT_GT(bench.bus.errors().overruns, 0u);
  EXPECT_EQ(read + bench.bus.errors().overruns, answers);
}

TEST(VirtualCan, AnUnpluggedNodeNeitherHearsNorSpeaks) {
  CanBench bench(2);
  bench.let_pass(5000);
  bench.bus.set_connected(2, false);
  bench.nmt(canopen::NmtCommand::kStart);
  std::int64_t value = 0;
  EXPECT_EQ(bench.read(2, plan::kDeviceType, value), canopen::Abort::kTimeout);
  bench.bus.set_connected(2, true);
  EXPECT_EQ(bench.read(2, plan::kDeviceType, value), canopen::Abort::kNone);
  EXPECT_EQ(value, 0x00020192);
}

TEST(VirtualCan, PowerThatComesBackBootsANodeWithoutTorqueAndWithItsDefaults) {
  CanBench bench(1);
  bench.enable(1);
  bench.write(1, object::kMaxTorque, 300, 2);
  ASSERT_TRUE(bench.setpoint(0).torque_on);
  bench.bus.set_powered(1, false);
  EXPECT_FALSE(bench.setpoint(0).torque_on);
  EXPECT_TRUE(bench.listen(20'000).empty());
  bench.bus.set_powered(1, true);
  const std::vector<CanFrame> frames = bench.listen(2000);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].id, 0x701u);
  EXPECT_FALSE(bench.setpoint(0).torque_on);
  EXPECT_EQ(bench.value(1, object::kMaxTorque), 1000);
}

}  // namespace
}  // namespace verp
