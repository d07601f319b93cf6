#pragma once
#include <set>
#include <string>

#include "host/author/edit/document.hpp"

namespace verp::edit {

/// Whether a joint's angles change sign in its mirror image. An axis in the mirror plane (roll,
/// yaw) keeps its direction, so they do; a pitch axis is normal to it, so they do not.
bool angle_changes_sign(const Document& document, int joint);

/// Splices for all numbers in an element that the mirror y -> -y changes. `sign_changes` names the
/// joints whose angles change sign, `joints` all that are mirrored.
std::vector<Splice> mirrored_numbers(const Document& document, int element,
                                     const std::set<std::string>& sign_changes,
                                     const std::set<std::string>& joints);

}  // namespace verp::edit
