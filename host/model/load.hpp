#pragma once
#include <string>

#include "host/model/entity.hpp"
#include "host/model/load_error.hpp"

namespace verp::model {

/// Loads, checks and normalises the robot in an SDF file (frames and units: entity.hpp). Nothing is
/// guessed: what the file leaves open or gets wrong throws LoadError with file, line and remedy.
/// Not thread-safe, because libsdformat takes its settings for nested includes from a global.
/// `bus` names one of its buses; empty: the first.
Entity load_robot(const std::string& path, const std::string& bus = "");

}  // namespace verp::model
