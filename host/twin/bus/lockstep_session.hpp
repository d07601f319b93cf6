#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "common/model/params.hpp"
#include "firmware/app/lockstep_messages.hpp"

namespace verp::bus {

/// What a controller in lockstep does, as it does it, on whatever bus. Empty members are allowed.
struct SessionHooks {
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
  /// Frames before this poll were damaged or lost on the link, or came twice.
  std::function<void()> damaged;
  /// Somebody wants the robot set on its feet. False: not now.
  std::function<bool()> set_upright;
};

/// What a twin's clock knows of its controller, on whatever bus: the base of the lockstep servers.
class LockstepSession {
 public:
  struct Counters {
    std::uint64_t polls = 0;
    std::uint32_t repeats = 0;  ///< answers given again
    std::uint32_t damaged = 0;  ///< polls before which frames were damaged, lost or doubled
    std::uint32_t greetings = 0;
  };

  /// A controller that has not our core is as welcome: nobody compares its bits.
  void welcome_strangers() { strangers_ = true; }
  /// From now on every hello is refused: the twin runs in real time.
  void refuse_lockstep() { real_time_ = true; }
  /// True once a controller has announced lockstep.
  bool greeted() const { return greeted_; }
  /// The controller was told to stop.
  bool stopped() const { return stopped_; }
  const Counters& counters() const { return counters_; }

 protected:
  explicit LockstepSession(const Params& params) : params_(params) {}

  /// A controller says hello: what it is to be told, and whether it begins anew.
  struct Meeting {
    lockstep::Verdict verdict = lockstep::Verdict::kAccepted;
    bool begins = false;
  };
  Meeting meet(const lockstep::Hello& hello, const SessionHooks& hooks);
  /// A controller asks for time: true if it was answered this number, and is to get that again.
  bool asks_again(std::uint8_t sequence);
  void note_answer(std::uint8_t sequence);
  void note_damage(const SessionHooks& hooks);

  bool stopped_ = false;

 private:
  const Params& params_;
  Counters counters_;
  std::uint8_t sequence_ = 0;  ///< of the last poll
  bool answered_ = false;      ///< since the hello
  bool greeted_ = false;
  bool real_time_ = false;
  bool strangers_ = false;
};

/// The first thing on which a controller that says `theirs` and this program differ.
lockstep::Verdict verdict_on(const lockstep::Hello& theirs, const Params& params);
/// One line of what differs, for a person; empty for kAccepted.
std::string words_for(lockstep::Verdict verdict, const lockstep::Hello& theirs, const Params& ours);

}  // namespace verp::bus
