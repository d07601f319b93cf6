#include "boards/stm32/servo_power.hpp"

#include <utility>
#include <vector>

#include "boards/opencr/board.hpp"
#include "boards/stm32/panel_pins.hpp"
#include "common/safety/machine.hpp"
#include "firmware/app/drive_power.hpp"
#include "tests/host/stm32_drivers/rig.hpp"
#include "tests/support/stm32/gpio_model.hpp"

// OpenCR's, as boards/stm32/loop_main.cpp uses them.
namespace verp::hal::stm32::test {
namespace {

using board::kEmergencyStop;
using board::kServoPower;
using Outside = model::GpioModel::Outside;
using State = dxl::controller::ServoPower;

struct Desk {
  app::OperatorOrder order(std::uint32_t) { return next; }
  app::OperatorOrder next;
};

class ServoPowerSwitch : public ::testing::Test {
 protected:
  ServoPowerSwitch() {
    circuit(true);
    pins.open();
    supply.open();
  }
  void circuit(bool closed) {
    rig.machine.gpio(kEmergencyStop.port)
        .drive(kEmergencyStop.number, closed ? Outside::kLow : Outside::kOpen);
  }
  bool powered() { return rig.machine.gpio(kServoPower.port).level(kServoPower.number); }
  app::DrivePower::Step tick() {
    const app::OperatorOrder order = panel.order(0);
    const bool emergency = (order.flags & kEmergencyStopFlag) != 0;
    const bool stand = order.command.request == Request::kStand;
    std::uint32_t conditions = safety::kServosKnown;
    if (emergency) conditions |= safety::kEmergency;
    conditions |= std::uint32_t{stand ? safety::kAskStand : safety::kAskRelax};
    mode = safety::next_mode(mode, conditions);
    torque_off_ticks = safety::has_torque(mode) ? 0 : torque_off_ticks + 1;
    const auto step = supply.after_tick(drive, panel.pressed(), mode);
    idle();
    return step;
  }
  void idle() { supply.permit(std::exchange(relax_asked, false)); }
  /// Bring-up again, without ticks.
  void try_in_vain() {
    for (int i = 0; i < 10; ++i) {
      supply.set(true);
      supply.watch();
      idle();
    }
  }
  void ask(Request request) {
    desk.next.command.request = request;
    relax_asked = request == Request::kRelax;
  }
  void stand_up() {
    supply.set(true);
    for (int i = 0; i < 50; ++i) tick();
    ask(Request::kStand);
    for (int i = 0; i < 50; ++i) tick();
    ASSERT_TRUE(safety::has_torque(mode));
    ASSERT_TRUE(powered());
  }

