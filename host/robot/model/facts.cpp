#include "host/robot/model/facts.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "host/robot/model/bounds.hpp"
#include "host/robot/model/bus_facts.hpp"
#include "host/robot/model/number.hpp"
#include "host/robot/model/principal.hpp"
#include "host/robot/model/servo_type_facts.hpp"

namespace verp::model {
namespace {

/// A <pose> child, as in SDF.
Transform read_pose(const XmlElement& element) {
  const auto poses = element.children("pose");
  if (poses.empty()) return Transform::Identity();
  const char* text = poses.front().raw().GetText();
  const auto values = parse_numbers(text ? text : "");
  if (!values || values->size() != 6) {
    poses.front().fail("<pose> is not 6 finite numbers", "write x y z roll pitch yaw");
  }
  const auto& v = *values;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double most = i < 3 ? kMostLength_m : kMostAngle;
    require_within(element.file(), poses.front().line(), "<pose>", v[i], -most, most, "");
  }
  Transform pose = Transform::Identity();
  pose.translation() = Vec3(v[0], v[1], v[2]);
  pose.linear() = rotation_rpy(Vec3(v[3], v[4], v[5]));
  return pose;
}

/// More than a second is probably another unit.
constexpr double kMostLatency_s = 1;

double read_latency_s(const XmlElement& e) {
  return e.number_within("latency_s", 0, kMostLatency_s, " s", 0);
}

ImuFact read_imu(const XmlElement& e) {
  e.allow({"sensor", "link", "id", "type", "latency_s"}, {"pose"});
  const std::string type_name = e.text("type");
  const ImuType* type = find_imu_type(type_name);
  if (!type) e.fail("no IMU type '" + type_name + "'", "choose one of: " + names_of(imu_types()));
  if (e.has("sensor") == e.has("link")) {
    e.fail("<verp:imu> needs either sensor or link",
           "name an SDF sensor, or a link (and a <pose> inside)");
  }
  ImuFact fact{e, e.text("sensor", ""), e.text("link", ""), {}};
  fact.imu.id = e.integer("id", 0, kHighestId);
  fact.imu.pose = read_pose(e);
  fact.imu.gyro_rad_s_per_count = type->gyro_rad_s_per_count;
  fact.imu.accel_m_s2_per_count = type->accel_m_s2_per_count;
  fact.imu.gyro_noise_rad_s_rthz = type->gyro_noise_rad_s_rthz;
  fact.imu.gyro_bias_rad_s = type->gyro_bias_rad_s;
  fact.imu.accel_noise_m_s2_rthz = type->accel_noise_m_s2_rthz;
  fact.imu.accel_bias_m_s2 = type->accel_bias_m_s2;
  fact.imu.latency_s = read_latency_s(e);
  return fact;
}

TruthFact read_truth(const XmlElement& e) {
  e.allow({"name", "link", "rate_hz", "latency_s", "position_noise_m", "angle_noise_rad",
           "velocity_noise_m_s", "rate_noise_rad_s"},
          {"pose"});
  TruthFact fact{e, e.text("link"), {}};
  TruthSensor& truth = fact.truth;
  truth.name = e.text("name");
  truth.pose = read_pose(e);
  truth.rate_hz = e.number_within("rate_hz", 0.01, 1000, " Hz", truth.rate_hz);
  truth.latency_s = read_latency_s(e);
  truth.position_noise_m = e.number_within("position_noise_m", 0, 10, " m", 0);
  truth.angle_noise_rad = e.number_within("angle_noise_rad", 0, 3, " rad", 0);
  truth.velocity_noise_m_s = e.number_within("velocity_noise_m_s", 0, 10, " m/s", 0);
  truth.rate_noise_rad_s = e.number_within("rate_noise_rad_s", 0, 10, " rad/s", 0);
  return fact;
}

class FactReader {
 public:
  Facts read(const XmlElement& model, const std::string& bus) {
    types_ = read_servo_types(model);
    for (const XmlElement& child : model.children()) {
      if (child.name() == "verp:servo_type") continue;
      if (child.name().starts_with("verp:")) {
        element(child);
      } else {
        refuse_strays(child);
      }
    }
    require_parts(model);
    for (const BusFact& each : f_.buses) unique_ids(each);
    choose_bus(model, bus);
    return std::move(f_);
  }

