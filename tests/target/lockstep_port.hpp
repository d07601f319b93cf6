#pragma once
#include <cstdint>
#include <vector>

#include "common/base/can_frame.hpp"
#include "hal/contract/can_bus.hpp"
#include "host/can/lockstep_server.hpp"
#include "host/link/can_port.hpp"

namespace verp::can {

/// A controller in lockstep at the other end of a SocketCAN interface. Nothing is to be done before
/// it asks for time, so this PC sleeps until then: a second socket, which hears the controller's
/// messages of the clock alone, says when. Answers leave in one call.
class LockstepPort {
 public:
  /// Throws LinkError.
  explicit LockstepPort(const wire::Endpoint& endpoint);

  /// Waits for a message of the clock; hands the server all up to it, in order, and sends its
  /// answer. False: none came in time.
  bool serve(LockstepServer& server, std::uint32_t wait_us);

  /// The interface is up. Up to date after serve().
  bool connected() const { return frames_.connected(); }
  hal::CanErrors errors() const;

 private:
  wire::CanPort frames_;
  wire::CanPort bell_;
  std::uint32_t rung_ = 0;   ///< messages of the clock that bell_ heard
  std::uint32_t taken_ = 0;  ///< and that frames_ brought
  std::vector<CanFrame> answer_;
};

}  // namespace verp::can
