#pragma once
#include <set>
#include <string>

#include "host/author/edit/document.hpp"

namespace verp::edit {

/// An axis in the mirror plane (roll, yaw) keeps its direction, so angles change sign; a pitch axis
/// is normal to it, so they do not.
bool angle_changes_sign(const Document& document, int joint);

/// Changes for the mirror y -> -y. `sign_changes`: joints whose angles change sign; `joints`: all
/// that are mirrored.
std::vector<Splice> mirrored_numbers(const Document& document, int element,
                                     const std::set<std::string>& sign_changes,
                                     const std::set<std::string>& joints);

}  // namespace verp::edit
