#include <gtest/gtest.h>

#include <vector>

#include "firmware/app/app.hpp"
#include "firmware/app/bus_master.hpp"
#include "firmware/app/operator_device.hpp"
#include "hal/fake/memory_link.hpp"
#include "host/twin/bus/virtual_bus.hpp"
#include "tests/host/bus/fake_plant.hpp"

namespace verp {
namespace {

using app::reg;
using test::bus_params;
using test::FakePlant;

class OperatorOnTheLoop : public ::testing::Test {
 protected:
  OperatorOnTheLoop() {
    EXPECT_EQ(loop.bring_up().status, app::BringUpStatus::kReady);
    write(reg("request"), {0});
    device.order(0);
  }

  std::vector<std::uint8_t> ask(std::size_t size) {
    EXPECT_EQ(wire.right().write(frame, size, 0), size);
    while (device.poll()) {
    }
    std::uint8_t bytes[256];
    const std::size_t count = wire.right().read(bytes, sizeof bytes, 0);
    dxl::Parser parser;
    bool complete = false;
    for (std::size_t i = 0; i < count; ++i) complete = parser.push(bytes[i]);
    EXPECT_TRUE(complete);
    EXPECT_EQ(parser.packet().error & ~dxl::kAlert, 0);
    return {parser.packet().parameters, parser.packet().parameters + parser.packet().size};
  }
  void write(std::uint16_t address, const std::vector<std::uint8_t>& data) {
    ask(dxl::encode_write(frame, sizeof frame, device.id(), address, data.data(), data.size()));
  }
  template <class Value>
  Value read(std::uint16_t address) {
    const auto data =
        ask(dxl::encode_read(frame, sizeof frame, device.id(), address, sizeof(Value)));
    Value value{};
    if (data.size() == sizeof value) __builtin_memcpy(&value, data.data(), sizeof value);
    return value;
  }

  Params params = bus_params(21);
  FakePlant plant;
  bus::VirtualBus bus{params, plant};
  hal::MemoryWire wire;
  app::OperatorDevice device{wire.left(), params, {}};
  app::App<bus::VirtualBus, decltype(device), decltype(device)> loop{params, bus, device, device};
  std::uint8_t frame[dxl::kMaxPacket];
};

TEST_F(OperatorOnTheLoop, ReadsWhatTheTickWas) {
  for (int i = 0; i < 5; ++i) {
    loop.tick();
    EXPECT_EQ(read<std::uint32_t>(reg("tick")), loop.inputs().tick);
    EXPECT_EQ(read<std::uint64_t>(reg("digest")), loop.state().digest.chain);
    EXPECT_EQ(read<std::int32_t>(reg("present_position") + 12), loop.inputs().position_count[3]);
    EXPECT_EQ(read<std::uint32_t>(reg("command_age")), loop.state().admit.operator_age);
  }
}

TEST_F(OperatorOnTheLoop, AnOrderFeedsTheWatchdogOfTheCore) {
  for (int i = 0; i < 5; ++i) loop.tick();
  EXPECT_EQ(read<std::uint32_t>(reg("command_age")), 5u);
  write(reg("request"), {1});
  loop.tick();
  EXPECT_EQ(loop.inputs().command.request, Request::kStand);
  EXPECT_EQ(read<std::uint32_t>(reg("command_age")), 0u);
  loop.tick();
  EXPECT_EQ(read<std::uint32_t>(reg("command_age")), 1u);
}

TEST_F(OperatorOnTheLoop, TheTorqueLimitReachesEveryServoWithTheFirstTorque) {
  ASSERT_EQ(loop.bring_up().status, app::BringUpStatus::kReady);
  const auto tick = [&] {
    loop.limit_torque(device.torque_limit_percent());
    loop.tick();
  };
  tick();
  write(reg("torque_limit"), {35});
  for (int i = 0; i < 200 && !plant.setpoint(0).torque_on; ++i) {
    write(reg("request"), {1});
    tick();
  }
  for (int j = 0; j < params.joint_count; ++j) {
    EXPECT_TRUE(plant.setpoint(j).torque_on) << j;
    EXPECT_EQ(plant.setpoint(j).pwm_limit, dxl::kFullPwm * 35 / 100) << j;
  }
}

TEST_F(OperatorOnTheLoop, ATuningWriteIsInTheInputsOfExactlyOneTickAndThenInForce) {
  loop.tick();
  const float lift_m = 0.0125F;
  std::vector<std::uint8_t> data = {2, 0, 0, 0, 0, 0};
  __builtin_memcpy(data.data() + 2, &lift_m, 4);
  write(reg("parameter_id"), data);
  int ticks = 0;
  for (int i = 0; i < 5; ++i) {
    loop.tick();
    if ((loop.inputs().flags & kParameterWrite) == 0) continue;
    ++ticks;
    EXPECT_EQ(loop.inputs().parameter_id, 2);
  }
  EXPECT_EQ(ticks, 1);
  EXPECT_EQ(loop.state().tuning.gait.lift_m, lift_m);
  EXPECT_EQ(read<float>(reg("parameter_value")), lift_m);
}

TEST_F(OperatorOnTheLoop, AnUnpluggedServoIsSeenInTheTableOfDevices) {
  const auto ticks = [&](int count) {
    for (int i = 0; i < count; ++i) {
      plant.motion.gyro_count[0] ^= 1;  // an IMU that repeats itself is stale
      loop.tick();
    }
  };
  ticks(10);
  constexpr int kJoint = 20;  // answers last
  bus.set_connected(params.joint[kJoint].servo_id, false);
  ticks(60);
  device.report({.bus = loop.counters(), .bus_crc_errors = loop.crc_errors()});
  const auto state = [&](int row) {
    return read<app::table::DeviceState>(app::element(reg("device_state"), row, 1));
  };
  EXPECT_EQ(state(kJoint), app::table::DeviceState::kLost);
  EXPECT_EQ(state(0), app::table::DeviceState::kGood);
  EXPECT_EQ(state(app::table::kDeviceImu), app::table::DeviceState::kGood);
  EXPECT_EQ(state(app::table::kDeviceBus), app::table::DeviceState::kGood);
  EXPECT_GE(read<std::uint32_t>(reg("bus_timeouts")), 60u);
  EXPECT_GE(read<std::uint32_t>(app::element(reg("device_errors"), kJoint, 4)), 60u);
}

}  // namespace
}  // namespace verp