  static constexpr std::uint16_t kEmergencyStopFlag = verp::kEmergencyStop;
  Rig rig{Family::kF746};
  board::PanelPins<Io> pins{kEmergencyStop, board::kButtons, rig.machine.io()};
  board::ServoPower<Io> supply{kServoPower, kEmergencyStop, rig.machine.io()};
  Desk desk;
  app::WithPanel<Desk, board::PanelPins<Io>> panel{desk, pins, kEmergencyStop.exists()};
  app::DrivePower drive;
  safety::Mode mode = safety::Mode::kRelaxed;
  int torque_off_ticks = 0;
  bool relax_asked = false;  ///< not yet passed on
};

TEST_F(ServoPowerSwitch, IsOffUntilTheLoopSwitchesItOn) {
  EXPECT_FALSE(powered());
  EXPECT_EQ(supply.state(), State::kOff);
  supply.set(true);
  EXPECT_TRUE(powered());
  EXPECT_EQ(supply.state(), State::kOn);
}

TEST_F(ServoPowerSwitch, IsNeverSwitchedOnWhileTheCircuitIsOpen) {
  circuit(false);
  for (int i = 0; i < 3; ++i) {
    supply.set(true);
    EXPECT_FALSE(powered());
    EXPECT_EQ(supply.state(), State::kOff);
  }
  circuit(true);
  EXPECT_FALSE(powered()) << "closing it is not enough";
  supply.set(true);
  EXPECT_FALSE(powered()) << "nor that the loop begins anew";
  ask(Request::kRelax);
  idle();
  supply.set(true);
  EXPECT_TRUE(powered());
}

// The board's loop asks for power again at once.
TEST_F(ServoPowerSwitch, ComesBackAfterAStopDuringBringUpByReleaseAndRequestInThisOrder) {
  supply.set(true);
  circuit(false);
  supply.watch();
  try_in_vain();
  ask(Request::kRelax);
  try_in_vain();
  EXPECT_FALSE(powered()) << "the stop is pressed";
  circuit(true);
  try_in_vain();
  EXPECT_FALSE(powered()) << "what was asked before counts no more";
  ask(Request::kStand);
  try_in_vain();
  EXPECT_FALSE(powered());
  EXPECT_EQ(supply.state(), State::kOff);
  ask(Request::kRelax);
  try_in_vain();
  EXPECT_TRUE(powered());
  EXPECT_EQ(supply.state(), State::kOn);
}

// Bring-up had finished: the loop ticks without power for a while.
TEST_F(ServoPowerSwitch, IsGivenBackByALoopThatBeganWithoutIt) {
  supply.set(true);
  circuit(false);
  supply.watch();
  circuit(true);
  for (int i = 0; i < 200; ++i) EXPECT_NE(tick(), app::DrivePower::Step::kAnew);
  EXPECT_FALSE(powered());
  ask(Request::kRelax);
  tick();
  EXPECT_EQ(tick(), app::DrivePower::Step::kAnew);
}

// An old request stands.
TEST_F(ServoPowerSwitch, WantsARequestThatIsWrittenAfterTheRelease) {
  supply.set(true);
  for (int i = 0; i < 50; ++i) tick();
  circuit(false);
  for (int i = 0; i < 50; ++i) tick();
  EXPECT_FALSE(powered());
  circuit(true);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(tick(), app::DrivePower::Step::kOff);
  ask(Request::kRelax);
  tick();
  EXPECT_EQ(tick(), app::DrivePower::Step::kAnew);
}

TEST_F(ServoPowerSwitch, GoesAtOnceIfTheCircuitOpensWhileNothingTicks) {
  supply.set(true);
  supply.watch();
  EXPECT_TRUE(powered());
  circuit(false);
  supply.watch();
  EXPECT_FALSE(powered());
}

// 40 ms: two readings, then three ticks without torque.
TEST_F(ServoPowerSwitch, GoesWithinFiveTicksOfAnOpenCircuitAfterTorqueOffWasSaid) {
  stand_up();
  circuit(false);
  int ticks = 0;
  for (; powered() && ticks < 100; ++ticks) tick();
  EXPECT_LE(ticks, 5);
  EXPECT_GE(torque_off_ticks, 3);
  EXPECT_EQ(mode, safety::Mode::kStopped);
}

TEST_F(ServoPowerSwitch, ComesBackNeitherByReleaseNorByAnOrderToStand) {
  stand_up();
  circuit(false);
  for (int i = 0; i < 50; ++i) tick();
  circuit(true);
  for (int i = 0; i < 500; ++i) {
    EXPECT_EQ(tick(), app::DrivePower::Step::kOff);
    ASSERT_FALSE(powered());
  }
  ask(Request::kRelax);
  idle();
  EXPECT_EQ(tick(), app::DrivePower::Step::kAnew);
  EXPECT_FALSE(powered()) << "that is for the new bring-up";
  EXPECT_EQ(mode, safety::Mode::kRelaxed);
}

TEST_F(ServoPowerSwitch, GoesByTheOperatorsStopToo) {
  stand_up();
  desk.next.flags = kEmergencyStopFlag;
  for (int i = 0; i < 3; ++i) tick();
  EXPECT_FALSE(powered());
}

// The stop briefly counts as pressed.
TEST_F(ServoPowerSwitch, StaysOnThroughAStart) {
  supply.set(true);
  for (int i = 0; i < 200; ++i) {
    tick();
    ASSERT_TRUE(powered()) << i;
  }
}

}  // namespace
}  // namespace verp::hal::stm32::test
