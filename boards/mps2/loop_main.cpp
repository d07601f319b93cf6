#include "boards/mps2/arguments.hpp"
#include "firmware/app/app.hpp"
#include "firmware/app/remote_bus.hpp"
#include "firmware/boot/boot.hpp"
#include "hal/chip/semihosting/semihosting.hpp"
#include "law.hpp"

/// loop_<board> TO_BOARD FROM_BOARD: the robot's control loop; its servo bus is on the PC, behind
/// two FIFOs.
namespace {

using verp::hal::semihosting::File;
using Remote = verp::app::RemoteBus<File, File>;

verp::Params params;
verp::app::ActionRoom actions;

const char* words_for(verp::app::BringUpStatus status) {
  using verp::app::BringUpStatus;
  switch (status) {
    case BringUpStatus::kReady:
      return "";
    case BringUpStatus::kSilent:
      return "bring-up: a device of the robot does not answer";
    case BringUpStatus::kWrongModel:
      return "bring-up: a device has another model number";
    case BringUpStatus::kRefused:
      return "bring-up: a device refused a setting";
    case BringUpStatus::kNotVerified:
      return "bring-up: a device did not keep a setting";
    case BringUpStatus::kHardwareError:
      return "bring-up: a servo has a hardware error";
    case BringUpStatus::kOccupied:
      return "bring-up: another controller is on the bus";
    case BringUpStatus::kNotReset:
      return "bring-up: a device did not boot when it was reset";
  }
  return "bring-up failed";
}

int run(Remote& remote) {
  using Loop = verp::app::App<Remote, Remote, Remote, verp::app::NoImu, verp::app::Law>;
  static Loop app(params, remote, remote, remote, nullptr,
                  verp::app::law_with(remote.actions(actions)));
  const auto report = app.bring_up();
  if (report.status != verp::app::BringUpStatus::kReady) {
    remote.quit(1, words_for(report.status));
    return 1;
  }
  for (std::uint32_t n = 0; !remote.stopped() && (remote.ticks() == 0 || n < remote.ticks()); ++n) {
    app.tick();
  }
  if (remote.lost()) return 3;
  remote.quit(0, "done");
  return 0;
}

}  // namespace

extern "C" int verp_main() {
  const verp::board::Arguments arguments;
  File in(arguments[1], File::Mode::kRead);
  File out(arguments[2], File::Mode::kWrite);
  static Remote remote(in, out);
  if (!in.is_open() || !out.is_open() || !remote.hello(params, &actions)) {
    verp::hal::semihosting::print(
        "loop: the PC's end of the link is missing or of another build\n");
    return 3;
  }
  return run(remote);
}
