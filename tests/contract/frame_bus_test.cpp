#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <thread>
#include <vector>

#include "common/protocol/dynamixel2.hpp"
#include "firmware/app/remote_bus.hpp"
#include "hal/contract/frame_bus.hpp"
#include "hal/fake/scripted_bus.hpp"
#include "host/bus/bus_server.hpp"
#include "host/bus/virtual_bus.hpp"
#include "tests/host/bus/fake_plant.hpp"
#include "tests/host/bus/pipes.hpp"

// The promises of hal/contract/frame_bus.hpp, held against each backend. A backend is prepared for
// `pings` pings of servo 1 and answers each with the e-Manual's status packet, but for the firmware
// version.

namespace verp {
namespace {

constexpr std::uint32_t kPlentyUs = 20000;
constexpr std::uint32_t kTooShortUs =
    60;  // less than a ping's own time, or than the script's delay
const std::vector<std::uint8_t> kPing = {0xFF, 0xFF, 0xFD, 0x00, 0x01,
                                         0x03, 0x00, 0x01, 0x19, 0x4E};

std::vector<std::uint8_t> ping_reply() {
  std::vector<std::uint8_t> reply(32);
  const std::uint8_t identity[] = {0x06, 0x04, 45};
  reply.resize(dxl::encode_status(reply.data(), reply.size(), 1, 0, identity, 3));
  return reply;
}

struct Scripted {
  explicit Scripted(int pings) {
    const auto reply = ping_reply();
    for (int i = 0; i < pings; ++i) {
      bus.expect(kPing.data(), kPing.size(), reply.data(), reply.size(), 200);
    }
  }
  hal::ScriptedBus bus;
};

struct ScriptedInPieces : Scripted {
  explicit ScriptedInPieces(int pings) : Scripted(pings) { bus.set_piece(3); }
};

struct Virtual {
  explicit Virtual(int) {}
  Params params = test::bus_params(2);
  test::FakePlant plant;
  bus::VirtualBus bus{params, plant};
};

/// The virtual bus again, through the link of an emulated microcontroller.
struct Remote {
  explicit Remote(int) {
    server = std::thread([this] {
      bus::BusServer(
          params, virtual_bus,
          bus::file_streams(pipes.from_controller.read_end(), pipes.to_controller.write_end()), {},
          {})
          .serve();
    });
    EXPECT_TRUE(bus.hello(received));
  }
  ~Remote() {
    pipes.from_controller.close_write_end();
    server.join();
  }
  Params params = test::bus_params(2);
  Params received;
  test::FakePlant plant;
  bus::VirtualBus virtual_bus{params, plant};
  test::PipePair pipes;
  test::PipeEnd in{pipes.to_controller};
  test::PipeEnd out{pipes.from_controller};
  std::thread server;
  app::RemoteBus<test::PipeEnd, test::PipeEnd> bus{in, out};
};

template <class Backend>
class FrameBusContract : public ::testing::Test {
 protected:
  static bool ping(Backend& backend) { return backend.bus.send(kPing.data(), kPing.size()); }
  static std::vector<std::uint8_t> collect(Backend& backend, std::size_t capacity,
                                           std::uint32_t timeout_us) {
    std::vector<std::uint8_t> all;
    std::vector<std::uint8_t> piece(capacity);
    while (const std::size_t count = backend.bus.poll(piece.data(), capacity, timeout_us)) {
      EXPECT_LE(count, capacity);
      all.insert(all.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(count));
    }
    return all;
  }
};

using Backends = ::testing::Types<Scripted, ScriptedInPieces, Virtual, Remote>;
TYPED_TEST_SUITE(FrameBusContract, Backends);

TYPED_TEST(FrameBusContract, ModelsTheConcept) {
  static_assert(hal::FrameBus<decltype(TypeParam::bus)>);
}

TYPED_TEST(FrameBusContract, RefusesEmptyAndOversizedFrames) {
  TypeParam backend(0);
  const std::vector<std::uint8_t> large(hal::kMaxFrame + 1);
  EXPECT_FALSE(backend.bus.send(kPing.data(), 0));
  EXPECT_FALSE(backend.bus.send(large.data(), large.size()));
  EXPECT_TRUE(this->collect(backend, 64, kPlentyUs).empty());
}

TYPED_TEST(FrameBusContract, BringsTheReplyWholeAndInOrder) {
  TypeParam backend(2);
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(this->ping(backend));
    EXPECT_EQ(this->collect(backend, 256, kPlentyUs), ping_reply());
  }
}

TYPED_TEST(FrameBusContract, KeepsBytesThatDidNotFit) {
  TypeParam backend(1);
  ASSERT_TRUE(this->ping(backend));
  EXPECT_EQ(this->collect(backend, 1, kPlentyUs), ping_reply());
}

TYPED_TEST(FrameBusContract, ReturnsNothingOnlyWhenTheTimeIsOver) {
  TypeParam backend(0);
  const std::uint64_t before_us = backend.bus.now_us();
  std::array<std::uint8_t, 16> buffer{};
  EXPECT_EQ(backend.bus.poll(buffer.data(), buffer.size(), 1000), 0u);
  EXPECT_GE(backend.bus.now_us(), before_us + 1000);
}

TYPED_TEST(FrameBusContract, CountsTheTimeoutFromTheSendNotFromThePoll) {
  TypeParam backend(1);
  ASSERT_TRUE(this->ping(backend));
  EXPECT_EQ(this->collect(backend, 256, kPlentyUs), ping_reply());
  const std::uint64_t after_us = backend.bus.now_us();
  std::array<std::uint8_t, 16> buffer{};
  EXPECT_EQ(backend.bus.poll(buffer.data(), buffer.size(), kPlentyUs), 0u);
  EXPECT_EQ(backend.bus.now_us(), after_us);
}

TYPED_TEST(FrameBusContract, DeliversALateReplyToALaterPoll) {
  TypeParam backend(1);
  ASSERT_TRUE(this->ping(backend));
  EXPECT_TRUE(this->collect(backend, 256, kTooShortUs).empty());
  EXPECT_EQ(this->collect(backend, 256, kPlentyUs), ping_reply());
}

TYPED_TEST(FrameBusContract, NeverTurnsTimeBack) {
  TypeParam backend(4);
  std::uint64_t last_us = backend.bus.now_us();
  for (const std::uint32_t timeout_us : {0u, 500u, 100u, kPlentyUs}) {
    ASSERT_TRUE(this->ping(backend));
    this->collect(backend, 5, timeout_us);
    EXPECT_GE(backend.bus.now_us(), last_us);
    last_us = backend.bus.now_us();
  }
}

TEST(ScriptedBus, NamesWhatDidNotFollowTheScript) {
  hal::ScriptedBus bus;
  ASSERT_TRUE(bus.expect(kPing.data(), kPing.size(), nullptr, 0, 0));
  EXPECT_FALSE(bus.finished());
  bus.send(kPing.data(), kPing.size() - 1);
  EXPECT_EQ(bus.mismatches(), 1u);
  bus.send(kPing.data(), kPing.size());
  EXPECT_FALSE(bus.finished());
}

}  // namespace
}  // namespace verp
