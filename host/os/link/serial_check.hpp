#pragma once
#include <string>

namespace verp::link {

/// Throws LinkError that says what keeps `device` from being opened as a serial port, as far as it
/// shows from outside: it is not there, is something else, is another user's, is held alone.
void check_serial_port(const std::string& device);

}  // namespace verp::link
