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

/// Sends actions to a running controller.
namespace verp::action {

enum class Offer {
  kTaken,    ///< completely; it restarts with them
  kStopped,  ///< by the caller
  kNotYet,   ///< it makes a place: offer again
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
  /// The controller's name in errors.
  virtual std::string place() const = 0;
  virtual std::vector<std::uint8_t> read(const char* name) = 0;
  /// Sends the image from its beginning. `went(bytes)` gets the progress; false stops.
  virtual Offer offer(std::span<const std::uint8_t> image,
                      const std::function<bool(std::size_t)>& went) = 0;

  std::uint32_t number(const char* name) {
    std::uint32_t value = 0;
    const std::vector<std::uint8_t> bytes = read(name);
    for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | bytes[i];
    return value;
  }
};

/// The registers' window at the operator's port of device `id`.
std::unique_ptr<ActionPort> serial_action_port(const link::Endpoint& endpoint, std::uint8_t id);
/// The caller keeps the client.
std::unique_ptr<ActionPort> serial_action_port(bus::Client& client, std::uint8_t id);
/// Node `id` on its robot's CAN bus: object 5002h.
std::unique_ptr<ActionPort> can_action_port(const link::Endpoint& endpoint, std::uint8_t id);
std::unique_ptr<ActionPort> can_action_port(can::Client& client, std::uint8_t id);

struct SendOptions {
  std::string robot;
  int actions = 0;  ///< their number
  std::function<bool(std::size_t)> went = [](std::size_t) { return true; };
  double place_s = 15;  ///< time limit to make a place
  double start_s = 30;  ///< time limit to write and restart
};

/// Sends the image (kept_image()) and waits until the controller restarts with it. False: `went`
/// stopped it. Throws bus::DeviceError; unless that says otherwise, the controller keeps its old
/// actions.
bool send_actions(ActionPort& port, std::span<const std::uint8_t> image,
                  const SendOptions& options);

}  // namespace verp::action
