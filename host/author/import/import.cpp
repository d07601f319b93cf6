#include "host/author/import/import.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "common/model/params.hpp"
#include "host/author/import/masses.hpp"
#include "host/author/import/servos.hpp"
#include "host/author/import/swing.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/robot/model/supply.hpp"
#include "host/robot/model/unread.hpp"

namespace verp::import {
namespace {

namespace fs = std::filesystem;
using Sureness = Finding::Sureness;

constexpr std::size_t kLegJointCount = 6;
constexpr double kCount_rad = 0.002;     // limits are whole counts of a servo
constexpr double kMostServo_rad = 3.14;  // a single turn, with room for the encoder's last counts
// The knee's arm on one leg with the hip at 0.81 of the leg, over the leg's length (stance.cpp).
constexpr double kKneeArm = 0.295;
constexpr double kLevel_rad = 0.001;
// Share of the sole's length: its middle ahead of the ankle shows the direction.
constexpr double kLeastReach = 0.05;

/// Small letters, digits and _, as robots are named.
std::string plain(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    out += u < 128 && std::isalnum(u) != 0 ? static_cast<char>(std::tolower(u)) : '_';
  }
  if (out.size() >= kNameLength) out.resize(kNameLength - 1);
  return out.empty() ? "robot" : out;
}

class Importer {
 public:
  explicit Importer(const Wish& wish)
      : wish_(wish), source_(wish.file), robot_(root_of(source_)), s_(skeleton_of_urdf(robot_)) {}

  Imported import() {
    out_.left_out = wish_.source.left_out;
    for (Bone& each : s_.bones) {
      const auto drive = wish_.source.drives.find(each.name);
      if (drive != wish_.source.drives.end()) each.drive = drive->second;
    }
    body_ = find_body(s_, robot_);
    shorten_legs();
    out_.name = w_.name = plain(wish_.name.empty() ? s_.name : wish_.name);
    w_.uri =
        fs::relative(fs::weakly_canonical(wish_.file), fs::weakly_canonical(wish_.folder)).string();
    choose_servos();
    choose_types();
    choose_friction();
    std::vector<int> moving = followers_;
    for (const ServoRow& row : w_.servos) moving.push_back(row.bone);
    for (std::string& each : mend_masses(s_, moving, w_)) out_.left_out.push_back(std::move(each));
    stand_within_limits();
    place_body();
    measure();
    if (!body_.sure_of_forward) look_at_soles();
    say_what_was_found();
    out_.sdf = text_of(w_, s_, body_);
    try {
      load();
      name_estimates(*out_.entity);
      judge_speed(*out_.entity);
    } catch (const model::LoadError& error) {
      out_.refusal = error.what();
    }
    tell_unread();
    return std::move(out_);
  }

 private:
  static model::XmlElement root_of(const model::XmlSource& source) {
    const auto urdfs = source.urdfs();
    if (!urdfs.empty() && urdfs.front().file() == source.path()) return urdfs.front();
    throw model::LoadError(source.path(), 1, "is not a robot's file",
                           "give a URDF, xacro, SDF or MJCF file");
  }

  std::string place() const { return (fs::path(wish_.folder) / "robot.sdf").string(); }
  const Bone& bone(int index) const { return s_.bones[static_cast<std::size_t>(index)]; }
  const LinkPart& link(int index) const { return s_.links[static_cast<std::size_t>(index)]; }

  void found(Sureness sureness, std::string what, std::string value, std::string check = "") {
    out_.findings.push_back({sureness, std::move(what), std::move(value), std::move(check)});
  }

  /// Joints beyond the sixth, such as toes, are fixed.
  void shorten_legs() {
    for (FoundLimb& leg : body_.legs) {
      if (leg.bones.size() > kLegJointCount) leg.bones.resize(kLegJointCount);
      leg.tip = bone(leg.bones.back()).child;
      if (joints_of_leg(s_, body_, leg).complete) continue;
      robot_.fail(
          fmt::format("its legs have {} joints, from '{}' to '{}', and lack others than hip yaw "
                      "and ankle roll",
                      leg.bones.size(), link(body_.trunk).name, link(leg.tip).name),
          "VERP walks on legs of hip yaw, roll and pitch, knee, ankle pitch and roll: only the "
          "first and the last may be missing");
    }
  }

