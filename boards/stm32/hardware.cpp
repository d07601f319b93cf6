#include "boards/stm32/hardware.hpp"

#include "boards/stm32/vectors.hpp"
#include "hal/chip/stm32/instruction_cache.hpp"

namespace verp::board {

Timer timer(stm32::base::kTim2);
// A DMA writes into their rings, also while the core sleeps (boards/opencr/memory.ld).
[[gnu::section(".bss.dma")]] Port robot_port = RobotSide::make(timer);
[[gnu::section(".bss.dma")]] OperatorPort operator_port =
    OperatorSide::make(kOperatorPort, kFamily, timer);
Battery battery(kBattery, timer);
stm32::Buzzer<Io> buzzer(kBuzzer);

namespace {

// Servo replies must not wait for the operator. One port's handlers share a priority: none
// interrupts another.
constexpr std::uint8_t kRobotPriority = 4;
constexpr std::uint8_t kOperatorPriority = 8;
constexpr std::uint8_t kTimerPriority = 12;

void on_timer() {
  timer.on_timer();
}
void on_buzzer() {
  buzzer.on_interrupt();
}
void on_robot_port() {
  robot_port.on_interrupt();
}
void on_operator_port() {
  operator_port.on_interrupt();
}

}  // namespace

Start start_hardware() {
  Start start;
  start.cause = stm32::take_reset_cause(Io{});
  start.brown_out = stm32::keep_brown_out(Io{});  // refused: the next start tries again
  if constexpr (kFamily == stm32::Family::kF746) stm32::enable_instruction_cache(Io{});
  start.clocks = stm32::ClockTree<Io>(kFamily, kClockPlan).start();
  if (start.clocks.source == stm32::ClockSource::kAbsent) start.clocks = kWithoutClockController;
  stm32::enable_clock(Io{}, stm32::rcc::kApb1enr, stm32::rcc::kApb1Tim2);
  start.good = timer.open(start.clocks.apb1_timer_hz, start.clocks.sysclk_hz);
  stm32::enable_interrupt(Io{}, stm32::irq::kTim2, kTimerPriority);
  RobotSide::connect(kRobotPriority);
  OperatorSide::connect(kOperatorPort, kOperatorPriority);
  battery.open(start.clocks.apb2_hz);
  buzzer.open(start.clocks.apb1_timer_hz);
  stm32::enable_interrupt(Io{}, stm32::irq::kTim3, kTimerPriority);
  return start;
}

bool open_robot_port(const Start& start, std::uint32_t baud) {
  return RobotSide::open(robot_port, start.clocks, baud);
}
bool open_operator_port(const Start& start) {
  return OperatorSide::open(operator_port, kOperatorPort, start.clocks);
}

}  // namespace verp::board

/// It only ends a wait (hal/chip/stm32/tick_timer.hpp).
extern "C" void verp_systick() {}

namespace verp::board {
namespace {

constexpr InterruptTable all_interrupts() {
  InterruptTable table = make_interrupts({
      {stm32::irq::kTim2, on_timer},
      {stm32::irq::kTim3, on_buzzer},
      {kOperatorPort.interrupt, on_operator_port},
      {kOperatorPort.dma_interrupt, on_operator_port},
  });
  for (const unsigned each : kRobotInterrupts) table.handler[each] = on_robot_port;
  return table;
}

}  // namespace
}  // namespace verp::board

extern const verp::board::InterruptTable verp_interrupts;
__attribute__((section(".vectors.interrupts"), used))
const verp::board::InterruptTable verp_interrupts = verp::board::all_interrupts();
