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

/// Callbacks for the actions of a lockstep controller. Members may be empty.
struct LockstepHooks : bus::SessionHooks {
  /// A frame reached the bus, and so did all others before the same poll.
  std::function<void(const CanFrame& frame)> sent;
  std::function<void(const std::vector<CanFrame>& burst, std::uint64_t now_us)> polled;
};

/// PC side of firmware/app/lockstep_can_messages.hpp: frames in, frames out. It uses no interface,
/// no wait and no clock, so the same frames give the same answers at any speed. Other nodes may
/// share the interface. Frames that no controller sends do not reach the bus. Foreign requests and
/// commands do, and count as damage.
class LockstepServer : public bus::LockstepSession {
 public:
  /// `bus` must outlive the server.
  LockstepServer(const Params& params, VirtualCan& bus, LockstepHooks hooks);

  /// Appends the reply to `answer`.
  void take(const CanFrame& frame, std::vector<CanFrame>& answer);

  /// Queues a frame, for example a request, for the controller's own node. It goes with one of the
  /// next answers, where a small receive FIFO has room for it. A full queue drops its oldest frame;
  /// a new controller clears the queue.
  void enclose(const CanFrame& frame);

  /// Returns once the frames before the first hello that are not for the clock; empty afterwards.
  std::vector<CanFrame> unannounced();

 private:
  void hello(const lockstep::Hello& hello, std::vector<CanFrame>& answer);
  void advance(const lockstep::CanAdvance& advance, std::vector<CanFrame>& answer);
  /// Puts the frames since the last CanAdvance on the bus. False: no more ticks.
  bool send_frames(bool whole);
  /// Fills last_ with the next burst, as far as it fits an answer with `room` already used.
  void bring_burst(std::uint32_t timeout_us, std::size_t room);
  /// Appends the next queued frame for the controller's node; returns the room it takes.
  std::size_t bring_enclosed(std::vector<CanFrame>& answer);
  /// True if the received frames are those that the controller sent.
  bool is_whole(const lockstep::CanAdvance& advance) const;
  /// The same after dropping other nodes' frames.
  bool make_whole(const lockstep::CanAdvance& advance);

  VirtualCan& bus_;
  LockstepHooks hooks_;
  lockstep::CanHello hello_;
  std::vector<CanFrame> frames_;   ///< received since the last CanAdvance
  std::vector<CanFrame> last_;     ///< complete last answer
  std::deque<CanFrame> enclosed_;  ///< for the controller's node, not sent yet
};

}  // namespace verp::can
