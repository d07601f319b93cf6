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

/// Actions to a controller that runs, block by block.
namespace verp::action {

/// What became of an offer of actions.
enum class Offer {
  kTaken,    ///< all of it; the controller starts anew with it
  kStopped,  ///< by who offered it
  kNotYet,   ///< it makes a place for them: offer them again
  kRefused,  ///< window_fault says why
  kArmed,    ///< its servos hold torque
  kNoRoom,   ///< for so many bytes
  kNotHere,  ///< it takes no actions in this way
};

/// A controller's registers, and the way that its actions take. Throws bus::DeviceError if nobody
/// answers.
class ActionPort {
 public:
  virtual ~ActionPort() = default;
  /// What errors call it.
  virtual std::string place() const = 0;
  virtual std::vector<std::uint8_t> read(const char* name) = 0;
  /// From its beginning on; `went(bytes)` tells how far it is, and false stops it.
  virtual Offer offer(std::span<const std::uint8_t> image,
                      const std::function<bool(std::size_t)>& went) = 0;

  /// A register that is a number.
  std::uint32_t number(const char* name) {
    std::uint32_t value = 0;
    const std::vector<std::uint8_t> bytes = read(name);
    for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | bytes[i];
    return value;
  }
};

/// At the operator's port of device `id`: the window of its registers.
std::unique_ptr<ActionPort> serial_action_port(const link::Endpoint& endpoint, std::uint8_t id);
/// Over a client that stays the caller's.
std::unique_ptr<ActionPort> serial_action_port(bus::Client& client, std::uint8_t id);
/// On its robot's CAN bus, as node `id`: object 5002h.
std::unique_ptr<ActionPort> can_action_port(const link::Endpoint& endpoint, std::uint8_t id);
std::unique_ptr<ActionPort> can_action_port(can::Client& client, std::uint8_t id);

struct SendOptions {
  std::string robot;  ///< whose actions they are
  int actions = 0;    ///< how many
  std::function<bool(std::size_t)> went = [](std::size_t) { return true; };
  double place_s = 15;  ///< that a controller may need to make a place for them
  double start_s = 30;  ///< and to write them, and start with them
};

/// Sends the image (kept_image()) and waits until the controller has started anew with it. False:
/// `went` stopped it. Throws bus::DeviceError with the reason; the controller keeps the actions
/// that it had, unless the reason says otherwise.
bool send_actions(ActionPort& port, std::span<const std::uint8_t> image,
                  const SendOptions& options);

}  // namespace verp::action
