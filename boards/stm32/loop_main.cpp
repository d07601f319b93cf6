#include <cstddef>
#include <new>

#include "boards/stm32/hardware.hpp"
#include "boards/stm32/kept.hpp"
#include "boards/stm32/no_time.hpp"
#include "boards/stm32/operator_setup.hpp"
#include "boards/stm32/own_imu.hpp"
#include "boards/stm32/panel_pins.hpp"
#include "boards/stm32/servos.hpp"
#include "common/action/kept.hpp"
#include "common/control/boot_check.hpp"
#include "common/model/image.hpp"
#include "firmware/app/app.hpp"
#include "firmware/app/drive_power.hpp"
#include "firmware/app/operator_device.hpp"
#include "firmware/app/pacer.hpp"
#include "firmware/app/signals.hpp"
#include "firmware/app/start_fault.hpp"
#include "firmware/app/tick_log.hpp"
#include "firmware/boot/boot.hpp"
#include "firmware/boot/crash.hpp"
#include "law.hpp"

/// loop_<board>: the robot's control loop over the board's ports; loop_can_<board>: the same on
/// CAN. The far end may be servos, or a twin that answers the greeting
/// (firmware/app/lockstep_messages.hpp and its CAN counterpart); the image tries both in turn.
/// Torque is off until one answers. At the operator's port the controller is a Dynamixel device
/// from the start.
extern "C" const std::uint8_t verp_params_begin[];
extern "C" const std::uint8_t verp_params_bytes[];  ///< the address is the size (memory.ld)
extern "C" const std::uint8_t verp_actions_begin[];
extern "C" const std::uint8_t verp_actions_bytes[];

namespace verp::board {
namespace {

constexpr std::uint64_t kGreeting_us = 300'000;
constexpr std::uint64_t kForever_us = ~std::uint64_t{0};
/// Silence after which a twin's torque no longer blocks the operator.
constexpr std::uint64_t kTwinSilent_us = 5'000'000;
/// For ticks of 5 to 20 ms. A shorter timeout would fire when a lost reply delays the loop.
constexpr std::uint32_t kWatchdog_us = 100'000;

// After this many ticks a run counts as healthy.
constexpr std::uint32_t kSettledTicks = 1000;
/// A real-time loop stops serving the operator so long before the period ends: one SysTick
/// millisecond, if the compare interrupt is late, and a slice of bytes.
constexpr std::uint64_t kServingEnds_us = 2'000;
/// The longest reply and Reboot's take half of it at 1 Mbaud.
constexpr std::uint64_t kLastWords_us = 40'000;

using app::table::StartFault;
using Ticks = app::TickLog;
using Operator = app::OperatorDevice;
using Node = RobotNode<Port>;

struct Board {
  Board(const Start& start, const Params& params, const control::BootReport& boot_check)
      : dog(start.cause),
        guard(dog, start.clocks.source != stm32::ClockSource::kAbsent),
        kept(dog, *reinterpret_cast<const ParamsImage*>(verp_params_begin), verp_actions_begin,
             reinterpret_cast<std::uintptr_t>(verp_actions_bytes)),
        imu(params, kept.log),
        operator_device(operator_port, params, setup(start, boot_check), ticks_kept),
        node(robot_port, params, operator_device.registers(), ticks_kept),
        actions(verp_actions_begin, reinterpret_cast<std::uintptr_t>(verp_actions_bytes), params) {
    operator_device.offer_actions(actions.library.count(), actions.fault);
    imu.open(start);
    pins.open();
    supply.open();
  }

  app::OperatorSetup setup(const Start& start, const control::BootReport& boot_check) {
    app::OperatorSetup setup = operator_setup(start, boot_check);
    imu.offer(setup);
    kept.settings.load(setup);
    return setup;
  }

  /// Runs whenever nothing arrives. Feeds the watchdog while waiting for a twin; a dead loop never
  /// gets here.
  void idle() {
    dog.feed();
    serve();
    kept.keep({operator_device.id(), operator_device.imu_source(),
               operator_device.torque_limit_percent()},
              !operator_device.armed());
    imu.serve(operator_device.take_calibration_order(), operator_device.armed());
    operator_device.show(imu.calibration());
    supply.permit(operator_device.take_relax());
    operator_device.show(supply.state());
    const app::LifeSign::Now sign = life.at(timer.now_us(), fault);
    if (sign.changed) gpio.write(kLed, sign.lit);
    say(sign.tone);
  }
  // Stops all ticks and torque for good and keeps reporting the reason.
  [[noreturn]] void refuse(StartFault why) {
    fault = why;
    operator_device.show(why);
    for (;;) idle();
  }

