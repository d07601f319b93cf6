#include "host/model/facts.hpp"

#include <algorithm>
#include <map>
#include <numbers>

#include "host/model/bounds.hpp"
#include "host/model/number.hpp"
#include "host/model/servo_types.hpp"

namespace verp::model {
namespace {

constexpr int kHighestId =
    199;  // 200 is the controller, 201 the clock, 253 and up are the protocol's

/// The optional <pose>x y z roll pitch yaw</pose> child, as in SDF.
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
  pose.linear() = (Eigen::AngleAxisd(v[5], Vec3::UnitZ()) * Eigen::AngleAxisd(v[4], Vec3::UnitY()) *
                   Eigen::AngleAxisd(v[3], Vec3::UnitX()))
                      .toRotationMatrix();
  return pose;
}

template <class Type>
std::string names_of(const std::vector<Type>& types) {
  std::string list;
  for (const Type& type : types) list += (list.empty() ? "" : ", ") + std::string(type.name);
  return list;
}

std::uint16_t gain(const XmlElement& e, const char* name, int fallback) {
  return static_cast<std::uint16_t>(e.integer(name, 0, 16383, fallback));  // e-Manual: 0 to 16,383
}

ServoFact read_servo(const XmlElement& e) {
  e.allow({"joint", "id", "type", "direction", "offset", "backlash_rad", "p_gain", "i_gain",
           "d_gain", "profile_ms", "lower_rad", "upper_rad"});
  const std::string type_name = e.text("type");
  const ServoType* type = find_servo_type(type_name);
  if (!type)
    e.fail("no servo type '" + type_name + "'", "choose one of: " + names_of(servo_types()));
  ServoFact fact{e, e.text("joint"), {}, {}, {}};
  Servo& s = fact.servo;
  s.type = type->name;
  s.id = e.integer("id", 1, kHighestId);
  s.direction = e.integer("direction", -1, 1, 1);
  if (s.direction == 0)
    e.fail("<verp:servo> direction is 0", "write 1, or -1 for a servo mounted backwards");
  s.offset_count = e.integer("offset", 0, static_cast<int>(type->counts_per_rev) - 1, 2048);
  s.backlash_rad = e.number("backlash_rad", 0);
  if (s.backlash_rad < 0 || s.backlash_rad > 0.1) {
    e.fail("<verp:servo> backlash_rad is not within 0 to 0.1",
           "write the gear play in radians, like 0.0044");
  }
  s.stall_torque_n_m = type->stall_torque_n_m;
  s.no_load_speed_rad_s = type->no_load_rev_min * 2 * std::numbers::pi / 60;
  s.stall_current_a = type->stall_current_a;
  s.counts_per_rev = type->counts_per_rev;
  s.model_number = type->model_number;
  s.fast_sync_read = type->fast_sync_read;
  s.p_gain = gain(e, "p_gain", type->default_p_gain);
  s.i_gain = gain(e, "i_gain", 0);
  s.d_gain = gain(e, "d_gain", 0);
  s.profile_ms = static_cast<std::uint16_t>(e.integer("profile_ms", 0, 1000, 0));
  if (s.p_gain == 0)
    e.fail("<verp:servo> p_gain is 0: the servo would hold nothing", "write 1 to 16383");
  if (e.has("lower_rad")) fact.lower_rad = e.number("lower_rad");
  if (e.has("upper_rad")) fact.upper_rad = e.number("upper_rad");
  return fact;
}

ImuFact read_imu(const XmlElement& e) {
  e.allow({"sensor", "link", "id", "type"});
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
  fact.imu.gyro_noise_rad_s = type->gyro_noise_rad_s;
  fact.imu.gyro_bias_rad_s = type->gyro_bias_rad_s;
  fact.imu.accel_noise_m_s2 = type->accel_noise_m_s2;
  fact.imu.accel_bias_m_s2 = type->accel_bias_m_s2;
  return fact;
}

class FactReader {
 public:
  Facts read(const XmlElement& model) {
    for (const XmlElement& child : model.children()) {
      if (child.name().starts_with("verp:")) {
        element(child);
      } else {
        refuse_strays(child);
      }
    }
    unique_ids(model);
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
      std::string list;
      for (const auto& [name, reader] : readers()) list += (list.empty() ? "" : ", ") + name;
      e.fail("unknown element <" + e.name() + ">", "use one of: " + list);
    }
    (this->*known->second)(e);
  }
  using Reader = void (FactReader::*)(const XmlElement&);
  static const std::map<std::string, Reader>& readers() {
    static const std::map<std::string, Reader> kReaders = {
        {"verp:body", &FactReader::body},     {"verp:limb", &FactReader::limb},
        {"verp:bus", &FactReader::bus},       {"verp:imu", &FactReader::imu},
        {"verp:feet", &FactReader::feet},     {"verp:pose", &FactReader::pose},
        {"verp:tuning", &FactReader::tuning}, {"verp:inertia", &FactReader::inertia},
        {"verp:box", &FactReader::box},       {"verp:drop", &FactReader::drop},
    };
    return kReaders;
  }
  template <class T>
  static void once(const XmlElement& e, const std::optional<T>& fact) {
    if (fact) e.fail("<" + e.name() + "> is given twice", "keep one of them");
  }

