#include "common/action/player.hpp"

#include "common/math/elementary.hpp"
#include "common/math/scalar.hpp"
#include "common/math/spline.hpp"

namespace verp::action {
namespace {

constexpr float kLies_up = 0.5F;     // cosine of the tilt: more than 60 degrees
constexpr float kUpright_up = 0.9F;  // less than 26 degrees
constexpr float kAtStand_rad = 0.005F;
constexpr float kLeastReturn_s = 0.4F, kMostReturn_s = 10.0F;

bool holds(Condition condition, const PlayerIn& in) {
  const bool lies = in.up < kLies_up;
  const float roll = math::sin(in.roll_rad) * math::cos(in.pitch_rad);
  const float pitch = math::sin(in.pitch_rad);  // nose down positive
  const bool sideways = math::abs(roll) > math::abs(pitch);
  switch (condition) {
    case Condition::kNone:
      return true;
    case Condition::kUpright:
      return in.up > kUpright_up;
    case Condition::kLiesFront:
      return lies && !sideways && pitch > 0.0F;
    case Condition::kLiesBack:
      return lies && !sideways && !(pitch > 0.0F);
    case Condition::kLiesLeft:
      return lies && sideways && !(roll > 0.0F);
    case Condition::kLiesRight:
      return lies && sideways && roll > 0.0F;
    case Condition::kLeftFoot:
      return in.pressed[0];
    case Condition::kRightFoot:
      return in.pressed[1];
    case Condition::kBothFeet:
      return in.pressed[0] && in.pressed[1];
    case Condition::kNoFoot:
      return !in.pressed[0] && !in.pressed[1];
  }
  return false;
}

float carry_left_of(Stance stance) {
  return stance == Stance::kLeft ? 1.0F : stance == Stance::kRight ? 0.0F : 0.5F;
}

struct Goal {
  float at_rad, rate_rad_s;
};

Goal goal_of(const Frame& frame, int joint, const PlayerIn& in) {
  if ((frame.joints >> joint & 1U) == 0) return {in.stand_rad[joint], 0.0F};
  return {1e-4F * static_cast<float>(frame.goal_tenth_mrad[joint]),
          1e-3F * static_cast<float>(frame.speed_mrad_s[joint])};
}

float share_of(const PlayerState& state, std::int32_t whole_us) {
  if (whole_us <= 0) return 1.0F;
  return math::clamp(static_cast<float>(state.time_us) / static_cast<float>(whole_us), 0.0F, 1.0F);
}

struct Now {
  float at_rad, rate_rad_s;
};

Now now_of(const PlayerState& state, int joint, const Goal& goal, float share, float whole_s,
           bool smooth) {
  const float from = state.from_rad[joint];
  const float m0 = whole_s * state.from_rad_s[joint];
  const float m1 = whole_s * goal.rate_rad_s;
  const math::CurvePoint point = smooth ? math::quintic(from, m0, goal.at_rad, m1, share)
                                        : math::hermite(from, m0, goal.at_rad, m1, share);
  // After arrival a joint holds its goal.
  return {point.value, share < 1.0F ? point.derivative / whole_s : goal.rate_rad_s};
}

PlayerOut look(const Params& params, const Library& library, const PlayerState& state,
               const PlayerIn& in, float* rate_rad_s) {
  const Frame standing;
  const bool back = state.part == Part::kReturn;
  const Frame& frame = back ? standing : library.frame(state.frame);
  const std::int32_t whole_us = back ? state.return_us : 1000 * std::int32_t{frame.time_ms};
  const float share = share_of(state, whole_us);
  const float whole_s = math::max(1e-6F * static_cast<float>(whole_us), 1e-3F);
  PlayerOut out;
  out.stance = frame.stance;
  const float gone = math::minimum_jerk(share).value;
  out.balance = state.balance + gone * (static_cast<float>(frame.balance) - state.balance);
  out.carry[0] = state.carry_left + gone * (carry_left_of(frame.stance) - state.carry_left);
  out.carry[1] = 1.0F - out.carry[0];
  for (int j = 0; j < params.joint_count; ++j) {
    const bool goes = ((state.moved | frame.joints) >> j & 1U) != 0;
    const bool has_goal = (frame.joints >> j & 1U) != 0;
    Now now{in.stand_rad[j], 0.0F};
    if (goes) {
      const bool smooth = back || !has_goal || (frame.smooth >> j & 1U) != 0;
      now = now_of(state, j, goal_of(frame, j, in), share, whole_s, smooth);
    }
    out.angle_rad[j] = now.at_rad;
    out.stiffness[j] = has_goal ? 0.01F * static_cast<float>(frame.stiffness_percent[j]) : 1.0F;
    if (rate_rad_s != nullptr) rate_rad_s[j] = now.rate_rad_s;
  }
  return out;
}

// Starts a motion from the present angles and rates.
void set_out(const Params& params, const Library& library, const PlayerIn& in, PlayerState& state) {
  float rate_rad_s[kMaxJoints] = {};
  const PlayerOut here = look(params, library, state, in, rate_rad_s);
  for (int j = 0; j < params.joint_count; ++j) {
    state.from_rad[j] = here.angle_rad[j];
    state.from_rad_s[j] = rate_rad_s[j];
  }
  state.carry_left = here.carry[0];
  state.balance = here.balance;
  if (state.part == Part::kFrame) state.moved |= library.frame(state.frame).joints;
}

void go_back(const Params& params, const Library& library, const PlayerIn& in, PlayerState& state) {
  set_out(params, library, in, state);
  float longest_s = 0;
  for (int j = 0; j < params.joint_count; ++j) {
    const float way_rad = math::abs(in.stand_rad[j] - state.from_rad[j]);
    if ((state.moved >> j & 1U) == 0 || way_rad < kAtStand_rad) continue;
    const float limit_rad_s = math::max(params.joint[j].velocity_limit_rad_s, 0.1F);
    // Peak speed is twice the mean, and a return takes half of the limit.
    longest_s = math::max(longest_s, math::max(4.0F * way_rad / limit_rad_s, kLeastReturn_s));
  }
  state.part = Part::kReturn;
  state.time_us = 0;
  state.return_us = static_cast<std::int32_t>(1e6F * math::min(longest_s, kMostReturn_s));
}

// `late_us`: time since the previous motion ended. Without it a joint would rest for a tick at each
// key frame.
void go_to(const Params& params, const Library& library, const PlayerIn& in, std::uint16_t frame,
           std::int32_t late_us, PlayerState& state) {
  if (frame == kToStand) return go_back(params, library, in, state);
  set_out(params, library, in, state);
  state.frame = frame;
  state.time_us = late_us;
}

void begin(const Params& params, const Library& library, const PlayerIn& in, PlayerState& state) {
  state = PlayerState{};
  state.asked = state.number = in.asked;
  state.frame = library.action(in.asked).first;
  state.carry_left = 0.5F;
  state.balance = 1.0F;
  for (int j = 0; j < params.joint_count; ++j) state.from_rad[j] = in.stand_rad[j];
}

void leave_frame(const Params& params, const Library& library, const PlayerIn& in,
                 PlayerState& state) {
  const Frame& frame = library.frame(state.frame);
  const std::int32_t there_us = 1000 * std::int32_t{frame.time_ms};
  if (in.stop && (frame.exit == kToStand || state.time_us >= there_us)) {
    return go_to(params, library, in, frame.exit, 0, state);
  }
  const std::int32_t rested_us = there_us + 1000 * std::int32_t{frame.pause_ms};
  if (state.time_us < rested_us) return;
  if (!holds(frame.condition, in)) {
    const bool patient = state.time_us < rested_us + 1000 * std::int32_t{frame.wait_ms};
    if (!patient) go_to(params, library, in, frame.otherwise, 0, state);
    return;
  }
  // A frame that waited is not late.
  const std::int32_t late_us = frame.condition == Condition::kNone ? state.time_us - rested_us : 0;
  if (state.loops < frame.loops) {
    ++state.loops;
    return go_to(params, library, in, frame.loop_to, late_us, state);
  }
  if (frame.loops > 0) state.loops = 0;
  go_to(params, library, in, frame.next, late_us, state);
}

bool is_there(const Library& library, std::uint8_t number) {
  return number > 0 && number <= library.count();
}

// Joints that no frame names go to their stand.
void begin_anywhere(const Params& params, const Library& library, const PlayerIn& in,
                    PlayerState& state) {
  state = PlayerState{};
  state.asked = is_there(library, in.asked) ? in.asked : std::uint8_t{0};
  state.number = in.begin;
  state.frame = library.action(in.begin).first;
  state.carry_left = 0.5F;
  for (int j = 0; j < params.joint_count; ++j) {
    state.from_rad[j] = in.from_rad[j];
    state.moved |= 1U << j;
  }
}

}  // namespace

bool is_new(const Library& library, const PlayerState& state, std::uint8_t asked) {
  return is_there(library, asked) && asked != state.asked;
}

PlayerOut update(const Params& params, const Library& library, PlayerState& state,
                 const PlayerIn& in) {
  if (in.begin != 0) {
    begin_anywhere(params, library, in, state);
    return look(params, library, state, in, nullptr);
  }
  if (state.number == 0) {
    if (in.may_begin && is_new(library, state, in.asked)) {
      begin(params, library, in, state);
    } else if (!is_there(library, in.asked)) {
      state = PlayerState{};
    }
    return state.number == 0 ? PlayerOut{} : look(params, library, state, in, nullptr);
  }
  state.time_us += in.period_us;
  if (state.part == Part::kReturn) {
    if (state.time_us >= state.return_us) {
      const std::uint8_t asked = state.asked;
      state = PlayerState{};
      if (is_there(library, in.asked)) state.asked = asked;
      return {};
    }
  } else {
    leave_frame(params, library, in, state);
  }
  return look(params, library, state, in, nullptr);
}

}  // namespace verp::action