  std::string lacks() const {
    const LegJoints joints = joints_of_leg(s_, body_, body_.legs.front());
    return joints.yaws    ? joints.rolls ? "" : "no ankle roll"
           : joints.rolls ? "no hip yaw"
                          : "no hip yaw and no ankle roll";
  }

  bool keeps(int index) const {
    return std::any_of(w_.servos.begin(), w_.servos.end(),
                       [&](const ServoRow& row) { return row.bone == index; }) ||
           std::find(followers_.begin(), followers_.end(), index) != followers_.end();
  }

  /// Legs first, then arms and head, as many as the controller has room for. A joint that follows
  /// another one needs no servo.
  void choose_servos() {
    std::vector<int> wanted;
    for (const auto* limbs : {&body_.legs, &body_.others}) {
      for (const FoundLimb& limb : *limbs)
        wanted.insert(wanted.end(), limb.bones.begin(), limb.bones.end());
    }
    for (const int each : wanted) {
      if (keeps(each)) continue;
      if (w_.servos.size() + followers_.size() == kMaxJoints) break;
      const bool follows = std::any_of(wanted.begin(), wanted.end(), [&](int driver) {
        return bone(driver).name == bone(each).follows;
      });
      if (follows) {
        followers_.push_back(each);
      } else {
        w_.servos.push_back(row_of(each));
      }
    }
    for (std::size_t i = 0; i < s_.bones.size(); ++i) leave(static_cast<int>(i));
    if (!endless_.empty()) {
      out_.left_out.push_back(fmt::format("no limits, so a servo's single turn is taken: joints {}",
                                          fmt::join(endless_, ", ")));
    }
    std::vector<std::string> fixed;
    for (const int each : w_.fixed) fixed.push_back(bone(each).name);
    if (!fixed.empty())
      out_.left_out.push_back(fmt::format("fixed at zero: joints {}", fmt::join(fixed, ", ")));
    for (const std::string& sensor : s_.sensors_to_drop)
      out_.left_out.push_back(fmt::format("sensor {}: the twin has no such sensor", sensor));
    for (FoundLimb& limb : body_.others) trim(limb);
    std::erase_if(body_.others, [](const FoundLimb& limb) { return limb.bones.empty(); });
  }

  void leave(int index) {
    const Bone& each = bone(index);
    const bool kept = keeps(index);
    const bool is_follower =
        std::find(followers_.begin(), followers_.end(), index) != followers_.end();
    if (!each.follows.empty() && !is_follower) w_.dropped_mimics.push_back(each.name);
    if (kept || each.kind == Bone::Kind::kFixed) return;
    w_.fixed.push_back(index);
  }

  void trim(FoundLimb& limb) {
    std::erase_if(limb.bones, [&](int each) { return !keeps(each); });
    if (!limb.bones.empty()) limb.tip = bone(limb.bones.back()).child;
  }

  ServoRow row_of(int index) {
    const Bone& each = bone(index);
    ServoRow row{index, each.lower_rad, each.upper_rad, ""};
    const bool stops = each.lower_rad < each.upper_rad && !each.has_no_stops;
    if (!stops) row.lower_rad = -kMostServo_rad, row.upper_rad = kMostServo_rad;
    row.lower_rad = std::clamp(row.lower_rad, -kMostServo_rad, kMostServo_rad - 0.1);
    row.upper_rad = std::clamp(row.upper_rad, row.lower_rad + 0.05, kMostServo_rad);
    const double lost_rad =
        std::abs(row.lower_rad - each.lower_rad) + std::abs(row.upper_rad - each.upper_rad);
    if (!stops) {
      endless_.push_back(each.name);
    } else if (lost_rad > 0.02) {
      out_.left_out.push_back(
          fmt::format("joint {} turns from {:.3g} to {:.3g} rad: the part of a "
                      "servo's single turn is taken",
                      each.name, each.lower_rad, each.upper_rad));
    }
    return row;
  }

