#pragma once
#include <cstddef>
#include <cstdint>

#include "common/action/library.hpp"

namespace verp::app {

/// RAM for the actions of a board that keeps none in flash; as large as the flash area of other
/// boards (boards/*/memory.ld).
struct ActionRoom {
  static constexpr std::size_t kBytes = 64 * 1024;

  /// The library in the first `size` bytes; empty if they are not a valid library.
  action::Library library(std::size_t size) const { return {bytes, size}; }

  alignas(4) std::uint8_t bytes[kBytes] = {};
};

}  // namespace verp::app
