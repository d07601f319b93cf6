#pragma once
#include <cstdint>
#include <string>

#include "common/model/params.hpp"

namespace verp::shadow {

/// Why a controller with this identity cannot be compared with `params`; empty if it can.
std::string why_another(const Params& params, std::uint32_t params_crc, std::uint32_t core_version);

inline constexpr const char* kKeepsNoTicks =
    "the controller keeps no ticks; its firmware is built without them";
inline constexpr const char* kNoTickHold =
    "the controller has no register tick_hold; build its firmware from this revision";

}  // namespace verp::shadow
