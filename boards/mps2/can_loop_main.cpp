#include "board.hpp"
#include "boards/mps2/arguments.hpp"
#include "can.hpp"
#include "firmware/app/action_room.hpp"
#include "firmware/app/app.hpp"
#include "firmware/app/can_loop_job.hpp"
#include "firmware/app/lockstep_can.hpp"
#include "firmware/app/operator_node.hpp"
#include "firmware/app/tick_log.hpp"
#include "firmware/boot/boot.hpp"
#include "hal/chip/semihosting/semihosting.hpp"
#include "law.hpp"

/// loop_<board> JOB RECORDS: the robot's control loop over the board's own CAN bus, with a twin in
/// lockstep at the far end. JOB: can_loop_job.hpp; each tick goes to RECORDS. The controller is
/// also a node, which takes no orders.
namespace {

using verp::hal::semihosting::File;

/// Each clock read costs an emulator more than a frame.
constexpr std::uint32_t kSlice_us = 100'000;

/// Waits for ever: if the twin is gone, the PC ends the emulator.
struct Patience {
  bool operator()() const { return true; }
};

using Log = verp::app::TickLog;
using Node = verp::app::OperatorNode;

struct Desk {
  // OperatorLink. Skips orders of skipped ticks.
  verp::app::OperatorOrder order(std::uint32_t tick) {
    while (next <= tick && job.read(&latest, sizeof latest)) ++next;
    return latest;
  }
  // Recorder
  void record(const verp::TickRecord& record, const verp::State& state,
              const verp::Outputs& outputs) {
    kept = records.write(&record, sizeof record) && kept;
    node->record(record, state, outputs);
  }

  File& job;
  File& records;
  Node* node = nullptr;
  verp::app::OperatorOrder latest = {};
  std::uint32_t next = 0;
  bool kept = true;
};

verp::board::Can can = verp::board::make_can();
verp::Params params;
verp::app::ActionRoom actions;

int fail(const char* why) {
  verp::hal::semihosting::print(why);
  return 3;
}

int run(Desk& desk, const verp::app::CanLoopJob& job) {
  static Log log(verp::app::no_images);
  static verp::app::OperatorRegisters registers(
      params, verp::app::OperatorSetup{.takes_orders = false}, log);
  static Node node(can, params, registers, log);
  desk.node = &node;
  const verp::action::Library library = actions.library(job.actions_size);
  registers.offer_actions(library.count());
  using Bus = verp::app::LockstepCan<Node, Patience>;
  static Bus bus(node, Patience{}, kSlice_us);
  if (bus.greet(params) != verp::lockstep::Verdict::kAccepted) {
    return fail("loop: the twin refused\n");
  }
  static verp::app::App<Bus, Desk, Desk, verp::app::NoImu, verp::app::Law> app(
      params, bus, desk, desk, nullptr, verp::app::law_with(library));
  if (app.bring_up().status != verp::app::BringUpStatus::kReady) {
    return fail("loop: a device of the robot did not come up\n");
  }
  for (std::uint32_t n = 0; n < job.ticks && !bus.stopped(); ++n) {
    app.tick();
    node.report({.bus = app.counters(),
                 .bus_crc_errors = app.crc_errors(),
                 .bus_noise_bytes = app.noise_bytes(),
                 .efforts = app.efforts()});
  }
  const verp::hal::CanErrors errors = can.errors();
  // The twin repeats frames that other nodes displaced.
  if (errors.overruns != 0 && node.asked() == 0) {
    return fail("loop: the CAN controller lost frames\n");
  }
  return desk.kept ? 0 : fail("loop: the records can't be written\n");
}

}  // namespace

extern "C" int verp_main() {
  const verp::board::Arguments arguments;
  static File job(arguments[1], File::Mode::kRead);
  static File records(arguments[2], File::Mode::kWrite);
  verp::app::CanLoopJob head;
  if (!job.is_open() || !records.is_open() || !job.read(&head, sizeof head) || !head.fits() ||
      !job.read(&params, sizeof params) || head.actions_size > verp::app::ActionRoom::kBytes ||
      !job.read(actions.bytes, head.actions_size)) {
    return fail("loop: no job, of another build, or no place for records\n");
  }
  if (!verp::board::open_can(can)) return fail("loop: no CAN controller here\n");
  static Desk desk{job, records};
  return run(desk, head);
}
