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

/// Members may be empty.
struct LockstepHooks : bus::SessionHooks {
  /// The frame and all others before the same poll have reached the bus.
  std::function<void(const CanFrame& frame)> sent;
  std::function<void(const std::vector<CanFrame>& burst, std::uint64_t now_us)> polled;
};

/// PC side of firmware/app/lockstep_can_messages.hpp, without interface and clock. Frames that no
/// controller sends do not reach the bus; foreign requests and commands do, and count as damage.
class LockstepServer : public bus::LockstepSession {
 public:
  /// `bus` must outlive the server.
  LockstepServer(const Params& params, VirtualCan& bus, LockstepHooks hooks);

  void take(const CanFrame& frame, std::vector<CanFrame>& answer);

  /// Queues a frame for the controller's own node. It goes with one of the next answers that has
  /// room for it. A full queue drops its oldest frame; a new controller clears the queue.
  void enclose(const CanFrame& frame);

  /// Frames before the first hello that are not for the clock; empty afterwards.
  std::vector<CanFrame> unannounced();

 private:
  void hello(const lockstep::Hello& hello, std::vector<CanFrame>& answer);
  void advance(const lockstep::CanAdvance& advance, std::vector<CanFrame>& answer);
  /// Puts the frames since the last CanAdvance on the bus. False: no more ticks.
  bool send_frames(bool whole);
  /// Fills last_ with the next burst, as far as it fits an answer with `room` already used.
  void bring_burst(std::uint32_t timeout_us, std::size_t room);
  /// Returns the room that the frame takes.
  std::size_t bring_enclosed(std::vector<CanFrame>& answer);
  bool is_whole(const lockstep::CanAdvance& advance) const;
  /// As is_whole(), after dropping other nodes' frames.
  bool make_whole(const lockstep::CanAdvance& advance);

  VirtualCan& bus_;
  LockstepHooks hooks_;
  lockstep::CanHello hello_;
  std::vector<CanFrame> frames_;
  std::vector<CanFrame> last_;     ///< complete last answer
  std::deque<CanFrame> enclosed_;  ///< for the controller's node, not sent yet
};

}  // namespace verp::can