  bool serve() {
    if (fault == StartFault::kOperatorPort) return false;
    const bool wanted = operator_device.reboot_asked() || kept.has_news();
    if (wanted && !operator_device.armed()) start_anew();
    return operator_device.poll();
  }
  /// Restarts for a reboot or new images. The caller has checked that torque is off.
  [[noreturn]] void start_anew() {
    const std::uint64_t end_us = timer.now_us() + kLastWords_us;
    while (timer.now_us() < end_us) operator_device.poll();
    if (kept.has_news()) kept.write_news();
    verp_exit(0);
  }
  /// Sleeps until an interrupt or SysTick if there is nothing to serve.
  void serve_until(std::uint64_t end_us) {
    while (timer.now_us() < end_us) {
      if (!serve()) timer.doze_until(end_us, [] { return false; });
    }
  }

  // Recorder
  void record(const TickRecord& record, const State& state, const Outputs& outputs) {
    boot::note_tick(record.inputs.tick);
    ticked_us = timer.now_us();
    if (++ticks == kSettledTicks) boot::forget_crashes();
    operator_device.record(record, state, outputs);
    node.tell(record.inputs);
    say(signals.after_tick(timer.now_us(), outputs.faults));
  }
  static void say(const app::Tone& tone) {
    if (tone.duration_ms > 0) buzzer.sound(tone.hz, tone.duration_ms);
  }
  bool is_up(const app::BringUpReport& report) {
    operator_device.brought_up(report);
    return report.status == app::BringUpStatus::kReady;
  }
  template <class Loop>
  void report(const Loop& loop) {
    operator_device.report({.bus = loop.counters(),
                            .bus_crc_errors = loop.crc_errors(),
                            .bus_noise_bytes = loop.noise_bytes(),
                            .skipped_periods = skipped_periods,
                            .imu_faults = imu.faults(),
                            .battery_tenth_v = tenth_v(battery.poll_mv()),
                            .efforts = loop.efforts()});
  }

  static std::uint16_t tenth_v(std::uint32_t mv) {
    return static_cast<std::uint16_t>((mv + 50) / 100);
  }

