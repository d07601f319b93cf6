#pragma once
#include <optional>
#include <string>

namespace verp::link {

/// FTDI adapter's `latency_timer`: ms for which it holds back a partly filled packet. Empty for
/// other devices. `device` may be a link.
std::optional<int> latency_timer_ms(const std::string& device,
                                    const std::string& system_folder = "/sys");

/// One line if `device` holds bytes back for more than 1 ms; else empty.
std::string latency_advice(const std::string& device, const std::string& system_folder = "/sys");

}  // namespace verp::link
