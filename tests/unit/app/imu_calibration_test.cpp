#include "firmware/app/imu_calibration.hpp"

#include <gtest/gtest.h>

#include "firmware/app/calibrated_imu.hpp"
#include "hal/fake/memory_store.hpp"
#include "hal/fake/scripted_imu.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::app {
namespace {

using Outcome = dxl::controller::ImuCalibrationState;
using Chip = CalibratedImu<hal::ScriptedImu, hal::MemoryStore>;

constexpr float kGyroScale = 0.00106526F;   // 2000 deg/s
constexpr float kAccelScale = 0.00119710F;  // 4 g
constexpr float kG = 9.80665F;

ImuParams upright() {
  ImuParams imu;
  imu.gyro_rad_s_per_count = kGyroScale;
  imu.accel_m_s2_per_count = kAccelScale;
  return imu;
}
ImuParams on_its_side() {
  ImuParams imu = upright();
  const float body_imu[9] = {0, 0, -1, 0, 1, 0, 1, 0, 0};
  for (int i = 0; i < 9; ++i) imu.body_imu[i] = body_imu[i];
  return imu;
}

std::int16_t counts(float value, float scale) {
  return math::to_int16(value / scale);
}

/// Mounted as `imu` says, then turned about the axis `about`, with up to `noise` counts of noise.
hal::ImuSample at_rest(const ImuParams& imu, float tilt_rad, int about, const std::int16_t* bias,
                       test::Random& random, int noise = 8) {
  Vec3 up{imu.body_imu[6], imu.body_imu[7], imu.body_imu[8]};
  const int a = (about + 1) % 3, b = (about + 2) % 3;
  const math::SinCos t = math::sincos(tilt_rad);
  const float up_a = t.cos * up[a] - t.sin * up[b];
  up[b] = t.sin * up[a] + t.cos * up[b];
  up[a] = up_a;
  hal::ImuSample sample;
  for (int axis = 0; axis < 3; ++axis) {
    const auto jitter = [&] { return random.below(2 * noise + 1) - noise; };
    sample.gyro_count[axis] = static_cast<std::int16_t>(bias[axis] + jitter());
    sample.accel_count[axis] =
        static_cast<std::int16_t>(counts(kG * up[axis], kAccelScale) + jitter());
  }
  return sample;
}

Outcome measured(ImuCalibrator& calibrator, const ImuParams& imu, float tilt_rad, int about,
                 const std::int16_t* bias, int noise = 8) {
  test::Random random(1);
  calibrator.begin();
  for (int i = 1; i <= ImuCalibrator::kSamples; ++i) {
    const bool last = calibrator.take(at_rest(imu, tilt_rad, about, bias, random, noise));
    EXPECT_EQ(last, i == ImuCalibrator::kSamples);
  }
  return calibrator.state();
}

TEST(ImuCalibration, AnewItChangesNothing) {
  hal::ImuSample raw{{-32768, 32767, 5}, {32767, -32768, -7}, 99};
  const hal::ImuSample same = ImuCalibration{}.corrected(raw);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(same.gyro_count[axis], raw.gyro_count[axis]);
    EXPECT_EQ(same.accel_count[axis], raw.accel_count[axis]);
  }
  EXPECT_EQ(same.time_us, 99u);
}

TEST(ImuCalibration, TakesBiasAndTiltOutHoweverTheChipIsMounted) {
  const std::int16_t bias[3] = {50, -80, 7};
  for (const ImuParams& imu : {upright(), on_its_side()}) {
    for (int about = 0; about < 3; ++about) {
      for (const float tilt_rad : {-0.3F, -0.02F, 0.0F, 0.1F, 0.3F}) {
        ImuCalibrator calibrator(imu);
        ASSERT_TRUE(measured(calibrator, imu, tilt_rad, about, bias) == Outcome::kDone) << tilt_rad;
        test::Random random(2);
        const hal::ImuSample raw = at_rest(imu, tilt_rad, about, bias, random, 0);
        const hal::ImuSample good = calibrator.result().corrected(raw);
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_NEAR(good.gyro_count[axis], 0, 1.0F);
          EXPECT_NEAR(good.accel_count[axis], counts(kG * imu.body_imu[6 + axis], kAccelScale),
                      10.0F)
              << about << " " << tilt_rad;
        }
      }
    }
  }
}

