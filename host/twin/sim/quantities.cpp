#include "host/twin/sim/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "host/twin/sim/ode_parts.hpp"

namespace verp::sim {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

Thing thing_of(TwinRobot& robot, const std::string& prefix, int node) {
  Body& body = robot.body();
  Thing thing;
  thing.name = prefix + robot.entity().nodes[static_cast<std::size_t>(node)].name;
  thing.body = body.ode_body(node);
  thing.tags = body.tags(node);
  thing.pose = [&body, node] { return body.link_pose(node); };
  thing.set_mass = [&body, node](double mass_kg) { body.set_mass(node, mass_kg); };
  thing.set_inertia = [&body, node](int axis, double inertia_kg_m2) {
    body.set_inertia(node, axis, inertia_kg_m2);
  };
  if (node != 0) return thing;
  thing.move = [&body](const Transform& by) { body.move(by); };
  thing.add_velocity = [&body](const Vec3& v, const Vec3& w) { body.add_velocity(v, w); };
  return thing;
}

Thing thing_of(Scenery& scenery, std::size_t index) {
  const Scenery::Item& item = scenery.items()[index];
  const dBodyID body = item.body;
  Thing thing;
  thing.name = item.object->name;
  thing.body = body;
  thing.tags = item.tags;
  thing.pose = [&scenery, index] { return scenery.pose(index); };
  thing.set_mass = [body](double mass_kg) {
    dMass mass;
    dBodyGetMass(body, &mass);
    dMassAdjust(&mass, mass_kg);
    dBodySetMass(body, &mass);
  };
  thing.set_inertia = [body](int axis, double inertia_kg_m2) {
    dMass mass;
    dBodyGetMass(body, &mass);
    mass.I[5 * axis] = inertia_kg_m2;
    dBodySetMass(body, &mass);
  };
  thing.move = [&scenery, index](const Transform& by) {
    scenery.place(index, by * scenery.pose(index));
  };
  thing.add_velocity = [body](const Vec3& linear, const Vec3& angular) {
    const Vec3 v = vec_of(dBodyGetLinearVel(body)) + linear;
    const Vec3 w = vec_of(dBodyGetAngularVel(body)) + angular;
    dBodySetLinearVel(body, v.x(), v.y(), v.z());
    dBodySetAngularVel(body, w.x(), w.y(), w.z());
  };
  return thing;
}

/// Share of a speed that ODE removes in each step.
double lost_per_step(double damping_1_s, double step_s) {
  return -std::expm1(-damping_1_s * step_s);
}

}  // namespace

Quantities::Quantities(World& world) : world_(world) {
  world.add(*this);
  for (Quantity& each : quantities_of(world)) all_.push_back(std::move(each));
}

Quantities::~Quantities() {
  world_.remove(*this);
}

Thing& Quantities::add_thing(Thing thing) {
  Thing& added = things_.emplace_back(std::move(thing));
  added.velocity_m_s = vec_of(dBodyGetLinearVel(added.body));
  added.rate_rad_s = vec_of(dBodyGetAngularVel(added.body));
  for (Quantity& each : quantities_of(added, world_)) all_.push_back(std::move(each));
  return added;
}

void Quantities::add(TwinRobot& robot, const std::string& prefix) {
  const model::Entity& entity = robot.entity();
  for (Quantity& each : quantities_of(prefix + "robot", robot, world_))
    all_.push_back(std::move(each));
  for (std::size_t n = 0; n < entity.nodes.size(); ++n)
    add_thing(thing_of(robot, prefix, static_cast<int>(n)));
  for (std::size_t j = 0; j < entity.joints.size(); ++j) {
    const std::string name = prefix + entity.joints[j].name;
    for (Quantity& each : quantities_of(name, robot, static_cast<int>(j)))
      all_.push_back(std::move(each));
  }
}

