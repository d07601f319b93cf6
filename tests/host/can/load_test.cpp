#include "host/twin/can/load_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "common/protocol/canopen/robot_load.hpp"
#include "tests/host/can/can_bench.hpp"

namespace verp {
namespace {

using can::LoadRow;
using canopen::FrameBits;
using canopen::Stuffing;
using test::CanBench;
namespace plan = canopen::plan;

constexpr std::uint32_t kDataBaud = 5'000'000;

LoadRow row_of(const std::vector<LoadRow>& rows, std::uint32_t rate_hz, int buses, bool fd) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const LoadRow& row) {
    return row.rate_hz == rate_hz && row.buses == buses && row.fd == fd;
  });
  EXPECT_NE(found, rows.end());
  return found == rows.end() ? LoadRow{} : *found;
}

TEST(BusLoad, TwentyOneDrivesAt125HzStayUnder70PercentAtWorst) {
  const std::vector<LoadRow> rows = can::load_table(test::can_params(21), kDataBaud);
  EXPECT_EQ(rows.size(), 16u);
  const LoadRow row = row_of(rows, 125, 1, false);
  EXPECT_LE(row.worst_permille, 700u);
  EXPECT_FALSE(row.no_room);
}

// The live check takes two frames of eight bytes a tick, no more with the IMU on the bus.
TEST(BusLoad, TheLiveCheckFitsBeside21DrivesAt125Hz) {
  Params params = test::can_params(21);
  const LoadRow row = row_of(can::load_table(params, kDataBaud), 125, 1, false);
  EXPECT_LE(row.published_permille, 700u);
  const FrameBits frames = canopen::classic_bits(8, Stuffing::kWorst) * 2;
  const std::uint32_t more = canopen::load_permille(frames, {1'000'000, 1'000'000}, 8000);
  EXPECT_NEAR(row.published_permille, row.worst_permille + more, 1);
  params.period_us = 8000;
  EXPECT_TRUE(plan::has_room_to_publish(params, false));
  params.period_us = 5000;
  EXPECT_FALSE(plan::has_room_to_publish(params, false));
}

// The counts take twelve bytes; the IMU's own frames are saved.
TEST(BusLoad, AnOwnImuIsToldInTwoFramesMore) {
  Params params = test::can_params(21);
  const plan::TickLoad load(params, {});
  FrameBits frames = load.published(false);
  frames += canopen::classic_bits(8, Stuffing::kWorst) * 2;
  EXPECT_EQ(load.published(true), frames);
  params.imu.device_id = 0;
  const LoadRow own = row_of(can::load_table(params, kDataBaud), 125, 1, false);
  const std::uint32_t told = canopen::load_permille(plan::TickLoad(params, {}).published(true),
                                                    {1'000'000, 1'000'000}, 8000);
  EXPECT_NEAR(own.published_permille, own.worst_permille + told, 1);
  params.imu.device_id = test::kImuId;
  params.period_us = 8000;
  EXPECT_FALSE(plan::has_room_to_publish(params, true)) << "the device on the bus answers as well";
}

TEST(BusLoad, NewOrdersInEachTickFitBesideTheLiveCheck) {
  const Params params = test::can_params(21);
  const plan::TickLoad load(params, {});
  const auto share = [&](plan::TickKind kind) {
    FrameBits bits = load.bits(kind);
    bits += load.published(false);
    bits += load.published_order();
    return canopen::load_permille(bits, {1'000'000, 1'000'000}, 8000);
  };
  EXPECT_LE(share(plan::TickKind::kSteady), plan::kMostLoadPermille);
  EXPECT_LE(share(plan::TickKind::kChange), plan::kMostChangePermille);
}

TEST(BusLoad, AFasterTickNeedsTwoBusesOrFd) {
  const std::vector<LoadRow> rows = can::load_table(test::can_params(21), kDataBaud);
  EXPECT_TRUE(row_of(rows, 200, 1, false).no_room);
  EXPECT_TRUE(row_of(rows, 250, 1, false).no_room);
  EXPECT_FALSE(row_of(rows, 200, 2, false).no_room);
  EXPECT_FALSE(row_of(rows, 200, 1, true).no_room);
}

TEST(BusLoad, WhatDoesNotFitIsNamed) {
  Params params = test::can_params(21);
  const int first = row_of(can::load_table(params, kDataBaud), 200, 1, false).no_room.value_or(21);
  ASSERT_LT(first, params.joint_count);
  for (const int drives : {first, first + 1}) {
    params.joint_count = static_cast<std::uint8_t>(drives);
    const LoadRow row = row_of(can::load_table(params, kDataBaud), 200, 1, false);
    EXPECT_EQ(row.no_room.has_value(), drives > first) << drives;
  }
}

TEST(BusLoad, GrowsWithTheRateAndShrinksWithBusesAndFd) {
  const std::vector<LoadRow> rows = can::load_table(test::can_params(21), kDataBaud);
  for (const LoadRow& row : rows) {
    EXPECT_LT(row.bare_permille, row.expected_permille);
    EXPECT_LT(row.expected_permille, row.worst_permille);
    EXPECT_LT(row.worst_permille, row.change_permille);
    if (row.rate_hz > 100) {
      EXPECT_GT(row.worst_permille, row_of(rows, 100, row.buses, row.fd).worst_permille);
    }
    if (row.buses == 2) {
      EXPECT_LT(row.worst_permille, row_of(rows, row.rate_hz, 1, row.fd).worst_permille);
    }
    if (row.fd) {
      EXPECT_LT(row.worst_permille, row_of(rows, row.rate_hz, row.buses, false).worst_permille);
    }
  }
}

