#pragma once
#include <cstddef>
#include <cstdint>

#include "common/action/library.hpp"

namespace verp::app {

/// RAM for actions on a board without flash for them; as large as other boards' flash area.
struct ActionRoom {
  static constexpr std::size_t kBytes = 64 * 1024;

  /// Empty if the first `size` bytes are not a valid library.
  action::Library library(std::size_t size) const { return {bytes, size}; }

  alignas(4) std::uint8_t bytes[kBytes] = {};
};

}  // namespace verp::app
