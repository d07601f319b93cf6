#include "host/robot/model/assemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sdf/sdf.hh>
#include <set>

#include "common/model/tuning_ranges.hpp"
#include "host/robot/model/assemble_sensors.hpp"
#include "host/robot/model/couplings.hpp"
#include "host/robot/model/fit_gains.hpp"
#include "host/robot/model/joint_friction.hpp"
#include "host/robot/model/leg.hpp"
#include "host/robot/model/link_tree.hpp"
#include "host/robot/model/params.hpp"
#include "host/robot/model/sdf_parts.hpp"
#include "host/robot/model/self_collision.hpp"
#include "host/robot/model/stance.hpp"
#include "host/robot/model/supply.hpp"
#include "host/robot/model/visuals.hpp"

namespace verp::model {
namespace {

// The controller stops below 0.8 of what the servos are made for (safety.voltage_low_v); they
// report an error from 1.33 on (host/twin/sim/plant.hpp).
constexpr double kLeastSupply = 0.8, kMostSupply = 1.33;

class Assembler {
 public:
  Assembler(const XmlSource& source, const Facts& facts, const sdf::Model& model,
            const UrdfNames& names)
      : source_(source), facts_(facts), model_(model), tree_(source, facts, model, names, e_) {}

  Entity build() {
    e_.name = model_.Name();
    e_.file = source_.path();
    const BusFact& bus = facts_.bus();
    e_.bus = bus.name;
    e_.bus_file = bus.at.file();
    e_.bus_line = bus.at.line();
    for (const BusFact& each : facts_.buses) e_.buses.push_back(each.name);
    e_.protocol = bus.protocol;
    e_.baud = bus.baud;
    e_.period_us = bus.period_us;
    e_.rise_torque_percent = bus.rise_torque_percent;
    tree_.grow();
    join_servos();
    join_followers(facts_, e_);
    check_names();
    apply_poses();
    for (const LimbFact& fact : facts_.limbs) add_limb(fact);
    check_legs();
    check_coupled_legs(facts_, e_);
    refuse_servos_of_followers();
    assemble_sensors(source_, facts_, model_, tree_, e_);
    read_tuning();
    gather_leg_frames(e_);
    choose_gains();
    choose_supply();
    choose_friction(facts_, e_);
    settle_stance(facts_, e_);
    pose_followers(facts_, e_);
    check_poses();
    free_links();
    add_notes();
    return std::move(e_);
  }

 private:
  [[noreturn]] void fail(const std::string& about, const std::string& message,
                         const std::string& fix) const {
    fail_at(source_, about, message, fix);
  }

  Joint* joint_named(const std::string& name) {
    const auto found = std::find_if(e_.joints.begin(), e_.joints.end(),
                                    [&](const Joint& joint) { return joint.name == name; });
    return found == e_.joints.end() ? nullptr : &*found;
  }

  void join_servos() {
    std::map<std::string, const ServoFact*> servo_of;
    for (const ServoFact& fact : facts_.bus().servos) {
      Joint* joint = joint_named(fact.joint);
      if (!joint)
        fact.at.fail("there is no moving joint '" + fact.joint + "'", "name one that exists");
      if (joint->follows >= 0) continue;
      if (!servo_of.insert({fact.joint, &fact}).second) {
        fact.at.fail("joint '" + fact.joint + "' has two servos", "remove one of them");
      }
      joint->servo = fact.servo;
      const ServoFact& first = facts_.bus().servos.front();
      if (fact.servo.nominal_v != first.servo.nominal_v) {
        fact.at.fail("the servo of joint '" + fact.joint +
                         "' is made for another voltage than that of '" + first.joint + "'",
                     "choose types of one nominal_v: a robot has one supply");
      }
      if (joint->velocity_limit_rad_s > fact.servo.no_load_speed_rad_s) {
        joint->velocity_limit_rad_s = fact.servo.no_load_speed_rad_s;
      }
      joint->lower_rad = fact.lower_rad.value_or(joint->lower_rad);
      joint->upper_rad = fact.upper_rad.value_or(joint->upper_rad);
      check_limits(*joint, fact);
    }
    for (const Joint& joint : e_.joints) {
      if (joint.follows < 0 && !servo_of.contains(joint.name)) {
        fail(joint.name, "joint '" + joint.name + "' has no servo",
             "add <verp:servo joint=\"" + joint.name +
                 "\" id=\"...\" type=\"...\"/> to <verp:bus>, or fix the joint");
      }
    }
  }

