#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <memory>

#include "common/safety/machine.hpp"
#include "firmware/app/app.hpp"
#include "firmware/app/operator_node.hpp"
#include "firmware/app/tick_log.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/twin/can/virtual_can.hpp"
#include "host/twin/sim/robot.hpp"

// With host/guide/canopen.md's bytes only.
namespace verp::can {
namespace {

using Log = app::TickLog;
using Controller = app::OperatorNode;
using safety::Mode;
using Bytes = std::array<std::uint8_t, 8>;

constexpr Bytes kRelax = {0x2F, 0x50, 0x20, 0, 0, 0, 0, 0};
constexpr Bytes kStand = {0x2F, 0x50, 0x20, 0, 1, 0, 0, 0};
constexpr Bytes kWalk = {0x2F, 0x50, 0x20, 0, 2, 0, 0, 0};
constexpr Bytes kAhead = {0x2B, 0x52, 0x20, 0, 0x2C, 0x01, 0, 0};
constexpr Bytes kMode = {0x40, 0x90, 0x20, 0, 0, 0, 0, 0};

class Tool : public Node {
 public:
  std::uint8_t id() const override { return 126; }
  void power_on() override {}
  void power_off() override {}
  void work(std::uint64_t) override {}
  void hear(const CanFrame& frame, std::uint64_t) override {
    if (frame.id != 0x5FF) return;
    std::copy(frame.data, frame.data + 8, answer.begin());
    ++answers;
  }
  bool say(CanFrame& frame, std::uint64_t) override {
    if (requests.empty()) return false;
    frame = CanFrame();
    frame.id = 0x67F;
    frame.size = 8;
    std::copy(requests.front().begin(), requests.front().end(), frame.data);
    requests.pop_front();
    return true;
  }

  std::deque<Bytes> requests;
  Bytes answer{};
  int answers = 0;
};

struct Desk {
  app::OperatorOrder order(std::uint32_t tick) { return node.order(tick); }
  void record(const TickRecord& record, const State& state, const Outputs& outputs) {
    node.record(record, state, outputs);
  }
  Controller& node;
};

class OrderedByItsNode : public ::testing::Test {
 protected:
  OrderedByItsNode() {
    auto owned = std::make_unique<Tool>();
    tool = owned.get();
    bus.plug_in(std::move(owned));
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) loop->tick();
  }
  /// Within a few ticks, with this command byte.
  void ask(const Bytes& request, std::uint8_t command) {
    const int before = tool->answers;
    tool->requests.push_back(request);
    run(4);
    ASSERT_EQ(tool->answers, before + 1);
    EXPECT_EQ(tool->answer[0], command) << int{request[0]} << ' ' << int{request[4]};
  }
  /// At 10 Hz.
  void repeat(const Bytes& order, int times) {
    for (int i = 0; i < times; ++i) {
      ask(order, 0x60);
      run(6);
    }
  }
  Mode told_mode() {
    ask(kMode, 0x4F);
    EXPECT_EQ(tool->answer[4], loop->outputs().mode);
    return static_cast<Mode>(tool->answer[4]);
  }

  const model::Entity entity = model::load_robot(model::find_model("generic21"), "can");
  const Params params = model::make_params(entity);
  sim::World world;
  sim::TwinRobot robot{world, entity};
  VirtualCan bus{params, robot};
  Tool* tool = nullptr;
  Log log{app::no_images};
  std::unique_ptr<app::OperatorRegisters> registers =
      std::make_unique<app::OperatorRegisters>(params, app::OperatorSetup{}, log);
  Controller node{bus, params, *registers, log};
  Desk desk{node};
  std::unique_ptr<app::App<Controller, Desk, Desk>> loop =
      std::make_unique<app::App<Controller, Desk, Desk>>(params, node, desk, desk);
};

TEST_F(OrderedByItsNode, WalksWhileItIsOrderedToAndStandsWhenTheOrdersEnd) {
  ASSERT_EQ(loop->bring_up().status, app::BringUpStatus::kReady);
  run(2);
  ask(kStand, 0x80);
  ask(kRelax, 0x60);
  EXPECT_EQ(told_mode(), Mode::kRelaxed);
  repeat(kStand, 30);
  ASSERT_EQ(told_mode(), Mode::kStanding);
  const double from_m = robot.truth().body_world.translation().x();
  ask(kAhead, 0x60);
  repeat(kWalk, 40);
  EXPECT_EQ(told_mode(), Mode::kWalking);
  EXPECT_GT(robot.truth().body_world.translation().x() - from_m, 0.05)
      << "of 0.12 m that 4 s would take";
  run(300);
  EXPECT_EQ(told_mode(), Mode::kStanding);
  EXPECT_FALSE(robot.fallen());
}

}  // namespace
}  // namespace verp::can