  double leg_m() const {
    const FoundLimb& leg = body_.legs.front();
    double sum = 0;
    const std::size_t first = joints_of_leg(s_, body_, leg).hip_pitch;
    for (std::size_t i = first; i < first + 2; ++i) {
      sum += (bone(leg.bones[i + 1]).pose.translation() - bone(leg.bones[i]).pose.translation())
                 .norm();
    }
    return sum;
  }

  void choose_types() {
    const double needed_n_m =
        kTorqueReserve * kKneeArm * s_.mass_kg() * model::kGravity_m_s2 * leg_m();
    std::vector<ServoJoint> joints;
    for (const ServoRow& row : w_.servos)
      joints.push_back({bone(row.bone).name, bone(row.bone).drive, bone(row.bone).limit});
    ServoChoice choice = choose_servo_types(joints, wish_.servo_type, needed_n_m);
    w_.protocol = choice.protocol;
    w_.own_types = std::move(choice.own_types);
    for (std::size_t i = 0; i < joints.size(); ++i) w_.servos[i].type = choice.types[i];
    for (Finding& each : choice.findings) out_.findings.push_back(std::move(each));
  }

  /// The friction of servos is measured or scaled; many files have any number, for simulators that
  /// need one.
  void choose_friction() {
    w_.drops_friction = std::any_of(w_.servos.begin(), w_.servos.end(), [&](const ServoRow& row) {
      return bone(row.bone).has_friction;
    });
    if (!w_.drops_friction) return;
    found(Sureness::kGuessed, "friction", "that of the servos, not the file's <dynamics>",
          "<verp:friction from=\"file\"/> takes the file's, \"both\" their sum");
  }

  void name_estimates(const model::Entity& robot) {
    std::map<std::string, std::string> estimates;
    for (const model::Joint& joint : robot.joints) {
      if (!joint.servo.estimated.empty()) estimates[joint.servo.type] = joint.servo.estimated;
    }
    for (const auto& [type, what] : estimates) {
      found(Sureness::kGuessed, type, what + ": scaled by torque and speed",
            "write its own numbers into <verp:servo_type>");
    }
    found(Sureness::kGuessed, "supply",
          fmt::format("{:.4g} V, {:.2g} ohm", model::supply_volts(robot),
                      model::supply_resistance_ohm(robot)),
          "write the battery's into <verp:supply volts resistance_ohm>");
  }

  void tell_unread() {
    model::Lost lost;
    model::find_unread(robot_, lost);
    const bool told = std::any_of(out_.left_out.begin(), out_.left_out.end(), [](const auto& each) {
      return each.starts_with(model::kMissingMeshes);
    });
    if (out_.entity && !told) model::find_missing_meshes(*out_.entity, lost);
    for (std::string& each : model::lines_of(lost)) out_.left_out.push_back(std::move(each));
  }

  void load() {
    out_.entity = std::make_shared<const model::Entity>(model::load_robot_text(place(), out_.sdf));
  }

  void judge_speed(const model::Entity& robot) {
    const bool of_damping =
        wish_.servo_type.empty() &&
        std::any_of(s_.bones.begin(), s_.bones.end(), [](const Bone& each) {
          return each.drive && each.drive->no_load_rad_s <= 0 && each.drive->damping_n_m_s > 0;
        });
    SwingChoice choice = choose_swing(model::make_params(robot), of_damping);
    for (Finding& each : choice.findings) out_.findings.push_back(std::move(each));
    w_.tuning = std::move(choice.tuning);
    if (w_.tuning.empty()) return;
    out_.sdf = text_of(w_, s_, body_);
    load();
  }

  Vec3 middle_of(const std::vector<const FoundLimb*>& limbs) const {
    Vec3 sum = Vec3::Zero();
    for (const FoundLimb* limb : limbs) sum += bone(limb->bones.front()).pose.translation();
    return sum / static_cast<double>(limbs.size());
  }

