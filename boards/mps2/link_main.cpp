#include "boards/mps2/arguments.hpp"
#include "common/control/step.hpp"
#include "firmware/app/remote_bus.hpp"
#include "firmware/boot/boot.hpp"
#include "hal/chip/semihosting/semihosting.hpp"

/// link_<board> TO_BOARD FROM_BOARD [step]: a control tick's traffic (two frames with reply, two
/// without, one record) without a robot, to measure the link; with `step` the controller runs too.
namespace {

using verp::hal::semihosting::File;
using Remote = verp::app::RemoteBus<File, File>;

constexpr std::size_t kFrameBytes = 200;  // about 21 servos' traffic
constexpr std::uint32_t kTimeoutUs = 1000;

verp::Params params;
verp::State state;
verp::Inputs inputs;
verp::Outputs outputs;
std::uint8_t frame[kFrameBytes];
std::uint8_t reply[1024];

void tick(Remote& remote, bool with_step) {
  for (int request = 0; request < 2; ++request) {
    remote.send(frame, sizeof frame);
    remote.poll(reply, sizeof reply, kTimeoutUs);
  }
  if (with_step) step(params, state, inputs, outputs);
  for (int write = 0; write < 2; ++write) remote.send(frame, sizeof frame);
  remote.record(verp::TickRecord{state.digest, inputs}, state, outputs);
  ++inputs.tick;
}

}  // namespace

extern "C" int verp_main() {
  const verp::board::Arguments arguments;
  File in(arguments[1], File::Mode::kRead);
  File out(arguments[2], File::Mode::kWrite);
  static Remote remote(in, out);
  if (!in.is_open() || !out.is_open() || !remote.hello(params)) {
    verp::hal::semihosting::print(
        "link: the PC's end of the link is missing or of another build\n");
    return 3;
  }
  const bool with_step = arguments[3][0] != 0;
  for (std::uint32_t n = 0; n < remote.ticks() && !remote.stopped(); ++n) tick(remote, with_step);
  if (remote.lost()) return 3;
  remote.quit(0, "done");
  return 0;
}
