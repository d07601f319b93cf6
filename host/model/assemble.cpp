#include "host/model/assemble.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <sdf/sdf.hh>

#include "common/io/io.hpp"
#include "common/model/tuning_ranges.hpp"
#include "host/model/leg.hpp"
#include "host/model/load_error.hpp"
#include "host/model/params.hpp"
#include "host/model/sdf_parts.hpp"

namespace verp::model {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A link before it is lumped: everything in the body frame at the zero pose.
struct RawLink {
  const sdf::Link* sdf = nullptr;
  Transform pose = Transform::Identity();
  double mass_kg = 0;
  Vec3 com_m = Vec3::Zero();
  Mat3 inertia_kg_m2 = Mat3::Zero();
  int node = -1;
};

Mat3 steiner(double mass_kg, const Vec3& d) {
  return mass_kg * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
}

class Assembler {
 public:
  Assembler(const XmlSource& source, const Facts& facts, const sdf::Model& model)
      : source_(source), facts_(facts), model_(model) {}

  Entity build() {
    e_.name = model_.Name();
    e_.file = source_.path();
    e_.protocol = facts_.protocol;
    e_.baud = facts_.baud;
    e_.period_us = facts_.period_us;
    read_links();
    read_joints();
    grow_tree();
    for (auto& [name, link] : links_) attach_shapes(link);
    add_boxes();
    check_inertias();
    join_servos();
    apply_poses();
    for (const LimbFact& fact : facts_.limbs) add_limb(fact);
    check_legs();
    read_sensors();
    read_tuning();
    gather_leg_frames(e_);
    add_notes();
    return std::move(e_);
  }

 private:
  [[noreturn]] void fail(const std::string& about, const std::string& message,
                         const std::string& fix) const {
    const XmlSource::Place place = source_.blame(about);
    throw LoadError(place.file, place.line, message, fix);
  }

  void read_links() {
    const sdf::Link* body = model_.LinkByName(facts_.body->link);
    if (!body) {
      facts_.body->at.fail("there is no link '" + facts_.body->link + "'", "name the trunk's link");
    }
    model_body_ = model_pose(body->SemanticPose()) * facts_.body->pose;
    const Transform body_model = model_body_.inverse();
    for (std::uint64_t i = 0; i < model_.LinkCount(); ++i) {
      const sdf::Link& sdf = *model_.LinkByIndex(i);
      if (!is_urdf_link(sdf.Name()) && !sdf.Element()->HasElement("inertial")) {
        fail(sdf.Name(), "link '" + sdf.Name() + "' has no <inertial>",
             "give it a mass, or make it a <frame> of the link that carries it");
      }
      RawLink link;
      link.sdf = &sdf;
      link.pose = body_model * model_pose(sdf.SemanticPose());
      const auto& inertial = sdf.Inertial();
      Transform com = link.pose * to_transform(inertial.Pose());
      if (const auto corrected = corrected_com(sdf.Name()))
        com.translation() = link.pose * *corrected;
      link.mass_kg = inertial.MassMatrix().Mass();
      link.com_m = com.translation();
      link.inertia_kg_m2 =
          inertia_scale(sdf.Name()) *
          (com.linear() * to_matrix(inertial.MassMatrix().Moi()) * com.linear().transpose());
      links_[sdf.Name()] = link;
    }
  }

  bool is_urdf_link(const std::string& name) const {
    const auto place = source_.find(name);
    return place && place->file != source_.path();
  }

  double inertia_scale(const std::string& link) const {
    double scale = 1;
    for (const InertiaFact& fact : facts_.inertias) {
      if (fact.link == "*" || fact.link == link) scale *= fact.scale;
    }
    return scale;
  }

  std::optional<Vec3> corrected_com(const std::string& link) const {
    std::optional<Vec3> com_m;
    for (const InertiaFact& fact : facts_.inertias) {
      if (fact.link == link && fact.com_m) com_m = fact.com_m;
    }
    return com_m;
  }

