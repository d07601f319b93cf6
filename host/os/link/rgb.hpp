#pragma once
#include <cstdint>
#include <vector>

#include "hal/contract/camera.hpp"

namespace verp::link {

/// The picture as three bytes a pixel, rows without gaps. Empty: it is compressed, or has fewer
/// bytes than it says.
std::vector<std::uint8_t> rgb_of(const hal::CameraFrame& frame);

}  // namespace verp::link
