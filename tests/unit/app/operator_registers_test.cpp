#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>

#include "common/base/crc32.hpp"
#include "common/model/counts.hpp"
#include "common/safety/machine.hpp"
#include "tests/unit/app/operator_bench.hpp"

namespace verp::app::test {
namespace {

using dxl::Error;

TEST(OperatorStart, IsToldInRegisters) {
  const OperatorSetup setup = {
      .self_test = table::SelfTest::kKinematics,
      .reset_cause = table::ResetCause::kFault,
      .brown_out = table::BrownOut::kRefused,
      .clock_source = table::ClockSource::kInternalPll,
      .bad_field = {"joint[3].lower_rad"},
      .crash = {.pc = 0x0800'1234, .cause = 0x8200, .tick = 77, .count = 3}};
  Bench& bench = renewed<Bench>(no_images, setup);
  EXPECT_EQ(bench.value<std::uint8_t>(reg("self_test")), 5);
  EXPECT_STREQ(bench.value<FieldName>(reg("image_field")).text, "joint[3].lower_rad");
  EXPECT_EQ(bench.value<std::uint8_t>(reg("reset_cause")), 6);
  EXPECT_EQ(bench.value<std::uint8_t>(reg("brown_out")), 3);
  EXPECT_EQ(bench.value<std::uint8_t>(reg("clock_source")), 2);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("crash_pc")), 0x0800'1234u);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("crash_cause")), 0x8200u);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("crash_tick")), 77u);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("crash_count")), 3u);
}

TEST(OperatorTorqueLimit, IsAPercentageThatChangesWithTorqueOffOnly) {
  const OperatorSetup kept = {.torque_limit_percent = 40};
  Bench& bench = renewed<Bench>(no_images, kept);
  EXPECT_EQ(bench.value<std::uint8_t>(reg("torque_limit")), 40) << "as the board kept it";
  EXPECT_EQ(bench.device.torque_limit_percent(), 40);
  for (const int percent : {1, 30, 100}) {
    EXPECT_TRUE(bench.write(reg("torque_limit"), static_cast<std::uint8_t>(percent)) ==
                Error::kNone);
    EXPECT_EQ(bench.device.torque_limit_percent(), percent);
  }
  for (const int percent : {0, 101, 255}) {
    EXPECT_TRUE(bench.write(reg("torque_limit"), static_cast<std::uint8_t>(percent)) ==
                Error::kDataRange);
  }
  bench.arm(true);
  EXPECT_TRUE(bench.write(reg("torque_limit"), std::uint8_t{30}) == Error::kAccess);
  EXPECT_EQ(bench.device.torque_limit_percent(), 100);
  bench.arm(false);
  EXPECT_TRUE(bench.write(reg("torque_limit"), std::uint8_t{30}) == Error::kNone);
  EXPECT_EQ(bench.device.order(0).flags, 0) << "it is no order";
}

struct Number {
  std::uint16_t id;
  float value;
};
Reply tune(Bench& bench, const Number& number) {
  std::uint8_t bytes[6];
  dxl::put_u16(bytes, number.id);
  __builtin_memcpy(bytes + 2, &number.value, 4);
  return bench.write_bytes(reg("parameter_id"), bytes, sizeof bytes);
}

TEST(OperatorTuning, AWriteReachesExactlyOneTick) {
  Bench& bench = fresh_bench();
  EXPECT_TRUE(tune(bench, {2, 0.02F}).error == Error::kNone);
  const OperatorOrder order = bench.device.order(0);
  EXPECT_EQ(order.flags, kParameterWrite);
  EXPECT_EQ(order.parameter_id, 2);
  float value;
  __builtin_memcpy(&value, &order.parameter_bits, 4);
  EXPECT_EQ(value, 0.02F);
  EXPECT_EQ(bench.device.order(1).flags, 0);
}

TEST(OperatorTuning, ASecondWriteBeforeTheTickIsRefused) {
  Bench& bench = fresh_bench();
  EXPECT_TRUE(tune(bench, {2, 0.02F}).error == Error::kNone);
  EXPECT_TRUE(tune(bench, {3, 0.03F}).error == Error::kResultFail);
  EXPECT_EQ(bench.device.order(0).parameter_id, 2);
  EXPECT_TRUE(tune(bench, {3, 0.03F}).error == Error::kNone);
}

TEST(OperatorTuning, EveryNumberIsHeldToItsRange) {
  Bench& bench = fresh_bench();
  for (std::uint16_t id = 0; id < kTuningCount; ++id) {
    const Range range = kTuningRanges[id];
    for (const float good : {range.low, range.high}) {
      EXPECT_TRUE(tune(bench, {id, good}).error == Error::kNone) << id;
      EXPECT_EQ(bench.device.order(0).flags, kParameterWrite) << id;
    }
    const float zero = 0;
    for (const float bad : {range.low - 1, range.high + 1, zero / zero, 1 / zero}) {
      EXPECT_TRUE(tune(bench, {id, bad}).error == Error::kDataRange) << id;
      EXPECT_EQ(bench.device.order(0).flags, 0) << id;
    }
    EXPECT_EQ(bench.value<float>(reg("parameter_low")), range.low);
    EXPECT_EQ(bench.value<float>(reg("parameter_high")), range.high);
  }
  EXPECT_TRUE(tune(bench, {kTuningCount, 0}).error == Error::kDataRange);
}

TEST(OperatorTuning, ShowsTheValueInForce) {
  Bench& bench = fresh_bench();
  bench.write(reg("parameter_id"), std::uint16_t{2});
  EXPECT_EQ(bench.value<float>(reg("parameter_value")), kRobot.tuning.gait.lift_m);
  bench.state.tuning.gait.lift_m = 0.03F;
  bench.record();
  EXPECT_EQ(bench.value<float>(reg("parameter_value")), 0.03F);
}

TEST(OperatorReport, ShowsTheTick) {
  Bench& bench = fresh_bench();
  bench.state.digest.chain = 0x0123456789ABCDEF;
  bench.inputs.tick = 77;
  bench.inputs.gyro_count[2] = -3;
  bench.inputs.foot_count[1][0] = 99;
  bench.inputs.position_count[20] = -2048;
  bench.outputs.goal_count[31] = 4095;
  bench.outputs.mode = 3;
  bench.outputs.tilt_tenth_mrad[1] = -12;
  bench.outputs.faults = safety::kNoteOverrun;
  bench.record();
  EXPECT_EQ(bench.value<std::uint64_t>(reg("digest")), 0x0123456789ABCDEFu);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("tick")), 77u);
  EXPECT_EQ(bench.value<std::int16_t>(reg("gyro") + 4), -3);
  EXPECT_EQ(bench.value<std::uint16_t>(reg("feet") + 8), 99);
  EXPECT_EQ(bench.value<std::int32_t>(reg("present_position") + 80), -2048);
  EXPECT_EQ(bench.value<std::int32_t>(reg("goal_position") + 124), 4095);
  EXPECT_EQ(bench.value<std::uint8_t>(reg("mode")), 3);
  EXPECT_EQ(bench.value<std::int16_t>(reg("tilt_pitch")), -12);
  EXPECT_FALSE(bench.read(0, 1).alert) << "a note stops nothing";
  bench.outputs.faults |= safety::kFaultOperatorQuiet;
  bench.record();
  EXPECT_FALSE(bench.read(0, 1).alert) << "nothing is wrong with the robot of a quiet operator";
  EXPECT_EQ(bench.value<std::uint8_t>(reg("hardware_error")), 0);
  bench.outputs.faults |= safety::kFaultVoltage;
  bench.record();
  EXPECT_TRUE(bench.read(0, 1).alert);
}

TEST(OperatorReport, NamesTheJointThatKeepsTheRobotDown) {
  Bench& bench = fresh_bench();
  EXPECT_EQ(bench.value<std::uint8_t>(reg("joint_beyond")), 255) << "before the first tick";
  for (int j = 0; j < kRobot.joint_count; ++j) {
    const JointParams& joint = kRobot.joint[j];
    bench.inputs.position_count[j] = model::count_of(joint, joint.sit_rad);
  }
  bench.inputs.position_count[7] = model::count_of(kRobot.joint[7], -3.0F);
  bench.record();
  EXPECT_EQ(bench.value<std::uint8_t>(reg("joint_beyond")), 255) << "nobody asked it to stand";
  bench.outputs.faults = safety::kFaultJointBeyond;
  bench.record();
  EXPECT_EQ(bench.value<std::uint8_t>(reg("joint_beyond")), kRobot.joint[7].servo_id);
}

TEST(OperatorReport, NamesTheHottestServoAndTheLowestSupply) {
  Bench& bench = fresh_bench();
  bench.inputs.flags = kSlowFresh;
  for (int j = 0; j < kRobot.joint_count; ++j) {
    bench.inputs.slow_joint = static_cast<std::uint8_t>(j);
    bench.inputs.slow_temperature_c = static_cast<std::uint8_t>(j == 5 ? 61 : 40);
    bench.inputs.slow_voltage_tenth_v = static_cast<std::uint16_t>(j == 7 ? 108 : 120);
    bench.record();
  }
  EXPECT_EQ(bench.value<std::uint8_t>(reg("hottest_servo")), kRobot.joint[5].servo_id);
  EXPECT_EQ(bench.value<std::uint8_t>(reg("hottest_temperature")), 61);
  EXPECT_EQ(bench.value<std::uint16_t>(reg("battery_voltage")), 108);
  bench.device.report({.battery_tenth_v = 115});
  bench.record();
  EXPECT_EQ(bench.value<std::uint16_t>(reg("battery_voltage")), 115) << "measured by the board";
}

TEST(OperatorReport, CountsWhatWentWrong) {
  Bench& bench = fresh_bench();
  bench.device.report({.bus = {.refused = 1, .timeouts = 2, .strays = 3, .errors = 4},
                       .bus_crc_errors = 5,
                       .skipped_periods = 6,
                       .imu_faults = 7});
  EXPECT_EQ(bench.value<std::uint32_t>(reg("bus_refused")), 1u);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("bus_timeouts")), 2u);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("bus_strays")), 3u);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("bus_errors")), 4u);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("bus_crc_errors")), 5u);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("skipped_periods")), 6u);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("imu_faults")), 7u);
  EXPECT_EQ(bench.value<std::uint32_t>(element(reg("device_errors"), table::kDeviceBus, 4)), 8u);
  bench.inputs.flags = kOverrun;
  bench.record();
  bench.record();
  EXPECT_EQ(bench.value<std::uint32_t>(reg("overruns")), 2u);
  hal::MemoryWire::spoil_framing(bench.wire.left());
  bench.device.poll();
  EXPECT_EQ(bench.value<std::uint32_t>(reg("link_framing")), 1u);
}

