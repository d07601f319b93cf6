#pragma once
#include <cstddef>
#include <cstdint>

#include "common/action/library.hpp"

namespace verp::app {

/// Where a board without a flash of its own keeps the actions that it is given: as many bytes as a
/// board with one has for them (boards/*/memory.ld).
struct ActionRoom {
  static constexpr std::size_t kBytes = 64 * 1024;

  /// The library in the first `size` bytes; none if they are no sound one.
  action::Library library(std::size_t size) const { return {bytes, size}; }

  alignas(4) std::uint8_t bytes[kBytes] = {};
};

}  // namespace verp::app