  /// Halfway from the hips to what sits on top; axes x ahead, y left, z up.
  void place_body() {
    const Vec3 hips = middle_of({&body_.legs[0], &body_.legs[1]});
    std::vector<const FoundLimb*> top;
    for (const FoundLimb& limb : body_.others) {
      if (limb.name != "waist") top.push_back(&limb);
    }
    double up_m = 0.35 * leg_m();
    if (!top.empty()) up_m = std::max(up_m, (middle_of(top).z() - hips.z()) / 2);
    w_.body.linear().col(0) = body_.forward;
    w_.body.linear().col(1) = body_.left;
    w_.body.linear().col(2) = Vec3::UnitZ();
    w_.body.translation() = hips + up_m * Vec3::UnitZ();
  }

  static int node_of(const model::Entity& entity, const std::string& link) {
    for (std::size_t i = 0; i < entity.nodes.size(); ++i) {
      if (entity.nodes[i].name == link) return static_cast<int>(i);
    }
    return 0;
  }

  void measure() {
    w_.soles.clear();
    w_.below_soles.clear();
    w_.trunk_box.reset();
    const model::Entity probe = model::load_part_of_robot_text(place(), text_of(w_, s_, body_));
    std::vector<int> feet;
    for (const FoundLimb& leg : body_.legs) {
      feet.push_back(node_of(probe, link(leg.tip).name));
      w_.soles.push_back(sole_of(probe, feet.back(), leg_m()));
    }
    w_.below_soles = reach_below(probe, feet, w_.soles);
    if (!probe.nodes[0].collisions.empty()) return;
    Eigen::AlignedBox3d box;
    for (const Vec3& point : points_of(probe, 0)) box.extend(point);
    if (box.isEmpty()) {
      const double half_m = 0.3 * leg_m();
      box.extend(Vec3(-half_m / 2, -half_m, -half_m));
      box.extend(Vec3(half_m / 2, half_m, half_m));
    }
    const Vec3 centre = box.center(), half = 0.45 * box.sizes();  // corners are round
    w_.trunk_box = Eigen::AlignedBox3d(centre - half, centre + half);
  }

  static std::string how_found(const Sole& sole) {
    if (!sole.measured) return ", from the leg's length: the foot has no shape here";
    const double tilt_rad = std::acos(std::min(1.0, sole.pose.linear()(2, 2)));
    if (tilt_rad < kLevel_rad) return "";
    return fmt::format(", tilted by {:.1f} degrees where all joints are at zero",
                       tilt_rad * 180 / std::numbers::pi);
  }

  /// Feet reach further ahead of the ankle than behind it.
  void look_at_soles() {
    double ahead = 0;
    for (std::size_t side = 0; side < 2; ++side) {
      if (!w_.soles[side].measured) return;
      const Vec3 ankle = w_.body.inverse() * link(body_.legs[side].tip).pose.translation();
      const Sole& sole = w_.soles[side];
      ahead += (sole.pose.translation().x() - ankle.x()) / sole.length_m;
    }
    if (std::abs(ahead) < 2 * kLeastReach) return;
    body_.sure_of_forward = true;
    body_.reasons = {"its feet are longer there"};
    if (ahead > 0) return;
    body_.turn_round();
    place_body();
    measure();
  }

  /// Joints beside the legs: as the file has them, else at zero; the legs' angles are found.
  void stand_within_limits() {
    for (const ServoRow& row : w_.servos) {
      const bool of_leg = std::any_of(body_.legs.begin(), body_.legs.end(), [&](const auto& leg) {
        return std::find(leg.bones.begin(), leg.bones.end(), row.bone) != leg.bones.end();
      });
      const auto key = wish_.source.stand.find(bone(row.bone).name);
      const double wanted_rad = key == wish_.source.stand.end() ? 0 : key->second;
      const bool fits = row.lower_rad <= wanted_rad && wanted_rad <= row.upper_rad;
      const double rad =
          fits ? wanted_rad
               : std::clamp(wanted_rad, row.lower_rad + kCount_rad, row.upper_rad - kCount_rad);
      if (!of_leg && rad != 0) w_.stand.emplace_back(bone(row.bone).name, rad);
    }
  }

