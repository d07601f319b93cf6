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

/// Members may be empty.
struct LockstepHooks : SessionHooks {
  std::function<void(std::span<const std::uint8_t> frame)> sent;
  std::function<void(std::span<const std::uint8_t> bytes, std::uint64_t now_us)> polled;
};

/// PC side of firmware/app/lockstep_messages.hpp, without link and clock.
class LockstepServer : public LockstepSession {
 public:
  /// `bus` must outlive the server.
  LockstepServer(const Params& params, VirtualBus& bus, LockstepHooks hooks);

  void take(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& answer);

  /// Bytes before the first hello that are not for the clock; empty afterwards.
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
  std::vector<std::uint8_t> frames_;
  std::vector<std::uint8_t> last_;
};

}  // namespace verp::bus
