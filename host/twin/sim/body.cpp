#include "host/twin/sim/body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "host/robot/model/principal.hpp"
#include "host/twin/sim/ode_parts.hpp"

namespace verp::sim {
namespace {

/// Least principal inertia for the engine: a 10 g cube of 8 mm. Imported links may be lighter, and
/// between two joints they would make the solver's matrix singular.
constexpr double kMinInertia = 1e-7;

std::size_t index_of(int i) {
  return static_cast<std::size_t>(i);
}

double lowest_point(const model::Collision& shape, const Transform& link_world) {
  const Transform pose = link_world * shape.pose;
  const Eigen::RowVector3d up = pose.linear().row(2);
  const Vec3& size = shape.size_m;
  const double along = std::abs(up.z()) * size.z() / 2;
  double reach = 0;
  switch (shape.shape) {
    case model::Collision::Shape::kBox:
      reach = std::abs(up.x()) * size.x() / 2 + std::abs(up.y()) * size.y() / 2 + along;
      break;
    case model::Collision::Shape::kSphere:
      reach = size.x();
      break;
    case model::Collision::Shape::kCapsule:
      reach = along + size.x();
      break;
    case model::Collision::Shape::kCylinder:
      reach = along + size.x() * std::sqrt(std::max(0.0, 1 - up.z() * up.z()));
      break;
  }
  return pose.translation().z() - reach;
}

/// Links that never collide with `node`, one bit each.
std::uint64_t passes(const model::Entity& entity, int node) {
  std::uint64_t links = 0;
  const auto pair = [&](int a, int b) {
    if (a == node) links |= std::uint64_t{1} << b;
    if (b == node) links |= std::uint64_t{1} << a;
  };
  for (std::size_t j = 0; j < entity.joints.size(); ++j)
    pair(entity.joints[j].parent, static_cast<int>(j) + 1);
  for (const model::NoCollide& exempt : entity.no_collide) pair(exempt.link, exempt.other);
  return links;
}

void set_pose(dBodyID body, const Transform& pose, const Vec3& com_m) {
  const Vec3 position = pose * com_m;
  dMatrix3 rotation;
  to_ode(pose.linear(), rotation);
  dBodySetPosition(body, position.x(), position.y(), position.z());
  dBodySetRotation(body, rotation);
}

/// Level frame midway between the soles, in body coordinates; z is their mean normal, x their mean
/// heading.
Transform between_soles(const model::Entity& entity, const std::vector<Transform>& link_body) {
  Vec3 normal = Vec3::Zero();
  Vec3 heading = Vec3::Zero();
  Vec3 middle = Vec3::Zero();
  int soles = 0;
  for (int foot = 0; foot < 2; ++foot) {
    const model::Limb* leg = find_leg(entity, foot);
    if (leg == nullptr) continue;
    const Transform sole = link_body[index_of(leg->joints.back() + 1)] * leg->tip;
    normal += sole.linear().col(2);
    heading += sole.linear().col(0);
    middle += sole.translation();
    ++soles;
  }
  Transform frame = Transform::Identity();
  if (soles == 0) return frame;
  const Vec3 z = normal.normalized();
  const Vec3 x = (heading - heading.dot(z) * z).normalized();
  frame.linear() << x, z.cross(x), z;
  frame.translation() = middle / soles;
  return frame;
}

}  // namespace

std::vector<Transform> link_poses(const model::Entity& entity, const Transform& body_world,
                                  const std::vector<double>& joint_rad) {
  std::vector<Transform> pose(entity.nodes.size());
  pose[0] = body_world;
  for (const std::size_t j : outward(entity)) {
    const model::Joint& joint = entity.joints[j];
    pose[j + 1] = pose[index_of(joint.parent)] * Eigen::Translation3d(joint.origin_m) *
                  Eigen::AngleAxisd(joint_rad[j], joint.axis);
  }
  return pose;
}

const model::Limb* find_leg(const model::Entity& entity, int foot) {
  const char* name = foot == 0 ? "left_leg" : "right_leg";
  for (const model::Limb& limb : entity.limbs) {
    if (limb.name == name && !limb.joints.empty()) return &limb;
  }
  return nullptr;
}

Transform resting(const model::Entity& entity, const std::vector<double>& joint_rad,
                  Transform body_world, double gap_m) {
  const std::vector<Transform> pose = link_poses(entity, body_world, joint_rad);
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < entity.nodes.size(); ++n) {
    for (const model::Collision& shape : entity.nodes[n].collisions) {
      lowest = std::min(lowest, lowest_point(shape, pose[n]));
    }
  }
  if (std::isfinite(lowest)) body_world.translation().z() += gap_m - lowest;
  return body_world;
}

