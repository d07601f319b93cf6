#pragma once
#include <gtest/gtest.h>

#include "common/balance/estimator.hpp"
#include "common/kinematics/leg_ik.hpp"
#include "common/model/counts.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::test {

using balance::AttitudeIn;
using balance::AttitudeState;
using balance::EstimatorIn;
using balance::EstimatorState;

inline constexpr float kPeriod_s = 0.01F;
inline constexpr float kStandHeight_m = 0.26F;  // of the body over level soles

/// The soles stay while the body is led. Sensors are exact but for the counts; it looks along x.
struct Led {
  Params params = kRobot;
  AttitudeState attitude;
  EstimatorState state;
  Inputs inputs;
  EstimatorIn in;
  gait::Lump lump;
  Vec3 sole_m[kFeet] = {Vec3(0, 0.037F, 0), Vec3(0, -0.037F, 0)};
  Vec3 body_m{0, 0, kStandHeight_m}, velocity_m_s{0, 0, 0};
  Mat3 turned = Mat3::Identity();
  float load_n[kFeet] = {15, 15};
  Vec3 accel_offset_m_s2{0, 0, 0};  ///< beyond the attitude's up
  Vec3 up_offset_m_s2{0, 0, 0};     ///< within the attitude's up
  Mat3 ground = Mat3::Identity();   ///< the soles' orientation

  Led() {
    float angle_rad[kMaxJoints] = {};
    lump = gait::lump_of(params, angle_rad);
    inputs.fresh = ~0u;
    inputs.flags = kImuFresh | kFeetFresh;
    in.lump = &lump;
    in.attitude = &attitude;
    in.inputs = &inputs;
    in.imu_fresh = true;
    in.on_feet = true;
  }

  /// All lengths, masses kept: before the first tick.
  void grow(float times) {
    const auto scale = [&](Xyz& place_m) {
      place_m = {times * place_m.x, times * place_m.y, times * place_m.z};
    };
    for (int j = 0; j < params.joint_count; ++j) {
      scale(params.joint[j].origin_parent_m);
      scale(params.joint[j].com_link_m);
    }
    scale(params.body_com_m);
    for (int side = 0; side < kFeet; ++side) {
      LegParams& leg = params.leg[side];
      scale(leg.hip_body_m);
      scale(leg.sole_foot_m);
      leg.thigh_m *= times;
      leg.shank_m *= times;
      sole_m[side] = times * sole_m[side];
    }
    body_m = times * body_m;
    float angle_rad[kMaxJoints] = {};
    lump = gait::lump_of(params, angle_rad);
  }

  /// False if the legs cannot reach the soles.
  bool place_legs() {
    bool reached = true;
    const float bent[kLegJoints] = {0, 0, -0.6F, 1.2F, -0.6F, 0};
    for (int side = 0; side < kFeet; ++side) {
      const LegParams& leg = params.leg[side];
      const Pose sole{turned.transpose() * ground, turned.transpose() * (sole_m[side] - body_m)};
      const kinematics::LegAngles angles = kinematics::solve_leg(params, leg, sole, bent);
      reached = reached && angles.flags == 0;
      for (int k = 0; k < kLegJoints; ++k) {
        const int j = leg.joint[k];
        inputs.position_count[j] = model::count_of(params.joint[j], angles.angle_rad[k]);
      }
    }
    return reached;
  }

  bool tick(const Vec3& next_m_s) {
    const Vec3 accel_m_s2 = (next_m_s - velocity_m_s) / kPeriod_s;
    body_m += (0.5F * kPeriod_s) * (velocity_m_s + next_m_s);
    velocity_m_s = next_m_s;
    in.accel_body_m_s2 =
        turned.transpose() * (accel_m_s2 + Vec3(0, 0, math::kGravityMS2)) + up_offset_m_s2;
    AttitudeIn feels;
    feels.fresh = true;
    feels.accel_body_m_s2 = in.accel_body_m_s2;
    balance::update(attitude, feels);
    in.accel_body_m_s2 += accel_offset_m_s2;
    for (int side = 0; side < kFeet; ++side) {
      for (std::uint16_t& count : inputs.foot_count[side]) {
        count = static_cast<std::uint16_t>(25.0F * load_n[side]);
      }
    }
    const bool reached = place_legs();
    balance::update(params, state, in);
    return reached;
  }
  void rest() { ticks(120); }
  void ticks(int count, const Vec3& velocity = Vec3(0, 0, 0)) {
    for (int i = 0; i < count; ++i) ASSERT_TRUE(tick(velocity)) << "tick " << i;
  }
  void stand_on(float left) {
    load_n[0] = 30.0F * left;
    load_n[1] = 30.0F - load_n[0];
  }
  Vec3 believed_m() const { return math::to_vec(state.body_m); }
  Vec3 believed_m_s() const { return math::to_vec(state.body_velocity_m_s); }
};

/// It holds pointers into itself.
inline Led& led_robot() {
  static Led led;
  led = Led{};
  led.in.lump = &led.lump;
  led.in.attitude = &led.attitude;
  led.in.inputs = &led.inputs;
  return led;
}

}  // namespace verp::test
