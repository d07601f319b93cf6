#include "firmware/app/sensor_device.hpp"

#include <gtest/gtest.h>

#include "tests/unit/app/operator_bench.hpp"

// With its samples and its clock; tests/target/ask_sensor asks the whole image.
namespace verp::app::test {
namespace {

constexpr std::uint8_t kImu = 120;

/// A master and the device on one wire.
struct SensorBench {
  SensorBench() { at(0); }

  void at(std::uint64_t us) {
    now_us = us;
    device.registers().set_time(us);
    for (int i = 0; i < 8; ++i) device.poll();
  }
  void add(std::int16_t gyro, std::int16_t accel) {
    hal::ImuSample sample;
    sample.gyro_count[0] = gyro;
    sample.accel_count[2] = accel;
    device.registers().add(sample);
  }
  void ask(std::size_t size) {
    wire.right().write(frame, size, 0);
    at(now_us);
  }
  void ask_block() {
    using namespace dxl::sensor_block;
    ask(dxl::encode_read(frame, sizeof frame, kImu, kAddress, kBytes));
  }
  /// False: the device has sent nothing.
  bool hear() {
    std::uint8_t bytes[64];
    bool whole = false;
    for (std::size_t n; (n = wire.right().read(bytes, sizeof bytes, 0)) > 0;) {
      for (std::size_t i = 0; i < n; ++i) whole = parser.push(bytes[i]) || whole;
    }
    return whole;
  }
  /// Word `index` of the last packet.
  std::int16_t word(int index) const {
    return static_cast<std::int16_t>(dxl::get_u16(parser.packet().parameters + 2 * index));
  }
  dxl::Error error() const { return static_cast<dxl::Error>(parser.packet().error); }
  void answer_at_once() {
    const std::uint8_t delay = 0;
    ask(dxl::encode_write(frame, sizeof frame, kImu, dxl::address::kReturnDelay, &delay, 1));
    at(now_us + 500);
    hear();
  }

  hal::MemoryWire wire;
  SensorDevice device{wire.left(), kImu, dxl::kModelImu, 1'000'000};
  dxl::Parser parser;
  std::uint64_t now_us = 0;
  std::uint8_t frame[32];
};

SensorBench& fresh_sensor() {
  return renewed<SensorBench>();
}

TEST(SensorDevice, AnswersAfterItsReturnDelay) {
  SensorBench& bench = fresh_sensor();
  bench.ask(dxl::encode_ping(bench.frame, sizeof bench.frame, kImu));
  bench.at(499);
  EXPECT_FALSE(bench.hear());
  bench.at(500);
  ASSERT_TRUE(bench.hear()) << "250 units of 2 us";
  EXPECT_EQ(dxl::get_u16(bench.parser.packet().parameters), dxl::kModelImu);
  bench.answer_at_once();
  bench.ask(dxl::encode_ping(bench.frame, sizeof bench.frame, kImu));
  EXPECT_TRUE(bench.hear());
}

// Servos answer it one after another, by id.
TEST(SensorDevice, AnswersAPingToAllInItsSlotOrNotAtAllAfterAnotherRequest) {
  SensorBench& bench = fresh_sensor();
  bench.answer_at_once();
  const std::uint64_t slot_us = bench.now_us + 3000 * kImu;
  bench.ask(dxl::encode_ping(bench.frame, sizeof bench.frame, dxl::kBroadcast));
  bench.at(slot_us - 1);
  EXPECT_FALSE(bench.hear());
  bench.at(slot_us);
  EXPECT_TRUE(bench.hear());
  bench.ask(dxl::encode_ping(bench.frame, sizeof bench.frame, dxl::kBroadcast));
  bench.ask(dxl::encode_ping(bench.frame, sizeof bench.frame, 7));
  bench.at(bench.now_us + 1'000'000);
  EXPECT_FALSE(bench.hear());
}

TEST(SensorDevice, GivesTheMeanOfTheSamplesSinceTheLastRead) {
  SensorBench& bench = fresh_sensor();
  bench.answer_at_once();
  bench.add(10, 8000);
  bench.add(13, 8200);
  bench.ask_block();
  ASSERT_TRUE(bench.hear());
  EXPECT_EQ(bench.word(0), 12) << "halves away from zero";
  EXPECT_EQ(bench.word(5), 8100);
  bench.add(-4, 8000);
  bench.ask_block();
  ASSERT_TRUE(bench.hear());
  EXPECT_EQ(bench.word(0), -4);
  bench.ask_block();
  ASSERT_TRUE(bench.hear());
  EXPECT_EQ(bench.word(0), -4) << "the newest, which is fresh";
}

TEST(SensorDevice, AMasterThatPausedGetsNoMeanOfThePause) {
  SensorBench& bench = fresh_sensor();
  bench.answer_at_once();
  for (int i = 0; i < 400; ++i) {
    bench.at(bench.now_us + 2000);
    bench.add(static_cast<std::int16_t>(i), 0);
  }
  bench.ask_block();
  ASSERT_TRUE(bench.hear());
  EXPECT_GE(bench.word(0), 388) << "22 ms of samples at most";
}

TEST(SensorDevice, RefusesToGiveOldCountsForNewOnes) {
  SensorBench& bench = fresh_sensor();
  bench.answer_at_once();
  const auto refused = [&] {
    bench.ask_block();
    EXPECT_TRUE(bench.hear()) << "others in a Sync Read wait for its answer";
    return bench.error() == dxl::Error::kAccess && bench.parser.packet().size == 0;
  };
  EXPECT_TRUE(refused()) << "no sample yet";
  bench.add(1, 2);
  EXPECT_FALSE(refused());
  bench.at(bench.now_us + SensorRegisters::kSilent_us + 1);
  EXPECT_TRUE(refused()) << "its chip is silent";
  bench.add(1, 2);
  EXPECT_FALSE(refused());
}

TEST(SensorDevice, AFootGivesItsNewestCountsAndFourZeros) {
  SensorBench& bench = fresh_sensor();
  bench.answer_at_once();
  bench.device.registers().set({1, 2, 3, 4});
  bench.device.registers().set({5, 6, 7, 65520});
  bench.ask_block();
  ASSERT_TRUE(bench.hear());
  EXPECT_EQ(bench.word(0), 5);
  EXPECT_EQ(static_cast<std::uint16_t>(bench.word(3)), 65520);
  EXPECT_EQ(bench.word(4), 0);
  EXPECT_EQ(bench.word(5), 0);
}

}  // namespace
}  // namespace verp::app::test
