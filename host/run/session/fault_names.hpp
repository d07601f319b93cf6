#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace verp::session {

struct FaultName {
  std::uint32_t bit;  ///< safety::Fault
  const char* name;
};
std::span<const FaultName> all_fault_names();

/// Names of the set fault bits, e.g. "fall, servo silent"; empty if none is set.
std::string fault_names(std::uint32_t faults);

/// Notes for the user that an order or tuning exceeds the legs, so that steps are shortened or
/// refused.
class PlanNotes {
 public:
  /// One line when the controller begins to shorten or refuse steps; else empty. `faults`:
  /// Outputs::faults of a tick.
  std::string news(std::uint32_t faults);

 private:
  std::uint32_t on_ = 0;
};

}  // namespace verp::session
