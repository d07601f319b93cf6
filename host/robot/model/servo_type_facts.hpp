#pragma once
#include <vector>

#include "host/robot/model/servo_types.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// The shipped servo types and those that the robot's own <verp:servo_type> elements describe, all
/// in the units of host/guide/robot-file.md. Throws LoadError.
std::vector<ServoType> read_servo_types(const XmlElement& model);

/// What speaks that protocol, as in a file.
BusProtocol read_protocol(const XmlElement& element);

}  // namespace verp::model