TEST(ImuCalibration, TurnsBothAlike) {
  const std::int16_t bias[3] = {0, 0, 0};
  const ImuParams imu = upright();
  ImuCalibrator calibrator(imu);
  ASSERT_TRUE(measured(calibrator, imu, 0.2F, 0, bias) == Outcome::kDone);
  ImuCalibration turn = calibrator.result();
  for (std::int16_t& count : turn.gyro_bias_count) count = 0;
  test::Random random(3);
  for (int i = 0; i < 200; ++i) {
    hal::ImuSample raw;
    float length = 0, turned = 0;
    for (int axis = 0; axis < 3; ++axis) {
      raw.gyro_count[axis] = raw.accel_count[axis] =
          static_cast<std::int16_t>(random.below(30001) - 15000);
    }
    const hal::ImuSample sample = turn.corrected(raw);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(sample.gyro_count[axis], sample.accel_count[axis]);
      const float before = math::to_float(std::int32_t{raw.gyro_count[axis]});
      const float after = math::to_float(std::int32_t{sample.gyro_count[axis]});
      length += before * before;
      turned += after * after;
    }
    EXPECT_NEAR(math::sqrt(turned), math::sqrt(length), 6.0F);
  }
}

TEST(ImuCalibration, SaturatesInsteadOfWrapping) {
  ImuCalibration calibration;
  calibration.gyro_bias_count[0] = -100;
  EXPECT_EQ(calibration.corrected({{32767, 0, 0}, {}, 0}).gyro_count[0], 32767);
  calibration.gyro_bias_count[0] = 100;
  EXPECT_EQ(calibration.corrected({{-32768, 0, 0}, {}, 0}).gyro_count[0], -32768);
}

TEST(ImuCalibration, IsRefusedFromARobotThatMoves) {
  const ImuParams imu = upright();
  ImuCalibrator calibrator(imu);
  const std::int16_t none[3] = {0, 0, 0};
  EXPECT_TRUE(measured(calibrator, imu, 0, 0, none, 40) == Outcome::kMoved) << "it trembles";
  const std::int16_t turning[3] = {0, 0, 200};
  EXPECT_TRUE(measured(calibrator, imu, 0, 0, turning) == Outcome::kMoved) << "12 deg/s: it turns";
  for (const int when : {0, 100, ImuCalibrator::kSamples - 1}) {
    test::Random random(1);
    calibrator.begin();
    for (int i = 0; i < ImuCalibrator::kSamples; ++i) {
      hal::ImuSample sample = at_rest(imu, 0, 0, none, random);
      if (i == when) sample.gyro_count[1] = 100;
      calibrator.take(sample);
    }
    EXPECT_TRUE(calibrator.state() == Outcome::kMoved) << when;
  }
}

TEST(ImuCalibration, IsRefusedFromARobotThatLeansOrASensorOfAnotherScale) {
  ImuParams imu = upright();
  const std::int16_t none[3] = {0, 0, 0};
  ImuCalibrator calibrator(imu);
  EXPECT_TRUE(measured(calibrator, imu, 0.4F, 1, none) == Outcome::kNotUpright);
  EXPECT_TRUE(measured(calibrator, imu, 3.14159F, 1, none) == Outcome::kNotUpright)
      << "on its head";
  imu.accel_m_s2_per_count *= 0.5F;
  EXPECT_TRUE(measured(calibrator, imu, 0, 1, none) == Outcome::kNotUpright) << "half of gravity";
}

