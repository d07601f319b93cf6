#pragma once
#include "common/model/params.hpp"
#include "common/safety/machine.hpp"

/// Which devices to believe: what they report is compared with what the robot does.
namespace verp::safety {

/// A servo with its joint follows a goal as a first-order lag of this time constant: an estimate
/// from walks of the twin, tuning seeds 1001-1006 of three robots. 0.03 s serves as well.
inline constexpr float kServoLag_s = 0.02F;
/// A joint that stays within kStays_rad, about the play of its gears, while kStuck_rad of motion
/// was due, is stuck: it is jammed, or its encoder is. That is well above the lag of those walks at
/// their turning points, and below the swing of each pitch joint of a leg.
inline constexpr float kStays_rad = 0.01F;
inline constexpr float kStuck_rad = 0.2F;
/// A joint further than this from where it should be is astray. More than on those walks, and than
/// where a robot hits the floor.
inline constexpr float kAstray_rad = 0.5F;

/// In so many readings of a robot that steps, two axes at least of the gyro and of the
/// accelerometer move further than this: more than a count's noise, far less than a step. A bit
/// that flickers moves one axis.
inline constexpr std::uint8_t kImuReadings = 20;
inline constexpr std::int32_t kImuMoves_count = 4;

/// Knees that feel less than this share of the load that the plan expects of them carry nothing.
inline constexpr float kLeastLoad = 0.3F;
inline constexpr int kKnee = 3;             ///< of kLegJoints
inline constexpr float kLoadTime_s = 1.0F;  ///< averaging time: several steps

struct FollowState {
  float model_rad = 0;           ///< where the joint should be
  std::int16_t stays_count = 0;  ///< where it was when it last moved; low bits
  /// Range of the model about the joint since then, kRangeUnit_rad.
  std::int8_t low = 0;
  std::int8_t high = 0;
  VERP_FIELDS(model_rad, stays_count, low, high)
};
VERP_PACKED(FollowState);

struct TrustState {
  FollowState joint[kMaxJoints];
  std::int16_t imu_low[6] = {};  ///< least and most counts so far: gyro, accelerometer
  std::int16_t imu_high[6] = {};
  float felt_rad2 = 0;  ///< mean of the knees' sag times the planned one
  float planned_rad2 = 0;
  std::int32_t unloaded_us = 0;  ///< how long the feet have carried nothing, saturating
  std::uint32_t doubted = 0;     ///< bit j: joint j, in the last tick
  std::uint8_t imu_readings = 0;
  std::uint8_t imu_still = 0;  ///< 1: it did not move
  std::uint8_t foreign = 0;    ///< 1: another controller's goals are sent; set from outside
  std::uint8_t reserved = 0;
  VERP_FIELDS(joint, imu_low, imu_high, felt_rad2, planned_rad2, unloaded_us, doubted, imu_readings,
              imu_still, foreign, reserved)
};
VERP_PACKED(TrustState);

/// The robot's own part in what its devices report.
struct Deed {
  Mode mode = Mode::kRelaxed;
  bool stepping = false;            ///< a foot is in the air
  const float* goal_rad = nullptr;  ///< sent in the last tick
};

struct Doubts {
  std::uint32_t servos = 0;  ///< bit j: joint j is stuck or astray
  bool imu = false;          ///< stuck
};

/// Call once a tick, first. Joints of a limp robot are not doubted; a stuck IMU is until it moves.
Doubts doubt(const Params& params, const Inputs& inputs, const Deed& deed, TrustState& state);

/// True once the feet have carried nothing for most_s. Cells and knees must both say so; a
/// robot without either is believed. `sag_rad`: planned sag of each knee. A knee counts if its
/// servo sags: its compliance is known and its loop has no integral part.
bool carries_nothing(const Params& params, const Inputs& inputs, const Deed& deed,
                     const float* sag_rad, float most_s, TrustState& state);

}  // namespace verp::safety
