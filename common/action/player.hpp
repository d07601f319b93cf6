#pragma once
#include "common/action/library.hpp"
#include "common/base/fields.hpp"

/// One action, tick by tick, from the stand and back.
namespace verp::action {

enum class Part : std::uint8_t { kFrame = 0, kReturn = 1 };

/// All zero while idle.
struct PlayerState {
  std::int32_t time_us = 0;    ///< in the frame or the return
  std::int32_t return_us = 0;  ///< duration of the return
  std::uint32_t moved = 0;     ///< bit j: joint j had a goal since the stand
  std::uint16_t frame = 0;     ///< frame index in the library
  std::uint16_t reserved[3] = {};
  std::uint8_t number = 0;  ///< action that plays; 0: none
  std::uint8_t asked = 0;   ///< previous tick's request: each plays once
  std::uint8_t loops = 0;   ///< done so far
  Part part = Part::kFrame;
  float carry_left = 0;  ///< left foot's share of the weight at the motion's start
  float balance = 0;     ///< PlayerOut::balance at the motion's start
  float from_rad[kMaxJoints] = {};
  float from_rad_s[kMaxJoints] = {};
  VERP_FIELDS(time_us, return_us, moved, frame, reserved, number, asked, loops, part, carry_left,
              balance, from_rad, from_rad_s)
};
VERP_PACKED(PlayerState);

struct PlayerIn {
  std::uint8_t asked = 0;  ///< requested action; 0: none, ends one that plays
  bool may_begin = false;
  std::uint8_t begin = 0;           ///< action to begin unconditionally; 0: none
  const float* from_rad = nullptr;  ///< joint angles where `begin` starts
  bool stop = false;                ///< by the frame's exit, or to the stand
  std::int32_t period_us = 10000;
  const float* stand_rad = nullptr;
  float roll_rad = 0, pitch_rad = 0, up = 1;
  bool pressed[kFeet] = {};  ///< feet that feel the ground
};

struct PlayerOut {
  float angle_rad[kMaxJoints] = {};
  float stiffness[kMaxJoints] = {};
  float carry[kFeet] = {0.5F, 0.5F};  ///< share of the weight on each foot
  float balance = 1;                  ///< share of the balance corrections
  Stance stance = Stance::kBoth;
};

/// True if action `asked` exists and is a new request.
bool is_new(const Library& library, const PlayerState& state, std::uint8_t asked);

/// The result is valid if state.number is then not 0.
PlayerOut update(const Params& params, const Library& library, PlayerState& state,
                 const PlayerIn& in);

}  // namespace verp::action