Transform standing_pose(const model::Entity& entity, const std::vector<double>& joint_rad,
                        const Vec3& start_m, double yaw_rad, double gap_m) {
  const Transform soles =
      between_soles(entity, link_poses(entity, Transform::Identity(), joint_rad));
  Transform start = Transform::Identity();
  start.linear() = Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()).toRotationMatrix();
  start.translation() = start_m;
  return resting(entity, joint_rad, start * soles.inverse(), gap_m);
}

Body::Body(World& world, const model::Entity& entity, const std::vector<double>& mass_factor,
           int owner)
    : world_(world), entity_(entity), outward_(outward(entity)) {
  const std::vector<double> zero(entity.joints.size(), 0.0);
  const std::vector<Transform> zero_pose = link_poses(entity, Transform::Identity(), zero);
  for (std::size_t n = 0; n < entity.nodes.size(); ++n) {
    make_link(entity.nodes[n], mass_factor[n], static_cast<int>(n), owner);
    set_pose(links_[n].body, zero_pose[n], links_[n].com_m);
  }
  for (std::size_t j = 0; j < entity.joints.size(); ++j) {
    make_hinge(entity.joints[j], static_cast<int>(j), zero_pose);
  }
  angle_rad_ = rate_rad_s_ = zero;
}

Body::~Body() {
  release();
  for (dJointID hinge : hinges_) dJointDestroy(hinge);
  for (dGeomID geom : geoms_) dGeomDestroy(geom);
  for (const Link& link : links_) dBodyDestroy(link.body);
}

void Body::make_link(const model::Node& node, double mass_factor, int index, int owner) {
  if (!(node.mass_kg > 0)) throw std::invalid_argument("link '" + node.name + "' has no mass");
  const Mat3 inertia = node.inertia_kg_m2 * mass_factor + Mat3::Identity() * kMinInertia;
  const Link link{dBodyCreate(world_.ode_world()), node.com_m, node.mass_kg * mass_factor, inertia};
  weigh(link);
  for (const model::Collision& shape : node.collisions) {
    const dGeomID geom = world_.make_shape(shape);
    dGeomSetBody(geom, link.body);
    const Vec3 offset = shape.pose.translation() - node.com_m;
    dGeomSetOffsetPosition(geom, offset.x(), offset.y(), offset.z());
    dMatrix3 rotation;
    to_ode(shape.pose.linear(), rotation);
    dGeomSetOffsetRotation(geom, rotation);
    world_.tag(geom, {owner,
                      index,
                      {shape.friction, shape.stiffness_n_m, shape.damping_n_s_m},
                      passes(entity_, index)});
    geoms_.push_back(geom);
  }
  mass_kg_ += link.mass_kg;
  links_.push_back(link);
}

void Body::weigh(const Link& link) const {
  const Mat3& inertia = link.inertia_kg_m2;
  dMass mass;
  dMassSetParameters(&mass, link.mass_kg, 0, 0, 0, inertia(0, 0), inertia(1, 1), inertia(2, 2),
                     inertia(0, 1), inertia(0, 2), inertia(1, 2));
  dBodySetMass(link.body, &mass);
}

void Body::set_mass(int node, double mass_kg) {
  Link& link = links_[index_of(node)];
  mass_kg_ += mass_kg - link.mass_kg;
  link.inertia_kg_m2 *= mass_kg / link.mass_kg;
  link.mass_kg = mass_kg;
  weigh(link);
}

void Body::set_inertia(int node, int axis, double inertia_kg_m2) {
  Link& link = links_[index_of(node)];
  Mat3 inertia = link.inertia_kg_m2;
  inertia(axis, axis) = inertia_kg_m2;
  if (!(model::principal_moments(inertia)[0] > 0))
    throw std::invalid_argument("that inertia is not positive definite");
  link.inertia_kg_m2 = inertia;
  weigh(link);
}

