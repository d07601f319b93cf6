#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "common/model/params.hpp"
#include "common/protocol/canopen/bus_load.hpp"
#include "hal/contract/can_bus.hpp"
#include "host/twin/can/node.hpp"
#include "host/twin/sim/plant.hpp"

namespace verp::can {

/// What frames meet on their way to each of those who hear them: what a wire does that is not as
/// good as this one.
class Interference {
 public:
  virtual ~Interference() = default;
  Interference(const Interference&) = delete;
  Interference& operator=(const Interference&) = delete;

  /// Whether this node (0: the controller) hears the frame that ends now. Asked for each that is
  /// there.
  virtual bool passes(const CanFrame& frame, std::uint8_t receiver) = 0;
  /// Those who hear a frame have heard it, or a millisecond has passed. May bring() others.
  virtual void passed(std::uint64_t now_us) = 0;

 protected:
  Interference() = default;
};

/// A robot's CAN bus in memory: a CanBus whose CANopen nodes stand on a plant, in simulated time.
///
/// Lockstep: a SYNC with counter 1 begins a tick. All that was sent before goes first, then it
/// waits on the wire for the next multiple of the control period; nothing else lets time pass but
/// frames and poll's timeouts. Frames take exactly their bits with the stuff bits that their own
/// bits cause; among those that wait when the wire becomes free the lowest identifier goes first.
/// Nodes sample what a SYNC asks for when it ends, targets take effect when their frame has
/// arrived, and each node works once a millisecond. Deterministic: the same frames give the same
/// answers at the same times.
class VirtualCan {
 public:
  /// Drives, IMU and feet as `params` names them. The plant must outlive the bus and stand at time
  /// 0.
  VirtualCan(const Params& params, sim::Plant& plant);

  bool send(const CanFrame& frame);
  /// Time goes on to the end of the burst that the frame belongs to: all that follows it on the
  /// wire without a rest, which the next polls bring. Who polls has no say in between, whether he
  /// is here or at the end of a link that brings a whole burst at once (lockstep_server.hpp).
  bool poll(CanFrame& frame, std::uint32_t timeout_us);
  /// What the next poll brings without any time going by; null if it would have to wait.
  const CanFrame* next_unread() const {
    return arrived_.empty() ? nullptr : &arrived_.front().frame;
  }
  std::uint64_t now_us() const { return now_ns_ / 1000; }
  hal::CanErrors errors() const { return errors_; }

  /// One more node: a tool, or an intruder.
  void plug_in(std::unique_ptr<Node> node);
  /// The controller has made too many errors: it leaves the bus, loses what waits, and comes back
  /// by itself.
  void leave_bus();

  /// Control periods since the first tick; 0 before it. The controller counts the same ticks.
  std::uint32_t tick() const { return tick_; }
  /// True once the first tick has begun.
  bool ticking() const { return ticking_; }
  /// Unplugs a node or plugs it in again; unplugged it hears nothing, and what it says is lost.
  void set_connected(std::uint8_t id, bool connected);
  /// Cuts a node's power or gives it back: then it begins anew, with its boot-up message.
  void set_powered(std::uint8_t id, bool powered);
  /// Whether a frame makes a tick begin, if time does not go on by itself.
  static bool begins_tick(const CanFrame& frame);

  /// In real time no SYNC waits for a period to begin, a poll ends with its frame, not with a
  /// burst, and what send() takes keeps its order, as it has on the interface that it comes from;
  /// bring_until() and go_on_until() let time go on.
  void set_real_time(bool real_time) { real_time_ = real_time; }
  /// The next frame that arrives up to `time_us`. If there is none, time goes on to there, and the
  /// plant follows.
  bool bring_until(std::uint64_t time_us, CanFrame& frame);
  /// Lets time go on up to there; what arrives meanwhile, waits for the next poll.
  void go_on_until(std::uint64_t time_us);
  /// Lets time go on up to there; what arrives meanwhile, nobody hears.
  void let_pass(std::uint64_t time_us) {
    CanFrame unheard;
    while (bring_until(time_us, unheard)) {
    }
  }

