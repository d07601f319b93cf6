#include "host/twin/sim/vary.hpp"

#include "host/robot/model/supply.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace verp::sim {
namespace {

class Drawing {
 public:
  Drawing(const model::Entity& entity, const TwinOptions& twin, const WorldOptions& world,
          const VaryBands& bands)
      : bands_(bands), out_{entity, twin, world, {}} {}

  Varied draw() {
    masses();
    floor_friction();
    delay();
    backlash();
    strength();
    gearbox();
    gyro_bias();
    floor_tilt();
    supply();
    return std::move(out_);
  }

 private:
  Random stream(Draw purpose) const { return Random(out_.twin.seed, purpose); }
  void note(const char* name, double value) { out_.drawn.emplace_back(name, value); }
  void note_range(const std::string& name, const std::vector<double>& values) {
    if (values.empty()) return;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    out_.drawn.emplace_back(name + "_least", *low);
    out_.drawn.emplace_back(name + "_most", *high);
  }

  void masses() {
    Random random = stream(Draw::kVaryMass);
    std::vector<double> factors;
    for (model::Node& node : out_.entity.nodes) {
      factors.push_back(1 + bands_.mass * random.uniform(-1, 1));
      node.mass_kg *= factors.back();
      node.inertia_kg_m2 *= factors.back();
    }
    note_range("mass_factor", factors);
  }

  void floor_friction() {
    const double friction =
        stream(Draw::kVaryFriction).uniform(bands_.friction_low, bands_.friction_high);
    out_.world.ground_surface.friction = friction;
    // The smaller friction counts (world.cpp): the robot's must not hide it.
    for (model::Node& node : out_.entity.nodes) {
      for (model::Collision& shape : node.collisions) shape.friction = friction;
    }
    note("friction", friction);
  }

  void delay() {
    out_.twin.goal_delay_s = stream(Draw::kVaryDelay).uniform(0, bands_.delay_s);
    note("goal_delay_s", out_.twin.goal_delay_s);
  }

  void backlash() {
    Random random = stream(Draw::kVaryBacklash);
    std::vector<double> drawn;
    for (model::Joint& joint : out_.entity.joints) {
      joint.servo.backlash_rad = random.uniform(0, bands_.backlash_rad);
      drawn.push_back(joint.servo.backlash_rad);
    }
    note_range("backlash_rad", drawn);
  }

  void strength() {
    Random random = stream(Draw::kVaryStrength);
    std::vector<double> factors;
    for (model::Joint& joint : out_.entity.joints) {
      factors.push_back(1 + bands_.strength * random.uniform(-1, 1));
      joint.servo.stall_torque_n_m *= factors.back();
    }
    note_range("strength_factor", factors);
  }

  void gearbox() {
    const double rotor = stream(Draw::kVaryRotor).uniform(-1, 1);
    const double friction = stream(Draw::kVaryGearFriction).uniform(-1, 1);
    for (model::Joint& joint : out_.entity.joints) {
      model::Servo& servo = joint.servo;
      servo.gearbox.armature_kg_m2 *= 1 + servo.armature_band * rotor;
      scale_friction(friction, servo);
    }
    note("rotor_in_band", rotor);
    note("gear_friction_in_band", friction);
  }

  void gyro_bias() {
    Random random = stream(Draw::kVaryGyroBias);
    Vec3 bias_rad_s;
    for (int axis = 0; axis < 3; ++axis)
      bias_rad_s[axis] = bands_.gyro_bias_rad_s * random.uniform(-1, 1);
    out_.twin.gyro_bias_rad_s = bias_rad_s;
    note("gyro_bias_x_rad_s", bias_rad_s.x());
    note("gyro_bias_y_rad_s", bias_rad_s.y());
    note("gyro_bias_z_rad_s", bias_rad_s.z());
  }

  void floor_tilt() {
    Random random = stream(Draw::kVaryTilt);
    const double tilt_rad = random.uniform(0, bands_.floor_tilt_rad);
    const double way_rad = random.uniform(-std::numbers::pi, std::numbers::pi);
    out_.world.up = Vec3(std::sin(tilt_rad) * std::cos(way_rad),
                         std::sin(tilt_rad) * std::sin(way_rad), std::cos(tilt_rad));
    note("floor_tilt_rad", tilt_rad);
    note("floor_uphill_rad", way_rad);
  }

  void supply() {
    const double part = stream(Draw::kVarySupply).uniform(bands_.supply_low, bands_.supply_high);
    const double supply_v = part * out_.twin.supply_v.value_or(model::supply_volts(out_.entity));
    out_.twin.supply_v = supply_v;
    note("supply_v", supply_v);
  }

  const VaryBands& bands_;
  Varied out_;
};

}  // namespace

void scale_friction(double in_band, model::Servo& servo) {
  const double factor = 1 + servo.friction_band * in_band;
  for (double* part : {&servo.gearbox.f_base_n_m, &servo.gearbox.f_strib_n_m, &servo.gearbox.l_base,
                       &servo.gearbox.l_strib, &servo.gearbox.f_visc_n_m_s,
                       &servo.gearbox.l_external, &servo.gearbox.l_external_strib,
                       &servo.gearbox.q_motor_per_n_m, &servo.gearbox.q_external_per_n_m}) {
    *part *= factor;
  }
}

Varied vary(const model::Entity& entity, const TwinOptions& twin, const WorldOptions& world,
            const VaryBands& bands) {
  return Drawing(entity, twin, world, bands).draw();
}

}  // namespace verp::sim