  std::string joints_of(const FoundLimb& limb) const {
    std::vector<std::string> names;
    for (const int each : limb.bones) names.push_back(bone(each).name);
    return fmt::format("{}", fmt::join(names, ", "));
  }

  void say_what_was_found() {
    found(Sureness::kRead, "mass", fmt::format("{:.4g} kg", s_.mass_kg()),
          "weigh the robot, battery included");
    found(Sureness::kMeasured, "trunk", link(body_.trunk).name);
    found(body_.sure_of_forward ? Sureness::kMeasured : Sureness::kGuessed, "ahead",
          fmt::format("({:.3g}, {:.3g}, 0) of the file: {}", body_.forward.x(), body_.forward.y(),
                      fmt::join(body_.reasons, ", ")),
          body_.sure_of_forward ? "" : "does the robot look that way?");
    for (const auto* limbs : {&body_.legs, &body_.others}) {
      for (const FoundLimb& limb : *limbs) found(Sureness::kMeasured, limb.name, joints_of(limb));
    }
    if (!lacks().empty()) {
      found(Sureness::kMeasured, "legs", "of fewer than six joints: " + lacks(),
            "is the missing joint fixed in the file?");
    }
    for (std::size_t side = 0; side < w_.soles.size(); ++side) {
      const Sole& sole = w_.soles[side];
      found(sole.measured ? Sureness::kMeasured : Sureness::kGuessed,
            side == 0 ? "left sole" : "right sole",
            fmt::format("{:.0f} by {:.0f} mm under {}{}", 1000 * sole.length_m, 1000 * sole.width_m,
                        link(body_.legs[side].tip).name, how_found(sole)),
            sole.measured ? "" : "measure it, and write it into <verp:box>");
    }
    if (!w_.below_soles.empty())
      out_.left_out.push_back(
          fmt::format("collisions of {}, which reach below the soles: measure the feet",
                      fmt::join(w_.below_soles, ", ")));
    const int imu = imu_of(s_, body_);
    found(imu >= 0 ? Sureness::kRead : Sureness::kGuessed, "IMU",
          link(imu >= 0 ? imu : body_.trunk).name,
          imu >= 0 ? "" : "on which link is it, and turned how?");
    found(Sureness::kGuessed, "ids",
          fmt::format("1 to {}, in the order of the limbs", w_.servos.size()),
          "write the robot's own into <verp:servo>, with direction and offset");
  }

  const Wish& wish_;
  model::XmlSource source_;
  model::XmlElement robot_;
  Skeleton s_;
  Body body_;
  Wrapper w_;
  Imported out_;
  std::vector<int> followers_;
  std::vector<std::string> endless_;  ///< joints
};

}  // namespace

void make_urdf(Wish& wish) {
  Source source = read_source(wish.file, wish.folder);
  if (source.urdf.empty()) return;
  const std::string name = fs::path(wish.file).stem().stem().string();  // as in robot.urdf.xacro
  const fs::path urdf = fs::path(wish.folder) / fmt::format("{}_from_{}.urdf", name, source.format);
  std::error_code error;
  if (fs::exists(urdf, error)) {
    throw model::LoadError(urdf.string(), 0, "is there already",
                           "remove it, or choose another folder with -o");
  }
  const files::Trouble trouble = files::replace(urdf, source.urdf);
  if (trouble.any()) {
    throw model::LoadError(urdf.string(), 0, trouble.text(), "choose another folder with -o");
  }
  wish.maker_file = wish.file;
  wish.file = urdf.string();
  wish.source = std::move(source);
}

Imported import_robot(const Wish& wish) {
  try {
    return Importer(wish).import();
  } catch (const model::LoadError& error) {
    if (wish.maker_file.empty() || error.file != wish.file) throw;
    throw model::LoadError(wish.maker_file, 0, error.message, error.fix);  // they know that file
  }
}

}  // namespace verp::import
