#pragma once
#include <string>

namespace verp::edit {

/// The unit follows from the path's last part: "kg" for link:trunk/inertial/mass, "rad" for
/// servo:l_knee@lower_rad. Empty: none, or unknown.
std::string unit_of(const std::string& path);

}  // namespace verp::edit
