#pragma once
#include <set>
#include <string>

#include "host/author/edit/document.hpp"

namespace verp::edit {

/// An axis in the mirror plane (roll, yaw) keeps its direction: angles change sign. A pitch axis is
/// normal to it: angles keep their sign.
bool angle_changes_sign(const Document& document, int joint);

/// Changes for y -> -y. `sign_changes`: joints whose angles do; `joints`: all mirrored.
std::vector<Splice> mirrored_numbers(const Document& document, int element,
                                     const std::set<std::string>& sign_changes,
                                     const std::set<std::string>& joints);

}  // namespace verp::edit
