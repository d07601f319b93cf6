#include <cmath>
#include <numbers>

#include "host/robot/model/principal.hpp"
#include "host/twin/sim/ode_parts.hpp"
#include "host/twin/sim/quantities.hpp"

namespace verp::sim {
namespace {

constexpr double kFar_m = 1000, kFast_m_s = 100, kFastTurn_rad_s = 1000, kStrong_n = 1e5;
constexpr double kTurn_rad = 2 * std::numbers::pi;
constexpr const char* kAxes[] = {".x", ".y", ".z"};

Vec3 along(int axis, double value) {
  return value * Vec3::Unit(axis);
}

/// Three quantities, one per world axis.
struct Vector {
  std::string name, unit, what;
  double most = 0;
  std::function<Vec3()> read;
  std::function<void(int axis, double value)> set = {};
};

void add(std::vector<Quantity>& out, const Vector& v) {
  for (int axis = 0; axis < 3; ++axis) {
    Quantity q{v.name + kAxes[axis],
               v.unit,
               v.what,
               -v.most,
               v.most,
               [read = v.read, axis] { return read()[axis]; },
               {}};
    if (v.set) q.set = [set = v.set, axis](double value) { set(axis, value); };
    out.push_back(std::move(q));
  }
}

Vec3 gravity_of(dBodyID body) {
  dVector3 gravity;
  dWorldGetGravity(dBodyGetWorld(body), gravity);
  return vec_of(gravity);
}

double mass_of(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  return mass.mass;
}

Mat3 inertia_of(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  return mat_of(mass.I);
}

Mat3 rotation_of(dBodyID body) {
  return mat_of(dBodyGetRotation(body));
}

Vec3 spin_of(dBodyID body) {
  const Mat3 rotation = rotation_of(body);
  return rotation * inertia_of(body) * rotation.transpose() * vec_of(dBodyGetAngularVel(body));
}

double kinetic_j(dBodyID body) {
  return (mass_of(body) * vec_of(dBodyGetLinearVel(body)).squaredNorm() +
          vec_of(dBodyGetAngularVel(body)).dot(spin_of(body))) /
         2;
}

/// Above the world's origin.
double potential_j(dBodyID body) {
  return -mass_of(body) * gravity_of(body).dot(vec_of(dBodyGetPosition(body)));
}

Vec3 angles_of(const Transform& pose) {
  return roll_pitch_yaw(pose.linear());
}

Quantity read_only(std::string name, const char* unit, const char* what,
                   std::function<double()> read) {
  return {std::move(name), unit, what, 0, 0, std::move(read), {}};
}

/// Turns the thing about its own origin until one of its angles has this value.
void turn_to(const Thing& thing, int axis, double value_rad) {
  const Transform now = thing.pose();
  Vec3 rpy = angles_of(now);
  rpy[axis] = value_rad;
  Transform goal = now;
  goal.linear() = model::rotation_rpy(rpy);
  thing.move(goal * now.inverse());
}

void add_pose(std::vector<Quantity>& out, Thing& t) {
  Vector position{t.name + ".position_m", "m", "where it is", kFar_m,
                  [&t] { return Vec3(t.pose().translation()); }};
  Vector velocity{t.name + ".velocity_m_s", "m/s", "of its centre of mass", kFast_m_s,
                  [&t] { return vec_of(dBodyGetLinearVel(t.body)); }};
  Vector rate{t.name + ".angular_velocity_rad_s", "rad/s", "how it turns", kFastTurn_rad_s,
              [&t] { return vec_of(dBodyGetAngularVel(t.body)); }};
  if (t.move) {
    position.set = [&t](int axis, double value) {
      Transform by = Transform::Identity();
      by.translation() = along(axis, value - t.pose().translation()[axis]);
      t.move(by);
    };
    velocity.set = [&t, read = velocity.read](int axis, double value) {
      t.add_velocity(along(axis, value - read()[axis]), Vec3::Zero());
    };
    rate.set = [&t, read = rate.read](int axis, double value) {
      t.add_velocity(Vec3::Zero(), along(axis, value - read()[axis]));
    };
  }
  add(out, position);
  const char* angles[] = {".roll_rad", ".pitch_rad", ".yaw_rad"};
  for (int axis = 0; axis < 3; ++axis) {
    Quantity q{t.name + angles[axis],
               "rad",
               "how it lies",
               -kTurn_rad,
               kTurn_rad,
               [&t, axis] { return angles_of(t.pose())[axis]; },
               {}};
    if (t.move) q.set = [&t, axis](double value) { turn_to(t, axis, value); };
    out.push_back(std::move(q));
  }
  add(out, velocity);
  add(out, rate);
  add(out, {t.name + ".acceleration_m_s2", "m/s^2", "of its centre of mass, in the last step", 0,
            [&t] { return t.acceleration_m_s2; }});
  add(out, {t.name + ".angular_acceleration_rad_s2", "rad/s^2", "in the last step", 0,
            [&t] { return t.angular_rad_s2; }});
}

void add_forces(std::vector<Quantity>& out, Thing& t, const World& world) {
  add(out, {t.name + ".force_n", "N",
            "applied at its centre of mass, besides gravity, contacts and joints", kStrong_n,
            [&t] { return t.applied_n; },
            [&t](int axis, double value) { t.force_world_n[axis] = value; }});
  add(out,
      {t.name + ".torque_n_m", "N m", "applied likewise", kStrong_n, [&t] { return t.applied_n_m; },
       [&t](int axis, double value) { t.torque_world_n_m[axis] = value; }});
  add(out, {t.name + ".impulse_n_s", "N s",
            "given by applied forces so far; setting it gives one more, in one step", kStrong_n,
            [&t] { return t.given_n_s; },
            [&t](int axis, double value) { t.impulse_world_n_s[axis] += value; }});
  add(out, {t.name + ".contact_force_n", "N", "of all that touches it, in the last step", 0,
            [&t, &world] {
              Vec3 sum = Vec3::Zero();
              for (const Contact& each : world.contacts()) {
                const bool it = !t.tags.empty() && each.owner == t.tags[0]->owner &&
                                each.node == t.tags[0]->node;
                if (it) sum += each.force_world_n;
              }
              return sum;
            }});
}

void add_matter(std::vector<Quantity>& out, Thing& t) {
  add(out, {t.name + ".momentum_kg_m_s", "kg m/s", "mass times velocity", 0,
            [&t] { return Vec3(mass_of(t.body) * vec_of(dBodyGetLinearVel(t.body))); }});
  add(out, {t.name + ".angular_momentum_kg_m2_s", "kg m^2/s", "about its centre of mass", 0,
            [&t] { return spin_of(t.body); }});
  out.push_back(read_only(t.name + ".kinetic_energy_j", "J", "of motion and of turning",
                          [&t] { return kinetic_j(t.body); }));
  out.push_back(read_only(t.name + ".potential_energy_j", "J",
                          "in gravity, from the world's origin",
                          [&t] { return potential_j(t.body); }));
  out.push_back({t.name + ".mass_kg", "kg", "setting it keeps the shape of the inertia", 1e-3, 1e3,
                 [&t] { return mass_of(t.body); }, t.set_mass});
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter = kAxes[axis] + 1;
    out.push_back({t.name + ".inertia_kg_m2." + letter + letter, "kg m^2",
                   "about its centre of mass, its own axes", 1e-8, 1e3,
                   [&t, axis] { return inertia_of(t.body)(axis, axis); },
                   [&t, axis](double value) { t.set_inertia(axis, value); }});
  }
  out.push_back({t.name + ".linear_damping_1_s", "1/s", "part of its speed that it loses in 1 s", 0,
                 100, [&t] { return t.linear_damping_1_s; },
                 [&t](double value) {
                   t.linear_damping_1_s = value;
                   dBodySetLinearDampingThreshold(t.body, 0);
                   if (value == 0) dBodySetLinearDamping(t.body, 0);
                 }});
  out.push_back({t.name + ".angular_damping_1_s", "1/s", "likewise, of its turning", 0, 100,
                 [&t] { return t.angular_damping_1_s; },
                 [&t](double value) {
                   t.angular_damping_1_s = value;
                   dBodySetAngularDampingThreshold(t.body, 0);
                   if (value == 0) dBodySetAngularDamping(t.body, 0);
                 }});
}

Quantity of_surface(const std::string& name, const char* unit, const char* what, double high,
                    const std::vector<GeomTag*>& tags, double Surface::*member) {
  return {name,
          unit,
          what,
          0,
          high,
          [tags, member] { return tags[0]->surface.*member; },
          [tags, member](double value) {
            for (GeomTag* tag : tags) tag->surface.*member = value;
          }};
}

/// A fault that is there, 1, or not, 0.
Quantity fault(const std::string& name, const char* what, bool& is_there) {
  return {name,
          "",
          what,
          0,
          1,
          [&is_there] { return is_there ? 1.0 : 0.0; },
          [&is_there](double value) { is_there = value > 0.5; }};
}

}  // namespace

