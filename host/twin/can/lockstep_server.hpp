#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "common/model/params.hpp"
#include "firmware/app/lockstep_can_messages.hpp"
#include "host/twin/bus/lockstep_session.hpp"
#include "host/twin/can/virtual_can.hpp"

namespace verp::can {

/// What a controller in lockstep does, as it does it. Empty members are allowed.
struct LockstepHooks : bus::SessionHooks {
  /// A frame that reached the bus, of those before a poll that all did.
  std::function<void(const CanFrame& frame)> sent;
  /// What a poll brought: a burst.
  std::function<void(const std::vector<CanFrame>& burst, std::uint64_t now_us)> polled;
};

/// The PC's end of firmware/app/lockstep_can_messages.hpp: frames in, frames out. It knows no
/// interface, waits for nothing and asks no clock, so the same frames give the same answers at any
/// speed. Others may speak on the interface as well: frames that no controller sends do not reach
/// the bus; their requests and commands do, and are damage.
class LockstepServer : public bus::LockstepSession {
 public:
  /// The bus must outlive the server.
  LockstepServer(const Params& params, VirtualCan& bus, LockstepHooks hooks);

  /// Takes a frame of the controller; appends to `answer` what it is to get.
  void take(const CanFrame& frame, std::vector<CanFrame>& answer);

  /// Something for the controller's own node, as a request: it goes with one of the next answers,
  /// where a small receive FIFO has room for it. Of what finds no answer the oldest is dropped, and
  /// all of it when a controller begins.
  void enclose(const CanFrame& frame);

  /// What came before the first hello and is not for the clock, once; afterwards nothing.
  std::vector<CanFrame> unannounced();

 private:
  void hello(const lockstep::Hello& hello, std::vector<CanFrame>& answer);
  void advance(const lockstep::CanAdvance& advance, std::vector<CanFrame>& answer);
  /// Puts what came since the last CanAdvance on the bus. False: there are to be no more ticks.
  bool send_frames(bool whole);
  /// The next burst, as much of it as fits an answer of which `room` is taken: last_.
  void bring_burst(std::uint32_t timeout_us, std::size_t room);
  /// The next of what waits for the controller's node; returns the room that it takes.
  std::size_t bring_enclosed(std::vector<CanFrame>& answer);
  /// Whether what came is what the controller sent.
  bool is_whole(const lockstep::CanAdvance& advance) const;
  /// The same, once what others say is dropped.
  bool make_whole(const lockstep::CanAdvance& advance);

  VirtualCan& bus_;
  LockstepHooks hooks_;
  lockstep::CanHello hello_;
  std::vector<CanFrame> frames_;   ///< came since the last CanAdvance
  std::vector<CanFrame> last_;     ///< the whole last answer
  std::deque<CanFrame> enclosed_;  ///< for the controller's node, and not sent yet
};

}  // namespace verp::can
