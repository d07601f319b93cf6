#include "host/twin/bus/lockstep_session.hpp"

#include <cstdio>

#include "common/control/state.hpp"
#include "common/model/image.hpp"
#include "common/record/tick_record.hpp"

namespace verp::bus {

lockstep::Verdict verdict_on(const lockstep::Hello& theirs, const Params& params) {
  using lockstep::Verdict;
  if (theirs.version != lockstep::kVersion) return Verdict::kOtherLink;
  if (theirs.params_size != sizeof(Params) || theirs.record_size != sizeof(TickRecord) ||
      theirs.state_size != sizeof(State)) {
    return Verdict::kOtherLayout;
  }
  if (theirs.core_version != kCoreVersion) return Verdict::kOtherCore;
  return theirs.params_crc == params_crc(params) ? Verdict::kAccepted : Verdict::kOtherRobot;
}

std::string words_for(lockstep::Verdict verdict, const lockstep::Hello& theirs,
                      const Params& ours) {
  const auto hex = [](std::uint32_t value) {
    char text[11];
    std::snprintf(text, sizeof text, "%08x", static_cast<unsigned>(value));
    return std::string(text);
  };
  switch (verdict) {
    case lockstep::Verdict::kOtherLink:
      return "the controller speaks version " + std::to_string(theirs.version) +
             " of the lockstep link, this program version " + std::to_string(lockstep::kVersion) +
             "; rebuild its firmware";
    case lockstep::Verdict::kOtherLayout:
      return "the controller's Params, record or State have other sizes (" +
             std::to_string(theirs.params_size) + ", " + std::to_string(theirs.record_size) + ", " +
             std::to_string(theirs.state_size) + " bytes, here " + std::to_string(sizeof(Params)) +
             ", " + std::to_string(sizeof(TickRecord)) + ", " + std::to_string(sizeof(State)) +
             "); rebuild its firmware";
    case lockstep::Verdict::kOtherCore:
      return "the controller's core has version " + std::to_string(theirs.core_version) +
             ", this program's " + std::to_string(kCoreVersion) + "; rebuild its firmware";
    case lockstep::Verdict::kOtherRobot:
      return "the controller's Params are not those of " + std::string(ours.name) + " (CRC " +
             hex(theirs.params_crc) + ", here " + hex(params_crc(ours)) +
             "); flash this model's Params, or name the controller's model";
    case lockstep::Verdict::kNoLockstep:
      return "the controller wants lockstep, but the twin already serves a master in real time; "
             "start verp hil again, then the controller";
    case lockstep::Verdict::kAccepted:
    case lockstep::Verdict::kNoAnswer:
      break;
  }
  return "";
}

namespace {

bool is_stranger(const lockstep::Hello& hello) {
  return hello.version == lockstep::kVersion && hello.core_version == 0 && hello.params_size == 0 &&
         hello.params_crc == 0 && hello.record_size == 0 && hello.state_size == 0;
}

}  // namespace

LockstepSession::Meeting LockstepSession::meet(const lockstep::Hello& hello,
                                               const SessionHooks& hooks) {
  Meeting meeting;
  const bool welcome = strangers_ && is_stranger(hello);
  meeting.verdict = real_time_ ? lockstep::Verdict::kNoLockstep
                    : welcome  ? lockstep::Verdict::kAccepted
                               : verdict_on(hello, params_);
  const bool repeated = greeted_ && !answered_;
  greeted_ = meeting.verdict == lockstep::Verdict::kAccepted;
  meeting.begins = greeted_ && !repeated;
  if (meeting.begins) {
    answered_ = false;
    ++counters_.greetings;
    if (hooks.greeted) hooks.greeted();
  }
  if (!greeted_ && hooks.refused) hooks.refused(words_for(meeting.verdict, hello, params_));
  return meeting;
}

bool LockstepSession::asks_again(std::uint8_t sequence) {
  const bool again = answered_ && sequence == sequence_;
  if (again) ++counters_.repeats;
  if (!again) ++counters_.polls;
  return again;
}

void LockstepSession::note_answer(std::uint8_t sequence) {
  answered_ = true;
  sequence_ = sequence;
}

void LockstepSession::note_damage(const SessionHooks& hooks) {
  ++counters_.damaged;
  if (hooks.damaged) hooks.damaged();
}

}  // namespace verp::bus