  void read_joints() {
    for (std::uint64_t i = 0; i < model_.JointCount(); ++i) {
      const sdf::Joint& joint = *model_.JointByIndex(i);
      std::string parent, child;
      joint.ResolveParentLink(parent);
      joint.ResolveChildLink(child);
      if (parent == "world") {
        fail(joint.Name(), "joint '" + joint.Name() + "' ties the robot to the world", "remove it");
      }
      if (joint.Type() != sdf::JointType::REVOLUTE && joint.Type() != sdf::JointType::FIXED) {
        fail(joint.Name(), "joint '" + joint.Name() + "' is neither revolute nor fixed",
             "model it as a revolute joint with limits, or fix it");
      }
      if (parent_joint_.contains(child)) {
        fail(joint.Name(),
             "link '" + child + "' hangs on two joints: '" + parent_joint_[child]->Name() +
                 "' and '" + joint.Name() + "'",
             "a robot is a tree: remove one of them");
      }
      parent_joint_[child] = &joint;
      children_[parent].push_back({&joint, child});
    }
  }

  /// Node 0 is the body's link with all that is fixed to it; then depth first, in the file's order.
  void grow_tree() {
    std::string top = facts_.body->link;
    while (parent_joint_.contains(top)) {
      const sdf::Joint& joint = *parent_joint_[top];
      if (joint.Type() != sdf::JointType::FIXED) {
        facts_.body->at.fail(
            "link '" + facts_.body->link + "' hangs on joint '" + joint.Name() + "'",
            "name the link at the root of the tree");
      }
      joint.ResolveParentLink(top);
    }
    add_node(facts_.body->link, Vec3::Zero());
    place_link(top, 0);
    for (const auto& [name, link] : links_) {
      if (link.node < 0) {
        fail(name, "link '" + name + "' is not connected to '" + facts_.body->link + "'",
             "add its joint");
      }
    }
    if (e_.joints.size() > kMaxJoints) {
      facts_.body->at.fail("the robot has " + std::to_string(e_.joints.size()) + " joints",
                           "at most " + std::to_string(kMaxJoints) + " fit: fix some");
    }
  }

  void place_link(const std::string& name, int node) {
    RawLink& link = links_.at(name);
    link.node = node;
    lump(e_.nodes[static_cast<std::size_t>(node)], link, origin_[static_cast<std::size_t>(node)]);
    for (const auto& [joint, child] : children_[name]) {
      if (joint->Type() == sdf::JointType::FIXED) {
        place_link(child, node);
      } else {
        place_link(child, add_joint(*joint, child, node));
      }
    }
  }

  static void lump(Node& node, const RawLink& link, const Vec3& origin) {
    const double total = node.mass_kg + link.mass_kg;
    if (total <= 0) return;
    const Vec3 com = link.com_m - origin;
    const Vec3 mean = (node.mass_kg * node.com_m + link.mass_kg * com) / total;
    node.inertia_kg_m2 += link.inertia_kg_m2 + steiner(node.mass_kg, node.com_m - mean) +
                          steiner(link.mass_kg, com - mean);
    node.com_m = mean;
    node.mass_kg = total;
  }

  int add_joint(const sdf::Joint& sdf, const std::string& child, int parent) {
    const Transform pose = model_body_.inverse() * model_pose(sdf.SemanticPose());
    const sdf::JointAxis& axis = *sdf.Axis();
    ignition::math::Vector3d direction;
    axis.ResolveXyz(direction, "__model__");
    Joint joint;
    joint.name = sdf.Name();
    joint.parent = parent;
    joint.origin_m = pose.translation() - origin_[static_cast<std::size_t>(parent)];
    joint.axis = snapped(model_body_.linear().transpose() * to_vector(direction));
    joint.lower_rad = axis.Lower();
    joint.upper_rad = axis.Upper();
    joint.velocity_limit_rad_s = axis.MaxVelocity() > 0 ? axis.MaxVelocity() : kInfinity;
    joint.friction_n_m = axis.Friction();
    joint.damping_n_m_s = axis.Damping();
    if (joint.friction_n_m < 0 || joint.damping_n_m_s < 0) {
      fail(joint.name, "joint '" + joint.name + "' has negative friction or damping",
           "write zero or more");
    }
    e_.joints.push_back(joint);
    add_node(child, pose.translation());
    return static_cast<int>(e_.nodes.size()) - 1;
  }

