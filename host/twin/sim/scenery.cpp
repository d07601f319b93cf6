#include "host/twin/sim/scenery.hpp"

#include <algorithm>
#include <cmath>

#include "host/twin/sim/ode_parts.hpp"

namespace verp::sim {
namespace {

using Kind = model::WorldObject::Kind;
using ShapeKind = model::Shape::Kind;

Surface surface_of(const model::ContactSurface& s) {
  return {.friction = s.friction,
          .stiffness_n_m = s.stiffness_n_m,
          .damping_n_s_m = s.damping_n_s_m,
          .restitution = s.restitution};
}

void place_body(dBodyID body, const Transform& pose, const Vec3& com_m) {
  const Vec3 at = pose * com_m;
  dMatrix3 rotation;
  to_ode(pose.linear(), rotation);
  dBodySetPosition(body, at.x(), at.y(), at.z());
  dBodySetRotation(body, rotation);
}

void place_geom(dGeomID geom, const Transform& pose) {
  const Vec3& at = pose.translation();
  dMatrix3 rotation;
  to_ode(pose.linear(), rotation);
  dGeomSetPosition(geom, at.x(), at.y(), at.z());
  dGeomSetRotation(geom, rotation);
}

/// ODE's heightfields have heights along y.
Mat3 y_up() {
  return Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()).toRotationMatrix();
}

}  // namespace

Transform pose_at(const model::WorldObject& object, double t_s) {
  const std::vector<model::Waypoint>& points = object.waypoints;
  const double first_s = points.front().t_s, last_s = points.back().t_s;
  if (object.loops && t_s > last_s) t_s = first_s + std::fmod(t_s - first_s, last_s - first_s);
  if (t_s <= first_s) return points.front().pose;
  if (t_s >= last_s) return points.back().pose;
  std::size_t next = 1;
  while (points[next].t_s < t_s) ++next;
  const model::Waypoint &a = points[next - 1], &b = points[next];
  const double part = (t_s - a.t_s) / (b.t_s - a.t_s);
  Transform pose = Transform::Identity();
  pose.translation() = a.pose.translation() + part * (b.pose.translation() - a.pose.translation());
  pose.linear() = Eigen::Quaterniond(a.pose.linear())
                      .slerp(part, Eigen::Quaterniond(b.pose.linear()))
                      .toRotationMatrix();
  return pose;
}

Scenery::Scenery(World& world, std::shared_ptr<const model::World> data)
    : world_(world), data_(std::move(data)) {
  for (const model::WorldObject& object : data_->objects) add(object);
  world_.add(*this);
}

Scenery::~Scenery() {
  world_.remove(*this);
  for (const Item& item : items_) {
    for (dGeomID geom : item.geoms) dGeomDestroy(geom);
    if (item.body != nullptr) dBodyDestroy(item.body);
  }
  for (dTriMeshDataID mesh : meshes_) dGeomTriMeshDataDestroy(mesh);
  for (dHeightfieldDataID field : heightfields_) dGeomHeightfieldDataDestroy(field);
}

void Scenery::add(const model::WorldObject& object) {
  Item item{.object = &object, .geoms = {}, .tags = {}};
  int owner = kScenery;
  if (object.kind != Kind::kStatic) {
    item.body = dBodyCreate(world_.ode_world());
    if (object.kind == Kind::kDynamic) {
      owner = world_.new_owner();
      const Mat3& inertia = object.inertia_kg_m2;
      dMass mass;
      dMassSetParameters(&mass, object.mass_kg, 0, 0, 0, inertia(0, 0), inertia(1, 1),
                         inertia(2, 2), inertia(0, 1), inertia(0, 2), inertia(1, 2));
      dBodySetMass(item.body, &mass);
    } else {
      dBodySetKinematic(item.body);
    }
    place_body(item.body, object.pose, object.com_m);
  }
  for (const model::WorldCollision& each : object.collisions) add_shape(item, each, owner);
  items_.push_back(std::move(item));
}

void Scenery::add_shape(Item& item, const model::WorldCollision& collision, int owner) {
  const model::WorldObject& object = *item.object;
  Transform pose = collision.pose;
  dGeomID geom = nullptr;
  if (collision.shape.kind == ShapeKind::kPlane) {
    const Transform world = object.pose * pose;
    const Vec3 normal = world.linear().col(2);
    geom = dCreatePlane(world_.ode_space(), normal.x(), normal.y(), normal.z(),
                        normal.dot(world.translation()));
  } else {
    geom = make_geom(collision.shape);
    if (collision.shape.kind == ShapeKind::kHeightfield) pose.linear() *= y_up();
    if (item.body == nullptr) {
      place_geom(geom, object.pose * pose);
    } else {
      dGeomSetBody(geom, item.body);
      const Vec3 offset = pose.translation() - object.com_m;
      dMatrix3 rotation;
      to_ode(pose.linear(), rotation);
      dGeomSetOffsetPosition(geom, offset.x(), offset.y(), offset.z());
      dGeomSetOffsetRotation(geom, rotation);
    }
  }
  item.geoms.push_back(geom);
  item.tags.push_back(
      &world_.tag(geom, {.owner = owner, .surface = surface_of(collision.surface)}));
}

