#pragma once
#include "host/robot/model/facts.hpp"
#include "host/robot/model/servo_types.hpp"

namespace verp::model {

constexpr int kHighestId = 199;    // 200: controller; 201: clock; 253 and up: protocol
constexpr int kHighestNode = 125;  // CiA 301's 127 minus the controller's and a tool's

/// A <verp:bus> with servos of `types`. Throws LoadError.
BusFact read_bus(const XmlElement& e, const std::vector<ServoType>& types);

}  // namespace verp::model
