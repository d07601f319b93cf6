#pragma once
#include <functional>
#include <sdf/Sensor.hh>
#include <string>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Throws LoadError at the sensor, with error and remedy.
using WrongSensor = std::function<void(const std::string& what, const std::string& fix)>;

/// `pose`: in `node`'s link frame.
LaserSensor read_laser(const sdf::Sensor& sensor, int node, const Transform& pose,
                       const WrongSensor& wrong);

bool is_camera(const sdf::Sensor& sensor);
CameraSensor read_camera(const sdf::Sensor& sensor, int node, const Transform& pose,
                         const WrongSensor& wrong);

/// `link`: its own frame in that of `node`, whose axes SDF uses by default.
ForceTorqueSensor read_force_torque(const sdf::Sensor& sensor, int node, const Transform& link,
                                    const Transform& pose, const WrongSensor& wrong);

ContactSensor read_contact(const sdf::Sensor& sensor, int node, const WrongSensor& wrong);

}  // namespace verp::model
