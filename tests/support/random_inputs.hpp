#pragma once
#include <cstdint>
#include <vector>

#include "common/io/io.hpp"
#include "common/model/params.hpp"

/// Inputs from integers only: equal on every machine.
namespace verp::test {

/// Numerical Recipes' 32-bit linear congruential generator.
class SmallRandom {
 public:
  explicit SmallRandom(std::uint32_t seed) : state_(seed) {}
  std::uint32_t bits() {
    const std::uint32_t high = next() & 0xFFFF0000u;
    return high | (next() >> 16);
  }
  /// About uniform.
  std::int32_t around_zero(std::int32_t half) {
    return static_cast<std::int32_t>((next() >> 8) % static_cast<std::uint32_t>(2 * half + 1)) -
           half;
  }

 private:
  std::uint32_t next() { return state_ = state_ * 1664525u + 1013904223u; }
  std::uint32_t state_;
};

/// The robot stands with noisy sensors while its operator orders walk after walk; some readings are
/// missing. `one_g_count`: accelerometer at rest, IMU z up.
inline std::vector<Inputs> plausible_inputs(std::uint32_t ticks, std::uint32_t seed,
                                            std::int16_t one_g_count, const Params& params) {
  constexpr std::uint32_t kOrderTicks = 400;
  SmallRandom random(seed);
  std::vector<Inputs> trace(ticks);
  Command order;
  for (std::uint32_t tick = 0; tick < ticks; ++tick) {
    Inputs& in = trace[tick];
    in.tick = tick;
    in.fresh = 0xFFFFFFFFu & ~(random.bits() % 16 == 0 ? random.bits() : 0u);
    in.flags = kImuFresh | kFeetFresh | kSlowFresh | kCommandFresh;
    if (tick % kOrderTicks == 0) {
      order.request = tick % (4 * kOrderTicks) == 0 ? Request::kStand : Request::kWalk;
      order.vx_tenth_mm_s = static_cast<std::int16_t>(random.around_zero(2000));
      order.vy_tenth_mm_s = static_cast<std::int16_t>(random.around_zero(500));
      order.wz_mrad_s = static_cast<std::int16_t>(random.around_zero(400));
    }
    order.sequence = static_cast<std::uint8_t>(tick);
    in.command = order;
    for (auto& gyro : in.gyro_count) gyro = static_cast<std::int16_t>(random.around_zero(20));
    for (auto& accel : in.accel_count) accel = static_cast<std::int16_t>(random.around_zero(50));
    in.accel_count[2] = static_cast<std::int16_t>(in.accel_count[2] + one_g_count);
    for (auto& foot : in.foot_count) {
      for (auto& corner : foot) corner = static_cast<std::uint16_t>(random.bits() % 1000);
    }
    in.slow_joint =
        static_cast<std::uint8_t>(params.joint_count > 0 ? tick % params.joint_count : 0u);
    in.slow_temperature_c = 35;
    in.slow_voltage_tenth_v = 120;
    for (int joint = 0; joint < kMaxJoints; ++joint) {
      in.position_count[joint] = 2048 + random.around_zero(3);
    }
  }
  return trace;
}

/// All fields but the tick are random bits.
inline std::vector<Inputs> wild_inputs(std::uint32_t ticks, std::uint32_t seed) {
  SmallRandom random(seed);
  std::vector<Inputs> trace(ticks);
  for (std::uint32_t tick = 0; tick < ticks; ++tick) {
    std::uint32_t words[sizeof(Inputs) / 4];
    for (std::uint32_t& word : words) word = random.bits();
    __builtin_memcpy(static_cast<void*>(&trace[tick]), words, sizeof(Inputs));
    trace[tick].tick = tick;
  }
  return trace;
}

}  // namespace verp::test
