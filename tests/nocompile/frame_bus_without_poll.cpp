// must say: poll
#include "hal/contract/frame_bus.hpp"

namespace {

/// The compiler must name the missing member.
struct Bus {
  bool send(const std::uint8_t*, std::size_t) { return true; }
#ifndef BROKEN
  std::size_t poll(std::uint8_t*, std::size_t, std::uint32_t) {
    return 0;
  }
#endif
  std::uint64_t now_us() {
    return 0;
  }
};

static_assert(verp::hal::FrameBus<Bus>);

}  // namespace
