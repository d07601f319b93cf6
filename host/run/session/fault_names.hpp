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

/// An order or tuning exceeds the legs: steps are shortened or refused.
class PlanNotes {
 public:
  /// One line when that begins, else empty.
  std::string news(std::uint32_t faults);

 private:
  std::uint32_t on_ = 0;
};

}  // namespace verp::session
