#pragma once
#include <algorithm>
#include <vector>

#include "common/base/can_frame.hpp"
#include "hal/contract/can_bus.hpp"
#include "host/twin/bus/shadow_loop.hpp"

namespace verp::can {

/// Between two polls the controller fixes only the order of frames with the same identifier. A tick
/// ends when the next SYNC 1 is sent (LockstepHooks::tick_ends).
class CanTape final : public bus::ShadowTape<hal::CanBus, CanFrame, std::vector<CanFrame>> {
 public:
  static constexpr bool kWholeTicks = true;
  bool send(const CanFrame& frame) override {
    here.frames.push_back(frame);
    return true;
  }
  bool poll(CanFrame& frame, std::uint32_t) override {
    if (here.taken == here.received.size() && !play(same)) return false;
    if (here.taken == here.received.size()) return false;
    frame = here.received[here.taken++];
    return true;
  }
  hal::CanErrors errors() const override { return {}; }

 private:
  static bool same(std::vector<CanFrame> a, std::vector<CanFrame> b) {
    const auto by_id = [](const CanFrame& x, const CanFrame& y) { return x.id < y.id; };
    std::stable_sort(a.begin(), a.end(), by_id);
    std::stable_sort(b.begin(), b.end(), by_id);
    return a == b;
  }
};
using ShadowLoop = bus::ShadowLoopOver<CanTape>;

}  // namespace verp::can