  void refuse_servos_of_followers() const {
    for (const ServoFact& fact : facts_.bus().servos) {
      const MimicFact* const mimic = facts_.mimic_of(fact.joint);
      if (mimic == nullptr) continue;
      fact.at.fail(
          "joint '" + fact.joint + "' mimics '" + mimic->driver + "', whose servo turns both",
          "remove its <verp:servo>; or, if it has a servo of its own, add <verp:drop "
          "what=\"mimic\" name=\"" +
              fact.joint + "\" reason=\"...\"/>");
    }
  }

  /// Controllers have room for 23 characters; tables and traces one line.
  void check_names() {
    std::map<std::string, std::string> known;  // by the controller's name
    std::vector<std::string> names = {e_.name};
    for (const Joint& joint : e_.joints) names.push_back(joint.name);
    for (const std::string& name : names) {
      const bool control = std::any_of(name.begin(), name.end(), [](char c) {
        return static_cast<unsigned char>(c) < ' ' || c == 0x7F;
      });
      if (control) fail(name, "the name '" + name + "' has a line break or tab in it", "rename it");
      const std::string inside = short_name(name);
      const auto [other, is_new] = known.insert({inside, name});
      if (!is_new && other->second != name) {
        fail(
            name,
            "the controller would call '" + name + "' and '" + other->second + "' '" + inside + "'",
            "shorten one of them to " + std::to_string(kNameLength - 1) + " characters");
      }
      if (inside != name)
        e_.notes.push_back("'" + name + "' is '" + inside + "' to the controller");
    }
  }

  /// Where the file has no gains: a P gain that fits the robot, and an eighth of it as D gain.
  void choose_gains() {
    std::vector<OpenGain> open;
    for (const ServoFact& fact : facts_.bus().servos) {
      if (facts_.mimic_of(fact.joint) != nullptr || fact.gives_p_gain) continue;
      Servo& servo = joint_named(fact.joint)->servo;
      if (fitting_p_gain(e_, servo) == 0) continue;
      const bool known_unit = e_.protocol != BusProtocol::kFeetech;
      open.push_back({&servo, !fact.gives_d_gain && known_unit});
    }
    fit_gains(e_, open);
    for (Joint& joint : e_.joints) {
      if (joint.follows >= 0)
        joint.servo = e_.joints[static_cast<std::size_t>(joint.follows)].servo;
    }
  }

  void choose_supply() {
    if (!facts_.supply) return;
    e_.supply = facts_.supply->supply;
    const double nominal_v = e_.joints.empty() ? supply_volts(e_) : e_.joints[0].servo.nominal_v;
    const double share = supply_volts(e_) / nominal_v;
    if (share >= kLeastSupply && share <= kMostSupply) return;
    facts_.supply->at.fail(
        fmt::format("<verp:supply> volts is {:.3g} times what the servos are made for, {:.4g} V",
                    share, nominal_v),
        fmt::format("choose from {} to {} times, or give the servo type its own nominal_v",
                    kLeastSupply, kMostSupply));
  }

  void check_limits(Joint& joint, const ServoFact& fact) const {
    const auto wrong = [&](const std::string& message, const std::string& fix) {
      if (fact.lower_rad || fact.upper_rad) fact.at.fail(message, fix);
      fail(joint.name, message, fix);
    };
    const std::string what = "joint '" + joint.name + "' ";
    if (!(std::abs(joint.lower_rad) < 100 && std::abs(joint.upper_rad) < 100)) {
      wrong(what + "has no position limits", "add <limit> with lower and upper, in radians");
    }
    if (joint.lower_rad >= joint.upper_rad) {
      wrong(what + "has a lower limit that is not below its upper one", "swap them");
    }
    const Servo& s = joint.servo;
    const double counts_per_rad = s.direction * s.counts_per_rev / (2 * std::numbers::pi);
    for (double* limit : {&joint.lower_rad, &joint.upper_rad}) {
      const double count = s.offset_count + counts_per_rad * *limit;
      const double reachable = std::clamp(count, 0.0, s.counts_per_rev - 1);
      if (std::abs(count - reachable) > s.counts_per_rev / 360) {
        wrong(
            what + "may turn to " + std::to_string(*limit) + " rad, beyond its servo's single turn",
            "narrow the limit, or change the servo's offset");
      }
      *limit = (reachable - s.offset_count) / counts_per_rad + 0.0;  // no negative zero
    }
  }

