#include "boards/stm32/servo_power.hpp"

#include <vector>

#include "boards/opencr/board.hpp"
#include "boards/stm32/panel_pins.hpp"
#include "common/safety/machine.hpp"
#include "firmware/app/drive_power.hpp"
#include "tests/host/stm32_drivers/rig.hpp"
#include "tests/support/stm32/gpio_model.hpp"

// OpenCR's emergency stop and the switch of its servos' power, on a model of its chip: what
// boards/stm32/loop_main.cpp does with them, tick by tick.
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
  /// A tick of the loop: the robot is asked for what desk.next says.
  app::DrivePower::Step tick() {
    const app::OperatorOrder order = panel.order(0);
    const bool emergency = (order.flags & kEmergencyStopFlag) != 0;
    const bool stand = order.command.request == Request::kStand;
    mode = safety::next_mode(mode, safety::kServosKnown | (emergency ? safety::kEmergency : 0u) |
                                       (stand ? safety::kAskStand : safety::kAskRelax));
    torque_off_ticks = safety::has_torque(mode) ? 0 : torque_off_ticks + 1;
    const auto step = drive.after_tick(panel.pressed(), mode);
    if (step == app::DrivePower::Step::kOff) supply.set(false);
    return step;
  }
  void ask(Request request) { desk.next.command.request = request; }
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
  EXPECT_TRUE(powered());
}

TEST_F(ServoPowerSwitch, GoesAtOnceIfTheCircuitOpensWhileNothingTicks) {
  supply.set(true);
  supply.watch();
  EXPECT_TRUE(powered());
  circuit(false);
  supply.watch();
  EXPECT_FALSE(powered());
}

// 40 ms in a loop of 8 ms: two readings, and torque off in three ticks before the power goes.
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

// A start with the circuit closed: the stop counts as pressed for a while, and takes no power.
TEST_F(ServoPowerSwitch, StaysOnThroughAStart) {
  supply.set(true);
  for (int i = 0; i < 200; ++i) {
    tick();
    ASSERT_TRUE(powered()) << i;
  }
}

}  // namespace
}  // namespace verp::hal::stm32::test
