#pragma once
#include <vector>

#include "host/robot/model/servo_types.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// The shipped servo types and those of the robot's <verp:servo_type> elements, in the units of
/// host/guide/robot-file.md. Throws LoadError.
std::vector<ServoType> read_servo_types(const XmlElement& model);

/// Value of the attribute `protocol`.
BusProtocol read_protocol(const XmlElement& element);

}  // namespace verp::model
