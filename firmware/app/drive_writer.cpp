#include "firmware/app/drive_writer.hpp"

namespace verp::app {

void DriveWriter::note(int joint, State state) {
  state_[joint] = state;
  if (state == State::kOperationEnabled) enabled_ |= told_ & 1u << joint;
}

bool DriveWriter::has_torque(int joint) const {
  return ((told_ & (enabled_ | (patience_ == 0 ? ~0u : 0u))) >> joint & 1) != 0;
}

void DriveWriter::send(CanMaster& master, const Outputs& outputs, std::uint32_t doubted,
                       std::uint32_t limp) {
  const std::uint32_t wanted = outputs.torque_enable & all_joints(params_);
  begin(wanted, doubted, limp);
  set_words(wanted, doubted);
  if (wanted != 0) send_goals(master, outputs, wanted);
  if (wanted != 0) set_strengths(percent_in(outputs.mode));
  send_frames(master, canopen::plan::kWords, word_, words_due_);
  if (wanted != 0) send_frames(master, canopen::plan::kStrengths, strength_, strengths_due_);
  send_one_in_turn(master, wanted != 0);
}

bool DriveWriter::holds(int joint) const {
  return state_[joint] == State::kOperationEnabled || state_[joint] == State::kQuickStopActive;
}

void DriveWriter::begin(std::uint32_t wanted, std::uint32_t doubted, std::uint32_t limp) {
  if ((wanted & ~wanted_) != 0) {
    early_ = kRepeats - 1;
    together_ = kTogether;
    for (std::uint8_t& due : strengths_due_) due = kRepeats;
  } else if (early_ > 0) {
    --early_;
  }
  wanted_ = wanted;
  told_ &= wanted & ~limp;
  enabled_ &= told_;
  if (patience_ > 0) --patience_;
  if (early_ > 0) return;
  std::uint32_t on = 0;
  for (int j = 0; j < params_.servo_count(); ++j) on |= switched_on(j) ? 1u << j : 0;
  const std::uint32_t candidates = wanted & ~doubted;
  if (together_ > 0) --together_;
  if ((candidates & ~on) != 0 && together_ > 0) return;
  if ((candidates & on & ~told_) != 0) patience_ = kEnableUs / params_.period_us + kRepeats;
  told_ |= candidates & on;
}

std::uint16_t DriveWriter::word_for(int joint, bool wanted, bool doubted) const {
  using namespace canopen::cia402;
  if (!wanted) return kWordDisableVoltage;
  // A drive that lost its power ignores this word without earlier ones.
  if ((told_ >> joint & 1) != 0) return kWordEnableOperation;
  if (doubted) return kWordDisableVoltage;
  switch (state_[joint]) {
    case State::kSwitchOnDisabled:
      return kWordShutdown;
    case State::kReadyToSwitchOn:
    case State::kSwitchedOn:
      return kWordSwitchOn;
    default:
      return kWordDisableVoltage;
  }
}

void DriveWriter::set_words(std::uint32_t wanted, std::uint32_t doubted) {
  for (int j = 0; j < params_.servo_count(); ++j) {
    const auto has = [j](std::uint32_t mask) { return (mask >> j & 1) != 0; };
    std::uint8_t& due = words_due_[j / canopen::plan::kWords.width];
    set(word_[j], word_for(j, has(wanted), has(doubted)), due);
    const bool on = word_[j] == canopen::cia402::kWordEnableOperation;
    const bool obeyed = on ? state_[j] == State::kOperationEnabled : !holds(j);
    if (!obeyed && !has(doubted) && due == 0) due = 1;
  }
}

void DriveWriter::set_strengths(std::uint8_t percent) {
  for (int j = 0; j < params_.servo_count(); ++j) {
    set(strength_[j], strength_of(j, percent), strengths_due_[j / canopen::plan::kStrengths.width]);
  }
}

void DriveWriter::set(std::uint16_t& value, std::uint16_t to, std::uint8_t& due) {
  if (value != to) due = kRepeats;
  value = to;
}

void DriveWriter::send_goals(CanMaster& master, const Outputs& outputs, std::uint32_t wanted) {
  const canopen::plan::Shared& kind = canopen::plan::kGoals;
  for (int f = 0; f < shared_frames(kind, params_); ++f) {
    const int first = first_of(kind, f);
    const int members = members_of(kind, params_, f);
    if ((wanted >> first & ((1u << members) - 1)) == 0) continue;
    CanFrame frame = empty(kind, f, members);
    for (int i = 0; i < members; ++i) {
      const auto goal = static_cast<std::uint32_t>(outputs.goal_count[first + i]);
      canopen::put_le(frame.data + 4 * i, goal, 4);
    }
    master.send(frame);
  }
}

CanFrame DriveWriter::empty(const canopen::plan::Shared& kind, int frame, int members) const {
  return canopen::classic_frame(shared_id(kind, params_, frame),
                                static_cast<std::uint8_t>(members * kind.bytes_each()));
}

void DriveWriter::send_frame(CanMaster& master, const canopen::plan::Shared& kind,
                             const std::uint16_t (&values)[kMaxJoints], int f) {
  const int members = members_of(kind, params_, f);
  CanFrame frame = empty(kind, f, members);
  for (int i = 0; i < members; ++i) {
    canopen::put_le(frame.data + 2 * i, values[first_of(kind, f) + i], 2);
  }
  master.send(frame);
}

void DriveWriter::send_frames(CanMaster& master, const canopen::plan::Shared& kind,
                              const std::uint16_t (&values)[kMaxJoints],
                              std::uint8_t (&due)[kMostFrames]) {
  for (int f = 0; f < shared_frames(kind, params_); ++f) {
    if (due[f] == 0) continue;
    --due[f];
    send_frame(master, kind, values, f);
  }
}

void DriveWriter::send_one_in_turn(CanMaster& master, bool strengths) {
  const int words = shared_frames(canopen::plan::kWords, params_);
  const int all = words + (strengths ? shared_frames(canopen::plan::kStrengths, params_) : 0);
  if (all == 0) return;
  turn_ = turn_ + 1 < all ? turn_ + 1 : 0;
  if (turn_ < words) send_frame(master, canopen::plan::kWords, word_, turn_);
  if (turn_ >= words) send_frame(master, canopen::plan::kStrengths, strength_, turn_ - words);
}

}  // namespace verp::app
