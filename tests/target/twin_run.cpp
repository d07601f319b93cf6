#include "tests/target/twin_run.hpp"

#include <cmath>

#include "firmware/app/app.hpp"
#include "host/board/loop_on_target.hpp"
#include "host/bus/virtual_bus.hpp"
#include "host/model/find.hpp"
#include "host/model/load.hpp"
#include "host/model/params.hpp"
#include "host/sim/robot.hpp"
#include "host/sim/world.hpp"

namespace verp::test {
namespace {

constexpr std::uint32_t kStandUs = 6'000'000;
constexpr std::uint32_t kStopUs = 3'000'000;
constexpr std::uint32_t kLegUs = 3'000'000;

struct Walk {
  std::int16_t vx_tenth_mm_s, vy_tenth_mm_s, wz_mrad_s;
};
constexpr Walk kStraight = {1778, 0, 0};  // two 4 cm steps in 0.450 s
constexpr Walk kWanders[] = {kStraight,    {900, 300, 0},  {-700, 0, 200},
                             {0, 0, -400}, {1778, 0, 300}, {600, -300, -200}};

/// What a run needs besides its controller.
struct Twin {
  explicit Twin(const Robot& robot)
      : body(world, robot.entity), bus(robot.params, body), start(body.truth().com_world_m) {}
  TwinRun ended(TwinRun run) {
    const sim::Truth truth = body.truth();
    run.distance_m = (truth.com_world_m - start).head<2>().norm();
    run.fallen = truth.fallen;
    return run;
  }
  sim::World world;
  sim::TwinRobot body;
  bus::VirtualBus bus;
  sim::Vec3 start;
};

struct Keeper {
  TwinRun& run;
  void record(const TickRecord& record, const State&, const Outputs&) {
    run.records.push_back(record);
  }
};

}  // namespace

app::OperatorOrder ScriptedOperator::order(std::uint32_t tick) const {
  const std::uint64_t now_us = std::uint64_t{tick} * period_us_;
  const std::uint64_t end_us = std::uint64_t{ticks_} * period_us_;
  app::OperatorOrder order;
  order.flags = kCommandFresh;
  order.command.sequence = static_cast<std::uint8_t>(tick);
  order.command.request = Request::kStand;
  if (now_us < kStandUs || now_us + kStopUs >= end_us) return order;
  const std::uint64_t leg = (now_us - kStandUs) / kLegUs;
  const Walk& walk = wandering_ ? kWanders[leg % std::size(kWanders)] : kStraight;
  order.command.request = Request::kWalk;
  order.command.vx_tenth_mm_s = walk.vx_tenth_mm_s;
  order.command.vy_tenth_mm_s = walk.vy_tenth_mm_s;
  order.command.wz_mrad_s = walk.wz_mrad_s;
  return order;
}

Robot load_robot(const std::string& name, const std::string& bus) {
  Robot robot;
  robot.entity = model::load_robot(model::find_model(name), bus);
  robot.params = model::make_params(robot.entity);
  return robot;
}

TwinRun run_here(const Robot& robot, std::uint32_t ticks, bool wandering) {
  Twin twin(robot);
  TwinRun run;
  ScriptedOperator operator_link(robot.params, ticks, wandering);
  Keeper keeper{run};
  app::App app(robot.params, twin.bus, operator_link, keeper);
  if (app.bring_up().status != app::BringUpStatus::kReady) return run;
  for (std::uint32_t n = 0; n < ticks; ++n) app.tick();
  return twin.ended(std::move(run));
}

TwinRun run_on_board(const std::string& board, const Robot& robot, std::uint32_t ticks,
                     bool wandering) {
  Twin twin(robot);
  TwinRun run;
  const ScriptedOperator operator_link(robot.params, ticks, wandering);
  bus::ServerHooks hooks;
  hooks.order = [&](std::uint32_t tick) { return operator_link.order(tick); };
  hooks.record = [&](const TickRecord& record) { run.records.push_back(record); };
  board::run_loop_on(board, robot.params, twin.bus, hooks, {.ticks = ticks, .state_every = 0});
  return twin.ended(std::move(run));
}

}  // namespace verp::test