struct Life {
  explicit Life(hal::MemoryStore& memory, const ImuParams& params) : imu(chip, memory, params) {
    imu.load();
  }
  hal::ImuSample next(hal::MemoryStore& memory, const ImuParams& params) {
    static const std::int16_t kBias[3] = {30, 0, -30};
    hal::ImuSample sample = at_rest(params, 0.1F, 0, kBias, random);
    sample.time_us = ++time_us;
    chip.measure(sample);
    EXPECT_TRUE(imu.read(sample) == hal::ImuStatus::kFresh);
    imu.keep();
    memory.work(true);
    return sample;
  }
  Outcome calibrated(hal::MemoryStore& memory, const ImuParams& params) {
    imu.measure(0);
    for (int i = 0; i < ImuCalibrator::kSamples; ++i) next(memory, params);
    return imu.state();
  }
  hal::ScriptedImu chip;
  Chip imu;
  test::Random random{5};
  std::uint64_t time_us = 0;
};

TEST(CalibratedImu, MeasuresAppliesAndKeeps) {
  hal::MemoryStore memory;
  const ImuParams params = upright();
  Life first(memory, params);
  EXPECT_NEAR(first.next(memory, params).gyro_count[0], 30, 9.0F) << "as it comes";
  first.imu.measure(0);
  EXPECT_TRUE(first.imu.state() == Outcome::kMeasuring);
  for (int i = 0; i < ImuCalibrator::kSamples; ++i) first.next(memory, params);
  EXPECT_TRUE(first.imu.state() == Outcome::kDone);
  EXPECT_NEAR(first.next(memory, params).gyro_count[0], 0, 10.0F);
  Life second(memory, params);
  EXPECT_TRUE(second.imu.state() == Outcome::kDone);
  const hal::ImuSample sample = second.next(memory, params);
  EXPECT_NEAR(sample.gyro_count[2], 0, 10.0F);
  EXPECT_NEAR(sample.accel_count[1], 0, 20.0F) << "the tilt is gone";
  second.imu.forget();
  EXPECT_NEAR(second.next(memory, params).gyro_count[2], -30, 9.0F);
  EXPECT_TRUE(Life(memory, params).imu.state() == Outcome::kNone);
}

TEST(CalibratedImu, ARefusedMeasurementLeavesTheOldOneInForceAndInMemory) {
  hal::MemoryStore memory;
  const ImuParams params = upright();
  Life life(memory, params);
  ASSERT_TRUE(life.calibrated(memory, params) == Outcome::kDone);
  life.imu.measure(0);
  hal::ImuSample push{{3000, 0, 0}, {0, 0, 8192}, ++life.time_us};
  life.chip.measure(push);
  life.imu.read(push);
  for (int i = 1; i < ImuCalibrator::kSamples; ++i) life.next(memory, params);
  EXPECT_TRUE(life.imu.state() == Outcome::kMoved);
  EXPECT_NEAR(life.next(memory, params).gyro_count[0], 0, 10.0F);
  EXPECT_TRUE(Life(memory, params).imu.state() == Outcome::kDone);
}

TEST(CalibratedImu, AbandonedItChangesNothingAnyMore) {
  hal::MemoryStore memory;
  const ImuParams params = upright();
  Life life(memory, params);
  life.imu.abandon();
  EXPECT_TRUE(life.imu.state() == Outcome::kNone) << "nothing was under way";
  life.imu.measure(0);
  life.next(memory, params);
  life.imu.abandon();
  EXPECT_TRUE(life.imu.state() == Outcome::kMoved);
  for (int i = 0; i < ImuCalibrator::kSamples; ++i) {
    EXPECT_NEAR(life.next(memory, params).gyro_count[0], 30, 9.0F);
  }
  EXPECT_TRUE(Life(memory, params).imu.state() == Outcome::kNone);
}

TEST(CalibratedImu, OfAnotherVersionOrSizeIsNotTaken) {
  hal::MemoryStore memory;
  std::uint8_t bytes[ImuCalibration::kBytes];
  const ImuParams params = upright();
  ImuCalibration{}.encode(bytes, basis_of(params));
  bytes[0] ^= 0xFF;
  memory.put(kImuCalibrationKey, bytes, sizeof bytes);
  memory.work(true);
  EXPECT_TRUE(Life(memory, params).imu.state() == Outcome::kDropped);
  bytes[0] ^= 0xFF;
  memory.put(kImuCalibrationKey, bytes, sizeof bytes - 1);
  memory.work(true);
  EXPECT_TRUE(Life(memory, params).imu.state() == Outcome::kDropped);
}

