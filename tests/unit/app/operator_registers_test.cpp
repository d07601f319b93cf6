#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>

#include "common/base/crc32.hpp"
#include "common/safety/machine.hpp"
#include "tests/unit/app/operator_bench.hpp"

// What the registers mean: orders, tuning, the tick's report, devices, images.

namespace verp::app::test {
namespace {

using dxl::Error;

Bench<>& fresh_bench() {
  return renewed<Bench<>>(no_images);
}
/// One that was asked to relax, and takes any other request.
Bench<>& relaxed_bench() {
  Bench<>& bench = fresh_bench();
  bench.relax();
  bench.device.order(0);
  return bench;
}

// What the board found at its start, for an operator who comes later.
TEST(OperatorStart, IsToldInRegisters) {
  const OperatorSetup setup = {
      .self_test = table::SelfTest::kKinematics,
      .reset_cause = table::ResetCause::kFault,
      .clock_source = table::ClockSource::kInternalPll,
      .crash = {.pc = 0x0800'1234, .cause = 0x8200, .tick = 77, .count = 3}};
  Bench<>& bench = renewed<Bench<>>(no_images, setup);
  EXPECT_EQ(bench.value<std::uint8_t>(reg("self_test")), 5);
  EXPECT_EQ(bench.value<std::uint8_t>(reg("reset_cause")), 6);
  EXPECT_EQ(bench.value<std::uint8_t>(reg("clock_source")), 2);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("crash_pc")), 0x0800'1234u);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("crash_cause")), 0x8200u);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("crash_tick")), 77u);
  EXPECT_EQ(bench.value<std::uint32_t>(reg("crash_count")), 3u);
}

// The counterpart of `verp run --torque`.
TEST(OperatorTorqueLimit, IsAPercentageThatChangesWithTorqueOffOnly) {
  const OperatorSetup kept = {.torque_limit_percent = 40};
  Bench<>& bench = renewed<Bench<>>(no_images, kept);
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

// The core rises on a level. A program that repeats its order to stand raises no robot that was
// reset, by its watchdog or by a supply that sagged: somebody asks it to relax first.
TEST(OperatorOrders, ToStandOrWalkAreRefusedAfterEachStartUntilOneToRelaxWasGiven) {
  using Cause = table::ResetCause;
  for (const Cause cause : {Cause::kUnknown, Cause::kPower, Cause::kPin, Cause::kSoftware,
                            Cause::kWatchdog, Cause::kLowPower, Cause::kFault}) {
    const OperatorSetup setup = {.reset_cause = cause};
    Bench<>& bench = renewed<Bench<>>(no_images, setup);
    for (std::uint32_t tick = 0; tick < 20; ++tick) {
      const std::uint8_t order[] = {static_cast<std::uint8_t>(1 + tick % 2), 5, 0x2C, 0x01};
      EXPECT_TRUE(bench.write_bytes(reg("request"), order, sizeof order).error ==
                  Error::kResultFail);
      const OperatorOrder held = bench.device.order(tick);
      EXPECT_EQ(held.flags, 0) << "nor is it fresh";
      EXPECT_TRUE(held.command.request == Request::kRelax);
      EXPECT_EQ(held.command.vx_tenth_mm_s, 0) << "a write is done whole or not at all";
    }
    bench.write(reg("walk_vx"), std::int16_t{7});
    EXPECT_TRUE(bench.write(reg("request"), std::uint8_t{1}) == Error::kResultFail)
        << "another register is no request to relax";
    bench.relax();
    for (const int request : {2, 1, 0, 1}) {
      EXPECT_TRUE(bench.write(reg("request"), static_cast<std::uint8_t>(request)) == Error::kNone);
    }
  }
}

// A Reg Write is an order when its Action comes, not before.
TEST(OperatorOrders, AKeptRequestToRelaxCountsFromItsActionOn) {
  Bench<>& bench = fresh_bench();
  const std::uint8_t relax = 0;
  bench.send(
      dxl::encode_reg_write(bench.frame, sizeof bench.frame, bench.id, reg("request"), &relax, 1));
  EXPECT_TRUE(bench.write(reg("request"), std::uint8_t{1}) == Error::kResultFail);
  bench.plain(dxl::Instruction::kAction);
  EXPECT_TRUE(bench.write(reg("request"), std::uint8_t{1}) == Error::kNone);
}

TEST(OperatorOrders, AreFreshInTheOneTickThatFollowsAWrite) {
  Bench<>& bench = relaxed_bench();
  EXPECT_EQ(bench.device.order(0).flags, 0);
  const std::uint8_t order[] = {2, 5, 0x2C, 0x01, 0xCE, 0xFF, 0x64, 0};  // walk, 30, -5 mm/s, turn
  EXPECT_TRUE(bench.write_bytes(reg("request"), order, sizeof order).error == Error::kNone);
  const OperatorOrder first = bench.device.order(1);
  EXPECT_EQ(first.flags, kCommandFresh);
  EXPECT_TRUE(first.command.request == Request::kWalk);
  EXPECT_EQ(first.command.sequence, 5);
  EXPECT_EQ(first.command.vx_tenth_mm_s, 300);
  EXPECT_EQ(first.command.vy_tenth_mm_s, -50);
  EXPECT_EQ(first.command.wz_mrad_s, 100);
  const OperatorOrder second = bench.device.order(2);
  EXPECT_EQ(second.flags, 0) << "not fresh any more";
  EXPECT_TRUE(second.command.request == Request::kWalk) << "but it stands";
  EXPECT_EQ(second.command.vx_tenth_mm_s, 300);
}

TEST(OperatorOrders, TheSameOrderAgainIsFreshAgain) {
  Bench<>& bench = relaxed_bench();
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(bench.write(reg("request"), std::uint8_t{1}) == Error::kNone);
    EXPECT_EQ(bench.device.order(0).flags, kCommandFresh);
  }
}

// An erase of flash holds the processor for up to two seconds: who ordered before it, or into it,
// may be gone when it is over.
TEST(OperatorOrders, DoNotOutliveALoopThatStoodStill) {
  const auto hold_ticks = static_cast<std::uint32_t>(1e6F * kRobot.tuning.safety.command_hold_s /
                                                     static_cast<float>(kRobot.period_us));
  for (const bool in_the_link : {false, true}) {
    for (const std::uint32_t gap : {1u, hold_ticks, hold_ticks + 1, 10 * hold_ticks, 2'000'000u}) {
      Bench<>& bench = relaxed_bench();
      bench.device.order(100);
      const std::uint8_t stand = 1;
      if (in_the_link) {
        const std::size_t size =
            dxl::encode_write(bench.frame, sizeof bench.frame, bench.id, reg("request"), &stand, 1);
        ASSERT_EQ(bench.wire.right().write(bench.frame, size, 0), size);
      } else {
        bench.write(reg("request"), stand);
      }
      const bool slept = gap > hold_ticks;
      const OperatorOrder order = bench.device.order(100 + gap);
      if (in_the_link && !slept) continue;  // it comes with the next poll
      EXPECT_EQ(order.flags, slept ? 0 : kCommandFresh) << gap;
      EXPECT_TRUE(order.command.request == (slept ? Request::kRelax : Request::kStand)) << gap;
      EXPECT_EQ(bench.value<std::uint8_t>(reg("request")), slept ? 0 : 1) << gap;
      EXPECT_EQ(bench.device.order(101 + gap).flags, 0);
      bench.write(reg("request"), stand);
      EXPECT_EQ(bench.device.order(102 + gap).flags, kCommandFresh) << "given anew it counts";
    }
  }
}

// Nor does an order wait for servos to be found: a robot must not rise minutes after it was asked.
TEST(OperatorOrders, DoNotWaitForABringUp) {
  Bench<>& bench = relaxed_bench();
  bench.write(reg("request"), std::uint8_t{1});
  bench.device.brought_up({});
  const OperatorOrder order = bench.device.order(0);
  EXPECT_EQ(order.flags, 0);
  EXPECT_TRUE(order.command.request == Request::kRelax);
}

// With torque on a robot must not be told to sit down because its loop was late; an emergency stop
// outlives everything.
TEST(OperatorOrders, OfARobotWithTorqueAndTheStopStandWhateverHappens) {
  Bench<>& bench = relaxed_bench();
  bench.device.order(0);
  bench.write(reg("request"), std::uint8_t{2});
  bench.write(reg("emergency_stop"), std::uint8_t{1});
  bench.arm(true);
  const OperatorOrder order = bench.device.order(100'000);
  EXPECT_EQ(order.flags, kEmergencyStop) << "not fresh";
  EXPECT_TRUE(order.command.request == Request::kWalk);
  bench.arm(false);
  EXPECT_EQ(bench.device.order(200'000).flags, kEmergencyStop);
}

TEST(OperatorOrders, ReadsTuningAndRefusedWritesAreNoOrders) {
  Bench<>& bench = fresh_bench();
  bench.read(reg("request"), 20);
  bench.write(reg("request"), std::uint8_t{9});
  bench.write(reg("status_return_level"), std::uint8_t{2});
  bench.write(reg("parameter_id"), std::uint16_t{1});
  EXPECT_EQ(bench.device.order(0).flags, 0);
}

TEST(OperatorOrders, TheEmergencyStopStaysPressed) {
  Bench<>& bench = fresh_bench();
  bench.write(reg("emergency_stop"), std::uint8_t{1});
  for (int i = 0; i < 3; ++i) EXPECT_TRUE((bench.device.order(0).flags & kEmergencyStop) != 0);
  bench.write(reg("emergency_stop"), std::uint8_t{0});
  EXPECT_EQ(bench.device.order(0).flags & kEmergencyStop, 0);
}

TEST(OperatorOrders, TheHeadTakesAnglesOrAPointWhileWalking) {
  Bench<>& bench = relaxed_bench();
  bench.write(reg("request"), std::uint8_t{2});
  const std::int16_t angles[] = {250, -100, 1000, 1000, 110};  // the point is level with the head
  std::uint8_t bytes[sizeof angles];
  __builtin_memcpy(bytes, angles, sizeof angles);
  EXPECT_TRUE(bench.write_bytes(reg("head_pan"), bytes, sizeof bytes).error == Error::kNone);
  Command command = bench.device.order(0).command;
  EXPECT_EQ(command.head_pan_mrad, 250);
  EXPECT_EQ(command.head_tilt_mrad, -100);
  bench.write(reg("head_mode"), std::uint8_t{1});
  command = bench.device.order(1).command;
  EXPECT_TRUE(command.request == Request::kWalk);
  EXPECT_NEAR(command.head_pan_mrad, 785, 1);
  EXPECT_NEAR(command.head_tilt_mrad, 0, 1);
}

struct Number {
  std::uint16_t id;
  float value;
};
Reply tune(Bench<>& bench, const Number& number) {
  std::uint8_t bytes[6];
  dxl::put_u16(bytes, number.id);
  __builtin_memcpy(bytes + 2, &number.value, 4);
  return bench.write_bytes(reg("parameter_id"), bytes, sizeof bytes);
}

TEST(OperatorTuning, AWriteReachesExactlyOneTick) {
  Bench<>& bench = fresh_bench();
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
  Bench<>& bench = fresh_bench();
  EXPECT_TRUE(tune(bench, {2, 0.02F}).error == Error::kNone);
  EXPECT_TRUE(tune(bench, {3, 0.03F}).error == Error::kResultFail);
  EXPECT_EQ(bench.device.order(0).parameter_id, 2);
  EXPECT_TRUE(tune(bench, {3, 0.03F}).error == Error::kNone);
}

TEST(OperatorTuning, EveryNumberIsHeldToItsRange) {
  Bench<>& bench = fresh_bench();
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
  Bench<>& bench = fresh_bench();
  bench.write(reg("parameter_id"), std::uint16_t{2});
  EXPECT_EQ(bench.value<float>(reg("parameter_value")), kRobot.tuning.gait.lift_m);
  bench.state.tuning.gait.lift_m = 0.03F;
  bench.record();
  EXPECT_EQ(bench.value<float>(reg("parameter_value")), 0.03F);
}

TEST(OperatorReport, ShowsTheTick) {
  Bench<>& bench = fresh_bench();
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
  bench.outputs.faults |= safety::kFaultVoltage;
  bench.record();
  EXPECT_TRUE(bench.read(0, 1).alert);
}

TEST(OperatorReport, NamesTheHottestServoAndTheLowestSupply) {
  Bench<>& bench = fresh_bench();
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
  Bench<>& bench = fresh_bench();
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

TEST(OperatorDevices, HaveStateRateAgeAndErrors) {
  Bench<>& bench = fresh_bench();
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
  Bench<>& bench = fresh_bench();
  bench.inputs.fresh = 1;
  bench.record();
  bench.inputs.fresh = 0;
  bench.inputs.tick += 2;
  bench.record();
  EXPECT_EQ(bench.value<std::uint16_t>(reg("device_age")), 2);
}

/// A good image of a robot with another name, and what happens to it on the way.
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
  Bench<ParamsImages> bench;
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
