#include <cstring>

#include "tests/host/bus/app_fixture.hpp"

// A transceiver that feeds the master's own bytes back, in both protocols.
namespace verp::test {
namespace {

constexpr int kJoints = 21;
constexpr int kTicks = 50;

Params params_of(BusProtocol protocol) {
  return protocol == BusProtocol::kFeetech ? feetech_params(kJoints) : bus_params(kJoints);
}

struct EchoRun {
  EchoRun(BusProtocol protocol, bool echo) : params(params_of(protocol)) {
    if (protocol == BusProtocol::kFeetech) {
      plant.rated.nominal_v = 7.4;
      for (auto& each : plant.measured) each.voltage_v = 7.4, each.position_count = 2000;
    }
    bus.set_echo(echo);
    brought_up = app.bring_up().status;
    wanted = {};
    wanted.torque_enable = (1u << kJoints) - 1;
    for (int j = 0; j < kJoints; ++j) wanted.goal_count[j] = 2000 + j;
    for (int i = 0; i < kTicks; ++i) app.tick();
  }
  Params params;
  FakePlant plant;
  bus::VirtualBus bus{params, plant};
  Tap tap{bus};
  Script script;
  Memory memory;
  app::App<Tap, Script, Memory> app{params, tap, script, memory};
  app::BringUpStatus brought_up = app::BringUpStatus::kSilent;
};

class EchoingLine : public ::testing::TestWithParam<BusProtocol> {};
INSTANTIATE_TEST_SUITE_P(, EchoingLine,
                         ::testing::Values(BusProtocol::kDynamixel2, BusProtocol::kFeetech),
                         [](const auto& each) {
                           return each.param == BusProtocol::kFeetech ? "Feetech" : "Dynamixel";
                         });

TEST_P(EchoingLine, ChangesNoFrameAndNoRecord) {
  EchoRun clean(GetParam(), false), echoing(GetParam(), true);
  EXPECT_EQ(echoing.brought_up, app::BringUpStatus::kReady);
  EXPECT_EQ(echoing.tap.frames, clean.tap.frames);
  ASSERT_EQ(echoing.memory.records.size(), clean.memory.records.size());
  for (std::size_t i = 0; i < clean.memory.records.size(); ++i) {
    const TickRecord &a = clean.memory.records[i], &b = echoing.memory.records[i];
    EXPECT_EQ(b.inputs.fresh, (1u << kJoints) - 1) << i;
    EXPECT_EQ(std::memcmp(&a.inputs, &b.inputs, sizeof a.inputs), 0) << i;
  }
  EXPECT_EQ(echoing.app.counters().timeouts, 0u);
  EXPECT_EQ(echoing.bus.now_us(), clean.bus.now_us());
}

TEST_P(EchoingLine, ShowsInTheStrays) {
  EchoRun clean(GetParam(), false), echoing(GetParam(), true);
  EXPECT_EQ(clean.app.counters().strays, 0u);
  EXPECT_GE(echoing.app.counters().strays, 2u * kTicks) << "each read's, at least";
}

TEST_P(EchoingLine, BringsEachByteBackAsItLeaves) {
  const Params params = params_of(GetParam());
  FakePlant plant;
  bus::VirtualBus bus(params, plant);
  for (const bool real_time : {false, true}) {
    bus.set_real_time(real_time);
    bus.set_echo(true);
    const std::uint8_t noise[] = {1, 2, 3, 4, 5};
    const std::uint64_t begin_us = bus.now_us();
    ASSERT_TRUE(bus.send(noise, sizeof noise));
    std::uint8_t heard[16] = {};
    EXPECT_EQ(bus.poll(heard, sizeof heard, 1000), sizeof noise);
    EXPECT_EQ(std::memcmp(heard, noise, sizeof noise), 0);
    EXPECT_EQ(bus.now_us() - begin_us, sizeof noise * 10'000'000 / params.baud);
  }
}

}  // namespace
}  // namespace verp::test
