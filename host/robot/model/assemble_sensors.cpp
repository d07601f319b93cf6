#include "host/robot/model/assemble_sensors.hpp"

#include "host/robot/model/recorded_sensors.hpp"
#include "host/robot/model/sdf_parts.hpp"
#include "host/robot/model/sensor_sdf.hpp"

namespace verp::model {
namespace {

class SensorAssembler {
 public:
  SensorAssembler(const XmlSource& source, const Facts& facts, const sdf::Model& model,
                  const LinkTree& tree, Entity& entity)
      : source_(source), facts_(facts), model_(model), tree_(tree), e_(entity) {}

  void read() {
    read_link_sensors();
    read_joint_sensors();
    add_truths_and_latencies(facts_, tree_, e_);
    check_channels(source_, facts_, e_);
    require_imu();
    if (facts_.feet) e_.feet = facts_.feet->feet;
  }

 private:
  void read_link_sensors() {
    for (std::uint64_t l = 0; l < model_.LinkCount(); ++l) {
      const sdf::Link& link = *model_.LinkByIndex(l);
      for (std::uint64_t i = 0; i < link.SensorCount(); ++i) {
        const sdf::Sensor& sensor = *link.SensorByIndex(i);
        if (facts_.is_dropped("sensor", sensor.Name())) continue;
        const bool is_imu = facts_.imu && sensor.Name() == facts_.imu->sensor;
        LinkTree::Located place = tree_.locate(link.Name(), facts_.body->at);
        const Transform link_pose = place.pose;
        place.pose = place.pose * resolved(sensor.SemanticPose(), link.Name());
        OtherSensor& other = e_.sensors.emplace_back();
        other.name = sensor.Name();
        other.type = sensor.TypeStr();
        other.link = link.Name();
        other.node = place.node;
        other.pose = place.pose;
        if (is_imu) put_imu(place.node, place.pose, &sensor);
        if (sensor.LidarSensor() != nullptr)
          e_.lasers.push_back(read_laser(sensor, place.node, place.pose, wrong(sensor)));
        if (is_camera(sensor))
          e_.cameras.push_back(read_camera(sensor, place.node, place.pose, wrong(sensor)));
        if (sensor.ForceTorqueSensor() != nullptr) {
          e_.force_torques.push_back(
              read_force_torque(sensor, place.node, link_pose, place.pose, wrong(sensor)));
        }
        // Without a topic it only marks a position, as for <verp:feet>.
        if (sensor.Type() == sdf::SensorType::CONTACT && !sensor.Topic().empty())
          e_.contacts.push_back(read_contact(sensor, place.node, wrong(sensor)));
      }
    }
  }

  /// The IMU is on a link, or it is an SDF sensor found before.
  void require_imu() {
    if (facts_.imu && facts_.imu->sensor.empty()) {
      const LinkTree::Located place = tree_.locate(facts_.imu->link, facts_.imu->at);
      put_imu(place.node, place.pose * facts_.imu->imu.pose, nullptr);
    } else if (facts_.imu && !e_.imu) {
      facts_.imu->at.fail("there is no sensor '" + facts_.imu->sensor + "'",
                          "name an SDF sensor of type imu");
    }
  }

  void read_joint_sensors() {
    for (std::uint64_t j = 0; j < model_.JointCount(); ++j) {
      const sdf::Joint& joint = *model_.JointByIndex(j);
      std::string child;
      joint.ResolveChildLink(child);
      for (std::uint64_t i = 0; i < joint.SensorCount(); ++i) {
        const sdf::Sensor& sensor = *joint.SensorByIndex(i);
        if (facts_.is_dropped("sensor", sensor.Name())) continue;
        const LinkTree::Located place = tree_.locate(child, facts_.body->at);
        // libsdformat 12 has no frames in joints: the pose is in the joint's frame.
        if (!sensor.PoseRelativeTo().empty())
          wrong(sensor)("its <pose> has a relative_to", "give it in the joint's frame");
        const Transform pose =
            place.pose * resolved(joint.SemanticPose(), child) * to_transform(sensor.RawPose());
        e_.sensors.push_back({sensor.Name(), sensor.TypeStr(), child, place.node, pose});
        if (sensor.ForceTorqueSensor() == nullptr) continue;
        if (e_.nodes[static_cast<std::size_t>(place.node)].name != child) {
          wrong(sensor)("joint '" + joint.Name() + "' is fixed: what it holds is one piece here",
                        "put it into the joint that moves that piece");
        }
        e_.force_torques.push_back(
            read_force_torque(sensor, place.node, place.pose, pose, wrong(sensor)));
      }
    }
  }

  WrongSensor wrong(const sdf::Sensor& sensor) const {
    return [this, &sensor](const std::string& what, const std::string& fix) {
      fail_at(source_, sensor.Name(), sensor.TypeStr() + " '" + sensor.Name() + "': " + what, fix);
    };
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

  const XmlSource& source_;
  const Facts& facts_;
  const sdf::Model& model_;
  const LinkTree& tree_;
  Entity& e_;
};

}  // namespace

void assemble_sensors(const XmlSource& source, const Facts& facts, const sdf::Model& model,
                      const LinkTree& tree, Entity& entity) {
  SensorAssembler(source, facts, model, tree, entity).read();
}

}  // namespace verp::model
