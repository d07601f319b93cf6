#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/os/link/endpoint.hpp"
#include "host/twin/bus/client.hpp"
#include "host/twin/can/client.hpp"

namespace verp::action {

enum class Offer {
  kTaken,    ///< it restarts with them
  kStopped,  ///< by the caller
  kNotYet,   ///< offer again
  kRefused,  ///< window_fault has the reason
  kArmed,    ///< its servos hold torque
  kNoRoom,   ///< for so many bytes
  kNotHere,  ///< it takes no actions in this way
};

/// A controller's registers and the path for its actions. Throws bus::DeviceError if it does not
/// answer.
class ActionPort {
 public:
  virtual ~ActionPort() = default;
  virtual std::string place() const = 0;
  virtual std::vector<std::uint8_t> read(const char* name) = 0;
  /// Sends from the beginning. `went(bytes)`: progress; false stops.
  virtual Offer offer(std::span<const std::uint8_t> image,
                      const std::function<bool(std::size_t)>& went) = 0;

  std::uint32_t number(const char* name) {
    std::uint32_t value = 0;
    const std::vector<std::uint8_t> bytes = read(name);
    for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | bytes[i];
    return value;
  }
};

/// Uses the registers' window of device `id`.
std::unique_ptr<ActionPort> serial_action_port(const link::Endpoint& endpoint, std::uint8_t id);
/// The caller keeps the client.
std::unique_ptr<ActionPort> serial_action_port(bus::Client& client, std::uint8_t id);
/// Node `id` on its robot's bus: object 5002h.
std::unique_ptr<ActionPort> can_action_port(const link::Endpoint& endpoint, std::uint8_t id);
std::unique_ptr<ActionPort> can_action_port(can::Client& client, std::uint8_t id);

struct SendOptions {
  std::string robot;
  int actions = 0;  ///< their number
  std::function<bool(std::size_t)> went = [](std::size_t) { return true; };
  double place_s = 15;  ///< limit to make a place
  double start_s = 60;  ///< limit to write and restart; 30 were too few for a busy QEMU
};

/// Sends kept_image() and waits for the restart. False: `went` stopped it. Throws bus::DeviceError;
/// unless it says otherwise, the old actions stay.
bool send_actions(ActionPort& port, std::span<const std::uint8_t> image,
                  const SendOptions& options);

}  // namespace verp::action