std::vector<Quantity> surface_quantities(const std::string& name,
                                         const std::vector<GeomTag*>& tags) {
  if (tags.empty()) return {};
  return {of_surface(name + ".friction", "", "where two surfaces meet, the smaller counts", 100,
                     tags, &Surface::friction),
          of_surface(name + ".restitution", "", "of speed; of two surfaces the larger counts", 1,
                     tags, &Surface::restitution),
          of_surface(name + ".contact_stiffness_n_m", "N/m",
                     "0 is rigid; two are springs in series", 1e12, tags, &Surface::stiffness_n_m),
          of_surface(name + ".contact_damping_n_s_m", "N s/m", "two add up", 1e9, tags,
                     &Surface::damping_n_s_m)};
}

std::vector<Quantity> quantities_of(Thing& thing, const World& world) {
  std::vector<Quantity> out;
  add_pose(out, thing);
  add_forces(out, thing, world);
  add_matter(out, thing);
  for (Quantity& each : surface_quantities(thing.name, thing.tags)) out.push_back(std::move(each));
  return out;
}

std::vector<Quantity> quantities_of(const std::string& name, TwinRobot& robot, int joint) {
  ServoModel& servo = robot.servo(joint);
  const Body& body = robot.body();
  return {
      read_only(name + ".angle_rad", "rad", "of the joint, as it is",
                [&body, joint] { return body.angle_rad(joint); }),
      read_only(name + ".speed_rad_s", "rad/s", "of the joint",
                [&body, joint] { return body.rate_rad_s(joint); }),
      read_only(name + ".torque_n_m", "N m", "of motor and gearbox on the joint, in the last step",
                [&servo] { return servo.torque_n_m(); }),
      {name + ".damping_n_m_s", "N m s", "of the bearing, beside the servo's own", 0, 100,
       [&servo] { return servo.joint_damping_n_m_s(); },
       [&servo](double value) { servo.set_joint_damping(value); }},
      {name + ".friction_n_m", "N m", "of the bearing, beside the servo's own", 0, 100,
       [&servo] { return servo.joint_friction_n_m(); },
       [&servo](double value) { servo.set_joint_friction(value); }},
      fault(name + ".encoder_stuck", "1: it reads the angle it had", servo.encoder_stuck),
      {name + ".encoder_off_count", "counts", "added to what it reads", -65536, 65536,
       [&servo] { return servo.encoder_off_count; },
       [&servo](double value) { servo.encoder_off_count = value; }},
      {name + ".temperature_c", "degrees C", "of its motor", -40, 200,
       [&servo] { return servo.measurement().temperature_c; },
       [&servo](double value) { servo.heat_to(value); }}};
}

