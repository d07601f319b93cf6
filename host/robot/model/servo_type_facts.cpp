#include "host/robot/model/servo_type_facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "common/protocol/servo_models.hpp"
#include "host/robot/model/bam_file.hpp"
#include "host/robot/model/bounds.hpp"
#include "host/robot/model/find.hpp"

namespace verp::model {
namespace {

constexpr double kRevMin = 60 / (2 * std::numbers::pi);
// Bounds from watch servos to horse-sized ones.
constexpr double kMostSpeed_rev_min = 1e5;
constexpr double kLeastGear = 1, kMostGear = 1e4;
constexpr double kEstimateBand = 0.5;             // as that of the shipped types that are scaled
constexpr const char* kUsualType = "xm430_w210";  // of estimates for a type that is like none

void set_motor(double kt_n_m_a, double resistance_ohm, ServoType& type) {
  type.stall_current_a = type.nominal_v / resistance_ohm;
  type.stall_torque_n_m = kt_n_m_a * type.stall_current_a;
  type.no_load_rev_min = type.nominal_v / kt_n_m_a * kRevMin;
}

void read_motor(const XmlElement& e, const Bam& bam, ServoType& type) {
  const bool constants = e.has("kt_n_m_a") || e.has("resistance_ohm");
  const bool sheet = e.has("stall_torque_n_m") || e.has("no_load_rev_min");
  if (constants && sheet) {
    e.fail("<verp:servo_type> gives its motor twice",
           "write kt_n_m_a and resistance_ohm, or stall_torque_n_m and no_load_rev_min");
  }
  if (constants) {
    set_motor(e.number_within("kt_n_m_a", 1e-6, 1e3, " N m/A at the joint, like 1.66"),
              e.number_within("resistance_ohm", 1e-3, 1e4, " ohm, like 3.2"), type);
  } else if (!sheet && bam.has_motor()) {
    set_motor(bam.kt_n_m_a, bam.resistance_ohm, type);
  } else if (sheet || type.stall_torque_n_m <= 0) {
    type.stall_torque_n_m =
        e.number_within("stall_torque_n_m", 1e-6, kMostTorque_n_m, " N m, like 3.0");
    type.no_load_rev_min =
        e.number_within("no_load_rev_min", 1e-3, kMostSpeed_rev_min, " rev/min, like 77");
    // An ideal machine turns all power but heat into motion: kt is V s and N m/A.
    type.stall_current_a = type.stall_torque_n_m * type.no_load_rev_min / kRevMin / type.nominal_v;
  }
  type.stall_current_a =
      e.number_within("stall_current_a", 1e-6, 1e4, " A, like 2.3", type.stall_current_a);
}

bool gives_friction(const XmlElement& e) {
  constexpr const char* kNames[] = {"f_base_n_m", "f_strib_n_m", "f_visc_n_m_s", "l_base",
                                    "l_strib",    "w_s_rad_s",   "alpha",        "bam"};
  return std::any_of(std::begin(kNames), std::end(kNames),
                     [&](const char* name) { return e.has(name); });
}

std::string not_given(const XmlElement& e, const ServoType& type) {
  std::vector<std::string> parts;
  if (!e.has("gear_ratio")) parts.push_back(fmt::format("gear ratio {:.3g}", type.gear_ratio));
  if (!e.has("armature_kg_m2") && !e.has("bam")) parts.push_back("rotor");
  if (!gives_friction(e)) parts.push_back("friction");
  if (!e.has("heat_capacity_j_k")) parts.push_back("heat capacity");
  if (!e.has("heat_resistance_k_w")) parts.push_back("heat resistance");
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Rotor, gears and housing from those of another type, for what the file does not give. Rotors
/// have an inertia in proportion to their torque (servo_types.cpp) and about equal rim speeds: a
/// larger one turns slower, by the cube root of the torque. Friction is a share of the torque. A
/// motor's mass, which stores heat, grows with the torque; heat leaves through its surface.
void estimate(const XmlElement& e, const ServoType* like, ServoType& type) {
  const ServoType& base = like ? *like : *find_servo_type(servo_types(), kUsualType);
  const double stronger = type.stall_torque_n_m / base.stall_torque_n_m;
  const double faster = type.no_load_rev_min / base.no_load_rev_min;
  const double gear = base.gear_ratio / (faster * std::cbrt(stronger));
  type.gear_ratio = e.number_within("gear_ratio", kLeastGear, kMostGear, ", like 212.6",
                                    std::clamp(gear, kLeastGear, kMostGear));
  const double geared = type.gear_ratio / base.gear_ratio;
  if (like && stronger == 1 && faster == 1 && geared == 1) return;
  type.peak_torque_n_m = base.peak_torque_n_m * stronger;
  type.gearbox = base.gearbox;
  type.gearbox.armature_kg_m2 *= stronger * geared;
  type.gearbox.f_base_n_m *= stronger;
  type.gearbox.f_strib_n_m *= stronger;
  type.gearbox.f_visc_n_m_s *= stronger / faster;
  type.gearbox.q_motor_per_n_m /= stronger;
  type.gearbox.q_external_per_n_m /= stronger;
  type.heat_capacity_j_k = base.heat_capacity_j_k * stronger;
  type.heat_resistance_k_w = base.heat_resistance_k_w / std::cbrt(stronger * stronger);
  type.armature_band = std::max(base.armature_band, kEstimateBand);
  type.friction_band = std::max(base.friction_band, kEstimateBand);
  type.source = "scaled by torque and gear from " + base.name;
  type.estimated = not_given(e, type);
}

// Own numbers have no band; inherited ones keep theirs.
void read_bands(const XmlElement& e, const Bam& bam, ServoType& type) {
  const bool own_armature = e.has("armature_kg_m2") || e.has("bam");
  const bool own_friction = gives_friction(e);
  const auto band = [&](const char* name, bool own, double& value) {
    value =
        e.number_within(name, 0, 0.99, ": 0.5 is half to one and a half times", own ? 0.0 : value);
  };
  band("armature_band", own_armature, type.armature_band);
  band("friction_band", own_friction, type.friction_band);
  if (!own_armature && !own_friction && !e.has("source")) return;
  const std::string before = type.source;
  type.source = e.has("bam") ? e.text("source", bam.source()) : e.text("source");
  if (own_armature == own_friction || before.empty()) return;
  type.source += own_armature ? "; friction " + before : "; rotor " + before;
}

void check_shares(const XmlElement& e, double base, double still, const char* what) {
  if (base + still <= kMostLoad) return;
  e.fail(
      fmt::format("{} take {:.3g} of a load between them, and lock the gears", what, base + still),
      fmt::format("choose them so that their sum is at most {}", kMostLoad));
}

/// M5 and M6: the load's two sides apart.
void read_external(const XmlElement& e, Gearbox& g) {
  const auto read = [&](const char* name, double high, const char* unit, double& value) {
    if (!e.has(name)) return;
    g.is_directional = true;
    value = e.number_within(name, 0, high, unit);
  };
  read("l_external", kMostLoad, ", a part of the external load", g.l_external);
  read("l_external_strib", kMostLoad, ", a part of the external load", g.l_external_strib);
  read("q_motor_per_n_m", kMostQuadratic, " per N m, like 0.007", g.q_motor_per_n_m);
  read("q_external_per_n_m", kMostQuadratic, " per N m, like 0.01", g.q_external_per_n_m);
  check_shares(e, g.l_external, g.l_external_strib, "l_external and l_external_strib");
}

void read_gearbox(const XmlElement& e, const Bam& bam, ServoType& type) {
  Gearbox& g = type.gearbox;
  if (e.has("bam")) {
    g = bam.gearbox;
    type.unread = bam.unread_text();
    if (bam.has_motor() && bam.current_limit_a > 0)
      type.peak_torque_n_m = bam.kt_n_m_a * bam.current_limit_a;
  }
  const auto read = [&](const char* name, double low, double high, const char* unit,
                        double& value) { value = e.number_within(name, low, high, unit, value); };
  read("peak_torque_n_m", 1e-6, kMostTorque_n_m, " N m, like 45", type.peak_torque_n_m);
  read("armature_kg_m2", 0, kMostArmature_kg_m2, " kg m2 at the joint, like 0.011",
       g.armature_kg_m2);
  read("f_base_n_m", 0, kMostTorque_n_m, " N m, like 0.06", g.f_base_n_m);
  read("f_strib_n_m", 0, kMostTorque_n_m, " N m, like 0.02", g.f_strib_n_m);
  read("f_visc_n_m_s", 0, kMostTorque_n_m, " N m s/rad, like 0.015", g.f_visc_n_m_s);
  read("l_base", 0, kMostLoad, ", a part of the load", g.l_base);
  read("l_strib", 0, kMostLoad, ", a part of the load", g.l_strib);
  check_shares(e, g.l_base, g.l_strib, "l_base and l_strib");
  read_external(e, g);
  read("w_s_rad_s", 1e-3, 1e3, " rad/s, like 1.5", g.w_s_rad_s);
  read("alpha", 0.1, 20, ", like 1.3", g.alpha);
  read("heat_capacity_j_k", 0.1, 1e6, " J/K, like 74", type.heat_capacity_j_k);
  read("heat_resistance_k_w", 1e-3, 1e4, " K/W, like 13", type.heat_resistance_k_w);
  read_bands(e, bam, type);
}

// A file cannot give a servo what its model lacks.
void check_model(const XmlElement& e, const ServoType& type) {
  const dxl::ServoModel* model = dxl::find_servo_model(type.model_number);
  if (type.protocol != BusProtocol::kDynamixel2 || model == nullptr) return;
  const std::string what =
      fmt::format("<verp:servo_type> model_number {} is {}, which ", model->number, model->name);
  if (type.fast_sync_read && !model->has(dxl::kFastSyncRead)) {
    e.fail(what + "has no Fast Sync Read", "write fast_sync_read=\"0\"");
  }
  if (type.counts_per_rev != dxl::kCountsPerTurn) {
    e.fail(what + fmt::format("has {} counts a turn, not {:.0f}", dxl::kCountsPerTurn,
                              type.counts_per_rev),
           "leave counts_per_rev out, or give the servo's own model_number");
  }
}

/// Gains have the units of the protocol's servos.
void set_protocol(BusProtocol protocol, ServoType& type) {
  if (protocol == type.protocol) return;
  type.protocol = protocol;
  const bool feetech = protocol == BusProtocol::kFeetech;
  const ServoType* usual = find_servo_type(servo_types(), feetech ? "sts3215" : "xm430_w210");
  type.p_gain_unit = usual->p_gain_unit;
  type.most_gain = usual->most_gain;
  type.default_p_gain = usual->default_p_gain;
  type.default_d_gain = usual->default_d_gain;
}

Bam bam_of(const XmlElement& e) {
  if (!e.has("bam")) return {};
  const std::string file = resolve_model_uri(e.text("bam"), e.file());
  if (file.empty()) {
    e.fail("<verp:servo_type> bam: there is no file '" + e.text("bam") + "'",
           "give its path from this file's folder, or a model:// name");
  }
  return read_bam(file);
}

ServoType read_type(const XmlElement& e, const std::vector<ServoType>& known) {
  e.allow({"name",
           "like",
           "title",
           "protocol",
           "model_number",
           "nominal_v",
           "kt_n_m_a",
           "resistance_ohm",
           "peak_torque_n_m",
           "gear_ratio",
           "heat_capacity_j_k",
           "heat_resistance_k_w",
           "stall_torque_n_m",
           "no_load_rev_min",
           "stall_current_a",
           "counts_per_rev",
           "encoder_noise_deg",
           "loop_us",
           "loop_delay_us",
           "goal_delay_us",
           "fast_sync_read",
           "p_gain",
           "armature_kg_m2",
           "f_base_n_m",
           "f_strib_n_m",
           "l_base",
           "l_strib",
           "w_s_rad_s",
           "alpha",
           "f_visc_n_m_s",
           "l_external",
           "l_external_strib",
           "q_motor_per_n_m",
           "q_external_per_n_m",
           "bam",
           "armature_band",
           "friction_band",
           "source"});
  const std::string name = e.text("name");
  if (find_servo_type(known, name)) {
    e.fail("there is a servo type '" + name + "' already", "choose another name");
  }
  const ServoType* like = nullptr;
  if (e.has("like")) {
    like = find_servo_type(known, e.text("like"));
    if (!like)
      e.fail("no servo type '" + e.text("like") + "'", "choose one of: " + names_of(known));
  }
  ServoType type = like ? *like : ServoType{};
  type.name = name;
  type.title = e.text("title", name);
  if (!like || e.has("protocol")) set_protocol(read_protocol(e), type);
  const auto whole = [&](const char* attribute, int low, int high, int of_like) {
    return like ? e.integer(attribute, low, high, of_like) : e.integer(attribute, low, high);
  };
  type.model_number =
      static_cast<std::uint16_t>(whole("model_number", 1, 65535, type.model_number));
  const double nominal_v = e.number_within("nominal_v", 0.1, 1000, " V, like 12", type.nominal_v);
  const Bam bam = bam_of(e);
  const bool has_motor = e.has("kt_n_m_a") || e.has("stall_torque_n_m") || bam.has_motor();
  if (nominal_v != type.nominal_v && !has_motor) {
    e.fail("<verp:servo_type> nominal_v needs the motor's numbers at that voltage",
           "add kt_n_m_a and resistance_ohm, or stall_torque_n_m and no_load_rev_min");
  }
  type.nominal_v = nominal_v;
  read_motor(e, bam, type);
  type.counts_per_rev =
      e.integer("counts_per_rev", 64, 1 << 22, static_cast<int>(type.counts_per_rev));
  type.encoder_noise_deg =
      e.number_within("encoder_noise_deg", 0, 10, " degrees", type.encoder_noise_deg);
  type.loop_us = e.number_within("loop_us", 10, 20000, " us, like 1000", type.loop_us);
  type.loop_delay_us = e.number_within("loop_delay_us", 0, 20000, " us", type.loop_delay_us);
  type.goal_delay_us = e.number_within("goal_delay_us", 0, 100000, " us", type.goal_delay_us);
  type.fast_sync_read = e.integer("fast_sync_read", 0, 1, type.fast_sync_read ? 1 : 0) == 1;
  type.default_p_gain =
      static_cast<std::uint16_t>(e.integer("p_gain", 1, type.most_gain, type.default_p_gain));
  estimate(e, like, type);
  read_gearbox(e, bam, type);
  check_model(e, type);
  return type;
}

}  // namespace

BusProtocol read_protocol(const XmlElement& e) {
  const std::string name = e.text("protocol");
  for (const BusProtocol each :
       {BusProtocol::kDynamixel2, BusProtocol::kCia402, BusProtocol::kFeetech}) {
    if (name == protocol_name(each)) return each;
  }
  e.fail("no bus protocol '" + name + "'",
         "write protocol=\"dynamixel2\", \"feetech\" or \"cia402\"");
}

std::vector<ServoType> read_servo_types(const XmlElement& model) {
  std::vector<ServoType> types = servo_types();
  for (const XmlElement& child : model.children("verp:servo_type")) {
    types.push_back(read_type(child, types));
  }
  return types;
}

}  // namespace verp::model
