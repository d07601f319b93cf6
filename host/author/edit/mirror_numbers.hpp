#pragma once
#include <set>
#include <string>

#include "host/author/edit/document.hpp"

namespace verp::edit {

/// How a joint's mirror image turns. Its axis points as before where it lies in the mirror plane
/// (roll, yaw), and its angles change sign; a pitch axis stands across, and its angles stay.
bool angle_changes_sign(const Document& document, int joint);

/// The places in an element and all in it where a number is another behind the mirror y -> -y.
/// `sign_changes`: names of joints whose angles change sign; `joints`: all that are mirrored.
std::vector<Splice> mirrored_numbers(const Document& document, int element,
                                     const std::set<std::string>& sign_changes,
                                     const std::set<std::string>& joints);

}  // namespace verp::edit
