#include <gtest/gtest.h>

#include <vector>

#include "board.hpp"
#include "common/protocol/canopen/sdo_client.hpp"
#include "hal/chip/stm32/tick_timer.hpp"
#include "robot_port.hpp"
#include "tests/support/stm32/can_model.hpp"
#include "tests/support/stm32/gpio_model.hpp"
#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/rcc_model.hpp"

// How loop_can images open their CAN bus, for each board with a kCanPort.
namespace verp::board {
namespace {

namespace model = stm32::model;
using Io = model::ModelIo;
using Timer = stm32::TickTimer<Io>;
using Wiring = RobotWiring<Io, UsartKind, Timer>;

constexpr std::uint32_t kBaud = 1'000'000;

struct Chip {
  explicit Chip(model::Time crystal_starts = model::ms(2))
      : machine(kFamily, {.hse_hz = kClockPlan.crystal_hz}) {
    machine.rcc().hse_start = crystal_starts;
    clocks = stm32::ClockTree<Io>(kFamily, kClockPlan, machine.io()).start();
    stm32::enable_clock(machine.io(), stm32::rcc::kApb1enr, stm32::rcc::kApb1Tim2);
    EXPECT_TRUE(timer.open(clocks.apb1_timer_hz, clocks.sysclk_hz));
    machine.attach(stm32::irq::kTim2, [this] { timer.on_timer(); });
    stm32::enable_interrupt(machine.io(), stm32::irq::kTim2, 12);
    for (const unsigned each : kRobotInterrupts) {
      machine.attach(each, [this] { port.on_interrupt(); });
    }
    Wiring::connect(4, machine.io());
  }
  ~Chip() { EXPECT_STREQ(machine.violations_text().c_str(), ""); }
  void let_pass(std::uint64_t us) {
    const std::uint64_t end_us = timer.now_us() + us;
    while (timer.now_us() < end_us) machine.advance(model::us(10));
  }