void Quantities::add(Scenery& scenery) {
  for (std::size_t i = 0; i < scenery.items().size(); ++i) {
    const Scenery::Item& item = scenery.items()[i];
    if (item.object->kind == model::WorldObject::Kind::kDynamic) {
      add_thing(thing_of(scenery, i));
      continue;
    }
    for (Quantity& each : surface_quantities(item.object->name, item.tags))
      all_.push_back(std::move(each));
  }
}

const Quantity* Quantities::find(const std::string& name) const {
  const auto found =
      std::find_if(all_.begin(), all_.end(), [&](const Quantity& q) { return q.name == name; });
  return found == all_.end() ? nullptr : &*found;
}

std::vector<std::string> Quantities::names() const {
  std::vector<std::string> names;
  for (const Quantity& each : all_) names.push_back(each.name);
  return names;
}

std::vector<std::string> Quantities::things() const {
  std::vector<std::string> names;
  for (const Thing& each : things_) names.push_back(each.name);
  return names;
}

const Quantity& Quantities::get(const std::string& name) const {
  const Quantity* found = find(name);
  if (found == nullptr) throw std::invalid_argument("there is no quantity '" + name + "'");
  return *found;
}

double Quantities::read(const std::string& name) const {
  return get(name).read();
}

void Quantities::check(const std::string& name, double value) const {
  const Quantity& quantity = get(name);
  if (!quantity.settable()) throw std::invalid_argument("'" + name + "' can only be read");
  if (value >= quantity.low && value <= quantity.high) return;
  const std::string unit = quantity.unit.empty() ? "" : " " + quantity.unit;
  throw std::invalid_argument("'" + name + "' is " + number(quantity.low) + " to " +
                              number(quantity.high) + unit + ", not " + number(value));
}

void Quantities::set(const std::string& name, double value) {
  check(name, value);
  get(name).set(value);
}

Thing* Quantities::thing(const std::string& name) {
  for (Thing& each : things_) {
    if (each.name == name) return &each;
  }
  return nullptr;
}

void Quantities::check_push(const std::string& name) const {
  const auto is_it = [&](const Thing& each) { return each.name == name; };
  if (std::any_of(things_.begin(), things_.end(), is_it)) return;
  throw std::invalid_argument("there is no link or object '" + name + "' that moves");
}

void Quantities::push(const std::string& name, const Vec3& force_world_n, double for_s) {
  check_push(name);
  const auto for_us = static_cast<std::uint64_t>(std::llround(1e6 * for_s));
  pushes_.push_back({thing(name), force_world_n, world_.now_us() + for_us});
}

void Quantities::before_step(double step_s) {
  for (Thing& each : things_) {
    each.applied_n = each.force_world_n + each.impulse_world_n_s / step_s;
    each.applied_n_m = each.torque_world_n_m;
    each.impulse_world_n_s = Vec3::Zero();
  }
  std::erase_if(pushes_, [&](const Push& push) { return push.until_us <= world_.now_us(); });
  for (const Push& push : pushes_) push.thing->applied_n += push.force_world_n;
  for (Thing& each : things_) {
    const Vec3 &force = each.applied_n, &torque = each.applied_n_m;
    each.given_n_s += force * step_s;
    if (!force.isZero(0)) dBodyAddForce(each.body, force.x(), force.y(), force.z());
    if (!torque.isZero(0)) dBodyAddTorque(each.body, torque.x(), torque.y(), torque.z());
    if (each.linear_damping_1_s > 0)
      dBodySetLinearDamping(each.body, lost_per_step(each.linear_damping_1_s, step_s));
    if (each.angular_damping_1_s > 0)
      dBodySetAngularDamping(each.body, lost_per_step(each.angular_damping_1_s, step_s));
  }
}

void Quantities::after_step(double step_s) {
  for (Thing& each : things_) {
    const Vec3 v = vec_of(dBodyGetLinearVel(each.body));
    const Vec3 w = vec_of(dBodyGetAngularVel(each.body));
    each.acceleration_m_s2 = (v - each.velocity_m_s) / step_s;
    each.angular_rad_s2 = (w - each.rate_rad_s) / step_s;
    each.velocity_m_s = v;
    each.rate_rad_s = w;
  }
}

}  // namespace verp::sim
