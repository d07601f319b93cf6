#include "firmware/app/bus_master.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <new>

#include "common/protocol/control_table.hpp"
#include "firmware/app/read_chain.hpp"
#include "firmware/app/schedule.hpp"
#include "hal/fake/scripted_bus.hpp"

namespace verp::app {
namespace {

constexpr std::uint8_t kId = 5;
constexpr std::uint32_t kLateUs = 1000;
constexpr std::uint32_t kSoonUs = 100;

/// Two equal reads: the first reply is late.
struct Exchange {
  Exchange() {
    const std::uint8_t old_value[] = {1, 1, 1, 1};
    const std::uint8_t new_value[] = {2, 2, 2, 2};
    request_size =
        dxl::encode_read(request, sizeof request, kId, dxl::address::kPresentPosition, 4);
    std::uint8_t reply[32];
    std::size_t size = dxl::encode_status(reply, sizeof reply, kId, 0, old_value, 4);
    bus.expect(request, request_size, reply, size, kLateUs);
    size = dxl::encode_status(reply, sizeof reply, kId, 0, new_value, 4);
    bus.expect(request, request_size, reply, size, kSoonUs);
  }
  bool ask(BusMaster& master, std::uint32_t timeout) {
    for (std::size_t i = 0; i < request_size; ++i) master.frame()[i] = request[i];
    return master.request(request_size, timeout, [this](const dxl::Packet& packet) {
      value = packet.parameters[0];
      return packet.id == kId ? Take::kDone : Take::kStray;
    });
  }
  hal::ScriptedBus bus;
  std::uint8_t request[32];
  std::size_t request_size = 0;
  std::uint8_t value = 0;
};

struct LateReply {
  Exchange exchange;
  BusMaster master{exchange.bus};
};
/// In one place, for the RAM of a microcontroller.
LateReply& late_reply() {
  alignas(LateReply) static std::byte place[sizeof(LateReply)];
  return *new (place) LateReply;
}

TEST(BusMaster, GivesUpWhenTheTimeIsOverAndCountsIt) {
  auto& [exchange, master] = late_reply();
  EXPECT_FALSE(exchange.ask(master, kLateUs - 1));
  EXPECT_EQ(exchange.bus.now_us(), kLateUs - 1);
  EXPECT_EQ(master.counters().timeouts, 1u);
  EXPECT_EQ(exchange.value, 0);
}

TEST(BusMaster, ARequestIsNotAnsweredByItsPredecessorsReply) {
  auto& [exchange, master] = late_reply();
  EXPECT_FALSE(exchange.ask(master, kLateUs - 1));
  std::uint8_t seen = 0;
  EXPECT_EQ(exchange.bus.poll(&seen, 1, kLateUs), 1u);
  EXPECT_TRUE(exchange.ask(master, kSoonUs));
  EXPECT_EQ(exchange.value, 2);
  EXPECT_TRUE(exchange.bus.finished());
}

TEST(BusMaster, RepliesMayComeByteByByte) {
  auto& [exchange, master] = late_reply();
  exchange.bus.set_piece(1);
  EXPECT_TRUE(exchange.ask(master, kLateUs));
  EXPECT_EQ(exchange.value, 1);
}

// A write before a read leaves two echoes in front of the answer.
TEST(BusMaster, EchoesOfItsOwnPacketsAreStraysAndNoAnswers) {
  static hal::ScriptedBus bus;
  static BusMaster master(bus);
  std::uint8_t write[32], read[32], line[96];
  dxl::Encoder encoder(write, sizeof write);
  dxl::begin_sync_write(encoder, dxl::address::kTorqueEnable, 1);
  encoder.u8(kId), encoder.u8(0);
  const std::size_t written = encoder.finish();
  const std::size_t asked =
      dxl::encode_read(read, sizeof read, kId, dxl::address::kPresentPosition, 4);
  std::size_t size = 0;
  for (std::size_t i = 0; i < written; ++i) line[size++] = write[i];
  for (std::size_t i = 0; i < asked; ++i) line[size++] = read[i];
  const std::uint8_t value[] = {7, 0, 0, 0};
  size += dxl::encode_status(line + size, sizeof line - size, kId, 0, value, sizeof value);
  bus.expect(write, written, line, 0, 0);
  bus.expect(read, asked, line, size, kSoonUs);
  __builtin_memcpy(master.frame(), write, written);
  EXPECT_TRUE(master.send(written));
  __builtin_memcpy(master.frame(), read, asked);
  int position = -1;
  EXPECT_TRUE(master.request(asked, kLateUs, [&](const dxl::Packet& packet) {
    position = packet.parameters[0];
    return Take::kDone;
  }));
  EXPECT_EQ(position, 7);
  EXPECT_EQ(master.counters().strays, 2u);
  EXPECT_EQ(master.counters().errors, 0u);
}

TEST(ReadChain, PutsTheFirstMissedDeviceLast) {
  ReadChain<4> chain;
  for (std::uint8_t id = 1; id <= 4; ++id) chain.add(id, static_cast<std::uint8_t>(id - 1));
  chain.begin();
  EXPECT_EQ(chain.match(1), 0);
  EXPECT_EQ(chain.match(3), 2);
  EXPECT_EQ(chain.match(2), -1) << "its turn is over";
  EXPECT_EQ(chain.match(4), 3);
  EXPECT_TRUE(chain.ended());
  EXPECT_FALSE(chain.complete());
  const std::uint8_t expected[] = {1, 3, 4, 2};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(chain.ids()[i], expected[i]);
}

TEST(ReadChain, KeepsItsOrderWhenAllAnswer) {
  ReadChain<4> chain;
  for (std::uint8_t id = 1; id <= 4; ++id) chain.add(id, id);
  chain.begin();
  for (std::uint8_t id = 1; id <= 4; ++id) EXPECT_EQ(chain.match(id), id);
  EXPECT_TRUE(chain.complete());
  for (int i = 0; i < 4; ++i) EXPECT_EQ(chain.ids()[i], i + 1);
}

// Packet sizes for 21 servos at 2 Mbaud.
TEST(Schedule, CountsTheBytesOfATick) {
  EXPECT_EQ(sync_read_bytes(21, 4), 35u + 21 * 15);
  EXPECT_EQ(fast_sync_read_bytes(21, 4), 35u + 8 + 21 * 8);
  EXPECT_EQ(sync_write_bytes(21, 4), 14u + 21 * 5);
  EXPECT_EQ(wire_us(200, 2000000), 1000u);
  EXPECT_EQ(wire_us(1, 3000000), 4u) << "rounded up";
}

}  // namespace
}  // namespace verp::app
