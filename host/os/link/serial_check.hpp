#pragma once
#include <string>

namespace verp::link {

/// Throws LinkError if `device` is missing, of another kind, without permission, or open
/// exclusively elsewhere.
void check_serial_port(const std::string& device);

}  // namespace verp::link