void Body::move(const Transform& by_world) {
  for (std::size_t n = 0; n < links_.size(); ++n) {
    set_pose(links_[n].body, by_world * link_pose(static_cast<int>(n)), links_[n].com_m);
  }
  if (held()) dJointSetFixed(hold_);
}

void Body::add_velocity(const Vec3& linear_world_m_s, const Vec3& angular_world_rad_s) {
  const Vec3 origin = link_pose(0).translation();
  for (const Link& link : links_) {
    const dReal* at = dBodyGetPosition(link.body);
    const dReal* v = dBodyGetLinearVel(link.body);
    const dReal* w = dBodyGetAngularVel(link.body);
    const Vec3 arm = Vec3(at[0], at[1], at[2]) - origin;
    const Vec3 more = linear_world_m_s + angular_world_rad_s.cross(arm);
    dBodySetLinearVel(link.body, v[0] + more.x(), v[1] + more.y(), v[2] + more.z());
    dBodySetAngularVel(link.body, w[0] + angular_world_rad_s.x(), w[1] + angular_world_rad_s.y(),
                       w[2] + angular_world_rad_s.z());
  }
}

std::vector<GeomTag*> Body::tags(int node) const {
  std::vector<GeomTag*> tags;
  for (dGeomID geom = dBodyGetFirstGeom(ode_body(node)); geom != nullptr;
       geom = dBodyGetNextGeom(geom)) {
    tags.push_back(static_cast<GeomTag*>(dGeomGetData(geom)));
  }
  return tags;
}

void Body::make_hinge(const model::Joint& joint, int index,
                      const std::vector<Transform>& zero_pose) {
  const dJointID hinge = dJointCreateHinge(world_.ode_world(), nullptr);
  dJointAttach(hinge, links_[index_of(index + 1)].body, links_[index_of(joint.parent)].body);
  const Vec3 anchor = zero_pose[index_of(index + 1)].translation();
  dJointSetHingeAnchor(hinge, anchor.x(), anchor.y(), anchor.z());
  dJointSetHingeAxis(hinge, joint.axis.x(), joint.axis.y(), joint.axis.z());
  hinges_.push_back(hinge);
}

void Body::place(const Transform& body_world, const std::vector<double>& joint_rad) {
  const std::vector<Transform> pose = link_poses(entity_, body_world, joint_rad);
  for (std::size_t n = 0; n < links_.size(); ++n) {
    set_pose(links_[n].body, pose[n], links_[n].com_m);
    dBodySetLinearVel(links_[n].body, 0, 0, 0);
    dBodySetAngularVel(links_[n].body, 0, 0, 0);
  }
  angle_rad_ = joint_rad;
  std::fill(rate_rad_s_.begin(), rate_rad_s_.end(), 0.0);
}

void Body::read_joints() {
  for (std::size_t j = 0; j < hinges_.size(); ++j) {
    const double turn = dJointGetHingeAngle(hinges_[j]) - angle_rad_[j];
    angle_rad_[j] += std::remainder(turn, 2 * std::numbers::pi);
    rate_rad_s_[j] = dJointGetHingeAngleRate(hinges_[j]);
  }
}

void Body::drive(int joint, const Drive& drive) {
  // ODE solves rate = speed - CFM * torque: the torque-speed line. A constant torque is a very flat
  // line.
  constexpr double kLeastSlope = 1e-6;
  const dJointID hinge = hinges_[index_of(joint)];
  const bool idle = drive.standstill_n_m == 0 && drive.slope_n_m_s <= 0;
  const double slope = std::max(drive.slope_n_m_s, kLeastSlope);
  dJointSetHingeParam(hinge, dParamVel, drive.standstill_n_m / slope);
  dJointSetHingeParam(hinge, dParamCFM, 1.0 / slope);
  dJointSetHingeParam(hinge, dParamFMax, idle ? 0 : dInfinity);
}

void Body::meter(int joint) {
  const dJointID hinge = hinges_[index_of(joint)];
  if (dJointGetFeedback(hinge) != nullptr) return;
  dJointSetFeedback(hinge, &feedback_.emplace_back());
}

