#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/os/link/link_error.hpp"

namespace verp::link {

struct CanInterface {
  std::string name;
  int index = 0;
  bool is_can = false;
  bool is_virtual = false;  ///< vcan, vxcan: no wire or bit rate
  bool up = false;
  bool fd = false;
  std::uint32_t bitrate = 0;     ///< bit/s; 0: unknown or none
  std::uint32_t restart_ms = 0;  ///< delay after a bus-off; 0: no restart
  bool bus_off = false;
  std::uint32_t send_errors = 0, receive_errors = 0;  ///< of the controller; 0 to 256
};

/// This PC's interfaces, CAN or not. Throws LinkError if the kernel does not answer.
std::vector<CanInterface> network_interfaces();

/// The interface, ready to be opened. Throws LinkError with the remedy if missing, down or not CAN.
CanInterface find_can_interface(const std::string& name);
CanInterface find_can_interface(const std::string& name, const std::vector<CanInterface>& all);

/// Why the interface is off the bus, with the remedy; empty: it is on it.
std::string down_trouble(const CanInterface& interface);

/// Advice for a usable interface; may be empty.
std::string advice(const CanInterface& interface);

/// Why the interface cannot carry `baud` bit/s, with the remedy. Empty: it can, or its rate is
/// unknown.
std::string bit_rate_trouble(const CanInterface& interface, const std::string& robot,
                             std::uint32_t baud);

}  // namespace verp::link
