#pragma once
#include <string>

#include "host/author/action/compile.hpp"

/// Key frames as a table for other programs: time_s, hold_s, then one column per joint, rad.
namespace verp::action {

/// The compiled action, with body and feet converted to joint angles.
std::string to_csv(const Params& params, const Made& made, int number);

/// The parts of an action that a table cannot hold: "note, stance, repeats"; may be empty.
std::string not_in_csv(const Document& document);

/// An action with the table's frames. An empty cell means no goal. Throws LoadError, also for a
/// joint that the robot lacks.
Document from_csv(const Params& params, const std::filesystem::path& file, const std::string& text,
                  const std::string& name);

}  // namespace verp::action