TEST(OperatorReport, ShowsHowJointsMoveAndPushIfTheirBusTells) {
  Bench& bench = fresh_bench();
  JointEffort efforts[kMaxJoints];
  for (int j = 0; j < kMaxJoints; ++j) {
    efforts[j] = {-1000 * j, static_cast<std::int16_t>(-j)};
  }
  bench.device.report({.efforts = efforts});
  bench.device.report({});
  for (int j = 0; j < kRobot.joint_count; ++j) {
    EXPECT_EQ(bench.value<std::int32_t>(element(reg("joint_velocity"), j, 4)), -1000 * j);
    EXPECT_EQ(bench.value<std::int16_t>(element(reg("joint_torque"), j, 2)), -j);
  }
}

TEST(OperatorDevices, HaveStateRateAgeAndErrors) {
  Bench& bench = fresh_bench();
  constexpr int kSilent = 4;
  const auto state = [&](int row) {
    return bench.value<table::DeviceState>(element(reg("device_state"), row, 1));
  };
  const auto age = [&](int row) {
    return bench.value<std::uint16_t>(element(reg("device_age"), row, 2));
  };
  EXPECT_TRUE(state(0) == table::DeviceState::kNeverSeen);
  const std::uint32_t all = (1u << kRobot.joint_count) - 1;
  bench.inputs.flags = kImuFresh;
  bench.inputs.fresh = all;
  for (; bench.inputs.tick < 150; ++bench.inputs.tick) bench.record();
  EXPECT_TRUE(state(kSilent) == table::DeviceState::kGood);
  EXPECT_TRUE(state(table::kDeviceImu) == table::DeviceState::kGood);
  EXPECT_TRUE(state(table::kDeviceFoot) == table::DeviceState::kNeverSeen);
  EXPECT_EQ(bench.value<std::uint16_t>(element(reg("device_rate"), kSilent, 2)), 100);
  EXPECT_EQ(age(kSilent), 0);

  const auto stale = static_cast<std::uint32_t>(kRobot.tuning.safety.stale_hold_s * 100);
  const auto lost = static_cast<std::uint32_t>(kRobot.tuning.safety.stale_release_s * 100);
  bench.inputs.fresh = all & ~(1u << kSilent);
  for (std::uint32_t silent = 1; silent <= lost; ++silent, ++bench.inputs.tick) {
    bench.record();
    EXPECT_EQ(age(kSilent), silent);
    const table::DeviceState expected = silent >= lost    ? table::DeviceState::kLost
                                        : silent >= stale ? table::DeviceState::kStale
                                                          : table::DeviceState::kGood;
    EXPECT_TRUE(state(kSilent) == expected) << silent;
    EXPECT_TRUE(state(kSilent + 1) == table::DeviceState::kGood);
  }
  EXPECT_EQ(bench.value<std::uint32_t>(element(reg("device_errors"), kSilent, 4)), lost);
  EXPECT_EQ(bench.value<std::uint8_t>(element(reg("device_id"), kSilent, 1)),
            kRobot.joint[kSilent].servo_id);
}

