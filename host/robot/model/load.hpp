#pragma once
#include <string>

#include "host/robot/model/entity.hpp"
#include "host/robot/model/load_error.hpp"

namespace verp::model {

/// Loads, checks and normalises an SDF robot (entity.hpp). Omissions and errors throw LoadError
/// with file, line and remedy. Not thread-safe: libsdformat keeps settings in a global. `bus`:
/// empty: the first. Ticks must fit it (bus_time.hpp).
Entity load_robot(const std::string& path, const std::string& bus = "");
/// The same without the bus check, for callers that report it or set another period.
Entity load_robot_on_any_bus(const std::string& path, const std::string& bus);
/// Any model with a body and a bus, even without legs or IMU; it cannot be controlled.
Entity load_part_of_robot(const std::string& path);
/// The same from a text that is not in the file yet.
Entity load_part_of_robot_text(const std::string& path, const std::string& text);
/// A text that is not in the file yet; includes are relative to the file.
Entity load_robot_text(const std::string& path, const std::string& text);
/// Checks only what needs no whole robot: well-formed XML, numbers, unique elements.
void check_numbers(const std::string& path, const std::string& text);
/// Without a name: the first CAN bus, else the first.
Entity load_robot_on_can(const std::string& path, const std::string& bus);

}  // namespace verp::model
