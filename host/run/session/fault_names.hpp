#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "common/control/state.hpp"

namespace verp::session {

struct FaultName {
  std::uint32_t bit;  ///< safety::Fault
  const char* name;
};
std::span<const FaultName> all_fault_names();

/// Names of the set fault bits, e.g. "fall, servo silent"; empty if none is set.
std::string fault_names(std::uint32_t faults);

/// For a robot that was not asked to: its faults, and what the user can do.
std::string why_it_let_go(std::uint32_t faults);

/// The devices whose silence held the robot last, e.g. "servo 7", "servos 7, 8", "IMU".
std::string silent_device(const Params& params, const State& state);

/// An order or tuning exceeds the legs: steps are shortened or refused.
class PlanNotes {
 public:
  /// One line when that begins, else empty.
  std::string news(std::uint32_t faults);

 private:
  std::uint32_t on_ = 0;
};

}  // namespace verp::session
