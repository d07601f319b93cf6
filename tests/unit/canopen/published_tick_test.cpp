#include "common/protocol/canopen/published_tick.hpp"

#include <gtest/gtest.h>

namespace verp::canopen::published {
namespace {

std::uint32_t random_state = 1;
std::uint32_t random_bits() {
  random_state = random_state * 1664525u + 1013904223u;
  return random_state >> 8;
}

Inputs random_inputs(std::uint32_t tick) {
  Inputs inputs;
  inputs.tick = tick;
  inputs.fresh = random_bits();
  inputs.flags = static_cast<std::uint16_t>(random_bits() & 0x7F);
  for (auto& count : inputs.position_count) count = static_cast<std::int32_t>(random_bits());
  for (auto& count : inputs.gyro_count) count = static_cast<std::int16_t>(random_bits());
  for (auto& count : inputs.accel_count) count = static_cast<std::int16_t>(random_bits());
  for (auto& foot : inputs.foot_count) {
    for (auto& count : foot) count = static_cast<std::uint16_t>(random_bits());
  }
  inputs.slow_joint = static_cast<std::uint8_t>(random_bits() % 32);
  inputs.slow_voltage_tenth_v = static_cast<std::uint16_t>(random_bits());
  return inputs;
}

Inputs next_inputs(const Inputs& before, bool bus_imu, int words) {
  Inputs now = before;
  copy_heard(now, random_inputs(before.tick + 1), bus_imu);
  auto* bytes = reinterpret_cast<std::uint8_t*>(&now);
  for (int i = 0; i < words; ++i) {
    const std::size_t at = sizeof(std::uint64_t) + 2;
    bytes[at + random_bits() % (sizeof(Inputs) - at)] ^= static_cast<std::uint8_t>(random_bits());
  }
  return now;
}

TEST(PublishedTick, PartsAndHeardFramesTogetherAreTheInputs) {
  Inputs before = random_inputs(0);
  int most = 0;
  for (int n = 0; n < 500; ++n) {
    const bool bus_imu = n % 2 == 0;
    const Inputs now = next_inputs(before, bus_imu, n % (kMostParts + 1));
    Parts parts;
    parts.find(before, now, bus_imu);
    Inputs heard = before;
    copy_heard(heard, now, bus_imu);
    for (int i = 0; i < parts.count(); ++i) {
      EXPECT_TRUE(Part::from(parts.part(i).value()).put(heard));
    }
    EXPECT_EQ(__builtin_memcmp(&heard, &now, sizeof now), 0) << n;
    EXPECT_EQ(parts.flags() >> kPartsShift, parts.count());
    EXPECT_EQ(parts.flags() & kInputsMask, now.flags);
    EXPECT_EQ((parts.flags() & kImuInParts) != 0, !bus_imu);
    most = parts.count() > most ? parts.count() : most;
    before = now;
  }
  EXPECT_GT(most, 3);
}

TEST(PublishedTick, NothingIsToldTwice) {
  const Inputs before = random_inputs(0);
  Inputs now = before;
  copy_heard(now, random_inputs(1), true);
  Parts parts;
  parts.find(before, now, true);
  EXPECT_EQ(parts.count(), 0);
}

TEST(PublishedTick, MoreThanTheBusCarriesIsSaidToBeTooMany) {
  Inputs before, now;
  for (int j = 0; j < kMaxJoints; ++j) now.position_count[j] = -1;
  Parts parts;
  parts.find(before, now, true);
  EXPECT_EQ(parts.count(), 0);
  EXPECT_EQ(unsigned{parts.flags()} >> kPartsShift, kTooManyParts);
}

TEST(PublishedTick, APartOutsideOfInputsChangesNothing) {
  Inputs inputs;
  Part part;
  part.place = sizeof(Inputs) / 2 - 1;
  part.size = 4;
  part.bytes[0] = 1;
  EXPECT_FALSE(part.put(inputs));
  part.place = 0;
  part.size = kPartBytes + 1;
  EXPECT_FALSE(part.put(inputs));
  const Inputs none;
  EXPECT_EQ(__builtin_memcmp(&inputs, &none, sizeof none), 0);
}

}  // namespace
}  // namespace verp::canopen::published
