#include "boards/stm32/hardware.hpp"
#include "common/control/boot_check.hpp"
#include "common/model/image.hpp"
#include "firmware/app/app.hpp"
#include "firmware/app/link_bus.hpp"
#include "firmware/app/lockstep_bus.hpp"
#include "firmware/boot/boot.hpp"
#include "firmware/boot/crash.hpp"

/// loop_<board>: the robot's control loop over the board's serial ports. At the servo port may be
/// servos, or a twin that says so when it is greeted (firmware/app/lockstep_messages.hpp): the
/// image asks for the one and for the other in turn until somebody is there. Torque is off until
/// then.
extern "C" const std::uint8_t verp_params_begin[];
extern "C" const std::uint8_t verp_params_bytes[];  ///< an address that is a size (memory.ld)

namespace verp::board {
namespace {

constexpr std::uint64_t kGreeting_us = 300'000;
constexpr std::uint64_t kForever_us = ~std::uint64_t{0};
constexpr std::uint64_t kBlink_us = 500'000;
/// Of a loop that ticks every 5 to 20 ms. Shorter would bite a loop that a lost reply held up.
constexpr std::uint32_t kWatchdog_us = 100'000;

/// Gives no orders: the robot stays limp.
struct Nobody {
  app::OperatorOrder order(std::uint32_t) const { return {}; }
  void record(const TickRecord& record, const State&, const Outputs&) {
    boot::note_tick(record.inputs.tick);
  }
};

struct Board {
  explicit Board(const Start& start) : started(start), dog(start.cause) {}

  /// What can be done whenever nothing arrives. Waiting for a twin is life; a dead loop does not
  /// wait.
  void idle() {
    dog.feed();
    const std::uint64_t now_us = timer.now_us();
    if (now_us < blink_us) return;
    blink_us = now_us + kBlink_us;
    lit = !lit;
    gpio.write(kLed, lit);
  }

  const Start& started;
  stm32::IndependentWatchdog<Io> dog;
  stm32::Gpio<Io> gpio;
  Nobody nobody;
  control::BootReport boot;  ///< no servo is driven unless it is sound
  std::uint64_t blink_us = 0;
  bool lit = false;
};

/// The servo port during bring-up, when no tick can feed the watchdog.
struct PatientPort {
  std::size_t write(const std::uint8_t* data, std::size_t size, std::uint32_t timeout_us) {
    return servo_port.write(data, size, timeout_us);
  }
  std::size_t read(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) {
    if (!ticking) board.idle();
    return servo_port.read(buffer, capacity, timeout_us);
  }
  bool connected() const { return servo_port.connected(); }
  hal::LinkErrors errors() const { return servo_port.errors(); }

  Board& board;
  bool ticking = false;
};

struct Patience {
  bool operator()() const {
    board.idle();
    return timer.now_us() < until_us;
  }
  Board& board;
  const std::uint64_t& until_us;
};

/// Serves a twin for as long as it is there. False: there is none.
bool run_in_lockstep(Board& board, const Params& params) {
  std::uint64_t until_us = timer.now_us() + kGreeting_us;
  app::LockstepBus<Port, Patience> bus(servo_port, {board, until_us});
  if (bus.greet(params) != lockstep::Verdict::kAccepted) return false;
  until_us = kForever_us;
  app::App loop(params, bus, board.nobody, board.nobody);
  if (loop.bring_up().status != app::BringUpStatus::kReady) return true;
  while (!bus.stopped()) {
    loop.tick();
    board.idle();
  }
  return true;
}

/// Drives servos until the power goes. Returns if they are not all there.
void run_in_real_time(Board& board, const Params& params) {
  PatientPort port{board};
  app::LinkBus<PatientPort, Timer> bus(port, timer);
  app::App loop(params, bus, board.nobody, board.nobody);
  if (loop.bring_up().status != app::BringUpStatus::kReady) return;
  board.idle();
  const bool guarded =
      board.dog.start(kWatchdog_us) || board.started.clocks.source == stm32::ClockSource::kAbsent;
  if (!guarded || !timer.start(params.period_us)) return;
  port.ticking = true;
  for (;;) {
    timer.wait();
    loop.tick();
    board.idle();
  }
}

}  // namespace
}  // namespace verp::board

extern "C" int verp_main() {
  using namespace verp;
  const board::Start start = board::start_hardware();
  if (!start.good || !board::open_operator_port(start)) return 1;
  static board::Board here(start);
  here.gpio.output(board::kLed, false);
  const auto size = reinterpret_cast<std::uintptr_t>(verp_params_bytes);
  static Params scratch;
  static State state;
  here.boot = control::check_boot(verp_params_begin, size, scratch, state);
  while (here.boot.verdict != control::BootVerdict::kSound) here.idle();
  const Params& params = reinterpret_cast<const ParamsImage*>(verp_params_begin)->params;
  if (!board::open_servo_port(start, params.baud)) return 1;
  here.gpio.output(board::kServoPower, true);
  for (;;) {
    if (!board::run_in_lockstep(here, params)) board::run_in_real_time(here, params);
  }
}
