#pragma once
#include <optional>
#include <string>

namespace verp::link {

/// The `latency_timer` of an FTDI USB serial adapter: the time in milliseconds for which it holds
/// back a partly filled packet. Empty for other devices. `device` may be a symbolic link.
std::optional<int> latency_timer_ms(const std::string& device,
                                    const std::string& system_folder = "/sys");

/// One line of advice if `device` holds bytes back for more than 1 ms; otherwise empty.
std::string latency_advice(const std::string& device, const std::string& system_folder = "/sys");

}  // namespace verp::link
