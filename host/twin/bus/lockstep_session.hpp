#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "common/model/params.hpp"
#include "firmware/app/lockstep_messages.hpp"

namespace verp::bus {

/// For a lockstep controller on any bus; members may be empty.
struct SessionHooks {
  /// A controller's hello, first or after a reset.
  std::function<void()> greeted;
  /// A controller was refused; the text names what differs.
  std::function<void(const std::string&)> refused;
  /// All frames of a tick (first: of the bring-up) are sent. False: the controller must stop.
  std::function<bool()> tick_ends;
  /// Tick `tick` has begun and the controller does not know it yet: time for orders.
  std::function<void(std::uint32_t tick)> tick_begins;
  /// Before this poll, frames were damaged, lost or duplicated.
  std::function<void()> damaged;
  /// A client asks to set the robot upright. False: not now.
  std::function<bool()> set_upright;
};

class LockstepSession {
 public:
  struct Counters {
    std::uint64_t polls = 0;
    std::uint32_t repeats = 0;
    std::uint32_t damaged = 0;  ///< polls with damaged, lost or duplicated frames
    std::uint32_t greetings = 0;
  };

  /// Also accepts controllers without our core; their results are not compared.
  void welcome_strangers() { strangers_ = true; }
  /// Refuses every hello: the twin runs in real time.
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

/// The first difference between that controller and this program.
lockstep::Verdict verdict_on(const lockstep::Hello& theirs, const Params& params);
/// One line for the user; empty for kAccepted.
std::string words_for(lockstep::Verdict verdict, const lockstep::Hello& theirs, const Params& ours);

}  // namespace verp::bus
