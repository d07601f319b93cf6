#include "host/robot/model/check.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "common/model/image.hpp"
#include "host/robot/model/bus_time.hpp"
#include "host/robot/model/couplings.hpp"
#include "host/robot/model/fit_gains.hpp"
#include "host/robot/model/leg.hpp"
#include "host/robot/model/params.hpp"
#include "host/robot/model/servo_types.hpp"
#include "host/robot/model/stance.hpp"
#include "host/robot/model/supply.hpp"

namespace verp::model {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// Box around collision shapes and joint centres, zero pose.
Vec3 measures(const Entity& entity) {
  const auto origins = node_origins(entity);
  Eigen::AlignedBox3d box;
  for (std::size_t n = 0; n < entity.nodes.size(); ++n) {
    box.extend(origins[n]);
    for (const Collision& collision : entity.nodes[n].collisions) {
      Vec3 half = collision.size_m / 2;
      if (collision.shape != Collision::Shape::kBox) {
        const double radius = collision.size_m.x();
        const double cap = collision.shape == Collision::Shape::kCylinder ? 0 : radius;
        half = Vec3(radius, radius, collision.size_m.z() / 2 + cap);
      }
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
        box.extend(origins[n] + collision.pose * half.cwiseProduct(sign));
      }
    }
  }
  return box.sizes();
}

Vec3 center_of_mass(const Entity& entity) {
  const auto origins = node_origins(entity);
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < entity.nodes.size(); ++n) {
    sum += entity.nodes[n].mass_kg * (origins[n] + entity.nodes[n].com_m);
  }
  return sum / total_mass(entity);
}

std::string bus_text(const Entity& entity, const Params& params) {
  const BusTime time = bus_time(params);
  const bool can = params.bus_protocol == BusProtocol::kCia402;
  std::string text = fmt::format("bus: {}, {} baud, {} us period, {} {} a tick: {:.1f} % of it\n",
                                 protocol_name(entity.protocol), entity.baud, entity.period_us,
                                 can ? time.bits : time.bytes,
                                 can ? "bits with worst stuffing" : "bytes", 100 * time.share);
  if (entity.buses.size() < 2) return text;
  text += fmt::format("buses: this is {}, with --bus also", entity.bus);
  for (const std::string& name : entity.buses) {
    if (name != entity.bus) text += " " + name;
  }
  return text + "\n";
}

std::string leg_text(const Limb& limb, const LegGeometry& g) {
  return fmt::format(
      "  {:<10} {} (axes meet within {:.2f} mm{}), thigh {:.1f} mm, shank {:.1f} mm, sole {:.0f} x "
      "{:.0f} mm, "
      "{:.1f} mm below the ankle\n",
      limb.name, g.closed_form ? "closed form" : "Newton", 1000 * g.residual_m,
      g.reason.empty() ? "" : ": " + g.reason, 1000 * g.thigh_m, 1000 * g.shank_m,
      1000 * (limb.sole_max_m.x() - limb.sole_min_m.x()),
      1000 * (limb.sole_max_m.y() - limb.sole_min_m.y()), -1000 * limb.tip.translation().z());
}

/// Friction when the motor stalls against the gearbox.
double stall_friction_n_m(const Servo& servo) {
  const Gearbox& g = servo.gearbox;
  return g.f_base_n_m + g.f_strib_n_m + servo.stall_torque_n_m * (g.l_base + g.l_strib);
}

/// What follows for the user from joints that the legs lack.
std::string lacks_text(const Limb& limb, const LegGeometry& g) {
  const char* const count = limb.joints.size() == 4 ? "four" : "five";
  std::string text;
  if (g.joint[0] < 0) {
    text += fmt::format("  legs of {} joints: no hip yaw, so it walks straight and cannot turn\n",
                        count);
  }
  if (g.joint[5] < 0) {
    text += fmt::format(
        "  legs of {} joints: no ankle roll, so each sole rolls with its leg; hip "
        "roll and steps balance it sideways\n",
        count);
  }
  return text;
}

bool is_leg(const Limb& limb) {
  return limb.name == "left_leg" || limb.name == "right_leg";
}

