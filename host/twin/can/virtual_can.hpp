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

/// Decides who receives each frame: models a bad wire.
class Interference {
 public:
  virtual ~Interference() = default;
  Interference(const Interference&) = delete;
  Interference& operator=(const Interference&) = delete;

  /// True if this node (0: the controller) receives the frame that ends now.
  virtual bool passes(const CanFrame& frame, std::uint8_t receiver) = 0;
  /// Called after each delivery and each millisecond; may call bring().
  virtual void passed(std::uint64_t now_us) = 0;

 protected:
  Interference() = default;
};

/// A CanBus in memory with CANopen nodes on a plant, in simulated time: the same frames give the
/// same answers at the same times.
///
/// In lockstep a SYNC with counter 1 begins a tick: earlier frames go first, then it waits on the
/// wire for the next multiple of the control period. Otherwise only frames and poll's timeouts
/// advance time. A frame takes its exact bits; the lowest waiting identifier goes first. A node
/// samples for a SYNC when that ends, applies a target when its frame has arrived, and works once a
/// millisecond.
class VirtualCan final : public hal::CanBus {
 public:
  /// The plant must outlive the bus and be at time 0.
  VirtualCan(const Params& params, sim::Plant& plant);

  bool send(const CanFrame& frame) override;
  /// Advances to the end of the frame's burst: all frames that follow without a gap. The next polls
  /// return them. The caller cannot act inside a burst, on a link either (lockstep_server.hpp).
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override;
  /// The frame that the next poll returns at once, or null.
  const CanFrame* next_unread() const {
    return arrived_.empty() ? nullptr : &arrived_.front().frame;
  }
  std::uint64_t now_us() override { return now_ns_ / 1000; }
  hal::CanErrors errors() const override { return errors_; }

  void plug_in(std::unique_ptr<Node> node);
  /// Bus-off of the controller: it loses its waiting frames and returns by itself.
  void leave_bus();

  /// Control periods since the first tick, as the controller counts them; 0 before it.
  std::uint32_t tick() const { return tick_; }
  bool ticking() const { return ticking_; }
  /// A disconnected node receives nothing; its frames are lost.
  void set_connected(std::uint8_t id, bool connected);
  /// With power a node restarts with its boot-up message.
  void set_powered(std::uint8_t id, bool powered);
  static bool begins_tick(const CanFrame& frame);

  /// In real time no SYNC waits for a period, a poll ends with its frame, and send() keeps the
  /// order of its frames. bring_until() and go_on_until() advance time.
  void set_real_time(bool real_time) { real_time_ = real_time; }
  /// The next frame by `time_us`; without one, time advances to `time_us`.
  bool bring_until(std::uint64_t time_us, CanFrame& frame);
  /// Advances time to `time_us`; the next poll returns what arrives.
  void go_on_until(std::uint64_t time_us);
  /// Advances time to `time_us` and discards what arrives.
  void let_pass(std::uint64_t time_us) {
    CanFrame unheard;
    while (bring_until(time_us, unheard)) {
    }
  }

  /// Includes stuff bits and intermissions.
  std::uint64_t bits_on_wire() const { return bits_on_wire_; }
  std::uint64_t bare_bits_on_wire() const { return bare_bits_on_wire_; }
  std::uint64_t frames_on_wire() const { return frames_on_wire_; }
  /// A passive listener, called at the end of each frame.
  using Listener =
      std::function<void(const CanFrame&, std::uint64_t begin_ns, std::uint64_t end_ns)>;
  void set_listener(Listener listener) { listener_ = std::move(listener); }

  /// Null: none; it must outlive the bus or be removed.
  void set_interference(Interference* interference) { interference_ = interference; }
  /// The node (0: the controller) receives a frame that is not on the wire: repeated or late.
  void bring(const CanFrame& frame, std::uint8_t receiver);

  // For a chip model that owns the wire; it calls these before it advances.
  /// A frame has crossed that wire; only nodes receive it here.
  void crossed(const CanFrame& frame, std::uint64_t end_ns);
  void work_until(std::uint64_t time_ns);
  bool take_said(CanFrame& frame);

 private:
  struct Waiting {
    CanFrame frame;
    std::uint64_t ready_ns = 0;
    bool last = false;
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

  static constexpr std::size_t kRoom = 64;
  static constexpr std::uint64_t kWork_ns = 1'000'000;
  static constexpr std::uint64_t kNever_ns = ~std::uint64_t{0};

  Place* place_of(std::uint8_t id);
  /// Runs the next event that begins by `limit_ns`; false if there is none.
  bool step(std::uint64_t limit_ns);
  /// kNever_ns if no frame waits.
  std::uint64_t next_begin_ns() const;
  void transmit(std::uint64_t begin_ns);
  Place* arbitrate(std::uint64_t begin_ns, Waiting& winner);
  void deliver(const CanFrame& frame, const Place* sender, std::uint64_t end_ns);
  void arrive(const CanFrame& frame, std::uint64_t end_ns);
  void tell(Place& place, const CanFrame& frame, std::uint64_t end_ns);
  bool passes(const CanFrame& frame, std::uint8_t receiver) {
    return interference_ == nullptr || interference_->passes(frame, receiver);
  }
  void passed(std::uint64_t time_ns);
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
  std::uint64_t heard_ns_ = 0;  ///< last time a node received or worked
  std::uint64_t now_ns_ = 0;
  std::uint64_t wire_free_ns_ = 0;  ///< end of the intermission
  std::uint64_t next_work_ns_ = 0;
  std::uint64_t last_begin_ns_ = 0;  ///< of send()'s last frame
  bool last_waits_ = false;
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

}  // namespace verp::can
