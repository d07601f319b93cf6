// The operator's serial port: packets to the controller as a Dynamixel device, between its ticks.
#include "common/control/step.hpp"
#include "firmware/app/operator_device.hpp"
#include "hal/fake/memory_link.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/images/actions_board.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  using verp::fuzz::require;
  fuzz::Bytes bytes(data, size);
  static app::test::FakeBoard& board = *new app::test::FakeBoard;
  board.place.blocks_taken = 1000;
  hal::MemoryWire wire;
  app::OperatorDevice device(wire.left(), test::kRobot, {}, board.images);
  const int ticks = bytes.byte() % 4;
  const std::string stream = fuzz::packets(bytes, 2048);
  const auto* at = reinterpret_cast<const std::uint8_t*>(stream.data());
  State state;
  Inputs inputs;
  Outputs outputs;
  for (std::size_t sent = 0, idle = 0; idle < 3;) {
    sent += wire.right().write(at + sent, stream.size() - sent, 0);
    idle = device.poll() || sent < stream.size() ? 0 : idle + 1;
    std::uint8_t answer[512];
    wire.right().read(answer, sizeof answer, 0);
    for (int i = 0; i < ticks; ++i) {
      const app::OperatorOrder order = device.order(++inputs.tick);
      inputs.command = order.command;
      inputs.flags = order.flags | kImuFresh;
      inputs.parameter_id = order.parameter_id;
      inputs.parameter_bits = order.parameter_bits;
      inputs.fresh = ~0U;
      step(test::kRobot, state, inputs, outputs);
      device.record({state.digest, inputs}, state, outputs);
    }
  }
  require(test::struct_is_finite(state), "no order makes the State infinite");
  return 0;
}