std::string joint_rows(const Entity& entity) {
  std::string text = fmt::format(
      "  {:<18} {:>3} {:>4} {:<11} {:>5} {:>15} {:>7} {:>8} {:>8} {:>7}\n", "joint", "id", "dir",
      "servo", "axis", "limits, deg", "rad/s", "N m max", "N m/rad", "link kg");
  for (std::size_t j = 0; j < entity.joints.size(); ++j) {
    const Joint& joint = entity.joints[j];
    int along = 0;
    const double part = joint.axis.cwiseAbs().maxCoeff(&along);
    const std::string axis =
        part < 0.999 ? "skew" : std::string(joint.axis[along] < 0 ? "-" : "+") + "xyz"[along];
    text += fmt::format(
        "  {:<18} {:>3} {:>+4} {:<11} {:>5} {:>7.1f} {:>7.1f} {:>7.2f} {:>8.2f} {:>8.1f} "
        "{:>7.3f}\n",
        joint.name, joint.servo.id, joint.servo.direction, joint.servo.type, axis,
        joint.lower_rad * kDegrees, joint.upper_rad * kDegrees, joint.velocity_limit_rad_s,
        joint.servo.most_torque_n_m(), servo_stiffness_n_m_rad(joint.servo),
        entity.nodes[j + 1].mass_kg);
  }
  return text;
}

/// One line per type, with the source.
std::string servo_type_rows(const Entity& entity) {
  std::map<std::string, const Servo*> used;
  for (const Joint& joint : entity.joints) used.insert({joint.servo.type, &joint.servo});
  std::string text;
  for (const auto& [name, servo] : used) {
    const auto band = [](double part) {
      return part > 0 ? fmt::format(" +-{:.0f} %", 100 * part) : std::string();
    };
    text += fmt::format(
        "servo {}: rotor {:.4f} kg m2 at the joint{}, friction at stall {:.2f} N m{}; {}\n", name,
        servo->gearbox.armature_kg_m2, band(servo->armature_band), stall_friction_n_m(*servo),
        band(servo->friction_band), servo->source);
    text += fmt::format("  heat: {:.3g} J/K, {:.3g} K/W to the air\n", servo->heat_capacity_j_k,
                        servo->heat_resistance_k_w);
    if (!servo->estimated.empty())
      text += fmt::format("  estimated, not in the file: {}\n", servo->estimated);
    const std::uint16_t fitting = fitting_p_gain(entity, *servo);
    if (fitting == 0) continue;
    text += fmt::format(
        "  p_gain {} makes {:.1f} N m/rad; this mass and leg want about {:.1f}, p_gain {} "
        "(host/guide/your-robot.md)\n",
        servo->p_gain, servo_stiffness_n_m_rad(*servo), fitting_stiffness_n_m_rad(entity, *servo),
        fitting);
  }
  return text;
}

std::optional<double> latency_of(const Entity& entity, const std::string& name) {
  std::optional<double> latency_s;
  const auto look = [&](const auto& sensors) {
    for (const auto& each : sensors) {
      if (each.name == name) latency_s = each.latency_s;
    }
  };
  look(entity.lasers);
  look(entity.cameras);
  look(entity.force_torques);
  look(entity.contacts);
  return latency_s;
}

std::string late_text(double latency_s) {
  return latency_s > 0 ? fmt::format(" ({:g} ms late)", 1000 * latency_s) : "";
}

std::string sensor_rows(const Entity& entity) {
  std::string text = fmt::format("sensors: angle in all {} joints", entity.joints.size());
  if (entity.imu) {
    const int id = entity.imu->id;
    text += fmt::format(", IMU ({}) on {}{}",
                        id == 0 ? "not on the bus" : "bus id " + std::to_string(id),
                        entity.nodes[0].name, late_text(entity.imu->latency_s));
  }
  if (entity.feet.id[0] != 0) {
    text += fmt::format(", 4 force cells per foot (bus ids {}, {})", entity.feet.id[0],
                        entity.feet.id[1]);
  }
  for (const OtherSensor& sensor : entity.sensors) {
    const bool recorded = latency_of(entity, sensor.name).has_value();
    if (!recorded && (sensor.type == "imu" || sensor.type == "contact")) continue;
    text += fmt::format(", {} on {}{}", sensor.type, sensor.link,
                        late_text(latency_of(entity, sensor.name).value_or(0)));
  }
  for (const TruthSensor& truth : entity.truths) {
    text += fmt::format(", truth '{}' of {}{}", truth.name,
                        entity.nodes[static_cast<std::size_t>(truth.node)].name,
                        late_text(truth.latency_s));
  }
  return text + "\n";
}

