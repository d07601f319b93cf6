#include "common/control/self_test.hpp"

#include <bit>
#include <cstddef>

#include "common/control/step.hpp"
#include "common/math/convert.hpp"
#include "common/model/coupling.hpp"

namespace verp::control {
namespace {

constexpr float kGravity = 9.80665F;
constexpr std::uint32_t kStandUntil = 60, kWalkUntil = 120;  // ticks; then the walk ends
constexpr float kRise_s = 0.2F;
constexpr auto kRiseId = static_cast<std::uint16_t>(
    (offsetof(Tuning, safety) + offsetof(SafetyTuning, rise_s)) / sizeof(float));

std::uint32_t next(std::uint32_t& random) {
  random = random * 1664525u + 1013904223u;
  return random >> 16;
}

std::int16_t noise(std::uint32_t& random) {
  return static_cast<std::int16_t>(static_cast<std::int32_t>(next(random) & 0x3Fu) - 32);
}

void sense(const Params& params, std::uint32_t tick, std::uint32_t& random, const Outputs& last,
           Inputs& in) {
  in.tick = tick;
  in.flags = kImuFresh | kFeetFresh;
  in.fresh = params.joint_count == 32 ? ~0u : (1u << params.joint_count) - 1u;
  for (int j = 0; j < params.joint_count; ++j) {
    const bool holds = (last.torque_enable >> j & 1u) != 0u;
    in.position_count[j] = holds ? last.goal_count[j] + noise(random) / 16
                                 : model::count_of(params.joint[j], params.joint[j].sit_rad);
  }
  model::share_counts(params, in);
  const float scale = params.imu.accel_m_s2_per_count;
  const float up_count = scale > 0.0F && scale < 1.0F ? kGravity / scale : 0.0F;
  for (int i = 0; i < 3; ++i) {
    in.gyro_count[i] = noise(random);
    // The body's up in the IMU frame.
    const float rest = params.imu.body_imu[6 + i] * up_count;
    const auto count = static_cast<std::int32_t>(rest > -30000.0F && rest < 30000.0F ? rest : 0.0F);
    in.accel_count[i] = static_cast<std::int16_t>(count + noise(random));
  }
}

}  // namespace

std::uint64_t self_test_digest(const Params& params, State& scratch) {
  scratch = State{};
  // A known gyro bias: the walk begins in these ticks.
  scratch.attitude.still_s = balance::kCalibrated_s;
  Inputs inputs;
  Outputs outputs;
  std::uint32_t random = 1;
  for (std::uint32_t tick = 0; tick < kSelfTestTicks; ++tick) {
    sense(params, tick, random, outputs, inputs);
    const bool walks = tick >= kStandUntil && tick < kWalkUntil;
    inputs.command.request = walks ? Request::kWalk : Request::kStand;
    inputs.command.vx_tenth_mm_s = 1000;
    inputs.parameter_id = kRiseId;  // leaves more ticks for steps
    inputs.parameter_bits = std::bit_cast<std::uint32_t>(kRise_s);
    if (tick == 0) inputs.flags |= kParameterWrite;
    inputs.command.sequence = static_cast<std::uint8_t>(tick);
    inputs.flags |= kCommandFresh;
    step(params, scratch, inputs, outputs);
  }
  return scratch.digest.chain;
}

}  // namespace verp::control