 private:
  static void refuse_strays(const XmlElement& parent) {
    for (const XmlElement& child : parent.children()) {
      if (child.name().starts_with("verp:")) {
        child.fail("<" + child.name() + "> inside <" + parent.name() + "> is not read",
                   "put it directly below <model>, or into <verp:bus>");
      }
      refuse_strays(child);
    }
  }

  void element(const XmlElement& e) {
    const auto known = readers().find(e.name());
    if (known == readers().end()) {
      std::string list = "verp:servo_type";
      for (const auto& [name, reader] : readers()) list += ", " + name;
      e.fail("unknown element <" + e.name() + ">", "use one of: " + list);
    }
    (this->*known->second)(e);
  }
  using Reader = void (FactReader::*)(const XmlElement&);
  static const std::map<std::string, Reader>& readers() {
    static const std::map<std::string, Reader> kReaders = {
        {"verp:body", &FactReader::body},         {"verp:limb", &FactReader::limb},
        {"verp:bus", &FactReader::bus},           {"verp:imu", &FactReader::imu},
        {"verp:feet", &FactReader::feet},         {"verp:pose", &FactReader::pose},
        {"verp:tuning", &FactReader::tuning},     {"verp:inertia", &FactReader::inertia},
        {"verp:box", &FactReader::box},           {"verp:drop", &FactReader::drop},
        {"verp:fix", &FactReader::fix},           {"verp:no_collide", &FactReader::no_collide},
        {"verp:mimic", &FactReader::mimic},       {"verp:latency", &FactReader::latency},
        {"verp:truth", &FactReader::truth},       {"verp:supply", &FactReader::supply},
        {"verp:friction", &FactReader::friction},
    };
    return kReaders;
  }
  template <class T>
  static void once(const XmlElement& e, const std::optional<T>& fact) {
    if (fact) e.fail("<" + e.name() + "> is given twice", "keep one of them");
  }

