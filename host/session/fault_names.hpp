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

}  // namespace verp::session
