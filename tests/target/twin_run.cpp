#include "tests/target/twin_run.hpp"

#include <cmath>
#include <span>
#include <utility>

#include "firmware/app/app.hpp"
#include "host/author/action/compile.hpp"
#include "host/author/action/folder.hpp"
#include "host/boards/board/loop_on_target.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/twin/bus/virtual_bus.hpp"
#include "host/twin/sim/robot.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::test {
namespace {

constexpr std::uint32_t kStandUs = 4'000'000;
constexpr std::uint32_t kStopUs = 1'500'000;
constexpr std::uint32_t kLegUs = 3'000'000;

struct Walk {
  std::int16_t vx_tenth_mm_s, vy_tenth_mm_s, wz_mrad_s;
};
constexpr Walk kStraight = {1778, 0, 0};  // two 4 cm steps in 0.450 s
constexpr Walk kWanders[] = {kStraight,    {900, 300, 0},  {-700, 0, 200},
                             {0, 0, -400}, {1778, 0, 300}, {600, -300, -200}};

struct Twin {
  explicit Twin(const Robot& robot) : body(world, robot.entity), bus(robot.params, body) {}
  TwinRun ended(TwinRun run) {
    run.distance_m = hands.distance_m();
    run.pushed_m = hands.pushed_m();
    run.fallen = body.truth().fallen;
    return run;
  }
  sim::World world;
  sim::TwinRobot body;
  bus::VirtualBus bus;
  Hands hands{world, body};
};

struct Keeper {
  TwinRun& run;
  void record(const TickRecord& record, const State&, const Outputs& outputs) {
    run.records.push_back(record);
    const auto mode = static_cast<safety::Mode>(outputs.mode);
    if (run.modes.empty() || run.modes.back() != mode) run.modes.push_back(mode);
  }
};

struct Order {
  double from_s;
  Request request;
  Walk walk = {};
  const char* action = "";
};
constexpr Order kTour[] = {
    {0, Request::kStand},
    {6, Request::kWalk, kStraight},
    {9, Request::kWalk, {900, 0, 400}},
    {11, Request::kWalk, kStraight},
    {13, Request::kStand},
    {18, Request::kGetUp},
    {31.5, Request::kStand},
    {32, Request::kStand, {}, "kick_right"},
    {36.5, Request::kStand, {}, "wave"},
};
constexpr double kTourEnd_s = 42, kPush_s = 12, kOver_s = 16;

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

Script walk_script(const Params& params, std::uint32_t ticks, bool wandering) {
  const ScriptedOperator orders(params, ticks, wandering);
  return {.ticks = ticks, .order = [orders](std::uint32_t tick) { return orders.order(tick); }};
}

namespace {

/// Until `end_s`.
Script script_of(const Robot& robot, std::span<const Order> from, double end_s,
                 std::vector<Hand> hands) {
  const auto folder = action::folder_of(robot.entity.file);
  const action::CompiledActions made =
      action::make_library(robot.params, action::read_folder(folder));
  std::vector<app::OperatorOrder> orders;
  std::vector<double> from_s;
  for (const Order& each : from) {
    app::OperatorOrder order;
    order.flags = kCommandFresh;
    order.command.request = each.request;
    order.command.vx_tenth_mm_s = each.walk.vx_tenth_mm_s;
    order.command.wz_mrad_s = each.walk.wz_mrad_s;
    if (*each.action != 0)
      order.action = static_cast<std::uint16_t>(made.require(each.action, folder.string()));
    orders.push_back(order);
    from_s.push_back(each.from_s);
  }
  const double period_s = 1e-6 * robot.params.period_us;
  return {.ticks = static_cast<std::uint32_t>(end_s / period_s),
          .order =
              [orders, from_s, period_s](std::uint32_t tick) {
                std::size_t now = 0;
                while (now + 1 < orders.size() && from_s[now + 1] <= tick * period_s) ++now;
                app::OperatorOrder order = orders[now];
                order.command.sequence = static_cast<std::uint8_t>(tick);
                return order;
              },
          .hands = std::move(hands),
          .actions = made.words};
}

}  // namespace

Script tour_script(const Robot& robot) {
  return script_of(robot, kTour, kTourEnd_s,
                   {{kPush_s, {0, 10, 0}, 0.05}, {kOver_s, {-60, 0, 0}, 0.15}});
}

Script fall_script(const Robot& robot) {
  constexpr Order kFall[] = {{0, Request::kStand}, {4.5, Request::kGetUp}};
  constexpr double kEnd_s = 15;
  return script_of(robot, kFall, kEnd_s, {{4, {-60, 0, 0}, 0.15}});
}

std::string modes_text(const std::vector<safety::Mode>& modes) {
  std::string text;
  for (const safety::Mode mode : modes)
    text += std::string(safety::kModeNames[static_cast<int>(mode)]) + "; ";
  return text;
}

TwinRun run_here(const Robot& robot, const Script& script) {
  Twin twin(robot);
  TwinRun run;
  Orders orders{script};
  Keeper keeper{run};
  twin.hands.take(script);
  app::App app(robot.params, twin.bus, orders, keeper, static_cast<app::NoImu*>(nullptr),
               app::Core{{script.actions.data(), 4 * script.actions.size()}});
  if (app.bring_up().status != app::BringUpStatus::kReady) return run;
  for (std::uint32_t n = 0; n < script.ticks; ++n) app.tick();
  return twin.ended(std::move(run));
}

TwinRun run_here(const Robot& robot, std::uint32_t ticks, bool wandering) {
  return run_here(robot, walk_script(robot.params, ticks, wandering));
}

TwinRun run_on_board(const std::string& board, const Robot& robot, const Script& script) {
  Twin twin(robot);
  TwinRun run;
  bus::ServerHooks hooks;
  hooks.order = script.order;
  hooks.record = [&](const TickRecord& record) { run.records.push_back(record); };
  twin.hands.take(script);
  board::run_loop_on(board, robot.params, twin.bus, hooks,
                     {.ticks = script.ticks, .state_every = 0, .actions = script.actions});
  return twin.ended(std::move(run));
}

}  // namespace verp::test
