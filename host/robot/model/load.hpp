#pragma once
#include <string>

#include "host/robot/model/entity.hpp"
#include "host/robot/model/load_error.hpp"

namespace verp::model {

/// Loads, checks and normalises the robot in an SDF file (frames and units: entity.hpp). Nothing is
/// guessed: what the file leaves open or gets wrong throws LoadError with file, line and remedy.
/// Not thread-safe, because libsdformat takes its settings for nested includes from a global.
/// `bus` names one of its buses, empty: the first; it has to have room for the robot's ticks
/// (bus_time.hpp).
Entity load_robot(const std::string& path, const std::string& bus = "");
/// The same, whether or not the bus has room: for who tells that, or gives another period.
Entity load_robot_on_any_bus(const std::string& path, const std::string& bus);
/// The same of anything that has a body and a bus, legs and IMU or not: nobody can control it.
Entity load_part_of_robot(const std::string& path);
/// load_robot() of a text that is not in the file yet: what it includes lies as seen from there.
Entity load_robot_text(const std::string& path, const std::string& text);
/// Of that text what needs no whole robot: well-formed XML, numbers, one of what there is one of.
void check_numbers(const std::string& path, const std::string& text);
/// The same, where no bus is named on the first that is CAN; without one, on the robot's first bus.
Entity load_robot_on_can(const std::string& path, const std::string& bus);

}  // namespace verp::model
