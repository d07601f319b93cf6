#pragma once
#include <string>

#include "host/author/action/compile.hpp"

/// Columns: time_s, hold_s, then one per joint, rad.
namespace verp::action {

/// Body and feet become joint angles.
std::string to_csv(const Params& params, const CompiledActions& made, int number);

/// Lists the parts that a table cannot hold: "note, stance, repeats"; or empty.
std::string not_in_csv(const Document& document);

/// An empty cell means no goal. Throws LoadError, also for an unknown joint.
Document from_csv(const Params& params, const std::filesystem::path& file, const std::string& text,
                  const std::string& name);

}  // namespace verp::action
