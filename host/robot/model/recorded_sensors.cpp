#include "host/robot/model/recorded_sensors.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <string>

namespace verp::model {
namespace {

/// Sets the latency of all sensors of that name; false: there are none.
template <class Sensors>
bool give_latency(Sensors& sensors, const LatencyFact& fact) {
  bool found = false;
  for (auto& each : sensors) {
    if (each.name != fact.sensor) continue;
    each.latency_s = fact.latency_s;
    found = true;
  }
  return found;
}

[[noreturn]] void refuse_latency(const LatencyFact& fact, const Facts& facts,
                                 const Entity& entity) {
  if (facts.imu && facts.imu->sensor == fact.sensor) {
    fact.at.fail("sensor '" + fact.sensor + "' is the IMU of <verp:imu>",
                 "write latency_s=\"" + std::to_string(fact.latency_s) + "\" there");
  }
  for (const TruthFact& truth : facts.truths) {
    if (truth.truth.name == fact.sensor)
      fact.at.fail("'" + fact.sensor + "' is a <verp:truth>", "write its latency_s there");
  }
  std::string names;
  const auto add = [&](const auto& sensors) {
    for (const auto& each : sensors) names += (names.empty() ? "" : ", ") + each.name;
  };
  add(entity.lasers);
  add(entity.cameras);
  add(entity.force_torques);
  add(entity.contacts);
  fact.at.fail("there is no sensor '" + fact.sensor + "' that is sampled",
               names.empty() ? "remove it" : "name one of: " + names);
}

bool is_topic(const std::string& topic) {
  return !topic.empty() && std::isdigit(static_cast<unsigned char>(topic[0])) == 0 &&
         std::all_of(topic.begin(), topic.end(), [](unsigned char each) {
           return std::isalnum(each) != 0 || each == '_' || each == '/';
         });
}

}  // namespace

void add_truths_and_latencies(const Facts& facts, const LinkTree& tree, Entity& entity) {
  for (const TruthFact& fact : facts.truths) {
    const LinkTree::Located place = tree.locate(fact.link, fact.at);
    TruthSensor& truth = entity.truths.emplace_back(fact.truth);
    truth.node = place.node;
    truth.pose = place.pose * fact.truth.pose;
  }
  for (const LatencyFact& fact : facts.latencies) {
    bool found = give_latency(entity.lasers, fact);
    found = give_latency(entity.cameras, fact) || found;
    found = give_latency(entity.force_torques, fact) || found;
    found = give_latency(entity.contacts, fact) || found;
    if (!found) refuse_latency(fact, facts, entity);
  }
}

void check_channels(const XmlSource& source, const Facts& facts, const Entity& entity) {
  // Channels that every trace has; lasers and cameras join them by name.
  std::set<std::string> taken = {"joint_states", "joint_goals", "imu",
                                 "tf",           "tf_static",   "control",
                                 "objects",      "changed",     "robot_description"};
  for (const LaserSensor& each : entity.lasers) taken.insert(each.name);
  for (const CameraSensor& each : entity.cameras) taken.insert(each.name);
  const auto take = [&](const std::string& topic) -> std::string {
    if (!is_topic(topic)) return "'" + topic + "' is no name of a channel";
    return taken.insert(topic).second ? "" : "another channel is called /" + topic;
  };
  const auto check = [&](const auto& sensors) {
    for (const auto& each : sensors) {
      const std::string wrong = take(each.topic);
      if (wrong.empty()) continue;
      fail_at(source, each.name, "sensor '" + each.name + "': " + wrong,
              "give it a <topic> of its own, of letters, digits, _ and /");
    }
  };
  check(entity.force_torques);
  check(entity.contacts);
  for (const TruthFact& fact : facts.truths) {
    const std::string wrong = take(fact.truth.name);
    if (!wrong.empty())
      fact.at.fail("<verp:truth>: " + wrong,
                   "give it a name of its own, of letters, digits and _, a letter first");
  }
}

}  // namespace verp::model
