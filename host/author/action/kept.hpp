#pragma once
#include <cstdint>
#include <vector>

#include "common/action/kept.hpp"
#include "host/author/action/compile.hpp"

namespace verp::action {

/// The library as a board keeps it in its flash: with the mark of its robot.
std::vector<std::uint8_t> kept_image(const Made& made, const Params& params);

}  // namespace verp::action