  void apply_poses() {
    for (const PoseFact& fact : facts_.poses) {
      Joint* joint = joint_named(fact.joint);
      if (!joint)
        fact.at.fail("there is no moving joint '" + fact.joint + "'", "name one that exists");
      if (fact.rad < joint->lower_rad || fact.rad > joint->upper_rad) {
        fact.at.fail("pose '" + fact.pose + "' puts joint '" + fact.joint + "' outside its limits",
                     "choose from " + std::to_string(joint->lower_rad) + " to " +
                         std::to_string(joint->upper_rad));
      }
      (fact.pose == "stand" ? joint->stand_rad : joint->sit_rad) = fact.rad;
    }
  }

  void check_poses() const {
    for (const Joint& joint : e_.joints) {
      for (const double rad : {joint.stand_rad, joint.sit_rad}) {
        if (rad >= joint.lower_rad && rad <= joint.upper_rad) continue;
        fail(joint.name,
             "joint '" + joint.name + "' cannot stand at zero, and a pose leaves it there",
             "add it to <verp:pose name=\"stand\"> and name=\"sit\"");
      }
    }
  }

  void add_limb(const LimbFact& fact) {
    const LinkTree::Located base = tree_.locate(fact.base, fact.at);
    const LinkTree::Located tip = tree_.locate(fact.tip, fact.at);
    Limb limb;
    limb.name = fact.name;
    for (int node = tip.node; node != base.node;
         node = e_.joints[static_cast<std::size_t>(node - 1)].parent) {
      if (node == 0) {
        fact.at.fail("'" + fact.tip + "' does not hang on '" + fact.base + "'",
                     "choose a base between the body and the tip");
      }
      limb.joints.insert(limb.joints.begin(), node - 1);
    }
    if (limb.joints.empty())
      fact.at.fail("limb '" + fact.name + "' has no joints", "choose another tip");
    limb.tip = tip.pose;
    if (fact.name == "left_leg" || fact.name == "right_leg")
      check_leg(fact, limb, base.node, tip.node);
    e_.limbs.push_back(limb);
  }

  void check_leg(const LimbFact& fact, Limb& limb, int base, int foot) const {
    const bool starts_below_a_joint = base != 0 && limb.joints.size() < kLegJoints;
    if (!slots_of(e_, limb) || starts_below_a_joint) {
      fact.at.fail(
          fact.name + " has " + std::to_string(limb.joints.size()) +
              " joints: a leg needs hip yaw, roll and pitch, knee, ankle pitch and roll",
          "start the limb at the trunk and end it at the sole; only hip yaw and ankle roll may be "
          "missing");
    }
    if (limb.tip.linear()(2, 2) < 0.7) {
      fact.at.fail("the z axis of '" + fact.tip + "' does not point up at the zero pose",
                   "turn the sole's frame: x forward, z up");
    }
    Eigen::AlignedBox3d sole;
    for (const Collision& box : e_.nodes[static_cast<std::size_t>(foot)].collisions) {
      if (box.shape == Collision::Shape::kBox)
        extend_sole(sole, limb.tip.inverse() * box.pose, box.size_m);
    }
    if (sole.isEmpty()) {
      fact.at.fail("no box of the foot has its lower face in the sole's plane",
                   "move '" + fact.tip + "' down to the foot's lower face, or add a <verp:box>");
    }
    limb.sole_min_m = sole.min();
    limb.sole_max_m = sole.max();
    if (sole.min().x() >= 0 || sole.max().x() <= 0 || sole.min().y() >= 0 || sole.max().y() <= 0) {
      fact.at.fail("'" + fact.tip + "' lies outside the sole", "move it below the foot's box");
    }
  }

