#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace verp::session {

struct FaultName {
  std::uint32_t bit;  ///< safety::Fault
  const char* name;
};
/// All there are.
std::span<const FaultName> all_fault_names();

/// Names of the fault bits that are set, e.g. "fall, servo silent"; empty when none.
std::string fault_names(std::uint32_t faults);

/// Whoever orders or tunes more than the legs can do gets shorter steps, or none, and is to hear of
/// it.
class PlanNotes {
 public:
  /// One line when the controller begins to shorten or refuse steps; else empty. `faults`:
  /// Outputs::faults of a tick.
  std::string news(std::uint32_t faults);

 private:
  std::uint32_t on_ = 0;
};

}  // namespace verp::session
