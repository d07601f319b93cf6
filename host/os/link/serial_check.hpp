#pragma once
#include <string>

namespace verp::link {

/// Throws LinkError if `device` visibly cannot be opened as a serial port: it is missing, is
/// another kind of file, lacks permission, or is open exclusively elsewhere.
void check_serial_port(const std::string& device);

}  // namespace verp::link