  void check_legs() const {
    const auto has = [&](const char* name) {
      return std::any_of(e_.limbs.begin(), e_.limbs.end(),
                         [&](const Limb& l) { return l.name == name; });
    };
    if (has("left_leg") == has("right_leg")) return;
    facts_.body->at.fail("only one of left_leg and right_leg is given",
                         "add the other <verp:limb>");
  }

  void read_tuning() {
    for (const TuningFact& fact : facts_.tuning) {
      const std::optional<int> id = tuning_id(fact.name);
      if (!id) {
        fact.at.fail(
            "there is no tuning value '" + fact.name + "'",
            "common/model/tuning.hpp lists them: gait.lift_m, balance.gravity_enable, ...");
      }
      const Range range = kTuningRanges[*id];
      if (!in_range(*id, static_cast<float>(fact.value))) {
        fact.at.fail(
            "tuning value '" + fact.name + "' is out of range",
            "choose from " + std::to_string(range.low) + " to " + std::to_string(range.high));
      }
      e_.tuning.emplace_back(fact.name, fact.value);
    }
  }

  const std::string& link_name(int node) const {
    return e_.nodes[static_cast<std::size_t>(node)].name;
  }

  void free_links() {
    const NoCollideFact* any = nullptr;
    for (const NoCollideFact& fact : facts_.no_collides) {
      if (fact.is_any()) any = &fact;
      if (fact.is_any()) continue;
      const int a = tree_.locate(fact.link, fact.at).node,
                b = tree_.locate(fact.other, fact.at).node;
      if (a == b || joints_between(e_, a, b) <= 1) {
        fact.at.fail("'" + fact.link + "' and '" + fact.other + "' never collide anyway",
                     "remove this element, or name links that no joint connects");
      }
      e_.no_collide.push_back({std::min(a, b), std::max(a, b), fact.at.text("reason")});
    }
    for (const Clash& clash : find_near_overlaps(e_)) {
      if (any != nullptr) {
        e_.no_collide.push_back({clash.overlap.link, clash.overlap.other, any->at.text("reason")});
        continue;
      }
      const std::string &link = link_name(clash.overlap.link),
                        &other = link_name(clash.overlap.other);
      fail(link,
           "links '" + link + "' and '" + other + "' overlap by " +
               std::to_string(1000 * clash.overlap.depth_m) + " mm in the " + clash.pose + " pose",
           "correct the pose or the shapes, or add <verp:no_collide link=\"" + link +
               "\" other=\"" + other + "\" reason=\"...\"/>");
    }
  }

  void add_notes() {
    std::set<std::string> told;
    for (const Joint& joint : e_.joints) {
      if (!joint.servo.unread.empty() && told.insert(joint.servo.type).second)
        e_.notes.push_back("servo type '" + joint.servo.type + "': the twin has no use for " +
                           joint.servo.unread);
    }
    for (const NoCollide& pair : e_.no_collide) {
      e_.notes.push_back("links '" + link_name(pair.link) + "' and '" + link_name(pair.other) +
                         "' don't collide: " + pair.reason);
    }

    for (const InertiaFact& fact : facts_.inertias) {
      e_.notes.push_back("inertia of '" + fact.link + "' times " + fact.at.text("scale", "1") +
                         (fact.com_m ? ", centre of mass at " + fact.at.text("com") : "") +
                         (fact.ball_m ? ", a ball of radius " + fact.at.text("ball_m") : "") +
                         (fact.mass_kg ? ", mass " + fact.at.text("mass_kg") : "") + ": " +
                         fact.at.text("reason"));
    }
    for (const DropFact& fact : facts_.drops) {
      e_.notes.push_back(fact.what + " of '" + fact.name + "' dropped: " + fact.at.text("reason"));
    }
  }

  const XmlSource& source_;
  const Facts& facts_;
  const sdf::Model& model_;
  Entity e_;
  LinkTree tree_;
};

}  // namespace

Entity assemble(const XmlSource& source, const Facts& facts, const sdf::Model& model,
                const UrdfNames& names) {
  return Assembler(source, facts, model, names).build();
}

}  // namespace verp::model
