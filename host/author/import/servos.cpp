#include "host/author/import/servos.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/robot/model/load_error.hpp"
#include "host/robot/model/servo_types.hpp"

namespace verp::import {
namespace {

using Sureness = Finding::Sureness;

constexpr double kRevMin = 60 / (2 * std::numbers::pi);
constexpr double kUsual_rev_min = 60;  // where a file has no speed
// A servo on the bus reports its current in 2.69 mA, 16 bits: up to 88 A.
constexpr double kMostStall_a = 60;

// The torque of a joint's drive is a limit of its current, up to about half of the motor's no-load
// speed: 0.45 to 0.77 in the published curves of Unitree's actuators.
constexpr double kStallOverPeak = 2;
// A limit is no placeholder if it suits the robot's need and a motor's speed.
constexpr double kMostTimesNeed = 10;
constexpr double kLeastSpeed_rad_s = 0.5, kMostSpeed_rad_s = 45;

bool is_motor(const Drive& limit, double needed_n_m) {
  return limit.stall_torque_n_m > 0 && limit.stall_torque_n_m <= kMostTimesNeed * needed_n_m &&
         limit.no_load_rad_s >= kLeastSpeed_rad_s && limit.no_load_rad_s <= kMostSpeed_rad_s;
}

double strongest_known_n_m() {
  double most = 0;
  for (const model::ServoType& type : model::servo_types())
    most = std::max(most, type.stall_torque_n_m);
  return most;
}

/// True: limits became drives.
bool take_limits(std::vector<ServoJoint>& joints, double needed_n_m, double standing_n_m) {
  double most_n_m = 0;
  for (const ServoJoint& joint : joints) {
    if (joint.drive) return false;
    if (is_motor(joint.limit, needed_n_m))
      most_n_m = std::max(most_n_m, joint.limit.stall_torque_n_m);
  }
  if (most_n_m <= strongest_known_n_m() || most_n_m < standing_n_m) return false;
  for (ServoJoint& joint : joints) {
    if (is_motor(joint.limit, needed_n_m)) joint.drive = joint.limit;
  }
  return true;
}

/// Servos have no limit of current below their stall. Where a file gives no speed, the damping of
/// such a joint is its back-EMF: OP3's ends the motion at an XM430-W350's 4.6 rad/s.
void take_back_emf(Drive& drive) {
  constexpr double kLeast_rad_s = 1.5;
  if (drive.no_load_rad_s > 0 || drive.damping_n_m_s <= 0) return;
  const double end_rad_s = drive.stall_torque_n_m / drive.damping_n_m_s;
  if (drive.stall_torque_n_m > strongest_known_n_m() || end_rad_s < kLeast_rad_s ||
      end_rad_s > kMostSpeed_rad_s) {
    return;
  }
  drive.no_load_rad_s = end_rad_s;
  drive.is_line = true;
  drive.damping_n_m_s = 0;
}

// A swing leg of 0.2 m turns its hip at up to 4 rad/s: slower servos end steps elsewhere.
constexpr double kWalking_rad_s = 4;

/// The weakest that is strong enough, and fast enough where one is.
const model::ServoType* weakest_with(double torque_n_m) {
  const model::ServoType* best = nullptr;
  const auto is_fast = [](const model::ServoType& type) {
    return type.no_load_rev_min / kRevMin >= kWalking_rad_s;
  };
  for (const model::ServoType& type : model::servo_types()) {
    if (type.protocol != BusProtocol::kDynamixel2 || type.stall_torque_n_m < torque_n_m) continue;
    const bool is_better =
        best == nullptr || (is_fast(type) && !is_fast(*best)) ||
        (is_fast(type) == is_fast(*best) && type.stall_torque_n_m < best->stall_torque_n_m);
    if (is_better) best = &type;
  }
  return best;
}

class Chooser {
 public:
  Chooser(std::vector<ServoJoint> joints, double needed_n_m)
      : joints_(std::move(joints)),
        needed_n_m_(needed_n_m),
        are_limits_(take_limits(joints_, needed_n_m, needed_n_m / kTorqueReserve)) {
    for (ServoJoint& joint : joints_) {
      if (joint.drive) take_back_emf(*joint.drive);
    }
  }

  ServoChoice choose() {
    const bool all_drive = std::all_of(joints_.begin(), joints_.end(), has_drive);
    const model::ServoType* const known = all_drive ? nullptr : weakest_with(needed_n_m_);
    choose_supply(known, all_drive);
    if (!all_drive) choose_without_drive(known);
    out_.types.assign(joints_.size(), usual_);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (has_drive(joints_[i])) out_.types[i] = type_of(*joints_[i].drive, joints_[i].name);
    }
    for (const Group& group : groups_) {
      out_.own_types.push_back(group.element);
      say(group);
    }
    return std::move(out_);
  }

 private:
  struct Group {
    Drive drive;
    std::string name, numbers, element;
    std::vector<std::string> joints;
  };

  static bool has_drive(const ServoJoint& joint) {
    return joint.drive && joint.drive->stall_torque_n_m > 0;
  }

  static double rev_min(const Drive& drive) {
    return drive.no_load_rad_s > 0 ? drive.no_load_rad_s * kRevMin : kUsual_rev_min;
  }

  void found(Sureness sureness, std::string value, std::string check) {
    out_.findings.push_back({sureness, "servos", std::move(value), std::move(check)});
  }

