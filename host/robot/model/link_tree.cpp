#include "host/robot/model/link_tree.hpp"

#include <algorithm>
#include <limits>

#include "common/io/io.hpp"
#include "host/robot/model/bounds.hpp"
#include "host/robot/model/couplings.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/sdf_parts.hpp"
#include "host/robot/model/visuals.hpp"

namespace verp::model {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Mat3 steiner(double mass_kg, const Vec3& d) {
  return mass_kg * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
}

}  // namespace

void fail_at(const XmlSource& source, const std::string& about, const std::string& message,
             const std::string& fix) {
  const XmlSource::Place place = source.blame(about);
  throw LoadError(place.file, place.line, message, fix);
}

void LinkTree::grow() {
  read_links();
  read_joints();
  place_links();
  std::vector<std::string> from = {source_.path()};
  for (const XmlElement& urdf : source_.urdfs()) from.push_back(urdf.file());
  const PictureFiles files(std::move(from));
  for (auto& [name, link] : links_) {
    attach_shapes(link);
    attach_looks(link, files);
  }
  add_boxes();
  check_inertias();
}

void LinkTree::read_links() {
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
    if (names_.massless_links.contains(sdf.Name())) {
      link.mass_kg = 0;
      link.inertia_kg_m2 = Mat3::Zero();
    }
    links_[sdf.Name()] = link;
  }
}

bool LinkTree::is_urdf_link(const std::string& name) const {
  const auto place = source_.find(name);
  return place && place->file != source_.path();
}

bool LinkTree::is_of_urdf(const std::string& link) const {
  const auto urdfs = source_.urdfs();
  return std::any_of(urdfs.begin(), urdfs.end(), [&](const XmlElement& urdf) {
    const auto links = urdf.children("link");
    return std::any_of(links.begin(), links.end(),
                       [&](const XmlElement& each) { return each.text("name", "") == link; });
  });
}

double LinkTree::inertia_scale(const std::string& link) const {
  double scale = 1;
  for (const InertiaFact& fact : facts_.inertias) {
    if (fact.link == link && fact.ball_m) return fact.scale;  // "*" is about the file's moments
    if (fact.link == "*" || fact.link == link) scale *= fact.scale;
  }
  return scale;
}

std::optional<Vec3> LinkTree::corrected_com(const std::string& link) const {
  std::optional<Vec3> com_m;
  for (const InertiaFact& fact : facts_.inertias) {
    if (fact.link == link && fact.com_m) com_m = fact.com_m;
  }
  return com_m;
}