  /// All bits that crossed the wire so far, stuff bits and intermissions included.
  std::uint64_t bits_on_wire() const { return bits_on_wire_; }
  /// As many of them as were no stuff bits.
  std::uint64_t bare_bits_on_wire() const { return bare_bits_on_wire_; }
  std::uint64_t frames_on_wire() const { return frames_on_wire_; }
  /// Called for each frame when it ends: who listens on the wire besides.
  using Listener =
      std::function<void(const CanFrame&, std::uint64_t begin_ns, std::uint64_t end_ns)>;
  void set_listener(Listener listener) { listener_ = std::move(listener); }

  /// Null: none. It must outlive the bus, or be taken away.
  void set_interference(Interference* interference) { interference_ = interference; }
  /// This node (0: the controller) hears a frame now that is not on the wire: once more, or late.
  void bring(const CanFrame& frame, std::uint8_t receiver);

  // Nodes on the wire of somebody else, who models a chip: he asks each time before he goes on.
  /// A frame has crossed it. Only nodes hear it here.
  void crossed(const CanFrame& frame, std::uint64_t end_ns);
  /// The nodes work up to there.
  void work_until(std::uint64_t time_ns);
  /// The next frame that a node wants to send over it.
  bool take_said(CanFrame& frame);

 private:
  /// Who sends: a node, or the controller.
  struct Waiting {
    CanFrame frame;
    std::uint64_t ready_ns = 0;
    bool last = false;  ///< the last one that send() accepted
  };
  struct Place {
    std::unique_ptr<Node> node;
    std::deque<Waiting> out;
    bool connected = true;
    bool powered = true;
  };
  struct Arrival {
    CanFrame frame;
    std::uint64_t end_ns = 0;
  };

  /// Frames that the controller may leave unread.
  static constexpr std::size_t kRoom = 64;
  static constexpr std::uint64_t kWork_ns = 1'000'000;
  static constexpr std::uint64_t kNever_ns = ~std::uint64_t{0};

  Place* place_of(std::uint8_t id);
  /// The next thing that happens, if it begins at or before `limit_ns`; false if nothing does.
  bool step(std::uint64_t limit_ns);
  /// When the next frame begins; kNever_ns if none waits.
  std::uint64_t next_begin_ns() const;
  void transmit(std::uint64_t begin_ns);
  /// Takes the winner of the arbitration out of its queue; null: it is the controller's.
  Place* arbitrate(std::uint64_t begin_ns, Waiting& winner);
  void deliver(const CanFrame& frame, const Place* sender, std::uint64_t end_ns);
  void arrive(const CanFrame& frame, std::uint64_t end_ns);
  void tell(Place& place, const CanFrame& frame, std::uint64_t end_ns);
  bool passes(const CanFrame& frame, std::uint8_t receiver) {
    return interference_ == nullptr || interference_->passes(frame, receiver);
  }
  void passed(std::uint64_t time_ns);
  /// Takes the plant there.
  void reach(std::uint64_t time_ns);
  void work(std::uint64_t time_ns);
  void collect(Place& place, std::uint64_t time_ns);
  bool take(std::uint64_t deadline_ns, CanFrame& frame);
  void begin_tick();

  sim::Plant& plant_;
  std::uint64_t period_ns_;
  canopen::BitRates rates_;
  std::vector<Place> places_;
  std::deque<Waiting> out_;  ///< the controller's
  std::deque<Arrival> arrived_;
  hal::CanErrors errors_;
  Listener listener_;
  Interference* interference_ = nullptr;
  std::uint64_t heard_ns_ = 0;  ///< when somebody heard or worked last
  std::uint64_t now_ns_ = 0;
  std::uint64_t wire_free_ns_ = 0;  ///< when the last frame's intermission ends
  std::uint64_t next_work_ns_ = 0;
  std::uint64_t last_begin_ns_ = 0;  ///< of the last frame that send() accepted
  bool last_waits_ = false;          ///< it has not begun yet
  std::uint64_t off_until_ns_ = 0;
  std::uint64_t tick_start_ns_ = 0;
  std::uint64_t first_tick_ns_ = 0;
  std::uint64_t bits_on_wire_ = 0;
  std::uint64_t bare_bits_on_wire_ = 0;
  std::uint64_t frames_on_wire_ = 0;
  std::uint32_t tick_ = 0;
  bool ticking_ = false;
  bool real_time_ = false;
};

static_assert(hal::CanBus<VirtualCan>);

}  // namespace verp::can
