#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/twin/sim/robot.hpp"

/// Domain randomisation: draws another robot of the same kind on another floor, in all that its
/// builder cannot know. The controller keeps the original Params.
namespace verp::sim {

/// Half widths of uniform draws about 1 or 0, or limits.
struct VaryBands {
  double mass = 0.10;                              ///< each link's, with inertia
  double friction_low = 0.4, friction_high = 1.0;  ///< of the ground
  double delay_s = 0.020;          ///< most; from a goal's arrival to its servo's action
  double backlash_rad = 0.017453;  ///< most, each joint: 1 degree
  double strength = 0.10;          ///< each servo's stall torque
  /// Per axis: ICM-20648 datasheet DS-000179, zero-rate output +-5 degrees/s before calibration.
  double gyro_bias_rad_s = 0.087266;
  double floor_tilt_rad = 0.017453;  ///< most, in any direction: 1 degree
  /// Shares of the nominal voltage: three lithium cells, half empty to full.
  double supply_low = 0.925, supply_high = 1.05;
};

/// Sets the gearbox's friction to a place in its servo type's band: -1 the least, 0 as identified,
/// 1 the most.
void scale_friction(double in_band, model::Servo& servo);

struct Varied {
  model::Entity entity;
  TwinOptions twin;
  WorldOptions world;
  /// Drawn values for --json; draws per link or joint give the least and the most.
  std::vector<std::pair<std::string, double>> drawn;
};

/// A new kind of draw changes no other (random.hpp). Rotor inertia and gearbox friction are drawn
/// once per robot, within each servo type's band: its servos are of one make. `twin` and `world`
/// give the rest; twin.seed is the only seed.
Varied vary(const model::Entity& entity, const TwinOptions& twin, const WorldOptions& world,
            const VaryBands& bands = {});

}  // namespace verp::sim
