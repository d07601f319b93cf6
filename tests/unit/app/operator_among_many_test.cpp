#include <gtest/gtest.h>

#include <cstdint>

#include "firmware/app/operator_device.hpp"
#include "tests/unit/app/operator_bench.hpp"

namespace verp::app::test {
namespace {

using dxl::Instruction;

TEST(OperatorAmongMany, TakesItsPartOfWritesToMany) {
  Bench& bench = renewed<Bench>(no_images, OperatorSetup{});
  dxl::Encoder sync(bench.frame, sizeof bench.frame);
  dxl::begin_sync_write(sync, reg("walk_vx"), 2);
  for (const std::uint8_t id : {std::uint8_t{3}, bench.id}) {
    sync.u8(id);
    sync.u16(id);
  }
  EXPECT_EQ(bench.send(sync.finish()).packets, 0);
  EXPECT_EQ(bench.device.order(0).command.vx_tenth_mm_s, 200);
  dxl::Encoder bulk(bench.frame, sizeof bench.frame);
  dxl::begin_bulk(bulk, Instruction::kBulkWrite);
  dxl::bulk_entry(bulk, 3, reg("walk_vx"), 2);
  bulk.u16(1);
  dxl::bulk_entry(bulk, bench.id, reg("walk_vy"), 2);
  bulk.u16(2);
  EXPECT_EQ(bench.send(bulk.finish()).packets, 0);
  EXPECT_EQ(bench.device.order(1).command.vx_tenth_mm_s, 200);
  EXPECT_EQ(bench.device.order(2).command.vy_tenth_mm_s, 2);
}

TEST(OperatorAmongMany, WaitsForItsTurnInAReadOfMany) {
  Bench& bench = renewed<Bench>(no_images, OperatorSetup{});
  const std::uint8_t first[] = {bench.id, 3};
  const std::uint8_t second[] = {3, bench.id};
  const auto ask = [&](const std::uint8_t* ids) {
    return bench
        .send(dxl::encode_sync_read(bench.frame, sizeof bench.frame, Instruction::kSyncRead,
                                    reg("tick"), 4, ids, 2))
        .packets;
  };
  EXPECT_EQ(ask(first), 1);
  EXPECT_EQ(ask(second), 0);
  const std::uint8_t data[4] = {};
  std::size_t size = dxl::encode_status(bench.frame, sizeof bench.frame, 4, 0, data, 4);
  EXPECT_EQ(bench.send(size).packets, 0) << "not the one before us";
  size = dxl::encode_status(bench.frame, sizeof bench.frame, 3, 0, data, 4);
  EXPECT_EQ(bench.send(size).packets, 1);
  EXPECT_EQ(bench.send(size).packets, 0) << "once";
  EXPECT_EQ(ask(second), 0);
  bench.plain(Instruction::kPing);
  EXPECT_EQ(bench.send(dxl::encode_status(bench.frame, sizeof bench.frame, 3, 0, data, 4)).packets,
            0)
      << "another instruction ended that read";
}

TEST(OperatorAmongMany, AnswersFastReads) {
  Bench& bench = renewed<Bench>(no_images, OperatorSetup{});
  bench.inputs.tick = 0x12345678;
  bench.record();
  const std::size_t size = dxl::encode_sync_read(
      bench.frame, sizeof bench.frame, Instruction::kFastSyncRead, reg("tick"), 4, &bench.id, 1);
  const Reply reply = bench.send(size);
  ASSERT_EQ(reply.packets, 1);
  EXPECT_EQ(reply.id, dxl::kBroadcast);
  ASSERT_EQ(reply.size, dxl::kFastBlockBytes + 4);
  EXPECT_EQ(dxl::get_u32(reply.data + 2), 0x12345678u);
}

}  // namespace
}  // namespace verp::app::test