TEST(OperatorDevices, ASkippedTickAgesThemTwice) {
  Bench& bench = fresh_bench();
  bench.inputs.fresh = 1;
  bench.record();
  bench.inputs.fresh = 0;
  bench.inputs.tick += 2;
  bench.record();
  EXPECT_EQ(bench.value<std::uint16_t>(reg("device_age")), 2);
}

/// A good image of another robot, and its upload.
class Upload {
 public:
  Upload() : bench(store) {
    in_force.params = new_image.params = kRobot;
    new_image.params.name[0] = 'n';
    seal_image(new_image);
    bench.write(reg("window_kind"), std::uint8_t{1});
  }
  void send_all() {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&new_image);
    for (std::size_t at = 0; at < sizeof new_image; at += table::kWindowBytes) {
      const std::size_t left = sizeof new_image - at;
      const std::size_t count = left < table::kWindowBytes ? left : table::kWindowBytes;
      std::uint8_t block[4 + table::kWindowBytes];
      dxl::put_u32(block, static_cast<std::uint32_t>(at));
      __builtin_memcpy(block + 4, bytes + at, count);
      EXPECT_TRUE(bench.write_bytes(reg("window_offset"), block, 4 + count).error == Error::kNone);
    }
  }
  Error commit(std::uint32_t crc) {
    bench.write(reg("window_crc"), crc);
    return bench.write(reg("window_commit"), std::uint8_t{1});
  }
  Error commit() { return commit(crc32(&new_image, sizeof new_image)); }

  ParamsImage in_force;
  ParamsImage new_image;
  ParamsImages store{in_force};
  Bench bench;
};

