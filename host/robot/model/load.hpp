#pragma once
#include <string>

#include "host/robot/model/entity.hpp"
#include "host/robot/model/load_error.hpp"

namespace verp::model {

/// Loads, checks and normalises the robot in an SDF file (frames and units: entity.hpp). It guesses
/// nothing: omissions and errors throw LoadError with file, line and remedy. Not thread-safe,
/// because libsdformat keeps its settings for nested includes in a global. `bus` names the bus to
/// use; empty: the first. The robot's ticks must fit it (bus_time.hpp).
Entity load_robot(const std::string& path, const std::string& bus = "");
/// The same without the bus check, for callers that report it or set another period.
Entity load_robot_on_any_bus(const std::string& path, const std::string& bus);
/// The same for any model with a body and a bus, even without legs or IMU; it cannot be controlled.
Entity load_part_of_robot(const std::string& path);
/// load_robot() for a text that is not in the file yet; includes are relative to the file.
Entity load_robot_text(const std::string& path, const std::string& text);
/// Checks only what needs no whole robot: well-formed XML, numbers, unique elements.
void check_numbers(const std::string& path, const std::string& text);
/// load_robot(); without a bus name it uses the first CAN bus, or else the robot's first bus.
Entity load_robot_on_can(const std::string& path, const std::string& bus);

}  // namespace verp::model
