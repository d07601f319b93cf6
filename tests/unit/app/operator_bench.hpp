#pragma once
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <new>

#include "common/protocol/dynamixel2.hpp"
#include "firmware/app/operator_device.hpp"
#include "hal/fake/memory_link.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::app::test {

using verp::test::kRobot;

/// Replaces the last object: it is too large for a microcontroller's stack.
template <class Thing, class... Arguments>
Thing& renewed(Arguments&&... arguments) {
  alignas(Thing) static unsigned char place[sizeof(Thing)];
  return *new (static_cast<void*>(place)) Thing(static_cast<Arguments&&>(arguments)...);
}

struct Reply {
  int packets = 0;
  std::uint8_t id = 0;
  dxl::Error error = dxl::Error::kNone;
  bool alert = false;
  std::size_t size = 0;
  std::uint8_t data[dxl::kMaxPacket] = {};
};

class Bench {
 public:
  explicit Bench(Images& store, const OperatorSetup& setup = {})
      : device(wire.left(), kRobot, setup, store), id(setup.id) {
    state.tuning = kRobot.tuning;
  }

  /// Sends bytes and serves them. The reply stays in `raw`.
  Reply send(const std::uint8_t* bytes, std::size_t size) {
    raw_size = 0;
    Reply reply;
    dxl::Parser parser;
    std::size_t sent = 0;
    for (int idle = 0; idle < 2;) {
      sent += wire.right().write(bytes + sent, size - sent, 0);
      idle = device.poll() || sent < size ? 0 : idle + 1;
      receive(parser, reply);
    }
    return reply;
  }
  Reply send(std::size_t size) { return send(frame, size); }

  Reply read(std::uint16_t address, std::uint16_t length) {
    return send(dxl::encode_read(frame, sizeof frame, id, address, length));
  }
  template <class Value>
  Value value(std::uint16_t address) {
    const Reply reply = read(address, sizeof(Value));
    EXPECT_TRUE(reply.error == dxl::Error::kNone) << address;
    EXPECT_EQ(reply.size, sizeof(Value)) << address;
    Value result{};
    __builtin_memcpy(&result, reply.data, sizeof result);
    return result;
  }
  Reply write_bytes(std::uint16_t address, const std::uint8_t* data, std::size_t size) {
    return send(dxl::encode_write(frame, sizeof frame, id, address, data, size));
  }
  template <class Value>
  dxl::Error write(std::uint16_t address, Value value) {
    std::uint8_t bytes[sizeof value];
    __builtin_memcpy(bytes, &value, sizeof value);
    const Reply reply = write_bytes(address, bytes, sizeof bytes);
    EXPECT_EQ(reply.packets, 1) << address;
    return reply.error;
  }
  Reply plain(dxl::Instruction instruction) {
    return send(dxl::encode_plain(frame, sizeof frame, id, instruction));
  }
  void relax() { EXPECT_TRUE(write(reg("request"), std::uint8_t{0}) == dxl::Error::kNone); }
  void record() { device.record({state.digest, inputs}, state, outputs); }
  void arm(bool on) {
    outputs.torque_enable = on ? 1 : 0;
    record();
  }

  hal::MemoryWire wire;
  OperatorDevice device;
  std::uint8_t id;
  Inputs inputs;
  State state;
  Outputs outputs;
  std::uint8_t frame[dxl::kMaxPacket];
  std::uint8_t raw[1024];
  std::size_t raw_size = 0;

 private:
  void receive(dxl::Parser& parser, Reply& reply) {
    std::uint8_t bytes[256];
    const std::size_t count = wire.right().read(bytes, sizeof bytes, 0);
    for (std::size_t i = 0; i < count; ++i) {
      if (raw_size < sizeof raw) raw[raw_size++] = bytes[i];
      if (!parser.push(bytes[i])) continue;
      const dxl::Packet& packet = parser.packet();
      ++reply.packets;
      reply.id = packet.id;
      reply.error = static_cast<dxl::Error>(packet.error & ~dxl::kAlert);
      reply.alert = (packet.error & dxl::kAlert) != 0;
      reply.size = packet.size;
      __builtin_memcpy(reply.data, packet.parameters, packet.size);
    }
  }
};

inline Bench& fresh_bench(const OperatorSetup& setup = {}) {
  return renewed<Bench>(no_images, setup);
}
inline Bench& relaxed_bench() {
  Bench& bench = fresh_bench();
  bench.relax();
  bench.device.order(0);
  return bench;
}

}  // namespace verp::app::test
