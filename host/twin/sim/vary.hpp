#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/twin/sim/robot.hpp"

/// Domain randomisation: draws from one seed another robot of the same kind on another floor, in
/// all that its builder cannot know. The controller keeps the Params of the original robot.
namespace verp::sim {

/// Half width of a uniform draw about 1 or 0, or its limits.
struct VaryBands {
  double mass = 0.10;                              ///< each link's, with its inertia
  double friction_low = 0.4, friction_high = 1.0;  ///< of the ground under the soles
  double delay_s = 0.020;          ///< most; from a goal's arrival until its servo acts on it
  double backlash_rad = 0.017453;  ///< most, each joint: 1 degree
  double strength = 0.10;          ///< each servo's stall torque
  /// Constant bias per gyroscope axis: ICM-20648 datasheet DS-000179, zero-rate output +-5
  /// degrees/s before calibration.
  double gyro_bias_rad_s = 0.087266;
  double floor_tilt_rad = 0.017453;  ///< most, downhill in any direction: 1 degree
  /// Shares of the servos' nominal voltage: at 12 V, three lithium cells, half empty to full.
  double supply_low = 0.925, supply_high = 1.05;
};

struct Varied {
  model::Entity entity;
  TwinOptions twin;
  WorldOptions world;
  /// Drawn values for people and --json: name and value. For draws per link or joint: the least and
  /// the most.
  std::vector<std::pair<std::string, double>> drawn;
};

/// Pure: equal arguments give an equal robot. Each kind of draw has its own stream (random.hpp), so
/// a new kind changes no other. Rotor inertia and gearbox friction are drawn within the band of
/// each servo's type, once per robot, because its servos are of one make. `twin` and `world` give
/// the values that are not drawn; twin.seed is the only seed.
Varied vary(const model::Entity& entity, const TwinOptions& twin, const WorldOptions& world,
            const VaryBands& bands = {});

}  // namespace verp::sim
