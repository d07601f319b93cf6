#pragma once
#include <string>

namespace verp::edit {

/// The unit of what a path names, from its last part: "kg" of link:trunk/inertial/mass, "rad" of
/// servo:l_knee@lower_rad. Empty: it has none, or nobody knows.
std::string unit_of(const std::string& path);

}  // namespace verp::edit