// A bias belongs to a scale, a turn to a mounting.
TEST(CalibratedImu, MeasuredInAnotherScaleOrMountingIsDroppedAndSaid) {
  hal::MemoryStore memory;
  const ImuParams params = upright();
  Life first(memory, params);
  ASSERT_TRUE(first.calibrated(memory, params) == Outcome::kDone);
  ImuParams other[11];
  for (int i = 0; i < 11; ++i) {
    other[i] = params;
    float& value = i < 9    ? other[i].body_imu[i]
                   : i == 9 ? other[i].gyro_rad_s_per_count
                            : other[i].accel_m_s2_per_count;
    value = value == 0.0F ? 0.01F : 0.5F * value;
    Life life(memory, other[i]);
    EXPECT_TRUE(life.imu.state() == Outcome::kDropped) << i;
    EXPECT_NEAR(life.next(memory, params).gyro_count[0], 30, 9.0F) << "as it comes: " << i;
  }
  ImuParams on_bus = params;
  on_bus.device_id = 120;
  EXPECT_TRUE(Life(memory, on_bus).imu.state() == Outcome::kDone) << "the chip is the same";
  EXPECT_TRUE(Life(memory, params).imu.state() == Outcome::kDone);
}

// Only read() gives samples.
TEST(CalibratedImu, AMeasurementWithoutSamplesEndsWithAVerdict) {
  constexpr std::uint64_t kBegin_us = 5'000'000;
  for (const int samples : {0, 1, ImuCalibrator::kSamples - 1}) {
    hal::MemoryStore memory;
    const ImuParams params = upright();
    Life life(memory, params);
    life.imu.measure(0);
    for (int i = 0; i < ImuCalibrator::kSamples; ++i) life.next(memory, params);
    ASSERT_TRUE(life.imu.state() == Outcome::kDone);
    life.imu.measure(kBegin_us);
    for (int i = 0; i < samples; ++i) life.next(memory, params);
    life.imu.watch(kBegin_us + Chip::kMost_us - 1);
    EXPECT_TRUE(life.imu.state() == Outcome::kMeasuring) << samples;
    life.imu.watch(kBegin_us + Chip::kMost_us);
    EXPECT_TRUE(life.imu.state() == Outcome::kSilent) << samples;
    for (int i = 0; i < ImuCalibrator::kSamples; ++i) life.next(memory, params);
    EXPECT_TRUE(life.imu.state() == Outcome::kSilent) << "what comes late is no measurement";
    EXPECT_NEAR(life.next(memory, params).gyro_count[0], 0, 10.0F) << "the old one counts";
    EXPECT_TRUE(Life(memory, params).imu.state() == Outcome::kDone);
  }
}

TEST(CalibratedImu, TheSlowestLoopHasTimeToMeasure) {
  hal::MemoryStore memory;
  const ImuParams params = upright();
  Life life(memory, params);
  life.imu.watch(~std::uint64_t{0});
  EXPECT_TRUE(life.imu.state() == Outcome::kNone);
  life.imu.measure(0);
  for (std::uint64_t i = 1; i <= ImuCalibrator::kSamples; ++i) {
    life.next(memory, params);
    life.imu.watch(i * 20'000);
  }
  EXPECT_TRUE(life.imu.state() == Outcome::kDone);
  life.imu.watch(~std::uint64_t{0});
  EXPECT_TRUE(life.imu.state() == Outcome::kDone);
}

TEST(CalibratedImu, FaultsPassThrough) {
  hal::MemoryStore memory;
  const ImuParams params = upright();
  Life life(memory, params);
  life.chip.fail(1);
  hal::ImuSample sample{.time_us = 5};
  EXPECT_TRUE(life.imu.read(sample) == hal::ImuStatus::kFault);
  EXPECT_EQ(sample.time_us, 5u);
  EXPECT_EQ(life.imu.faults(), 1u);
  EXPECT_TRUE(life.imu.read(sample) == hal::ImuStatus::kStale);
}

}  // namespace
}  // namespace verp::app