void LinkTree::read_joints() {
  for (std::uint64_t i = 0; i < model_.JointCount(); ++i) {
    const sdf::Joint& joint = *model_.JointByIndex(i);
    std::string parent, child;
    joint.ResolveParentLink(parent);
    joint.ResolveChildLink(child);
    if (parent == "world") {
      fail(joint.Name(), "joint '" + joint.Name() + "' ties the robot to the world", "remove it");
    }
    if (joint.Type() != sdf::JointType::REVOLUTE && !is_fixed(joint)) {
      const std::string& name = names_.joint_name(joint.Name());
      fail(name, "joint '" + name + "' is neither revolute nor fixed",
           "model it as a revolute joint with limits, or add <verp:fix joint=\"" + name +
               "\" reason=\"...\"/>");
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
  std::vector<std::string> turning, fixed;
  for (std::uint64_t i = 0; i < model_.JointCount(); ++i) {
    const sdf::Joint& joint = *model_.JointByIndex(i);
    (is_fixed(joint) ? fixed : turning).push_back(names_.joint_name(joint.Name()));
  }
  check_mimics(facts_, turning, fixed);
}

void LinkTree::check_fixes() const {
  for (const FixFact& fix : facts_.fixes) {
    const sdf::Joint* joint = nullptr;
    for (std::uint64_t i = 0; i < model_.JointCount(); ++i) {
      const sdf::Joint* const each = model_.JointByIndex(i);
      if (fix.fixes(names_.joint_name(each->Name()))) joint = each;
    }
    if (!joint) fix.at.fail("there is no joint '" + fix.joint + "'", "name one that exists");
    if (joint->Type() == sdf::JointType::REVOLUTE || fix.rad == 0) continue;
    fix.at.fail("joint '" + fix.joint + "' does not turn", "leave rad out");
  }
}

bool LinkTree::is_fixed(const sdf::Joint& joint) const {
  return joint.Type() == sdf::JointType::FIXED ||
         facts_.fix_of(names_.joint_name(joint.Name())) != nullptr;
}

/// Joints without a servo come last: a bus sees the others as one block.
void LinkTree::put_followers_last() {
  std::vector<std::size_t> order;  // old joint indices
  for (const bool follower : {false, true}) {
    for (std::size_t j = 0; j < e_.joints.size(); ++j) {
      if ((facts_.mimic_of(e_.joints[j].name) != nullptr) == follower) order.push_back(j);
    }
  }
  std::vector<int> node_of(e_.nodes.size(), 0);
  std::vector<Node> nodes = {e_.nodes[0]};
  std::vector<Joint> joints;
  std::vector<Vec3> origin = {origin_[0]};
  for (const std::size_t j : order) {
    node_of[j + 1] = static_cast<int>(nodes.size());
    nodes.push_back(std::move(e_.nodes[j + 1]));
    joints.push_back(std::move(e_.joints[j]));
    origin.push_back(origin_[j + 1]);
  }
  for (Joint& joint : joints) {
    joint.parent = node_of[static_cast<std::size_t>(joint.parent)];
    const MimicFact* const mimic = facts_.mimic_of(joint.name);
    if (mimic == nullptr) continue;
    const auto driver = std::find_if(joints.begin(), joints.end(),
                                     [&](const Joint& each) { return each.name == mimic->driver; });
    joint.follows = static_cast<int>(driver - joints.begin());
    joint.ratio = mimic->multiplier;
    joint.offset_rad = mimic->offset_rad;
  }
  for (auto& [name, link] : links_) link.node = node_of[static_cast<std::size_t>(link.node)];
  e_.nodes = std::move(nodes);
  e_.joints = std::move(joints);
  origin_ = std::move(origin);
}

/// Transform of everything beyond a fixed joint; `turned`: the joint itself.
Transform LinkTree::turn_of(const sdf::Joint& joint, const Transform& turned) const {
  const FixFact* const fix = facts_.fix_of(names_.joint_name(joint.Name()));
  if (fix == nullptr || fix->rad == 0) return turned;
  const Vec3 at = (model_body_.inverse() * model_pose(joint.SemanticPose())).translation();
  return turned * Eigen::Translation3d(at) * Eigen::AngleAxisd(fix->rad, axis_of(joint)) *
         Eigen::Translation3d(-at);
}

/// Node 0: the body and links fixed to it; then depth first, in file order.
void LinkTree::place_links() {
  std::string top = facts_.body->link;
  while (parent_joint_.contains(top)) {
    const sdf::Joint& joint = *parent_joint_[top];
    if (!is_fixed(joint)) {
      facts_.body->at.fail("link '" + facts_.body->link + "' hangs on joint '" + joint.Name() + "'",
                           "name the link at the root of the tree");
    }
    joint.ResolveParentLink(top);
  }
  add_node(facts_.body->link, Vec3::Zero());
  check_fixes();
  place_link(top, 0, Transform::Identity());
  for (const auto& [name, link] : links_) {
    if (link.node < 0) {
      fail(name, "link '" + name + "' is not connected to '" + facts_.body->link + "'",
           "add its joint");
    }
  }
  put_followers_last();
  if (e_.joints.size() > kMaxJoints) {
    facts_.body->at.fail("the robot has " + std::to_string(e_.joints.size()) + " joints",
                         "at most " + std::to_string(kMaxJoints) + " fit: fix some");
  }
}

void LinkTree::place_link(const std::string& name, int node, const Transform& turned) {
  RawLink& link = links_.at(name);
  link.node = node;
  link.turned = turned;
  link.pose = turned * link.pose;
  link.com_m = turned * link.com_m;
  link.inertia_kg_m2 = turned.linear() * link.inertia_kg_m2 * turned.linear().transpose();
  lump(e_.nodes[static_cast<std::size_t>(node)], link, origin_[static_cast<std::size_t>(node)]);
  for (const auto& [joint, child] : children_[name]) {
    if (is_fixed(*joint)) {
      place_link(child, node, turn_of(*joint, turned));
    } else {
      place_link(child, add_joint(*joint, child, node, turned), turned);
    }
  }
}

void LinkTree::lump(Node& node, const RawLink& link, const Vec3& origin) {
  const double total = node.mass_kg + link.mass_kg;
  if (total <= 0) return;
  const Vec3 com = link.com_m - origin;
  const Vec3 mean = (node.mass_kg * node.com_m + link.mass_kg * com) / total;
  node.inertia_kg_m2 += link.inertia_kg_m2 + steiner(node.mass_kg, node.com_m - mean) +
                        steiner(link.mass_kg, com - mean);
  node.com_m = mean;
  node.mass_kg = total;
}

Vec3 LinkTree::axis_of(const sdf::Joint& joint) const {
  if (joint.Axis() == nullptr) {
    const std::string& name = names_.joint_name(joint.Name());
    fail(name, "joint '" + name + "' turns about no axis",
         "give it <axis><xyz>x y z</xyz></axis>, or type=\"fixed\"");
  }
  ignition::math::Vector3d direction;
  joint.Axis()->ResolveXyz(direction, "__model__");
  return snapped(model_body_.linear().transpose() * to_vector(direction));
}

int LinkTree::add_joint(const sdf::Joint& sdf, const std::string& child, int parent,
                        const Transform& turned) {
  const Transform pose = turned * model_body_.inverse() * model_pose(sdf.SemanticPose());
  Joint joint;
  joint.name = names_.joint_name(sdf.Name());
  joint.parent = parent;
  joint.origin_m = pose.translation() - origin_[static_cast<std::size_t>(parent)];
  joint.axis = snapped(turned.linear() * axis_of(sdf));
  const sdf::JointAxis& axis = *sdf.Axis();
  joint.lower_rad = axis.Lower();
  joint.upper_rad = axis.Upper();
  joint.velocity_limit_rad_s = axis.MaxVelocity() > 0 ? axis.MaxVelocity() : kInfinity;
  if (joint.velocity_limit_rad_s < kLeastSpeed_rad_s) {
    fail(joint.name,
         "joint '" + joint.name + "' may hardly move: its velocity limit is " +
             std::to_string(joint.velocity_limit_rad_s) + " rad/s",
         "raise <velocity> to 0.01 or more, or leave it out: the servo's own speed holds then");
  }
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

void LinkTree::add_node(const std::string& name, const Vec3& origin) {
  e_.nodes.emplace_back().name = name;
  origin_.push_back(origin);
}

/// Files write pi as 3.14159: within 0.1 mrad an axis is a body axis.
Vec3 LinkTree::snapped(const Vec3& axis) {
  constexpr double kTolerance = 1e-4;
  for (int i = 0; i < 3; ++i) {
    const Vec3 unit = Vec3::Unit(i);
    if ((axis - unit).norm() < kTolerance) return unit;
    if ((axis + unit).norm() < kTolerance) return Vec3::Zero() - unit;  // no negative zeros
  }
  return axis.normalized();
}

void LinkTree::attach_shapes(const RawLink& link) {
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
    if (least_measure(collision) < kLeastLength_m) {
      fail(sdf.Name(),
           "collision '" + sdf.Name() + "' of link '" + link.sdf->Name() +
               "' is thinner than 0.1 mm",
           "write its size in metres");
    }
    add_collision(link.node, link.pose * resolved(sdf.SemanticPose(), link.sdf->Name()), collision);
  }
}

void LinkTree::attach_looks(const RawLink& link, const PictureFiles& files) {
  for (Visual& visual : read_visuals(*link.sdf, files)) {
    visual.pose = link.pose * visual.pose;
    visual.pose.translation() -= origin_[static_cast<std::size_t>(link.node)];
    e_.nodes[static_cast<std::size_t>(link.node)].visuals.push_back(std::move(visual));
  }
}

void LinkTree::add_collision(int node, Transform body_pose, Collision collision) {
  body_pose.translation() -= origin_[static_cast<std::size_t>(node)];
  collision.pose = body_pose;
  e_.nodes[static_cast<std::size_t>(node)].collisions.push_back(collision);
}

LinkTree::Located LinkTree::locate(const std::string& name, const XmlElement& at) const {
  std::string link_name = name;
  Transform pose = Transform::Identity();
  if (const sdf::Frame* frame = model_.FrameByName(name)) {
    frame->ResolveAttachedToBody(link_name);
    pose = links_.at(link_name).turned * model_body_.inverse() * model_pose(frame->SemanticPose());
  } else if (links_.contains(name)) {
    pose = links_.at(name).pose;
  } else {
    at.fail("there is no link or frame '" + name + "'", "name one that exists");
  }
  const int node = links_.at(link_name).node;
  pose.translation() -= origin_[static_cast<std::size_t>(node)];
  return {node, pose};
}

void LinkTree::add_boxes() {
  for (const BoxFact& fact : facts_.boxes) {
    const Located place = locate(fact.frame, fact.at);
    Collision box = fact.box;
    box.pose = place.pose * box.pose;
    e_.nodes[static_cast<std::size_t>(place.node)].collisions.push_back(box);
  }
}

void LinkTree::check_inertias() const {
  for (const InertiaFact& fact : facts_.inertias) {
    if (fact.link != "*") locate(fact.link, fact.at);
    if (fact.ball_m && !is_of_urdf(fact.link)) {
      fact.at.fail("<verp:inertia> ball_m: link '" + fact.link + "' is in no URDF",
                   "correct its <inertial>");
    }
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

}  // namespace verp::model
