#include "host/run/session/readings.hpp"

#include "host/trace/record/ros_sensors.hpp"

namespace verp::session {
namespace {

namespace ros = record::ros;

ros::Three three(const sim::Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

ros::BodyPose pose_in_ros(const sim::Transform& pose) {
  const Eigen::Quaterniond q(pose.linear());
  return {three(pose.translation()), {q.x(), q.y(), q.z(), q.w()}};
}

/// Stamps of measurements after the trace began.
class Stamps {
 public:
  Stamps(std::uint64_t tick_ns, std::uint64_t now_us) : tick_ns_(tick_ns), now_us_(now_us) {}
  bool have(std::uint64_t measured_us) const { return age_ns(measured_us) <= tick_ns_; }
  /// In the trace's time.
  std::uint64_t of(std::uint64_t measured_us) const { return tick_ns_ - age_ns(measured_us); }

 private:
  std::uint64_t age_ns(std::uint64_t measured_us) const { return 1000 * (now_us_ - measured_us); }
  const std::uint64_t tick_ns_, now_us_;
};

ros::Motion motion_of(const model::TruthSensor& sensor, const sim::TruthReading& reading) {
  const auto squared = [](double value) { return value * value; };
  return {.pose = pose_in_ros(reading.world_sensor),
          .velocity_m_s = three(reading.velocity_m_s),
          .rate_rad_s = three(reading.rate_rad_s),
          .position_m2 = squared(sensor.position_noise_m),
          .angle_rad2 = squared(sensor.angle_noise_rad),
          .velocity_m2_s2 = squared(sensor.velocity_noise_m_s),
          .rate_rad2_s2 = squared(sensor.rate_noise_rad_s)};
}

}  // namespace

void place_frames(record::TraceWriter& trace, const model::Entity& entity, const Params& params) {
  for (const model::ForceTorqueSensor& sensor : entity.force_torques) {
    const std::vector<ros::ObjectPose> frame = {{sensor.topic, pose_in_ros(sensor.pose)}};
    trace.append("/tf_static", {"tf2_msgs/msg/TFMessage", ros::kTfSchema}, 0,
                 ros::objects(frame, 0, ros::frame_of(params, sensor.node)));
  }
}

void append(record::TraceWriter& trace, const model::Entity& entity,
            const sim::ProbeReadings& readings, std::uint64_t tick_ns, std::uint64_t now_us) {
  const Stamps stamps(tick_ns, now_us);
  for (const sim::WrenchReading& each : readings.wrenches) {
    if (!stamps.have(each.time_us)) continue;
    const model::ForceTorqueSensor& sensor = entity.force_torques[each.sensor];
    trace.append("/" + sensor.topic, ros::kWrenchStamped, tick_ns,
                 ros::wrench({three(each.force_n), three(each.torque_n_m)}, sensor.topic,
                             stamps.of(each.time_us)));
  }
  for (const sim::ContactReading& each : readings.contacts) {
    if (!stamps.have(each.time_us)) continue;
    const model::ContactSensor& sensor = entity.contacts[each.sensor];
    std::vector<ros::ContactPoint> points;
    for (const sim::Touch& touch : each.touches)
      points.push_back({touch.other, three(touch.position_world_m), three(touch.force_world_n)});
    trace.append("/" + sensor.topic, ros::kContacts, tick_ns,
                 ros::contacts(entity.nodes[static_cast<std::size_t>(sensor.node)].name, points,
                               stamps.of(each.time_us)));
  }
  for (const sim::TruthReading& each : readings.truths) {
    if (!stamps.have(each.time_us)) continue;
    const model::TruthSensor& sensor = entity.truths[each.sensor];
    trace.append("/" + sensor.name, ros::kOdometry, tick_ns,
                 ros::odometry(motion_of(sensor, each), sensor.name, stamps.of(each.time_us)));
  }
}

}  // namespace verp::session
