#pragma once
#include <functional>
#include <sdf/Sensor.hh>
#include <string>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Throws LoadError at the sensor with the error and the remedy.
using WrongSensor = std::function<void(const std::string& what, const std::string& fix)>;

/// `pose` is in the link frame of `node`.
LaserSensor read_laser(const sdf::Sensor& sensor, int node, const Transform& pose,
                       const WrongSensor& wrong);

bool is_camera(const sdf::Sensor& sensor);
CameraSensor read_camera(const sdf::Sensor& sensor, int node, const Transform& pose,
                         const WrongSensor& wrong);

/// `link` is the link's own frame in that of `node`; SDF uses its axes by default.
ForceTorqueSensor read_force_torque(const sdf::Sensor& sensor, int node, const Transform& link,
                                    const Transform& pose, const WrongSensor& wrong);

ContactSensor read_contact(const sdf::Sensor& sensor, int node, const WrongSensor& wrong);

}  // namespace verp::model