  void body(const XmlElement& e) {
    once(e, f_.body);
    e.allow({"link"});
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
    once(e, f_.bus);
    e.allow({"name", "protocol", "baud", "period_us", "rise_torque_percent"});
    f_.bus = e;
    f_.protocol = e.text("protocol");
    if (f_.protocol != "dynamixel2") {
      e.fail("no bus protocol '" + f_.protocol + "'", "write protocol=\"dynamixel2\"");
    }
    f_.baud = static_cast<std::uint32_t>(e.integer("baud", 9600, 4500000, 2000000));
    f_.rise_torque_percent =
        static_cast<std::uint8_t>(e.integer("rise_torque_percent", 10, 100, kRiseTorquePercent));
    f_.period_us = static_cast<std::uint32_t>(e.integer("period_us", 4000, 20000, 10000));
    for (const XmlElement& child : e.children()) {
      if (child.name() != "verp:servo") {
        child.fail("unknown element <" + child.name() + "> in <verp:bus>",
                   "it holds <verp:servo> only");
      }
      f_.servos.push_back(read_servo(child));
    }
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
  void pose(const XmlElement& e) {
    e.allow({"name"});
    const std::string name = e.text("name");
    if (name != "stand" && name != "sit") e.fail("no pose '" + name + "'", "write stand or sit");
    for (const XmlElement& joint : e.children()) {
      if (joint.name() != "verp:joint") {
        joint.fail("unknown element <" + joint.name() + "> in <verp:pose>",
                   "it holds <verp:joint> only");
      }
      joint.allow({"name", "rad"});
      f_.poses.push_back({joint, name, joint.text("name"), joint.number("rad")});
    }
  }
  void tuning(const XmlElement& e) {
    e.allow({"name", "value"});
    f_.tuning.push_back({e, e.text("name"), e.number("value")});
  }
  void inertia(const XmlElement& e) {
    e.allow({"link", "scale", "com", "reason"});
    e.text("reason");
    InertiaFact fact{e, e.text("link"), e.number_within("scale", 1e-6, 1e6, ", like 0.001", 1), {}};
    if (e.has("com")) fact.com_m = e.vector("com");
    if (fact.com_m && fact.link == "*") {
      e.fail("<verp:inertia> gives one centre of mass to all links", "name the link");
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
    if (what != "collision" && what != "massless_link" && what != "mimic") {
      e.fail("<verp:drop> what='" + what + "' is unknown",
             "write collision, massless_link or mimic");
    }
    f_.drops.push_back({e, what, e.text("name")});
  }

  void unique_ids(const XmlElement& model) {
    std::map<int, int> line_of;
    const auto take = [&](int id, const XmlElement& e) {
      if (id == 0) return;
      const auto [other, fresh] = line_of.insert({id, e.line()});
      if (!fresh) {
        e.fail("bus id " + std::to_string(id) + " is used twice (also in line " +
                   std::to_string(other->second) + ")",
               "give each device its own id");
      }
    };
    for (const ServoFact& servo : f_.servos) take(servo.servo.id, servo.at);
    if (f_.imu) take(f_.imu->imu.id, f_.imu->at);
    if (f_.feet) {
      for (const int id : f_.feet->feet.id) take(id, f_.feet->at);
    }
    if (!f_.body)
      model.fail("the model has no <verp:body>", "add <verp:body link=\"TRUNK LINK\"/>");
    if (!f_.bus)
      model.fail("the model has no <verp:bus>",
                 "add <verp:bus protocol=\"dynamixel2\"> with its servos");
  }

  Facts f_;
};

}  // namespace

bool Facts::is_dropped(const std::string& what, const std::string& name) const {
  return std::any_of(drops.begin(), drops.end(), [&](const DropFact& drop) {
    return drop.what == what && (drop.name == "*" || drop.name == name);
  });
}

Facts read_facts(const XmlElement& model) {
  return FactReader().read(model);
}

}  // namespace verp::model
