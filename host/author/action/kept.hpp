#pragma once
#include <cstdint>
#include <vector>

#include "common/action/kept.hpp"
#include "host/author/action/compile.hpp"

namespace verp::action {

/// The image as it is in a board's flash, with the robot's mark.
std::vector<std::uint8_t> kept_image(const CompiledActions& made, const Params& params);

}  // namespace verp::action
