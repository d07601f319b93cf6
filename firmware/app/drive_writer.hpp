#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "common/protocol/canopen/cia402.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "firmware/app/can_master.hpp"
#include "firmware/app/joint_rules.hpp"

namespace verp::app {

/// The tick's second half on CAN: goals, controlwords and strengths in shared RPDOs. RPDOs have no
/// reply, so a changed frame is sent in kRepeats ticks, and one other frame in turn each tick.
/// Controlwords follow each drive's statusword, so a lost one costs a tick. Strength is Max torque,
/// in thousandths of the rated torque.
class DriveWriter : public JointStrength {
 public:
  using State = canopen::cia402::State;

  using JointStrength::JointStrength;

  void note(int joint, State state);
  State state(int joint) const { return state_[joint]; }
  bool has_torque(int joint) const;

  /// Sends goals from the first tick that wants torque; torque from the third at the earliest, for
  /// all drives together once all are switched on. `doubted` drives get no more torque than they
  /// have; `limp` ones have no torque.
  void send(CanMaster& master, const Outputs& outputs, std::uint32_t doubted, std::uint32_t limp);

 private:
  static constexpr std::uint8_t kRepeats = 3;
  /// Ticks after which drives that are ready go ahead alone.
  static constexpr std::uint8_t kTogether = 20;
  /// Time to enable, with brake release: an allowance, not a measurement.
  static constexpr std::uint32_t kEnableUs = 300'000;
  static constexpr int kMostFrames = (kMaxJoints + 3) / 4;

  bool switched_on(int joint) const { return state_[joint] == State::kSwitchedOn || holds(joint); }
  bool holds(int joint) const;
  void begin(std::uint32_t wanted, std::uint32_t doubted, std::uint32_t limp);
  std::uint16_t word_for(int joint, bool wanted, bool doubted) const;
  void set_words(std::uint32_t wanted, std::uint32_t doubted);
  void set_strengths(std::uint8_t percent);
  static void set(std::uint16_t& value, std::uint16_t to, std::uint8_t& due);
  void send_goals(CanMaster& master, const Outputs& outputs, std::uint32_t wanted);
  CanFrame empty(const canopen::plan::Shared& kind, int frame, int members) const;
  void send_frame(CanMaster& master, const canopen::plan::Shared& kind,
                  const std::uint16_t (&values)[kMaxJoints], int f);
  void send_frames(CanMaster& master, const canopen::plan::Shared& kind,
                   const std::uint16_t (&values)[kMaxJoints], std::uint8_t (&due)[kMostFrames]);
  void send_one_in_turn(CanMaster& master, bool strengths);

  State state_[kMaxJoints] = {};
  std::uint16_t word_[kMaxJoints] = {};      ///< last sent
  std::uint16_t strength_[kMaxJoints] = {};  ///< last sent
  std::uint8_t words_due_[kMostFrames] = {};
  std::uint8_t strengths_due_[kMostFrames] = {};
  std::uint32_t wanted_ = 0;
  std::uint32_t told_ = 0;      ///< commanded to have torque
  std::uint32_t enabled_ = 0;   ///< those that have obeyed
  std::uint32_t patience_ = 0;  ///< ticks for the others to obey
  std::uint8_t early_ = 0;      ///< ticks before torque
  std::uint8_t together_ = 0;   ///< ticks left to wait for each other
  int turn_ = 0;
};

}  // namespace verp::app
