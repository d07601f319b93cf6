#pragma once
#include <optional>
#include <string>

namespace verp::link {

/// Milliseconds that a USB serial adapter of FTDI keeps bytes back before it sends a packet that is
/// not full: its `latency_timer`. Empty for other devices. `device` may be a symbolic link.
std::optional<int> latency_timer_ms(const std::string& device,
                                    const std::string& system_folder = "/sys");

/// One line of advice if `device` keeps bytes back for longer than 1 ms; empty if all is well.
std::string latency_advice(const std::string& device, const std::string& system_folder = "/sys");

}  // namespace verp::link