std::vector<Quantity> quantities_of(const std::string& name, TwinRobot& robot, const World&) {
  const Body& body = robot.body();
  const auto sum = [&body, count = robot.entity().nodes.size()](double (*of)(dBodyID)) {
    double total = 0;
    for (std::size_t n = 0; n < count; ++n) total += of(body.ode_body(static_cast<int>(n)));
    return total;
  };
  std::vector<Quantity> out = {
      read_only(name + ".mass_kg", "kg", "of all links", [&body] { return body.mass_kg(); }),
      read_only(name + ".kinetic_energy_j", "J", "of all links", [sum] { return sum(kinetic_j); }),
      read_only(name + ".potential_energy_j", "J", "of all links",
                [sum] { return sum(potential_j); })};
  add(out, {name + ".com_m", "m", "centre of mass", 0, [&body] { return body.com_world_m(); }});
  add(out, {name + ".momentum_kg_m_s", "kg m/s", "of all links", 0,
            [&body] { return Vec3(body.mass_kg() * body.com_velocity_world_m_s()); }});
  out.push_back({name + ".supply_v", "V", "set without load, read at the servos", 0, 100,
                 [&robot] { return robot.supply_v(); },
                 [&robot](double value) { robot.set_unloaded_v(value); }});
  ImuLies& lies = robot.imu_lies();
  out.push_back(fault(name + ".imu_stuck", "1: all its counts stay, but for one bit", lies.stuck));
  out.push_back(fault(name + ".gyro_stuck", "1: the gyro's counts stay", lies.gyro_stuck));
  out.push_back(fault(name + ".imu_loose", "1: the IMU hangs upright and still", lies.loose));
  return out;
}

std::vector<Quantity> quantities_of(World& world) {
  std::vector<Quantity> out = {
      read_only("world.time_s", "s", "simulated",
                [&world] { return static_cast<double>(world.now_us()) * 1e-6; }),
      {"world.gravity_m_s2", "m/s^2", "downwards", 0, 100,
       [&world] { return world.options().gravity_m_s2; },
       [&world](double value) { world.set_gravity(value); }}};
  if (world.ground_tag() != nullptr) {
    for (Quantity& each : surface_quantities("ground", {world.ground_tag()}))
      out.push_back(std::move(each));
  }
  return out;
}

}  // namespace verp::sim
