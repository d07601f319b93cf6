#include "host/robot/model/bus_facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <numbers>
#include <span>

#include "common/protocol/feetech_table.hpp"
#include "common/protocol/servo_models.hpp"
#include "host/robot/model/bounds.hpp"
#include "host/robot/model/servo_type_facts.hpp"

namespace verp::model {
namespace {

const ServoType& read_type(const XmlElement& e, const std::vector<ServoType>& types,
                           BusProtocol protocol) {
  const std::string name = e.text("type");
  const ServoType* type = find_servo_type(types, name);
  std::vector<ServoType> fitting = types;
  std::erase_if(fitting, [=](const ServoType& each) { return each.protocol != protocol; });
  const std::string choice =
      "choose one of: " + names_of(fitting) + ", or describe it in a <verp:servo_type>";
  if (!type) e.fail("no servo type '" + name + "'", choice);
  if (type->protocol != protocol) {
    e.fail("servo type '" + name + "' does not speak " + protocol_name(protocol), choice);
  }
  return *type;
}

Servo servo_of(const ServoType& type) {
  Servo s;
  s.type = type.name;
  s.stall_torque_n_m = type.stall_torque_n_m;
  s.peak_torque_n_m = type.peak_torque_n_m;
  s.no_load_speed_rad_s = type.no_load_rev_min * 2 * std::numbers::pi / 60;
  s.stall_current_a = type.stall_current_a;
  s.nominal_v = type.nominal_v;
  s.counts_per_rev = type.counts_per_rev;
  s.encoder_noise_deg = type.encoder_noise_deg;
  s.loop_s = type.loop_us * 1e-6;
  s.loop_delay_s = type.loop_delay_us * 1e-6;
  s.goal_delay_s = type.goal_delay_us * 1e-6;
  s.gearbox = type.gearbox;
  s.armature_band = type.armature_band;
  s.friction_band = type.friction_band;
  s.source = type.source;
  s.estimated = type.estimated;
  s.unread = type.unread;
  s.heat_capacity_j_k = type.heat_capacity_j_k;
  s.heat_resistance_k_w = type.heat_resistance_k_w;
  s.model_number = type.model_number;
  s.fast_sync_read = type.fast_sync_read;
  s.p_gain_unit = type.p_gain_unit;
  s.most_gain = type.most_gain;
  return s;
}

/// e-Manual: 0 to 16,383. Feetech: 0 to 254.
std::uint16_t gain(const XmlElement& e, const ServoType& type, const char* name, int fallback) {
  return static_cast<std::uint16_t>(e.integer(name, 0, type.most_gain, fallback));
}

ServoFact read_servo(const XmlElement& e, const std::vector<ServoType>& types, BusProtocol protocol,
                     std::uint32_t period_us) {
  e.allow({"joint", "id", "type", "direction", "offset", "backlash_rad", "p_gain", "i_gain",
           "d_gain", "profile_ms", "lower_rad", "upper_rad"});
  const bool can = protocol == BusProtocol::kCia402;
  const bool feetech = protocol == BusProtocol::kFeetech;
  if ((can || feetech) && e.has("profile_ms")) {
    e.fail(
        can ? "<verp:servo> profile_ms: a CiA 402 drive joins its targets over the control period"
            : "<verp:servo> profile_ms: a Feetech servo has no profile of a given time",
        "leave it out");
  }
  const ServoType& type = read_type(e, types, protocol);
  ServoFact fact{e, e.text("joint"), servo_of(type), {}, {}, true, true};
  Servo& s = fact.servo;
  s.id = e.integer("id", 1, can ? kHighestNode : kHighestId);
  s.direction = e.integer("direction", -1, 1, 1);
  if (s.direction == 0)
    e.fail("<verp:servo> direction is 0", "write 1, or -1 for a servo mounted backwards");
  const int turn = static_cast<int>(type.counts_per_rev);
  s.offset_count = e.integer("offset", 0, turn - 1, turn / 2);
  s.backlash_rad = e.number("backlash_rad", 0);
  if (s.backlash_rad < 0 || s.backlash_rad > 0.1) {
    e.fail("<verp:servo> backlash_rad is not within 0 to 0.1",
           "write the gear play in radians, like 0.0044");
  }
  s.p_gain = gain(e, type, "p_gain", type.default_p_gain);
  fact.gives_p_gain = e.has("p_gain");
  fact.gives_d_gain = e.has("d_gain");
  s.i_gain = gain(e, type, "i_gain", 0);
  s.d_gain = gain(e, type, "d_gain", type.default_d_gain);
  // Straight lines then join the goals.
  const int joined_ms = can || feetech ? 0 : static_cast<int>(period_us / 1000);
  s.profile_ms = static_cast<std::uint16_t>(e.integer("profile_ms", 0, 1000, joined_ms));
  if (s.p_gain == 0)
    e.fail("<verp:servo> p_gain is 0: the servo would hold nothing",
           "write 1 to " + std::to_string(type.most_gain));
  if (e.has("lower_rad")) fact.lower_rad = e.number("lower_rad");
  if (e.has("upper_rad")) fact.upper_rad = e.number("upper_rad");
  return fact;
}

// Feetech's, or CiA 301's bit rates without 800 kbit/s, which bxCAN cannot make from 42, 45 or 54
// MHz.
std::uint32_t read_baud(const XmlElement& e, BusProtocol protocol) {
  if (protocol == BusProtocol::kDynamixel2) {
    return static_cast<std::uint32_t>(e.integer("baud", 9600, 4500000, 2000000));
  }
  const int baud = e.integer("baud", 10000, 1000000, 1000000);
  if (protocol == BusProtocol::kFeetech) {
    if (feetech::baud_rate_code(static_cast<std::uint32_t>(baud)) != 0xFF)
      return static_cast<std::uint32_t>(baud);
    e.fail("<verp:bus> baud " + std::to_string(baud) + " is no rate of Feetech's STS servos",
           fmt::format("choose one of: {}", fmt::join(feetech::kBaudRates, ", ")));
  }
  std::string list;
  for (const int each : {10000, 20000, 50000, 125000, 250000, 500000, 1000000}) {
    if (each == baud) return static_cast<std::uint32_t>(baud);
    list += (list.empty() ? "" : ", ") + std::to_string(each);
  }
  e.fail(
      "<verp:bus> baud " + std::to_string(baud) + " is no bit rate of CANopen that all boards make",
      "choose one of: " + list);
}

// Baud Rate (8).
void check_rate(const XmlElement& e, const BusFact& fact) {
  if (fact.protocol != BusProtocol::kDynamixel2) return;
  const std::uint8_t code = dxl::baud_rate_code(fact.baud);
  for (const ServoFact& each : fact.servos) {
    const dxl::ServoModel* model = dxl::find_servo_model(each.servo.model_number);
    const std::size_t rates = model ? model->most_baud_code + 1u : std::size(dxl::kBaudRates);
    if (code < rates) continue;
    e.fail(fmt::format("<verp:bus> baud {}: servo type '{}' has no such Baud Rate (8)", fact.baud,
                       each.servo.type),
           fmt::format("choose one of: {}", fmt::join(std::span(dxl::kBaudRates, rates), ", ")));
  }
}

}  // namespace

BusFact read_bus(const XmlElement& e, const std::vector<ServoType>& types) {
  e.allow({"name", "protocol", "baud", "period_us", "rise_torque_percent"}, {"verp:servo"});
  BusFact fact{.at = e, .name = e.text("name", "bus"), .protocol = read_protocol(e), .servos = {}};
  fact.baud = read_baud(e, fact.protocol);
  fact.rise_torque_percent =
      static_cast<std::uint8_t>(e.integer("rise_torque_percent", 10, 100, kRiseTorquePercent));
  fact.period_us = static_cast<std::uint32_t>(
      e.integer("period_us", kShortestPeriod_us, kLongestPeriod_us, 10000));
  for (const XmlElement& child : e.children()) {
    fact.servos.push_back(read_servo(child, types, fact.protocol, fact.period_us));
  }
  check_rate(e, fact);
  return fact;
}

}  // namespace verp::model