dGeomID Scenery::make_geom(const model::Shape& shape) {
  const dSpaceID space = world_.ode_space();
  const Vec3& size = shape.size_m;
  switch (shape.kind) {
    case ShapeKind::kSphere:
      return dCreateSphere(space, size.x());
    case ShapeKind::kCylinder:
      return dCreateCylinder(space, size.x(), size.z());
    case ShapeKind::kCapsule:
      return dCreateCapsule(space, size.x(), size.z());
    case ShapeKind::kMesh:
      return make_mesh(*shape.mesh);
    case ShapeKind::kHeightfield:
      return make_heightfield(*shape.heightfield);
    default:
      return dCreateBox(space, size.x(), size.y(), size.z());
  }
}

dGeomID Scenery::make_mesh(const model::Mesh& mesh) {
  std::vector<double>& corners = numbers_.emplace_back();
  std::vector<dTriIndex>& triangles = triangles_.emplace_back();
  for (const Vec3& corner : mesh.vertex_m)
    corners.insert(corners.end(), corner.begin(), corner.end());
  for (const auto& triangle : mesh.triangle)
    triangles.insert(triangles.end(), triangle.begin(), triangle.end());
  meshes_.push_back(dGeomTriMeshDataCreate());
  dGeomTriMeshDataBuildDouble(meshes_.back(), corners.data(), 3 * sizeof(double),
                              static_cast<int>(mesh.vertex_m.size()), triangles.data(),
                              static_cast<int>(triangles.size()), 3 * sizeof(dTriIndex));
  return dCreateTriMesh(world_.ode_space(), meshes_.back(), nullptr, nullptr, nullptr);
}

/// ODE's rows go along z, here -y.
dGeomID Scenery::make_heightfield(const model::Heightfield& field) {
  std::vector<double>& heights = numbers_.emplace_back();
  for (int row = field.rows - 1; row >= 0; --row) {
    for (int column = 0; column < field.columns; ++column) heights.push_back(field.at(column, row));
  }
  constexpr double kThick_m = 1;
  heightfields_.push_back(dGeomHeightfieldDataCreate());
  dGeomHeightfieldDataBuildDouble(heightfields_.back(), heights.data(), 0, field.size_x_m,
                                  field.size_y_m, field.columns, field.rows, 1, 0, kThick_m, 0);
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  dGeomHeightfieldDataSetBounds(heightfields_.back(), *low, *high);
  return dCreateHeightfield(world_.ode_space(), heightfields_.back(), 1);
}

Transform Scenery::pose(std::size_t index) const {
  const Item& item = items_[index];
  if (item.body == nullptr) return item.object->pose;
  Transform pose = Transform::Identity();
  pose.linear() = mat_of(dBodyGetRotation(item.body));
  pose.translation() = vec_of(dBodyGetPosition(item.body)) - pose.linear() * item.object->com_m;
  return pose;
}

std::vector<Transform> Scenery::moving_poses() const {
  std::vector<Transform> poses;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (items_[i].body != nullptr) poses.push_back(pose(i));
  }
  return poses;
}

void Scenery::place(std::size_t index, const Transform& pose_world) {
  const Item& item = items_[index];
  if (item.body != nullptr) place_body(item.body, pose_world, item.object->com_m);
}

/// An object that follows its waypoints pushes others with its speed there.
void Scenery::before_step(double step_s) {
  const double t_s = static_cast<double>(world_.now_us()) * 1e-6;
  for (const Item& item : items_) {
    if (item.object->kind != Kind::kMoving) continue;
    const model::WorldObject& object = *item.object;
    const Transform now = pose_at(object, t_s), then = pose_at(object, t_s + step_s);
    place_body(item.body, now, object.com_m);
    const Vec3 v = (then * object.com_m - now * object.com_m) / step_s;
    const Eigen::AngleAxisd turn(then.linear() * now.linear().transpose());
    const Vec3 w = turn.angle() / step_s * turn.axis();
    dBodySetLinearVel(item.body, v.x(), v.y(), v.z());
    dBodySetAngularVel(item.body, w.x(), w.y(), w.z());
  }
}

WorldOptions furnished(WorldOptions options, model::World file) {
  options.gravity_m_s2 = file.gravity_m_s2.norm();
  if (options.gravity_m_s2 > 0) options.up = -file.gravity_m_s2 / options.gravity_m_s2;
  options.ground = false;
  options.scenery = std::make_shared<model::World>(std::move(file));
  return options;
}

}  // namespace verp::sim