  void body(const XmlElement& e) {
    once(e, f_.body);
    e.allow({"link"}, {"pose"});
    f_.body.emplace(BodyFact{e, e.text("link"), read_pose(e)});
  }
  void limb(const XmlElement& e) {
    e.allow({"name", "base", "tip"});
    const std::string name = e.text("name");
    for (const LimbFact& other : f_.limbs) {
      if (other.name == name) e.fail("limb '" + name + "' is given twice", "keep one of them");
    }
    f_.limbs.push_back({e, name, e.text("base"), e.text("tip")});
  }
  void bus(const XmlElement& e) {
    BusFact fact = read_bus(e, types_);
    for (const BusFact& other : f_.buses) {
      if (other.name != fact.name) continue;
      e.fail("bus '" + fact.name + "' is given twice", "give each <verp:bus> a name of its own");
    }
    f_.buses.push_back(std::move(fact));
  }
  void imu(const XmlElement& e) {
    once(e, f_.imu);
    f_.imu.emplace(read_imu(e));
  }
  void feet(const XmlElement& e) {
    once(e, f_.feet);
    e.allow({"left_id", "right_id", "newton_per_count"});
    f_.feet.emplace(
        FeetFact{e,
                 {{e.integer("left_id", 1, kHighestId), e.integer("right_id", 1, kHighestId)},
                  e.number_within("newton_per_count", 1e-6, 10, " N, like 0.01")}});
  }
  void supply(const XmlElement& e) {
    once(e, f_.supply);
    e.allow({"volts", "resistance_ohm"});
    SupplyFact fact{e, {}};
    if (e.has("volts")) fact.supply.volts = e.number_within("volts", 0.1, 1000, " V, like 12");
    if (e.has("resistance_ohm"))
      fact.supply.resistance_ohm = e.number_within("resistance_ohm", 0, 100, " ohm, like 0.1");
    f_.supply.emplace(fact);
  }
  void friction(const XmlElement& e) {
    once(e, f_.friction);
    e.allow({"from"});
    const std::string from = e.text("from");
    if (from != "servo" && from != "file" && from != "both") {
      e.fail("<verp:friction> from='" + from + "' is unknown",
             "write servo (the servo type's), file (the joint's <dynamics>) or both (their sum)");
    }
    f_.friction = from == "servo"  ? FrictionFrom::kServo
                  : from == "file" ? FrictionFrom::kFile
                                   : FrictionFrom::kBoth;
  }
  void pose(const XmlElement& e) {
    e.allow({"name"}, {"verp:joint"});
    const std::string name = e.text("name");
    if (name != "stand" && name != "sit") e.fail("no pose '" + name + "'", "write stand or sit");
    for (const XmlElement& joint : e.children()) {
      joint.allow({"name", "rad"});
      f_.poses.push_back({joint, name, joint.text("name"), joint.number("rad")});
    }
  }
  void tuning(const XmlElement& e) {
    e.allow({"name", "value"});
    const std::string name = e.text("name");
    for (const TuningFact& other : f_.tuning) {
      if (other.name != name) continue;
      e.fail("tuning value '" + name + "' is given twice (first in line " +
                 std::to_string(other.at.line()) + ")",
             "keep one of them");
    }
    f_.tuning.push_back({e, name, e.number("value")});
  }
  void inertia(const XmlElement& e) {
    e.allow({"link", "scale", "com", "ball_m", "mass_kg", "reason"});
    e.text("reason");
    InertiaFact fact{
        e, e.text("link"), e.number_within("scale", 1e-9, 1e6, ", like 0.001", 1), {}, {}, {}};
    if (e.has("com")) fact.com_m = e.vector("com");
    if (e.has("ball_m")) fact.ball_m = e.number_within("ball_m", 1e-3, 1, " m");
    if (e.has("mass_kg")) fact.mass_kg = e.number_within("mass_kg", 1e-6, 100, " kg");
    if (fact.mass_kg && !fact.ball_m) e.fail("<verp:inertia> mass_kg without ball_m", "add ball_m");
    if ((fact.com_m || fact.ball_m) && fact.link == "*") {
      e.fail("<verp:inertia> gives all links one centre of mass, or one ball", "name the link");
    }
    f_.inertias.push_back(fact);
  }
  void box(const XmlElement& e) {
    e.allow({"frame", "centre", "size", "friction", "stiffness_n_m", "damping_n_s_m"});
    Collision box;
    box.size_m = e.vector("size");
    if (box.size_m.minCoeff() < kLeastLength_m)
      e.fail("<verp:box> size is less than 0.1 mm", "write three lengths in metres");
    box.pose.translation() = e.vector("centre");
    box.friction = e.number_within("friction", 0, kMostFriction, "", box.friction);
    box.stiffness_n_m =
        e.number_within("stiffness_n_m", 1, kMostStiffness_n_m, " N/m", box.stiffness_n_m);
    box.damping_n_s_m =
        e.number_within("damping_n_s_m", 0, kMostDamping_n_s_m, " N s/m", box.damping_n_s_m);
    f_.boxes.push_back({e, e.text("frame"), box});
  }
  void drop(const XmlElement& e) {
    e.allow({"what", "name", "reason"});
    e.text("reason");
    const std::string what = e.text("what");
    if (what != "collision" && what != "massless_link" && what != "mimic" && what != "sensor") {
      e.fail("<verp:drop> what='" + what + "' is unknown",
             "write collision, massless_link, mimic or sensor");
    }
    f_.drops.push_back({e, what, e.text("name")});
  }

  void fix(const XmlElement& e) {
    e.allow({"joint", "rad", "reason"});
    e.text("reason");
    FixFact fact{e, e.text("joint"), e.number_within("rad", -7, 7, " rad", 0)};
    if (fact.rad != 0 && fact.joint.ends_with('*')) {
      e.fail("several joints are fixed at one angle", "name each joint that is fixed beside zero");
    }
    if (f_.fix_of(fact.joint) != nullptr) {
      e.fail("joint '" + fact.joint + "' is fixed twice", "keep one of them");
    }
    f_.fixes.push_back(fact);
  }