  void add_node(const std::string& name, const Vec3& origin) {
    e_.nodes.emplace_back().name = name;
    origin_.push_back(origin);
  }

  /// Third-party files write pi as 3.14159: axes within 0.1 mrad of a body axis are meant to be
  /// that axis.
  static Vec3 snapped(const Vec3& axis) {
    constexpr double kTolerance = 1e-4;
    for (int i = 0; i < 3; ++i) {
      const Vec3 unit = Vec3::Unit(i);
      if ((axis - unit).norm() < kTolerance) return unit;
      if ((axis + unit).norm() < kTolerance) return Vec3::Zero() - unit;  // no negative zeros
    }
    return axis.normalized();
  }

  void attach_shapes(const RawLink& link) {
    for (std::uint64_t i = 0; i < link.sdf->CollisionCount(); ++i) {
      const sdf::Collision& sdf = *link.sdf->CollisionByIndex(i);
      if (facts_.is_dropped("collision", link.sdf->Name())) continue;
      Collision collision;
      if (!read_shape(sdf, collision)) {
        fail(sdf.Name(),
             "collision '" + sdf.Name() + "' of link '" + link.sdf->Name() +
                 "' is a mesh or another shape that contacts cannot use",
             "use a box, sphere, cylinder or capsule, or declare <verp:drop what=\"collision\" "
             "name=\"" +
                 link.sdf->Name() + "\" reason=\"...\"/> and add a <verp:box>");
      }
      add_collision(link.node, link.pose * resolved(sdf.SemanticPose(), link.sdf->Name()),
                    collision);
    }
  }

  void add_collision(int node, Transform body_pose, Collision collision) {
    body_pose.translation() -= origin_[static_cast<std::size_t>(node)];
    collision.pose = body_pose;
    e_.nodes[static_cast<std::size_t>(node)].collisions.push_back(collision);
  }

  struct Located {
    int node;
    Transform pose;  ///< in the node's frame
  };
  /// A link or frame by name.
  Located locate(const std::string& name, const XmlElement& at) const {
    std::string link_name = name;
    Transform pose = Transform::Identity();
    if (const sdf::Frame* frame = model_.FrameByName(name)) {
      frame->ResolveAttachedToBody(link_name);
      pose = model_body_.inverse() * model_pose(frame->SemanticPose());
    } else if (links_.contains(name)) {
      pose = links_.at(name).pose;
    } else {
      at.fail("there is no link or frame '" + name + "'", "name one that exists");
    }
    const int node = links_.at(link_name).node;
    pose.translation() -= origin_[static_cast<std::size_t>(node)];
    return {node, pose};
  }

  void add_boxes() {
    for (const BoxFact& fact : facts_.boxes) {
      const Located place = locate(fact.frame, fact.at);
      Collision box = fact.box;
      box.pose = place.pose * box.pose;
      e_.nodes[static_cast<std::size_t>(place.node)].collisions.push_back(box);
    }
  }

  void check_inertias() const {
    for (const InertiaFact& fact : facts_.inertias) {
      if (fact.link != "*") locate(fact.link, fact.at);
    }
    Eigen::AlignedBox3d extent(Vec3::Zero());
    for (const Vec3& origin : origin_) extent.extend(origin);
    for (const Node& node : e_.nodes) {
      if (const std::string wrong = implausible(node, extent.diagonal().norm()); !wrong.empty()) {
        fail(node.name, "link '" + node.name + "': " + wrong,
             "correct <inertial>, or declare <verp:inertia link=\"" + node.name +
                 "\" scale=\"...\" reason=\"...\"/>");
      }
    }
  }

  Joint* joint_named(const std::string& name) {
    const auto found = std::find_if(e_.joints.begin(), e_.joints.end(),
                                    [&](const Joint& joint) { return joint.name == name; });
    return found == e_.joints.end() ? nullptr : &*found;
  }