/// ODE refers them to the link's centre of mass.
JointLoad Body::load(int joint) const {
  const dJointFeedback* given = dJointGetFeedback(hinges_[index_of(joint)]);
  if (given == nullptr) return {};
  const dReal* centre = dBodyGetPosition(links_[index_of(joint + 1)].body);
  return {{centre[0], centre[1], centre[2]},
          {given->f1[0], given->f1[1], given->f1[2]},
          {given->t1[0], given->t1[1], given->t1[2]}};
}

std::vector<double> Body::inertias_kg_m2() const {
  // Sums of each link and those beyond it, about the body's origin.
  struct Sum {
    double mass_kg = 0;
    Vec3 moment_kg_m = Vec3::Zero();
    Mat3 inertia_kg_m2 = Mat3::Zero();
  };
  const Vec3 origin = link_pose(0).translation();
  std::vector<Sum> beyond(links_.size());
  std::vector<double> inertia(hinges_.size());
  for (auto j = outward_.rbegin(); j != outward_.rend(); ++j) {
    const std::size_t n = *j + 1;
    const Link& link = links_[n];
    const Transform pose = link_pose(static_cast<int>(n));
    const Vec3 com = pose * link.com_m - origin;
    Sum& sum = beyond[n];
    sum.mass_kg += link.mass_kg;
    sum.moment_kg_m += link.mass_kg * com;
    sum.inertia_kg_m2 +=
        pose.linear() * link.inertia_kg_m2 * pose.linear().transpose() +
        link.mass_kg * (com.squaredNorm() * Mat3::Identity() - com * com.transpose());
    const model::Joint& joint = entity_.joints[n - 1];
    const Vec3 axis = pose.linear() * joint.axis;
    const Vec3 arm = axis.cross(pose.translation() - origin);
    inertia[n - 1] = axis.dot(sum.inertia_kg_m2 * axis) + sum.mass_kg * arm.squaredNorm() -
                     2 * arm.dot(axis.cross(sum.moment_kg_m));
    Sum& parent = beyond[index_of(joint.parent)];
    parent.mass_kg += sum.mass_kg;
    parent.moment_kg_m += sum.moment_kg_m;
    parent.inertia_kg_m2 += sum.inertia_kg_m2;
  }
  return inertia;
}

void Body::hold() {
  if (held()) return;
  hold_ = dJointCreateFixed(world_.ode_world(), nullptr);
  dJointAttach(hold_, links_[0].body, nullptr);
  dJointSetFixed(hold_);
}

void Body::release() {
  if (!held()) return;
  dJointDestroy(hold_);
  hold_ = nullptr;
}

std::vector<Transform> Body::links_world() const {
  std::vector<Transform> poses;
  for (std::size_t node = 0; node < links_.size(); ++node)
    poses.push_back(link_pose(static_cast<int>(node)));
  return poses;
}

Transform Body::link_pose(int node) const {
  const Link& link = links_[index_of(node)];
  Transform pose = Transform::Identity();
  pose.linear() = mat_of(dBodyGetRotation(link.body));
  pose.translation() = vec_of(dBodyGetPosition(link.body)) - pose.linear() * link.com_m;
  return pose;
}

Vec3 Body::angular_velocity_world_rad_s(int node) const {
  return vec_of(dBodyGetAngularVel(links_[index_of(node)].body));
}

Vec3 Body::point_velocity_world_m_s(int node, const Vec3& point_world_m) const {
  dVector3 v;
  dBodyGetPointVel(links_[index_of(node)].body, point_world_m.x(), point_world_m.y(),
                   point_world_m.z(), v);
  return vec_of(v);
}

Vec3 Body::com_world_m() const {
  Vec3 sum = Vec3::Zero();
  for (const Link& link : links_) sum += link.mass_kg * vec_of(dBodyGetPosition(link.body));
  return sum / mass_kg_;
}

Vec3 Body::com_velocity_world_m_s() const {
  Vec3 sum = Vec3::Zero();
  for (const Link& link : links_) sum += link.mass_kg * vec_of(dBodyGetLinearVel(link.body));
  return sum / mass_kg_;
}

}  // namespace verp::sim
