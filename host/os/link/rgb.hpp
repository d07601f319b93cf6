#pragma once
#include <cstdint>
#include <vector>

#include "hal/contract/camera.hpp"

namespace verp::link {

/// The picture with three bytes per pixel, rows without gaps. Empty: it is compressed or too short.
std::vector<std::uint8_t> rgb_of(const hal::CameraFrame& frame);

}  // namespace verp::link
