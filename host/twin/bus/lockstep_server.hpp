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

/// Callbacks for the actions of a lockstep controller. Members may be empty.
struct LockstepHooks : SessionHooks {
  /// A frame reached the bus undamaged.
  std::function<void(std::span<const std::uint8_t> frame)> sent;
  std::function<void(std::span<const std::uint8_t> bytes, std::uint64_t now_us)> polled;
};

/// PC side of firmware/app/lockstep_messages.hpp: bytes in, bytes out. It uses no link, no wait and
/// no clock, so the same bytes give the same answers at any speed.
class LockstepServer : public LockstepSession {
 public:
  /// `bus` must outlive the server.
  LockstepServer(const Params& params, VirtualBus& bus, LockstepHooks hooks);

  /// Appends the reply to `answer`.
  void take(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& answer);

  /// Returns once the bytes before the first hello that are not for the clock; empty afterwards.
  std::vector<std::uint8_t> unannounced();

 private:
  void handle(const dxl::Packet& packet, std::vector<std::uint8_t>& answer);
  dxl::Error set_upright(std::uint8_t value);
  void hello(const lockstep::Hello& hello, std::vector<std::uint8_t>& answer);
  void advance(const lockstep::Advance& advance, std::vector<std::uint8_t>& answer);
  /// Puts the frames since the last Advance on the bus; true: a tick has begun.
  bool send_frames(const lockstep::Advance& advance);
  /// False: the controller must stop.
  bool send_frame(std::span<const std::uint8_t> frame, bool intact);

  VirtualBus& bus_;
  LockstepHooks hooks_;
  lockstep::ClockSieve sieve_;
  std::vector<std::uint8_t> frames_;  ///< received since the last Advance
  std::vector<std::uint8_t> last_;    ///< complete last answer to an Advance
};

}  // namespace verp::bus
