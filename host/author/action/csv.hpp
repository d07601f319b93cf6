#pragma once
#include <string>

#include "host/author/action/compile.hpp"

/// Key frames as a table for other programs: time_s, hold_s, then a column of each joint, rad.
namespace verp::action {

/// Of a made action, whatever its text says: body and feet are joints there.
std::string to_csv(const Params& params, const Made& made, int number);

/// What of an action no table holds, in words: "note, stance, repeats"; empty: nothing.
std::string not_in_csv(const Document& document);

/// An action of that name with the table's frames. An empty cell: no goal. Throws LoadError, also
/// for a joint that the robot lacks.
Document from_csv(const Params& params, const std::filesystem::path& file, const std::string& text,
                  const std::string& name);

}  // namespace verp::action
