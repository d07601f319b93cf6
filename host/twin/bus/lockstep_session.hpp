#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "common/model/params.hpp"
#include "firmware/app/lockstep_messages.hpp"

namespace verp::bus {

/// Callbacks for a lockstep controller on any bus. Members may be empty.
struct SessionHooks {
  /// A controller said hello: for the first time, or after a reset.
  std::function<void()> greeted;
  /// A controller was refused; the text names what differs.
  std::function<void(const std::string&)> refused;
  /// All frames of a tick are sent (before the first tick: of the bring-up) and the plant has not
  /// advanced yet. False: the session ends and the controller must stop.
  std::function<bool()> tick_ends;
  /// Tick `tick` has begun on the bus and the controller does not know it yet: the time to give
  /// orders.
  std::function<void(std::uint32_t tick)> tick_begins;
  /// Frames before this poll were damaged, lost or duplicated on the link.
  std::function<void()> damaged;
  /// A client asks to set the robot upright. False: not now.
  std::function<bool()> set_upright;
};

/// Session state of a twin's clock with its controller, on any bus; base of the lockstep servers.
class LockstepSession {
 public:
  struct Counters {
    std::uint64_t polls = 0;
    std::uint32_t repeats = 0;
    std::uint32_t damaged = 0;  ///< polls whose frames were damaged, lost or duplicated
    std::uint32_t greetings = 0;
  };

  /// Also accepts controllers without our core, whose results are not compared.
  void welcome_strangers() { strangers_ = true; }
  /// Refuses every further hello, because the twin runs in real time.
  void refuse_lockstep() { real_time_ = true; }
  bool greeted() const { return greeted_; }
  bool stopped() const { return stopped_; }
  const Counters& counters() const { return counters_; }

 protected:
  explicit LockstepSession(const Params& params) : params_(params) {}

  struct Meeting {
    lockstep::Verdict verdict = lockstep::Verdict::kAccepted;
    bool begins = false;
  };
  Meeting meet(const lockstep::Hello& hello, const SessionHooks& hooks);
  /// True if this number was answered already and the server must repeat the answer.
  bool asks_again(std::uint8_t sequence);
  void note_answer(std::uint8_t sequence);
  void note_damage(const SessionHooks& hooks);

  bool stopped_ = false;

 private:
  const Params& params_;
  Counters counters_;
  std::uint8_t sequence_ = 0;
  bool answered_ = false;
  bool greeted_ = false;
  bool real_time_ = false;
  bool strangers_ = false;
};

/// The first property in which the controller of `theirs` and this program differ.
lockstep::Verdict verdict_on(const lockstep::Hello& theirs, const Params& params);
/// The difference as one line for a person; empty for kAccepted.
std::string words_for(lockstep::Verdict verdict, const lockstep::Hello& theirs, const Params& ours);

}  // namespace verp::bus
