#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/twin/sim/robot.hpp"

/// A robot as another one of its kind might be, on another floor: everything that a builder cannot
/// know of it, drawn from one seed. The controller keeps the Params of the robot that was varied
/// from: it must not know.
namespace verp::sim {

/// Half the width of a uniform draw about 1 or 0, or the ends of one.
struct VaryBands {
  double mass = 0.10;                              ///< each link's, with its inertia
  double friction_low = 0.4, friction_high = 1.0;  ///< of the ground under the soles
  double delay_s = 0.020;          ///< most; from a goal's arrival until its servo acts on it
  double backlash_rad = 0.017453;  ///< most, each joint: 1 degree
  double strength = 0.10;          ///< each servo's stall torque
  /// Each axis of the gyroscope, for good: ICM-20648 datasheet DS-000179, zero-rate output
  /// +-5 degrees/s before calibration.
  double gyro_bias_rad_s = 0.087266;
  double floor_tilt_rad = 0.017453;  ///< most, downhill any way: 1 degree
  /// Parts of what the servos are made for: at 12 V three lithium cells, half empty to full.
  double supply_low = 0.925, supply_high = 1.05;
};

struct Varied {
  model::Entity entity;
  TwinOptions twin;
  WorldOptions world;
  /// What was drawn, for people and --json: name and value; of a draw for each link or joint, the
  /// least and the most.
  std::vector<std::pair<std::string, double>> drawn;
};

/// Pure: equal arguments, equal robot. Every kind of draw has a stream of its own (random.hpp), so
/// that one kind more changes no other. Rotor inertia and gearbox friction are drawn within the
/// band that each servo's type states; one draw a robot, as its servos are of one make. `twin` and
/// `world` give what is not drawn; twin.seed is the seed of all.
Varied vary(const model::Entity& entity, const TwinOptions& twin, const WorldOptions& world,
            const VaryBands& bands = {});

}  // namespace verp::sim