// Only SYNC, heartbeat, controlword and telemetry are there twice.
TEST(BusLoad, TwoBusesShareTheDrives) {
  const std::vector<LoadRow> rows = can::load_table(test::can_params(21), kDataBaud);
  const LoadRow one = row_of(rows, 100, 1, false);
  const LoadRow two = row_of(rows, 100, 2, false);
  EXPECT_GE(2 * two.bits_bare, one.bits_bare);
  EXPECT_LE(two.bits_bare, one.bits_bare * 2 / 3);
}

class PlannedTicks {
 public:
  explicit PlannedTicks(const Params& params) : bench(params) {}

  /// Within 5 %, with and without stuff bits.
  void expect(const LoadRow& row) {
    set_up_all();
    std::uint64_t bare = 0, exact = 0;
    bench.bus.set_listener([&](const CanFrame& frame, std::uint64_t, std::uint64_t) {
      bare += canopen::frame_bits(frame, Stuffing::kNone).all();
      exact += canopen::exact_bits(frame).all();
    });
    const std::uint64_t before = bench.bus.bits_on_wire();
    for (int i = 0; i < kTicks; ++i) tick(i);
    EXPECT_EQ(bench.bus.bits_on_wire() - before, exact);
    EXPECT_NEAR(static_cast<double>(bare) / kTicks, row.bits_bare, 0.05 * row.bits_bare);
    EXPECT_NEAR(static_cast<double>(exact) / kTicks, row.bits_expected, 0.05 * row.bits_expected);
    EXPECT_GE(exact, std::uint64_t{row.bits_bare} * kTicks);
    EXPECT_LE(exact, std::uint64_t{row.bits_worst} * kTicks);
    EXPECT_EQ(bench.bus.errors().overruns, 0u);
  }

 private:
  static constexpr int kTicks = 20;

  void set_up(std::uint8_t node, std::uint16_t comm, std::uint8_t start) {
    const std::uint8_t groups = plan::sync_groups(bench.params);
    bench.write(node, plan::kSyncOverflow, groups, 1);
    bench.write(node, {comm, 1}, 0x80000000, 4);
    bench.write(node, {comm, 2}, groups, 1);
    bench.write(node, {comm, 6}, start, 1);
  }
  void turn_on(std::uint8_t node, std::uint16_t comm, std::uint32_t id) {
    ASSERT_EQ(bench.write(node, {comm, 1}, id, 4), canopen::Abort::kNone);
  }
  void set_up_all() {
    for (int j = 0; j < bench.params.joint_count; ++j) {
      const std::uint8_t node = bench.params.joint[j].servo_id;
      bench.write(node, {0x1400, 1}, 0x80000000, 4);
      bench.write(node, {0x1800, 1}, 0x80000000, 4);
      set_up(node, 0x1801, plan::group_of_joint(j));
      turn_on(node, 0x1801, canopen::tpdo_id(2, node));
    }
    const std::uint8_t last = plan::sync_groups(bench.params);
    for (const unsigned number : {1u, 2u}) {
      const auto comm = static_cast<std::uint16_t>(0x17FF + number);
      set_up(test::kImuId, comm, last);
      turn_on(test::kImuId, comm, canopen::tpdo_id(number, test::kImuId));
    }
    for (const std::uint8_t node : bench.params.feet.device_id) {
      if (node == 0) continue;
      set_up(node, 0x1800, last);
      turn_on(node, 0x1800, canopen::tpdo_id(1, node));
    }
    bench.nmt(canopen::NmtCommand::kStart);
    bench.let_pass(2000);
  }
  void shared(const plan::Shared& kind, int frame, std::uint32_t value) {
    const int members = plan::members_of(kind, bench.params, frame);
    CanFrame out = canopen::classic_frame(plan::shared_id(kind, bench.params, frame), 0);
    for (int i = 0; i < members; ++i) {
      canopen::put_le(out.data + out.size, value, kind.bytes_each());
      out.size = static_cast<std::uint8_t>(out.size + kind.bytes_each());
    }
    ASSERT_TRUE(bench.bus.send(out));
  }
  void tick(int number) {
    for (std::uint8_t counter = 1; counter <= plan::sync_groups(bench.params); ++counter) {
      bench.sync(counter);
      bench.let_pass(800);
    }
    bench.value(bench.params.joint[number % bench.params.joint_count].servo_id, plan::kTelemetry);
    for (int f = 0; f < plan::shared_frames(plan::kGoals, bench.params); ++f) {
      shared(plan::kGoals, f, 8192u + static_cast<std::uint32_t>(number * 7 + f));
    }
    shared(plan::kWords, 0, 0x0F);
    bench.bus.send(
        canopen::heartbeat_frame(plan::kControllerNode, canopen::NmtState::kOperational));
    bench.let_pass(3000);
  }

  CanBench bench;
};

TEST(PlannedTicks, PutOnTheWireWhatTheTableSays) {
  const Params params = test::can_params(21);
  PlannedTicks(params).expect(row_of(can::load_table(params, kDataBaud), 100, 1, false));
}

TEST(PlannedTicks, OfAHalfRobotAreThoseOfTwoBuses) {
  const LoadRow row = row_of(can::load_table(test::can_params(21), kDataBaud), 200, 2, false);
  Params half = test::can_params(11);
  for (std::uint8_t& id : half.feet.device_id) id = 0;
  PlannedTicks(half).expect(row);
}

}  // namespace
}  // namespace verp