nlohmann::ordered_json limb_json(const Entity& entity, const Limb& limb) {
  nlohmann::ordered_json out = {{"name", limb.name}, {"dof", limb.joints.size()}};
  for (const int j : limb.joints)
    out["joints"].push_back(entity.joints[static_cast<std::size_t>(j)].name);
  if (!is_leg(limb)) return out;
  const LegGeometry g = classify_leg(entity, limb);
  out["lacks"] = nlohmann::ordered_json::array();
  for (const auto& [slot, name] : {std::pair{0U, "hip yaw"}, {5U, "ankle roll"}}) {
    if (g.joint[slot] < 0) out["lacks"].push_back(name);
  }
  out["solver"] = g.closed_form ? "closed_form" : "newton";
  out["reason"] = g.reason;
  out["residual_mm"] = 1000 * g.residual_m;
  out["thigh_m"] = g.thigh_m;
  out["shank_m"] = g.shank_m;
  out["sole_length_m"] = limb.sole_max_m.x() - limb.sole_min_m.x();
  out["sole_width_m"] = limb.sole_max_m.y() - limb.sole_min_m.y();
  return out;
}

nlohmann::ordered_json joint_json(const Entity& entity, std::size_t j) {
  const Joint& joint = entity.joints[j];
  const Servo& servo = joint.servo;
  nlohmann::ordered_json follows = nullptr;
  if (joint.follows >= 0) {
    follows = {{"joint", entity.joints[static_cast<std::size_t>(joint.follows)].name},
               {"multiplier", joint.ratio},
               {"offset_rad", joint.offset_rad}};
  }
  return {{"name", joint.name},
          {"follows", follows},
          {"axis", {joint.axis.x(), joint.axis.y(), joint.axis.z()}},
          {"lower_rad", joint.lower_rad},
          {"upper_rad", joint.upper_rad},
          {"velocity_limit_rad_s", joint.velocity_limit_rad_s},
          {"link", entity.nodes[j + 1].name},
          {"link_mass_kg", entity.nodes[j + 1].mass_kg},
          {"servo",
           {{"id", servo.id},
            {"type", servo.type},
            {"direction", servo.direction},
            {"offset_count", servo.offset_count},
            {"backlash_rad", servo.backlash_rad},
            {"stall_torque_n_m", servo.stall_torque_n_m},
            {"peak_torque_n_m", servo.most_torque_n_m()},
            {"no_load_speed_rad_s", servo.no_load_speed_rad_s},
            {"stiffness_n_m_rad", servo_stiffness_n_m_rad(servo)},
            {"p_gain", servo.p_gain},
            {"p_gain_fitting", fitting_p_gain(entity, servo)},
            {"armature_kg_m2", servo.gearbox.armature_kg_m2},
            {"armature_band", servo.armature_band},
            {"stall_friction_n_m", stall_friction_n_m(servo)},
            {"friction_band", servo.friction_band},
            {"heat_capacity_j_k", servo.heat_capacity_j_k},
            {"heat_resistance_k_w", servo.heat_resistance_k_w},
            {"estimated", servo.estimated},
            {"unread", servo.unread},
            {"source", servo.source}}}};
}

}  // namespace

