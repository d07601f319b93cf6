#pragma once
#include "common/action/library.hpp"
#include "common/base/fields.hpp"

/// Plays one action of a library: where each joint should be, tick by tick, from the stand and back
/// to it.
namespace verp::action {

enum class Part : std::uint8_t { kFrame = 0, kReturn = 1 };

/// All zero while nothing plays and nothing is asked.
struct PlayerState {
  std::int32_t time_us = 0;    ///< in the present frame, or on the way back
  std::int32_t return_us = 0;  ///< how long the way back takes
  std::uint32_t moved = 0;     ///< bit j: joint j had a goal since the stand
  std::uint16_t frame = 0;     ///< of the library
  std::uint16_t reserved[3] = {};
  std::uint8_t number = 0;  ///< of the action that plays; 0: none
  std::uint8_t asked = 0;   ///< as in the tick before: an action plays once for each asking
  std::uint8_t loops = 0;   ///< taken so far
  Part part = Part::kFrame;
  float carry_left = 0;  ///< share of the weight, where the present way began
  float balance = 0;     ///< likewise
  float from_rad[kMaxJoints] = {};
  float from_rad_s[kMaxJoints] = {};
  VERP_FIELDS(time_us, return_us, moved, frame, reserved, number, asked, loops, part, carry_left,
              balance, from_rad, from_rad_s)
};
VERP_PACKED(PlayerState);

struct PlayerIn {
  std::uint8_t asked = 0;  ///< number of the action asked; 0: none, also ends one that plays
  bool may_begin = false;
  std::uint8_t begin = 0;           ///< this one begins now, whatever is asked or plays; 0: none
  const float* from_rad = nullptr;  ///< of `begin`: where the joints are
  bool stop = false;                ///< by the frame's exit, or straight back to the stand
  std::int32_t period_us = 10000;
  const float* stand_rad = nullptr;  ///< joints as they stand
  float roll_rad = 0, pitch_rad = 0, up = 1;
  bool pressed[kFeet] = {};  ///< feet that feel the ground
};

struct PlayerOut {
  float angle_rad[kMaxJoints] = {};
  float stiffness[kMaxJoints] = {};
  float carry[kFeet] = {0.5F, 0.5F};  ///< share of the weight
  float balance = 1;                  ///< share of the corrections that keep a robot up
  Stance stance = Stance::kBoth;
};

/// Whether a number that is asked is there, and was not asked in the tick before.
bool is_new(const Library& library, const PlayerState& state, std::uint8_t asked);

/// While state.number is not 0 afterwards, `out` is where the joints should be.
PlayerOut update(const Params& params, const Library& library, PlayerState& state,
                 const PlayerIn& in);

}  // namespace verp::action
