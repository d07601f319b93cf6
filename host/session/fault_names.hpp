#pragma once
#include <cstdint>
#include <string>

namespace verp::session {

/// Names of the fault bits that are set, e.g. "fall, servo silent"; empty when none.
std::string fault_names(std::uint32_t faults);

}  // namespace verp::session