  void mimic(const XmlElement& e) {
    e.allow({"joint", "follows", "multiplier", "offset_rad"});
    f_.mimics.push_back({e, e.text("joint"), e.text("follows"), e.number("multiplier", 1),
                         e.number("offset_rad", 0)});
  }

  void latency(const XmlElement& e) {
    e.allow({"sensor", "s"});
    LatencyFact fact{e, e.text("sensor"), e.number_within("s", 0, kMostLatency_s, " s")};
    for (const LatencyFact& other : f_.latencies) {
      if (other.sensor == fact.sensor)
        e.fail("sensor '" + fact.sensor + "' is given two latencies", "keep one of them");
    }
    f_.latencies.push_back(fact);
  }

  void truth(const XmlElement& e) { f_.truths.push_back(read_truth(e)); }

  void no_collide(const XmlElement& e) {
    e.allow({"link", "other", "reason"});
    e.text("reason");
    f_.no_collides.push_back({e, e.text("link"), e.text("other")});
  }

  void require_parts(const XmlElement& model) const {
    if (!f_.body)
      model.fail("the model has no <verp:body>", "add <verp:body link=\"TRUNK LINK\"/>");
    if (f_.buses.empty())
      model.fail("the model has no <verp:bus>",
                 "add <verp:bus protocol=\"dynamixel2\"> with its servos");
  }

  void unique_ids(const BusFact& bus) const {
    const bool can = bus.protocol == BusProtocol::kCia402;
    std::map<int, int> line_of;
    const auto take = [&](int id, const XmlElement& e) {
      if (id == 0) return;
      if (can && id > kHighestNode) {
        e.fail("id " + std::to_string(id) + " is no node id of bus '" + bus.name + "'",
               "choose from 1 to " + std::to_string(kHighestNode));
      }
      const auto [other, fresh] = line_of.insert({id, e.line()});
      if (!fresh) {
        e.fail("bus id " + std::to_string(id) + " is used twice (also in line " +
                   std::to_string(other->second) + ")",
               "give each device its own id");
      }
    };
    for (const ServoFact& servo : bus.servos) take(servo.servo.id, servo.at);
    if (f_.imu) take(f_.imu->imu.id, f_.imu->at);
    if (f_.feet) {
      for (const int id : f_.feet->feet.id) take(id, f_.feet->at);
    }
  }

  void choose_bus(const XmlElement& model, const std::string& name) {
    if (name.empty()) return;
    std::string list;
    for (f_.used = 0; f_.used < f_.buses.size(); ++f_.used) {
      if (f_.bus().name == name) return;
      list += (list.empty() ? "" : ", ") + f_.bus().name;
    }
    model.fail("the model has no bus '" + name + "'", "choose one of: " + list);
  }

  Facts f_;
  std::vector<ServoType> types_;
};

}  // namespace

bool Facts::is_dropped(const std::string& what, const std::string& name) const {
  return std::any_of(drops.begin(), drops.end(), [&](const DropFact& drop) {
    return drop.what == what && (drop.name == "*" || drop.name == name);
  });
}

bool FixFact::fixes(const std::string& name) const {
  if (!joint.ends_with('*')) return name == joint;
  return name.starts_with(std::string_view(joint).substr(0, joint.size() - 1));
}

const FixFact* Facts::fix_of(const std::string& joint) const {
  const auto found = std::find_if(fixes.begin(), fixes.end(),
                                  [&](const FixFact& fix) { return fix.fixes(joint); });
  return found == fixes.end() ? nullptr : &*found;
}

const MimicFact* Facts::mimic_of(const std::string& joint) const {
  const auto found = std::find_if(mimics.begin(), mimics.end(),
                                  [&](const MimicFact& mimic) { return mimic.joint == joint; });
  return found == mimics.end() ? nullptr : &*found;
}

Facts read_facts(const XmlElement& model, const std::string& bus) {
  return FactReader().read(model, bus);
}

}  // namespace verp::model