  void join_servos() {
    std::map<std::string, const ServoFact*> servo_of;
    for (const ServoFact& fact : facts_.servos) {
      Joint* joint = joint_named(fact.joint);
      if (!joint)
        fact.at.fail("there is no moving joint '" + fact.joint + "'", "name one that exists");
      if (!servo_of.insert({fact.joint, &fact}).second) {
        fact.at.fail("joint '" + fact.joint + "' has two servos", "remove one of them");
      }
      joint->servo = fact.servo;
      if (joint->velocity_limit_rad_s > fact.servo.no_load_speed_rad_s) {
        joint->velocity_limit_rad_s = fact.servo.no_load_speed_rad_s;
      }
      joint->lower_rad = fact.lower_rad.value_or(joint->lower_rad);
      joint->upper_rad = fact.upper_rad.value_or(joint->upper_rad);
      check_limits(*joint, fact);
    }
    for (const Joint& joint : e_.joints) {
      if (!servo_of.contains(joint.name)) {
        fail(joint.name, "joint '" + joint.name + "' has no servo",
             "add <verp:servo joint=\"" + joint.name +
                 "\" id=\"...\" type=\"...\"/> to <verp:bus>, or fix the joint");
      }
    }
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
    const Located base = locate(fact.base, fact.at);
    const Located tip = locate(fact.tip, fact.at);
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
    if (fact.name == "left_leg" || fact.name == "right_leg") check_leg(fact, limb, tip.node);
    e_.limbs.push_back(limb);
  }

  void check_leg(const LimbFact& fact, Limb& limb, int foot) const {
    if (limb.joints.size() != 6) {
      fact.at.fail(
          fact.name + " has " + std::to_string(limb.joints.size()) +
              " joints: a foot with all six freedoms needs 6",
          "start the limb at the trunk and end it at the sole; legs of 5 joints are not supported");
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

  void read_sensors() {
    const sdf::Sensor* imu = nullptr;
    for (std::uint64_t l = 0; l < model_.LinkCount(); ++l) {
      const sdf::Link& link = *model_.LinkByIndex(l);
      for (std::uint64_t i = 0; i < link.SensorCount(); ++i) {
        const sdf::Sensor& sensor = *link.SensorByIndex(i);
        const bool is_imu = facts_.imu && sensor.Name() == facts_.imu->sensor;
        if (is_imu) imu = &sensor;
        Located place = locate(link.Name(), facts_.body->at);
        place.pose = place.pose * resolved(sensor.SemanticPose(), link.Name());
        e_.sensors.push_back(
            {sensor.Name(), sensor.TypeStr(), link.Name(), place.node, place.pose});
        if (is_imu) put_imu(place.node, place.pose, &sensor);
      }
    }
    if (facts_.imu && facts_.imu->sensor.empty()) {
      const Located place = locate(facts_.imu->link, facts_.imu->at);
      put_imu(place.node, place.pose * facts_.imu->imu.pose, nullptr);
    } else if (facts_.imu && !imu) {
      facts_.imu->at.fail("there is no sensor '" + facts_.imu->sensor + "'",
                          "name an SDF sensor of type imu");
    }
    if (facts_.feet) e_.feet = facts_.feet->feet;
  }

  void put_imu(int node, const Transform& pose, const sdf::Sensor* sensor) {
    if (sensor && sensor->Type() != sdf::SensorType::IMU) {
      facts_.imu->at.fail("sensor '" + sensor->Name() + "' is not an IMU", "give it type=\"imu\"");
    }
    if (node != 0)
      facts_.imu->at.fail("the IMU is not on the body's link", "mount it on the trunk");
    e_.imu = facts_.imu->imu;
    e_.imu->node = node;
    e_.imu->pose = pose;
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

  void add_notes() {
    for (const InertiaFact& fact : facts_.inertias) {
      e_.notes.push_back("inertia of '" + fact.link + "' times " + fact.at.text("scale", "1") +
                         (fact.com_m ? ", centre of mass at " + fact.at.text("com") : "") + ": " +
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
  Transform model_body_ = Transform::Identity();
  std::map<std::string, RawLink> links_;
  std::map<std::string, const sdf::Joint*> parent_joint_;
  std::map<std::string, std::vector<std::pair<const sdf::Joint*, std::string>>> children_;
  std::vector<Vec3> origin_;  ///< of each node, in the body frame at the zero pose
};

}  // namespace

Entity assemble(const XmlSource& source, const Facts& facts, const sdf::Model& model) {
  return Assembler(source, facts, model).build();
}

}  // namespace verp::model
