#include "host/run/session/operator_console.hpp"

#include <string>
#include <utility>

#include "host/twin/bus/order_packets.hpp"
#include "host/twin/bus/order_sink.hpp"

namespace verp::session {

OperatorConsole::OperatorConsole(Robot& robot)
    : robot_(robot),
      device_(wire_, robot.plan().params,
              app::OperatorSetup{.self_test = app::table::SelfTest::kNotRun}) {
  device_.offer_actions(robot.actions().count());
}

app::OperatorOrder OperatorConsole::order(std::uint32_t tick) {
  const app::OperatorOrder wanted = robot_.order(tick);
  const bool stop = (wanted.flags & kEmergencyStop) != 0;
  const bool changed = std::exchange(stopped_, stop) != stop;
  if (changed || (wanted.flags & (kCommandFresh | kParameterWrite)) != 0) {
    std::size_t packets = 0;
    // Sends the required first order, relax: no person stands beside a twin.
    if (!std::exchange(relaxed_, true)) {
      bus::append_write(wire_.asked, app::reg("request"),
                        {static_cast<std::uint8_t>(Request::kRelax)});
      ++packets;
    }
    hand_over(packets + bus::append_order(wire_.asked, wanted));
  }
  return device_.order(tick);
}

void OperatorConsole::hand_over(std::size_t packets) {
  wire_.told.clear();
  while (device_.poll()) {
  }
  std::size_t answers = 0;
  dxl::Parser parser;
  for (const std::uint8_t byte : wire_.told) {
    for (bool found = parser.push(byte); found; found = parser.next()) {
      const int error = parser.packet().error & ~dxl::kAlert;
      if (error != 0) {
        throw bus::SinkError("the controller refuses an order (error " + std::to_string(error) +
                             "); see firmware/app/registers.md for what registers take");
      }
      ++answers;
    }
  }
  if (answers != packets) throw bus::SinkError("the controller does not answer its operator");
}

void OperatorConsole::record(const TickRecord& tick, const State& state, const Outputs& outputs) {
  device_.record(tick, state, outputs);
  robot_.take(tick, state, outputs);
}

}  // namespace verp::session