  model::Machine machine;
  stm32::Clocks clocks;
  Timer timer{stm32::base::kTim2, machine.io()};
  model::CanModel& bus = kCanPort.base == stm32::base::kCan1 ? machine.can1() : machine.can2();
  Wiring::Port port = Wiring::make(timer, machine.io());
};

CanFrame sync(std::uint8_t counter) {
  CanFrame frame;
  frame.id = 0x80;
  frame.size = 1;
  frame.data[0] = counter;
  return frame;
}

TEST(CanPort, PutsItsPinsAtTheController) {
  Chip chip;
  for (const stm32::Pin pin : {kCanPort.transmit, kCanPort.receive}) {
    EXPECT_EQ(chip.machine.gpio(pin.port).function(pin.number), kCanPort.function) << pin.port;
  }
}

TEST(CanPort, BothEndsHearEachOtherAtTheRobotsRate) {
  Chip chip;
  ASSERT_TRUE(Wiring::open(chip.port, chip.clocks, kBaud));
  EXPECT_EQ(chip.bus.bitrate(), kBaud);
  EXPECT_NEAR(chip.bus.sample_point(), 0.875, 0.025);
  ASSERT_TRUE(chip.port.send(sync(1)));
  chip.let_pass(500);
  ASSERT_EQ(chip.bus.sent().size(), 1u);
  EXPECT_TRUE(chip.bus.sent()[0].frame == sync(1));
  CanFrame answer;
  answer.id = 0x181;
  answer.size = 8;
  chip.bus.send(answer);
  CanFrame heard;
  ASSERT_TRUE(chip.port.poll(heard, 5000));
  EXPECT_TRUE(heard == answer);
}

// The internal oscillator is too inaccurate.
TEST(CanPort, DoesNotOpenWithoutTheCrystal) {
  Chip chip(model::kNever);
  EXPECT_NE(chip.clocks.source, stm32::ClockSource::kCrystal);
  EXPECT_FALSE(Wiring::open(chip.port, chip.clocks, kBaud));
}

TEST(CanPort, DoesNotOpenAtARateThatTheClockDoesNotMake) {
  Chip chip;
  EXPECT_FALSE(Wiring::open(chip.port, chip.clocks, 0));
  EXPECT_FALSE(Wiring::open(chip.port, chip.clocks, 2'000'000));
}

// Drives that an earlier run left stiff lose their torque.
TEST(CanPort, TellsAllNodesToBeginAnew) {
  Chip chip;
  ASSERT_TRUE(Wiring::open(chip.port, chip.clocks, kBaud));
  Wiring::release(chip.port);
  chip.let_pass(2000);
  ASSERT_EQ(chip.bus.sent().size(), 3u);
  for (const auto& sent : chip.bus.sent()) {
    EXPECT_EQ(sent.frame.id, 0u);
    EXPECT_EQ(sent.frame.size, 2);
    EXPECT_EQ(sent.frame.data[0], 129) << "CiA 301, 7.3.1.2.1.5: reset node";
    EXPECT_EQ(sent.frame.data[1], 0) << "all nodes";
  }
}

// The node exists before a robot is loaded.
TEST(CanPort, ItsTimeBeginsWhenItIsOpened) {
  Chip chip;
  chip.let_pass(50'000);
  const Params params;
  app::OperatorRegisters registers(params, {}, app::no_images);
  RobotNode<Wiring::Port> node(chip.port, params, registers, app::no_images);
  ASSERT_TRUE(Wiring::open(chip.port, chip.clocks, kBaud));
  const std::uint64_t begun_us = node.port().now_us();
  EXPECT_LT(begun_us, 50'000u);
  chip.let_pass(1000);
  EXPECT_GE(node.port().now_us() - begun_us, 1000u);
}

TEST(CanPort, TellsOfEachTickAndAnswersWhoAsksThere) {
  Chip chip;
  ASSERT_TRUE(Wiring::open(chip.port, chip.clocks, kBaud));
  Params params;
  params.baud = kBaud;
  params.period_us = 10'000;
  app::OperatorRegisters registers(params, {}, app::no_images);
  RobotNode<Wiring::Port> node(chip.port, params, registers, app::no_images);
  TickRecord record;
  const auto tick = [&] {
    registers.record(record, State{}, Outputs{});
    node.tell(record.inputs);
    chip.let_pass(2000);
  };
  tick();
  const std::size_t before = chip.bus.sent().size();
  canopen::SdoClient client(canopen::plan::kControllerNode);
  std::uint8_t crc[4] = {};
  client.upload(app::object("model_information"), crc, 4, canopen::SdoClient::Mode::kPlain, 0);
  CanFrame frame;
  ASSERT_TRUE(client.next(frame, 0));
  chip.bus.send(frame);
  EXPECT_FALSE(node.port().poll(frame, 5000)) << "the loop sees nothing of it";
  record.digest.chain = 0x1122334455667788;
  tick();
  ASSERT_EQ(chip.bus.sent().size(), before + 3);
  const auto* sent = &chip.bus.sent()[before];
  namespace published = canopen::published;
  EXPECT_EQ(sent[0].frame.id, canopen::tpdo_id(published::kDigestPdo, app::OperatorNode::kNode));
  EXPECT_EQ(canopen::get_le(sent[0].frame.data, 8), record.digest.chain);
  EXPECT_EQ(sent[1].frame.id, canopen::tpdo_id(published::kRecordPdo, app::OperatorNode::kNode));
  EXPECT_EQ(sent[2].frame.id, canopen::sdo_response_id(app::OperatorNode::kNode));
  client.receive(sent[2].frame, 0);
  EXPECT_EQ(canopen::get_le(crc, 4), params_crc(params));
}

// During bring-up only this serves watchdog and operator.
TEST(CanPort, LooksAfterTheBoardDuringALongWaitAndStillWaitsItsTime) {
  Chip chip;
  ASSERT_TRUE(Wiring::open(chip.port, chip.clocks, kBaud));
  std::vector<std::uint64_t> looks_us;
  const auto watch = [&] { looks_us.push_back(chip.timer.now_us()); };
  RealTimeOn<Wiring::Port, Timer, decltype(watch)> way(chip.port, chip.timer, watch, 0);
  ASSERT_TRUE(way.bus().send(sync(1)));
  const std::uint64_t sent_us = chip.timer.now_us();
  CanFrame frame;
  EXPECT_FALSE(way.bus().poll(frame, 200'000));
  EXPECT_GE(chip.timer.now_us() - sent_us, 200'000u);
  EXPECT_LE(chip.timer.now_us() - sent_us, 201'000u);
  ASSERT_GE(looks_us.size(), 20u);
  for (std::size_t i = 1; i < looks_us.size(); ++i) {
    EXPECT_LE(looks_us[i] - looks_us[i - 1], 10'000u) << "a tenth of the watchdog's time";
  }
  chip.bus.send(sync(2));
  EXPECT_TRUE(way.bus().poll(frame, 400'000)) << "a frame ends the wait";
}

}  // namespace
}  // namespace verp::board