std::string describe(const Entity& entity) {
  const Params params = make_params(entity);
  const Vec3 size = measures(entity);
  const Vec3 com = center_of_mass(entity);
  std::string text = fmt::format(
      "{}: {} joints, {:.3f} kg, {:.0f} x {:.0f} x {:.0f} mm (x, y, z at the zero pose)\n",
      entity.name, entity.joints.size(), total_mass(entity), 1000 * size.x(), 1000 * size.y(),
      1000 * size.z());
  text += fmt::format("file: {}\n", entity.file);
  text += fmt::format(
      "body frame: centre of {} ({:.3f} kg); the robot's centre of mass is at {:.1f} {:.1f} {:.1f} "
      "mm\n",
      entity.nodes[0].name, entity.nodes[0].mass_kg, 1000 * com.x(), 1000 * com.y(),
      1000 * com.z());
  text += "limbs:";
  for (const Limb& limb : entity.limbs)
    text += fmt::format(" {} {} DOF;", limb.name, limb.joints.size());
  text.back() = '\n';
  for (const Limb& limb : entity.limbs) {
    if (is_leg(limb)) text += leg_text(limb, classify_leg(entity, limb));
  }
  const Limb* const leg = find_limb(entity, "left_leg");
  if (leg) text += lacks_text(*leg, classify_leg(entity, *leg));
  text += joint_rows(entity);
  for (const std::string& line : describe_couplings(entity)) text += line + "\n";
  text += servo_type_rows(entity);
  text += supply_text(entity) + "\n";
  text += sensor_rows(entity);
  text += bus_text(entity, params);
  text += fmt::format("params: {} bytes, CRC-32 {:08x}\n", sizeof params, params_crc(params));
  for (const std::string& line : entity.defaults) text += "not in the file: " + line + "\n";
  for (const std::string& note : entity.notes) text += "note: " + note + "\n";
  return text;
}

std::string describe_json(const Entity& entity) {
  const Params params = make_params(entity);
  const Vec3 size = measures(entity);
  const Vec3 com = center_of_mass(entity);
  const BusTime load = bus_time(params);
  nlohmann::ordered_json out = {{"name", entity.name},
                                {"file", entity.file},
                                {"dof", entity.joints.size()},
                                {"mass_kg", total_mass(entity)},
                                {"size_m", {size.x(), size.y(), size.z()}},
                                {"center_of_mass_body_m", {com.x(), com.y(), com.z()}},
                                {"limbs", nlohmann::ordered_json::array()},
                                {"joints", nlohmann::ordered_json::array()},
                                {"sensors", nlohmann::ordered_json::array()}};
  for (const Limb& limb : entity.limbs) out["limbs"].push_back(limb_json(entity, limb));
  for (std::size_t j = 0; j < entity.joints.size(); ++j)
    out["joints"].push_back(joint_json(entity, j));
  for (const OtherSensor& sensor : entity.sensors) {
    nlohmann::ordered_json row = {
        {"name", sensor.name}, {"type", sensor.type}, {"link", sensor.link}};
    const double latency_s = latency_of(entity, sensor.name).value_or(0);
    if (latency_s > 0) row["latency_s"] = latency_s;
    out["sensors"].push_back(row);
  }
  for (const TruthSensor& truth : entity.truths) {
    nlohmann::ordered_json row = {
        {"name", truth.name},
        {"type", "truth"},
        {"link", entity.nodes[static_cast<std::size_t>(truth.node)].name}};
    if (truth.latency_s > 0) row["latency_s"] = truth.latency_s;
    out["sensors"].push_back(row);
  }
  out["bus"] = {{"name", entity.bus},
                {"buses", entity.buses},
                {"protocol", protocol_name(entity.protocol)},
                {"baud", entity.baud},
                {"period_us", entity.period_us},
                {"bytes_per_tick", load.bytes},
                {"bits_per_tick", load.bits},
                {"share", load.share}};
  out["supply"] = {{"volts", supply_volts(entity)},
                   {"resistance_ohm", supply_resistance_ohm(entity)},
                   {"estimated", !entity.supply.resistance_ohm}};
  out["params"] = {{"bytes", sizeof params}, {"crc32", fmt::format("{:08x}", params_crc(params))}};
  out["defaults"] = entity.defaults;
  out["notes"] = entity.notes;
  return out.dump(2) + "\n";
}

}  // namespace verp::model
