#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/twin/sim/body.hpp"
#include "host/twin/sim/delay.hpp"
#include "host/twin/sim/exposure.hpp"
#include "host/twin/sim/random.hpp"
#include "host/twin/sim/world.hpp"

/// Sensors that no bus carries: force-torque, contact, ground truth. Sampled at whole periods of
/// simulated time, in the step that ends then or first after. A run does not depend on them.
namespace verp::sim {

/// Sensor axes, about its origin.
struct WrenchReading {
  std::uint64_t time_us = 0;
  std::size_t sensor = 0;  ///< index in Entity::force_torques
  Vec3 force_n = Vec3::Zero(), torque_n_m = Vec3::Zero();
};

struct Touch {
  std::string other;  ///< a link, an object, "world" (static things), "robot"
  Vec3 position_world_m = Vec3::Zero();
  Vec3 force_world_n = Vec3::Zero();  ///< on the link
};
struct ContactReading {
  std::uint64_t time_us = 0;
  std::size_t sensor = 0;  ///< index in Entity::contacts
  std::vector<Touch> touches;
};

struct TruthReading {
  std::uint64_t time_us = 0;
  std::size_t sensor = 0;  ///< index in Entity::truths
  Transform world_sensor = Transform::Identity();
  Vec3 velocity_m_s = Vec3::Zero(), rate_rad_s = Vec3::Zero();  ///< in the sensor's axes
};

struct ProbeReadings {
  std::vector<WrenchReading> wrenches;
  std::vector<ContactReading> contacts;
  std::vector<TruthReading> truths;
};

class Probes {
 public:
  /// Meters its joints in `body`; `owner`: number in the world.
  Probes(const model::Entity& entity, Body& body, int owner, bool noise, std::uint64_t seed);

  void sample(const World& world, const Body& body);
  /// Readings since the last call; the oldest are dropped if nobody takes them.
  ProbeReadings take();

 private:
  template <class Sensor, class Reading>
  struct Probe {
    Probe(const Sensor& sensor_, Random random_)
        : sensor(sensor_), random(random_), shutter(sensor_.rate_hz), delay(sensor_.latency_s) {}
    Sensor sensor;
    Random random;
    Shutter shutter;
    Delay<Reading> delay;
  };
  using WrenchProbe = Probe<model::ForceTorqueSensor, WrenchReading>;
  using ContactProbe = Probe<model::ContactSensor, ContactReading>;
  using TruthProbe = Probe<model::TruthSensor, TruthReading>;

  WrenchReading measure(WrenchProbe& probe, const World& world, const Body& body) const;
  ContactReading measure(ContactProbe& probe, const World& world, const Body& body) const;
  TruthReading measure(TruthProbe& probe, const World& world, const Body& body) const;
  template <class Kind, class Reading>
  void sample_all(std::vector<Kind>& probes, std::vector<Reading>& out, const World& world,
                  const Body& body);
  std::string name_of(const World& world, const Contact& contact) const;

  const model::Entity& entity_;
  const int owner_;
  const bool noise_;
  std::vector<WrenchProbe> wrench_;
  std::vector<ContactProbe> contact_;
  std::vector<TruthProbe> truth_;
  ProbeReadings readings_;
};

}  // namespace verp::sim