Upload& fresh_upload() {
  return renewed<Upload>();
}

TEST(OperatorWindow, ReadsTheImageInForce) {
  Upload& upload = fresh_upload();
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&upload.in_force);
  ASSERT_EQ(upload.bench.value<std::uint32_t>(reg("window_size")), sizeof(ParamsImage));
  for (std::uint32_t at = 0; at < sizeof(ParamsImage); at += 100) {
    upload.bench.write(reg("window_offset"), at);
    const Reply reply = upload.bench.read(reg("window_data"), table::kWindowBytes);
    ASSERT_EQ(reply.size, table::kWindowBytes);
    for (std::uint32_t i = 0; i < table::kWindowBytes; ++i) {
      ASSERT_EQ(reply.data[i], at + i < sizeof(ParamsImage) ? bytes[at + i] : 0);
    }
  }
}

TEST(OperatorWindow, TakesAWholeGoodImage) {
  Upload& upload = fresh_upload();
  upload.send_all();
  EXPECT_TRUE(upload.store.accepted() == nullptr);
  EXPECT_TRUE(upload.commit() == Error::kNone);
  ASSERT_TRUE(upload.store.accepted() != nullptr);
  EXPECT_EQ(upload.store.accepted()->params.name[0], 'n');
  EXPECT_TRUE(upload.bench.value<table::WindowState>(reg("window_state")) ==
              table::WindowState::kAccepted);
}

TEST(OperatorWindow, TakesNothingWhileAnyServoHoldsTorque) {
  Upload& upload = fresh_upload();
  upload.bench.arm(true);
  upload.send_all();
  EXPECT_TRUE(upload.commit() == Error::kAccess);
  EXPECT_TRUE(upload.store.accepted() == nullptr);
}

TEST(OperatorWindow, RefusesWrongBytesAndBadImagesAndSaysWhy) {
  Upload& upload = fresh_upload();
  const auto fault = [&] { return upload.bench.value<std::uint8_t>(reg("window_fault")); };
  upload.send_all();
  EXPECT_TRUE(upload.commit(1) == Error::kResultFail);
  EXPECT_EQ(fault(), kWrongWindowCrc);
  upload.new_image.header.core_version += 1;
  upload.send_all();
  EXPECT_TRUE(upload.commit() == Error::kResultFail);
  EXPECT_EQ(fault(), static_cast<int>(ImageFault::kOtherCore));
  EXPECT_TRUE(upload.store.accepted() == nullptr);
}

TEST(OperatorWindow, NoBlockReachesPastTheImage) {
  Upload& upload = fresh_upload();
  std::uint8_t block[8] = {};
  dxl::put_u32(block, sizeof(ParamsImage) - 3);
  EXPECT_TRUE(upload.bench.write_bytes(reg("window_offset"), block, 8).error == Error::kDataLimit);
  EXPECT_TRUE(upload.bench.write_bytes(reg("window_offset"), block, 7).error == Error::kNone);
  dxl::put_u32(block, 0xFFFFFFFF);
  EXPECT_TRUE(upload.bench.write_bytes(reg("window_offset"), block, 8).error == Error::kDataLimit);
  EXPECT_TRUE(upload.bench.write(reg("window_kind"), std::uint8_t{2}) == Error::kDataRange)
      << "there is no action library";
}

}  // namespace
}  // namespace verp::app::test
