#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/os/link/link_error.hpp"

namespace verp::link {

/// A CAN interface of this PC, as the kernel describes it.
struct CanInterface {
  std::string name;
  int index = 0;
  bool is_can = false;
  bool is_virtual = false;  ///< vcan, vxcan: no wire, no bit rate, no bus-off
  bool up = false;
  bool fd = false;               ///< takes CAN FD frames
  std::uint32_t bitrate = 0;     ///< bit/s; 0: unknown, or there is none
  std::uint32_t restart_ms = 0;  ///< how long after a bus-off it starts again; 0: never by itself
};

/// All network interfaces of this PC, CAN or not. Throws LinkError if the kernel does not say.
std::vector<CanInterface> network_interfaces();

/// The interface `name`, fit to be opened, or a LinkError that says what is wrong with it and how
/// to make it right: not there, no CAN, down.
CanInterface find_can_interface(const std::string& name);

/// What its user should know though it can be opened; empty: nothing.
std::string advice(const CanInterface& interface);

/// Why it can't carry a robot's bus of so many bit/s, and what to do; empty: it can, or has no bit
/// rate that is known.
std::string bit_rate_trouble(const CanInterface& interface, const std::string& robot,
                             std::uint32_t baud);

}  // namespace verp::link
