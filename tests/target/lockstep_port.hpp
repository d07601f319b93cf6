#pragma once
#include <cstdint>
#include <vector>

#include "common/base/can_frame.hpp"
#include "hal/contract/can_bus.hpp"
#include "host/os/link/can_port.hpp"
#include "host/twin/can/lockstep_server.hpp"

namespace verp::can {

/// A lockstep controller behind a SocketCAN interface. This PC sleeps until the controller's clock
/// message arrives on a second socket.
class LockstepPort {
 public:
  /// Throws LinkError.
  explicit LockstepPort(const link::Endpoint& endpoint);

  /// Waits for a clock message, passes all frames up to it to the server, and sends the answer.
  /// False if none came in time.
  bool serve(LockstepServer& server, std::uint32_t wait_us);

  /// Current after serve().
  bool connected() const { return frames_.connected(); }
  hal::CanErrors errors() const;

 private:
  link::CanPort frames_;
  link::CanPort bell_;
  std::uint32_t rung_ = 0;   ///< clock messages that bell_ received
  std::uint32_t taken_ = 0;  ///< clock messages that frames_ received
  std::vector<CanFrame> answer_;
};

}  // namespace verp::can
