#pragma once
#include <vector>

#include "host/robot/model/servo_types.hpp"
#include "host/robot/model/xml_source.hpp"

namespace verp::model {

/// Shipped types and <verp:servo_type> elements, units of host/guide/robot-file.md. Throws
/// LoadError.
std::vector<ServoType> read_servo_types(const XmlElement& model);

BusProtocol read_protocol(const XmlElement& element);

}  // namespace verp::model
