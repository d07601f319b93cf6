#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "firmware/app/lockstep_messages.hpp"
#include "host/bus/virtual_bus.hpp"

namespace verp::bus {

/// What a controller in lockstep does, as it does it. Empty members are allowed.
struct LockstepHooks {
  /// A controller began: at first, or again after a reset.
  std::function<void()> greeted;
  /// One was turned away; the words say on what both ends differ.
  std::function<void(const std::string&)> refused;
  /// The frames of a tick (before the first: of the bring-up) have all been sent, and the plant has
  /// not gone on yet. False: no further tick; the controller is told to stop.
  std::function<bool()> tick_ends;
  /// Tick `tick` has begun on the bus, and the controller does not know yet: the moment to give it
  /// orders.
  std::function<void(std::uint32_t tick)> tick_begins;
  /// A frame that reached the bus as it was sent.
  std::function<void(std::span<const std::uint8_t> frame)> sent;
  /// Frames before this poll were damaged on the link.
  std::function<void()> damaged;
  /// Somebody wants the robot set on its feet. False: not now.
  std::function<bool()> set_upright;
  /// What a poll brought.
  std::function<void(std::span<const std::uint8_t> bytes, std::uint64_t now_us)> polled;
};

/// The PC's end of firmware/app/lockstep_messages.hpp: bytes in, bytes out. It knows no link, waits
/// for nothing and asks no clock, so the same bytes give the same answers at any speed.
class LockstepServer {
 public:
  struct Counters {
    std::uint64_t polls = 0;
    std::uint32_t repeats = 0;  ///< answers given again
    std::uint32_t damaged = 0;  ///< polls before which frames were damaged on the link
    std::uint32_t greetings = 0;
  };

  /// The bus must outlive the server.
  LockstepServer(const Params& params, VirtualBus& bus, LockstepHooks hooks);

  /// Takes what the controller sent; appends to `answer` what it is to get.
  void take(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& answer);

  /// What came before the first hello and is not for the clock, once; afterwards nothing.
  std::vector<std::uint8_t> unannounced();
  /// From now on every hello is refused: the twin runs in real time.
  void refuse_lockstep() { real_time_ = true; }

  /// True once a controller has announced lockstep.
  bool greeted() const { return greeted_; }
  /// The controller was told to stop.
  bool stopped() const { return stopped_; }
  const Counters& counters() const { return counters_; }

 private:
  void handle(const dxl::Packet& packet, std::vector<std::uint8_t>& answer);
  dxl::Error set_upright(std::uint8_t value);
  void hello(const lockstep::Hello& hello, std::vector<std::uint8_t>& answer);
  void advance(const lockstep::Advance& advance, std::vector<std::uint8_t>& answer);
  /// Puts what came since the last Advance on the bus; true: a tick has begun.
  bool send_frames(const lockstep::Advance& advance);
  /// False: the controller is to stop.
  bool send_frame(std::span<const std::uint8_t> frame, bool intact);

  const Params& params_;
  VirtualBus& bus_;
  LockstepHooks hooks_;
  lockstep::ClockSieve sieve_;
  Counters counters_;
  std::vector<std::uint8_t> frames_;  ///< came since the last Advance
  std::vector<std::uint8_t> last_;    ///< the whole last answer to an Advance
  std::uint8_t sequence_ = 0;         ///< of that Advance
  bool answered_ = false;             ///< since the hello
  bool greeted_ = false;
  bool stopped_ = false;
  bool real_time_ = false;
};

/// The first thing on which a controller that says `theirs` and this program differ.
lockstep::Verdict verdict_on(const lockstep::Hello& theirs, const Params& params);
/// One line of what differs, for a person; empty for kAccepted.
std::string words_for(lockstep::Verdict verdict, const lockstep::Hello& theirs, const Params& ours);

}  // namespace verp::bus
