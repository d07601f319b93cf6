#include "host/twin/sim/probes.hpp"

#include <utility>

#include "host/twin/sim/scenery.hpp"

namespace verp::sim {
namespace {

constexpr std::size_t kMostReadings = 1000;  // per kind, if never taken

Vec3 noise_of(Random& random, const Vec3& mean, const Vec3& stddev) {
  const double x = random.normal();
  const double y = random.normal();
  const double z = random.normal();
  return mean + stddev.cwiseProduct(Vec3(x, y, z));
}

Vec3 noise_of(Random& random, double stddev) {
  return noise_of(random, Vec3::Zero(), Vec3::Constant(stddev));
}

}  // namespace

Probes::Probes(const model::Entity& entity, Body& body, int owner, bool noise, std::uint64_t seed)
    : entity_(entity), owner_(owner), noise_(noise) {
  int index = 0;
  for (const model::ForceTorqueSensor& each : entity.force_torques) {
    wrench_.emplace_back(each, Random(seed, Draw::kForceTorque, index++));
    body.meter(each.node - 1);
  }
  // Contacts have no noise: nothing is drawn from that stream.
  for (const model::ContactSensor& each : entity.contacts)
    contact_.emplace_back(each, Random(seed, Draw::kForceTorque));
  index = 0;
  for (const model::TruthSensor& each : entity.truths)
    truth_.emplace_back(each, Random(seed, Draw::kTruth, index++));
}

/// The hinge's force is the link's only support and includes all that the servo applies.
WrenchReading Probes::measure(WrenchProbe& probe, const World&, const Body& body) const {
  const model::ForceTorqueSensor& sensor = probe.sensor;
  const Transform pose = body.link_pose(sensor.node) * sensor.pose;
  const JointLoad load = body.load(sensor.node - 1);
  const double sense = sensor.on_child ? 1 : -1;
  const Vec3 lever_m = load.point_world_m - pose.translation();
  const Vec3 torque_n_m = load.torque_world_n_m + lever_m.cross(load.force_world_n);
  WrenchReading reading;
  reading.force_n = sense * (pose.linear().transpose() * load.force_world_n);
  reading.torque_n_m = sense * (pose.linear().transpose() * torque_n_m);
  if (!noise_) return reading;
  reading.force_n += noise_of(probe.random, sensor.force_mean_n, sensor.force_stddev_n);
  reading.torque_n_m += noise_of(probe.random, sensor.torque_mean_n_m, sensor.torque_stddev_n_m);
  return reading;
}

ContactReading Probes::measure(ContactProbe& probe, const World& world, const Body&) const {
  ContactReading reading;
  for (const Contact& contact : world.contacts()) {
    if (contact.owner != owner_ || contact.node != probe.sensor.node) continue;
    reading.touches.push_back(
        {name_of(world, contact), contact.position_world_m, contact.force_world_n});
  }
  return reading;
}

TruthReading Probes::measure(TruthProbe& probe, const World&, const Body& body) const {
  const model::TruthSensor& sensor = probe.sensor;
  TruthReading reading;
  Transform& pose = reading.world_sensor;
  pose = body.link_pose(sensor.node) * sensor.pose;
  const Mat3 sensor_world = pose.linear().transpose();
  reading.velocity_m_s =
      sensor_world * body.point_velocity_world_m_s(sensor.node, pose.translation());
  reading.rate_rad_s = sensor_world * body.angular_velocity_world_rad_s(sensor.node);
  if (!noise_) return reading;
  pose.translation() += noise_of(probe.random, sensor.position_noise_m);
  const Vec3 turn_rad = noise_of(probe.random, sensor.angle_noise_rad);
  if (turn_rad.norm() > 0)
    pose.linear() *= Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()).toRotationMatrix();
  reading.velocity_m_s += noise_of(probe.random, sensor.velocity_noise_m_s);
  reading.rate_rad_s += noise_of(probe.random, sensor.rate_noise_rad_s);
  return reading;
}

std::string Probes::name_of(const World& world, const Contact& contact) const {
  if (contact.other_owner == owner_)
    return entity_.nodes[static_cast<std::size_t>(contact.other_node)].name;
  if (contact.other_owner == kScenery) return "world";
  if (world.scenery() != nullptr) {
    for (const Scenery::Item& item : world.scenery()->items()) {
      for (const GeomTag* tag : item.tags) {
        if (tag->owner == contact.other_owner) return item.object->name;
      }
    }
  }
  return "robot";
}

template <class Kind, class Reading>
void Probes::sample_all(std::vector<Kind>& probes, std::vector<Reading>& out, const World& world,
                        const Body& body) {
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (probes[i].shutter.opens(world.now_us())) {
      Reading reading = measure(probes[i], world, body);
      reading.time_us = world.now_us();
      reading.sensor = i;
      probes[i].delay.put(world.now_us(), std::move(reading));
    }
    while (auto reading = probes[i].delay.take(world.now_us())) {
      if (out.size() == kMostReadings) out.erase(out.begin());
      out.push_back(std::move(*reading));
    }
  }
}

void Probes::sample(const World& world, const Body& body) {
  sample_all(wrench_, readings_.wrenches, world, body);
  sample_all(contact_, readings_.contacts, world, body);
  sample_all(truth_, readings_.truths, world, body);
}

ProbeReadings Probes::take() {
  return std::exchange(readings_, {});
}

}  // namespace verp::sim