  stm32::IndependentWatchdog<Io> dog;
  app::LoopGuard<stm32::IndependentWatchdog<Io>> guard;
  stm32::Gpio<Io> gpio;
  Kept kept;
  OwnImu<kImu.exists(), decltype(Kept::log)> imu;
  PanelPins<Io> pins{kEmergencyStop, kButtons};
  ServoPower<Io> supply{kServoPower, kEmergencyStop};
  Ticks ticks_kept{kept.images};  ///< beside the images in flash
  Operator operator_device;
  Node node;
  app::WithPanel<Operator, PanelPins<Io>> panel{operator_device, pins, kEmergencyStop.exists()};
  const action::KeptLibrary actions;  ///< the robot's actions in flash
  app::Signals signals;
  app::LifeSign life;
  std::uint32_t ticks = 0;
  std::uint64_t ticked_us = 0;
  std::uint32_t skipped_periods = 0;
  StartFault fault = StartFault::kNone;
};

/// Runs while bring-up waits, when no tick feeds the watchdog.
struct UntilTicks {
  void operator()() const {
    if (ticking) return;
    board.supply.watch();
    board.idle();
  }
  Board& board;
  const bool& ticking;
};

struct Patience {
  bool operator()() const {
    const std::uint64_t now_us = timer.now_us();
    const bool answered = until_us == kForever_us;
    if (!answered) board.supply.watch();
    if (answered && now_us - board.ticked_us > kTwinSilent_us) board.operator_device.servos_gone();
    board.idle();
    return now_us < until_us;
  }
  Board& board;
  const std::uint64_t& until_us;
};

/// Serves a twin, or returns why there is none. The board's own IMU and stop do not know the twin's
/// world and are ignored; so is the torque limit, because the twin compares each frame. A silent
/// twin may be paused: the loop waits for ever, then goes on with the same bits. Meanwhile the
/// operator can restart the board.
lockstep::Verdict run_in_lockstep(Board& board, const Params& params) {
  std::uint64_t until_us = timer.now_us() + kGreeting_us;
  LockstepOn<Node::LoopPort, Patience> bus(board.node.port(), {board, until_us});
  const lockstep::Verdict verdict = bus.greet(params);
  if (verdict != lockstep::Verdict::kAccepted) return verdict;
  until_us = kForever_us;
  app::NoImu* const none = nullptr;
  app::App loop(params, bus, board.operator_device, board, none,
                app::law_with(board.actions.library));
  if (!board.is_up(loop.bring_up())) return verdict;
  while (!bus.stopped()) {
    loop.tick();
    board.report(loop);
    board.idle();
  }
  board.operator_device.servos_gone();
  return verdict;
}

/// Drives servos until power-off; returns if servos are missing, or after an emergency stop cut
/// their power. `held_us`: how long devices between port and servos may delay bytes.
void run_in_real_time(Board& board, Servos& servos, const Params& params, std::uint32_t held_us) {
  bool ticking = false;
  RealTimeOn<Node::LoopPort, Timer, UntilTicks> way(board.node.port(), timer, {board, ticking},
                                                    held_us);
  app::App loop(params, way.bus(), board.panel, board, board.imu.chip(),
                app::law_with(board.actions.library));
  if (!board.is_up(loop.bring_up())) return;
  board.idle();
  app::Pacer pacer(timer);
  const StartFault fault = board.guard.begin(pacer, params.period_us, kWatchdog_us);
  if (fault != StartFault::kNone) {
    servos.power(false);
    servos.release();
    board.refuse(fault);
  }
  ticking = true;
  app::DrivePower drive;
  for (;;) {
    const app::Beat beat = pacer.next();
    board.skipped_periods = static_cast<std::uint32_t>(pacer.deadlines().skipped);
    const std::uint64_t begun_us = timer.now_us();
    loop.use_chip(board.operator_device.imu_source() == app::table::ImuSource::kChip);
    loop.limit_torque(board.operator_device.torque_limit_percent());
    loop.tick(beat);
    const auto mode = static_cast<safety::Mode>(loop.outputs().mode);
    const auto power = board.supply.after_tick(drive, board.panel.pressed(), mode);
    if (power == app::DrivePower::Step::kAnew) return;
    board.report(loop);
    board.idle();
    board.serve_until(begun_us + params.period_us - kServingEnds_us);
  }
}

/// Runs before the watchdog starts and the board exists, with its own handle to it.
[[gnu::noinline]] void finish_kept(const Start& start) {
  stm32::IndependentWatchdog<Io> dog(start.cause);
  Kept::finish(dog);
}

StartFault judge(bool has_desk, control::BootVerdict verdict, const Params& params) {
  if (!has_desk) return StartFault::kOperatorPort;
  if (verdict != control::BootVerdict::kSound) return StartFault::kSelfTest;
  return drives(params.bus_protocol) ? StartFault::kNone : StartFault::kProtocol;
}

/// Keeps its State on the stack, which is free before a loop runs.
[[gnu::noinline]] control::BootReport check_boot(std::size_t size, Params& scratch) {
  State state;
  return control::check_boot(verp_params_begin, size, scratch, state);
}

}  // namespace
}  // namespace verp::board

extern "C" int verp_main() {
  using namespace verp;
  const board::Start start = board::start_hardware();
  hal::stm32::Gpio<board::Io> gpio;
  gpio.output(board::kServoPower, false);
  gpio.input(board::kEmergencyStop,
             hal::stm32::gpio::kPullUp);  // charged before its first use
  gpio.output(board::kLed, false);
  if (!start.good) board::refuse_without_time(start);
  const bool has_desk = board::open_operator_port(start);
  board::finish_kept(start);
  const auto size = reinterpret_cast<std::uintptr_t>(verp_params_bytes);
  // An initialised variable would put its 4 KB into flash.
  alignas(Params) static std::byte room[sizeof(Params)];
  Params& scratch = *new (room) Params;
  const control::BootReport boot_check = board::check_boot(size, scratch);
  scratch = {};  // the default robot of a board without one
  const bool has_robot = check_image(verp_params_begin, size) == ImageFault::kNone;
  const Params& params =
      has_robot ? reinterpret_cast<const ParamsImage*>(verp_params_begin)->params : scratch;
  static board::Board here(start, params, boot_check);
  board::Servos servos{start, params, has_robot, here.supply};
  const auto fault = app::open_servos(servos, board::judge(has_desk, boot_check.verdict, params));
  here.say(app::Signals::at_start(fault == board::StartFault::kNone));
  if (fault != board::StartFault::kNone) here.refuse(fault);
  for (;;) {
    here.supply.set(true);  // unless a stop cut the power
    const lockstep::Verdict twin = board::run_in_lockstep(here, params);
    if (twin == lockstep::Verdict::kAccepted) continue;
    // A real-time twin answers through a PC and perhaps a USB adapter.
    const bool through_pc = twin == lockstep::Verdict::kNoLockstep;
    board::run_in_real_time(here, servos, params, through_pc ? params.period_us / 4 : 0);
  }
}