  /// A robot has one supply: that of the known type, else the lowest that needs no cables as thick
  /// as a car's.
  void choose_supply(const model::ServoType* known, bool all_drive) {
    if (known != nullptr) supply_v_ = known->nominal_v;
    if (known != nullptr) return;
    double most_w = all_drive ? 0 : std::ceil(needed_n_m_) * kUsual_rev_min / kRevMin;
    for (const ServoJoint& joint : joints_) {
      if (!has_drive(joint)) continue;
      most_w = std::max(
          most_w, kStallOverPeak * joint.drive->stall_torque_n_m * rev_min(*joint.drive) / kRevMin);
    }
    while (supply_v_ < 48 && most_w / supply_v_ > kMostStall_a) supply_v_ *= 2;
  }

  std::string element(const std::string& name, const std::string& numbers) const {
    const std::string volts =
        supply_v_ == 12 ? "" : fmt::format(" nominal_v=\"{:.4g}\"", supply_v_);
    return fmt::format("<verp:servo_type name=\"{}\" like=\"xm540_w270\"{}{}/>", name, volts,
                       numbers);
  }

  void choose_without_drive(const model::ServoType* known) {
    if (known != nullptr) {
      usual_ = known->name;
      found(Sureness::kGuessed,
            fmt::format("{}, the weakest known with {:.3g} N m, twice what a knee has to hold, "
                        "of those that are fast enough",
                        usual_, needed_n_m_),
            "give the robot's own with --servos TYPE");
      return;
    }
    usual_ = "motor";
    const double torque_n_m = std::ceil(needed_n_m_);
    out_.own_types.push_back(
        element(usual_, fmt::format(" stall_torque_n_m=\"{:.3g}\" no_load_rev_min=\"{:.3g}\"",
                                    torque_n_m, kUsual_rev_min)));
    found(Sureness::kGuessed,
          fmt::format("a motor of {:.3g} N m, because no known servo holds this robot", torque_n_m),
          "write the motor's own numbers into <verp:servo_type>");
  }

  /// Friction of a file is Coulomb and viscous: no part of the load.
  static std::string numbers_of(const Drive& drive) {
    const std::string peak =
        drive.is_line ? "" : fmt::format(" peak_torque_n_m=\"{:.4g}\"", drive.stall_torque_n_m);
    std::string out = fmt::format(" stall_torque_n_m=\"{:.4g}\"{} no_load_rev_min=\"{:.4g}\"",
                                  (drive.is_line ? 1 : kStallOverPeak) * drive.stall_torque_n_m,
                                  peak, rev_min(drive));
    if (drive.armature_kg_m2 > 0)
      out += fmt::format(" armature_kg_m2=\"{:.4g}\"", drive.armature_kg_m2);
    if (drive.friction_n_m > 0 || drive.damping_n_m_s > 0) {
      out += fmt::format(
          " f_base_n_m=\"{:.4g}\" f_strib_n_m=\"0\" l_base=\"0\" l_strib=\"0\" "
          "f_visc_n_m_s=\"{:.4g}\"",
          std::max(drive.friction_n_m, 0.0), std::max(drive.damping_n_m_s, 0.0));
    }
    const bool said = drive.armature_kg_m2 > 0 || drive.friction_n_m > 0 || drive.damping_n_m_s > 0;
    return said ? out + " source=\"the imported file\"" : out;
  }

  const std::string& type_of(const Drive& drive, const std::string& joint) {
    const std::string numbers = numbers_of(drive);
    auto group = std::find_if(groups_.begin(), groups_.end(),
                              [&](const Group& each) { return each.numbers == numbers; });
    if (group == groups_.end()) {
      const std::string name = fmt::format("motor_{}", groups_.size() + 1);
      groups_.push_back({drive, name, numbers, element(name, numbers), {}});
      group = std::prev(groups_.end());
    }
    group->joints.push_back(joint);
    return group->name;
  }

  void say(const Group& group) {
    const Drive& drive = group.drive;
    std::vector<std::string> guessed;
    if (!(drive.no_load_rad_s > 0)) guessed.push_back("speed");
    if (!(drive.armature_kg_m2 > 0)) guessed.push_back("rotor");
    if (!(drive.friction_n_m > 0) && !(drive.damping_n_m_s > 0)) guessed.push_back("friction");
    const std::string kp =
        drive.kp_n_m_rad > 0
            ? fmt::format("; the file's gain of {:.4g} N m/rad is not taken, VERP's fits the robot",
                          drive.kp_n_m_rad)
            : "";
    const std::string guess =
        guessed.empty() ? "" : fmt::format("its {}: a guess", fmt::join(guessed, ", "));
    found(Sureness::kRead,
          fmt::format("{} of {:.4g} N m{} for {}{}", group.name, drive.stall_torque_n_m,
                      are_limits_ ? fmt::format(" and {:.3g} rad/s, its joints' <limit>,",
                                                drive.no_load_rad_s)
                                  : "",
                      fmt::join(group.joints, ", "), kp),
          are_limits_ ? "is this the motor? " + guess : guess);
  }

  std::vector<ServoJoint> joints_;
  double needed_n_m_;
  bool are_limits_;
  double supply_v_ = 12;
  std::string usual_;
  std::vector<Group> groups_;
  ServoChoice out_;
};

ServoChoice wished_type(const std::string& name, std::size_t joints) {
  const model::ServoType* const type = model::find_servo_type(model::servo_types(), name);
  if (type == nullptr) {
    throw model::LoadError("--servos", 0, "there is no servo type '" + name + "'",
                           "choose one of: " + model::names_of(model::servo_types()));
  }
  return {model::protocol_name(type->protocol),
          std::vector<std::string>(joints, name),
          {},
          {{Sureness::kRead, "servos", name, ""}}};
}

}  // namespace

ServoChoice choose_servo_types(const std::vector<ServoJoint>& joints, const std::string& wished,
                               double needed_n_m) {
  if (!wished.empty()) return wished_type(wished, joints.size());
  return Chooser(joints, needed_n_m).choose();
}

}  // namespace verp::import
