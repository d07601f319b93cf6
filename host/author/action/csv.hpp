#pragma once
#include <string>

#include "host/author/action/compile.hpp"

/// Key frames as a table: time_s, hold_s, then one column per joint, rad.
namespace verp::action {

/// The compiled action; body and feet become joint angles.
std::string to_csv(const Params& params, const CompiledActions& made, int number);

/// Lists the parts that a table cannot hold: "note, stance, repeats"; may be empty.
std::string not_in_csv(const Document& document);

/// Makes an action from a table. An empty cell means no goal. Throws LoadError, also for an unknown
/// joint.
Document from_csv(const Params& params, const std::filesystem::path& file, const std::string& text,
                  const std::string& name);

}  // namespace verp::action
