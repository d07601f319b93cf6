#pragma once
#include <cstdint>
#include <vector>

#include "hal/contract/camera.hpp"

namespace verp::link {

/// Three bytes per pixel, no gaps. Empty: compressed or too short.
std::vector<std::uint8_t> rgb_of(const hal::CameraFrame& frame);

}  // namespace verp::link
