#pragma once
#include "firmware/app/app.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::fuzz {

struct Walker {
  app::OperatorOrder order(std::uint32_t tick) const {
    return {.command = {.request = tick < 2 ? Request::kRelax : Request::kWalk},
            .flags = kCommandFresh};
  }
};
struct Nobody {
  void record(const TickRecord&, const State&, const Outputs&) {}
};

/// Brings the robot up on that bus, and lets it rise and walk while there are bytes.
template <class Bus>
void run_loop(const Params& params, Bus& bus, const Bytes& bytes) {
  Walker walker;
  Nobody nobody;
  app::App<Bus, Walker, Nobody> loop(params, bus, walker, nobody);
  if (loop.bring_up().status != app::BringUpStatus::kReady) return;
  for (int tick = 0; tick < 40 && bytes.left() > 0; ++tick) loop.tick();
  require(test::struct_is_finite(loop.state()), "no answer makes the State infinite");
}

}  // namespace verp::fuzz
