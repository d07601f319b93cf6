#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/model/params.hpp"
#include "firmware/app/lockstep_messages.hpp"
#include "host/twin/bus/lockstep_session.hpp"
#include "host/twin/bus/virtual_bus.hpp"

namespace verp::bus {

/// What a controller in lockstep does, as it does it. Empty members are allowed.
struct LockstepHooks : SessionHooks {
  /// A frame that reached the bus as it was sent.
  std::function<void(std::span<const std::uint8_t> frame)> sent;
  /// What a poll brought.
  std::function<void(std::span<const std::uint8_t> bytes, std::uint64_t now_us)> polled;
};

/// The PC's end of firmware/app/lockstep_messages.hpp: bytes in, bytes out. It knows no link, waits
/// for nothing and asks no clock, so the same bytes give the same answers at any speed.
class LockstepServer : public LockstepSession {
 public:
  /// The bus must outlive the server.
  LockstepServer(const Params& params, VirtualBus& bus, LockstepHooks hooks);

  /// Takes what the controller sent; appends to `answer` what it is to get.
  void take(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& answer);

  /// What came before the first hello and is not for the clock, once; afterwards nothing.
  std::vector<std::uint8_t> unannounced();

 private:
  void handle(const dxl::Packet& packet, std::vector<std::uint8_t>& answer);
  dxl::Error set_upright(std::uint8_t value);
  void hello(const lockstep::Hello& hello, std::vector<std::uint8_t>& answer);
  void advance(const lockstep::Advance& advance, std::vector<std::uint8_t>& answer);
  /// Puts what came since the last Advance on the bus; true: a tick has begun.
  bool send_frames(const lockstep::Advance& advance);
  /// False: the controller is to stop.
  bool send_frame(std::span<const std::uint8_t> frame, bool intact);

  VirtualBus& bus_;
  LockstepHooks hooks_;
  lockstep::ClockSieve sieve_;
  std::vector<std::uint8_t> frames_;  ///< came since the last Advance
  std::vector<std::uint8_t> last_;    ///< the whole last answer to an Advance
};

}  // namespace verp::bus
