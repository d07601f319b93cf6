#pragma once
#include "host/robot/model/facts.hpp"
#include "host/robot/model/servo_types.hpp"

namespace verp::model {

constexpr int kHighestId =
    199;  // 200 is the controller, 201 the clock; 253 and up belong to the protocol
constexpr int kHighestNode =
    125;  // CiA 301 has 127; the last two are the controller's and a tool's

/// Reads a <verp:bus> with its servos, each of one of `types`. Throws LoadError.
BusFact read_bus(const XmlElement& e, const std::vector<ServoType>& types);

}  // namespace verp::model
