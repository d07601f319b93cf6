#include "host/apps/demos/crew.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/run/scenario/expand.hpp"
#include "host/trace/record/ros_radio.hpp"
#include "host/trace/record/trace_error.hpp"

namespace verp::demos {
namespace {

/// A URG-04LX is accurate to 10 mm up to 1 m, and to 1 % beyond (Hokuyo, C-42-3389). The robots'
/// files have lasers without noise, on which no behaviour may rely.
constexpr double kLaserNoise_m = 0.01;
constexpr double kPictures_hz = 5;       // rendering takes time; the file has 30
constexpr double kPictureLate_s = 0.06;  // sensor readout and USB; the file has none

session::WalkPlan plan_of(const Demo& demo, const Options& options, int number, int robots) {
  const brain::Pose place = demo.places(robots)[static_cast<std::size_t>(number)];
  scenario::Robot robot;
  robot.name = fmt::format("r{}", number + 1);
  robot.model = options.model;
  robot.orders = scenario::Velocity{};  // the robot's brain gives the orders
  robot.seed = options.seed + static_cast<std::uint64_t>(number);
  robot.at = {place.at_m.x, place.at_m.y, place.yaw_rad};
  model::Entity entity = model::load_robot(model::find_model(options.model));
  for (model::LaserSensor& laser : entity.lasers) laser.noise_stddev_m = kLaserNoise_m;
  for (model::CameraSensor& camera : entity.cameras) {
    camera.rate_hz = kPictures_hz;
    camera.latency_s = kPictureLate_s;
  }
  session::WalkPlan plan = scenario::plan_of(
      robot, options.for_s > 0 ? options.for_s : demo.length_s, std::move(entity));
  plan.twin.cameras = demo.cameras;
  return plan;
}

/// The robot touches another robot or an object now, other than the floor.
bool touches_something(const sim::World& world, int owner) {
  constexpr double kFloor_m = 0.01;
  return std::any_of(
      world.contacts().begin(), world.contacts().end(), [&](const sim::Contact& each) {
        const bool floor =
            each.other_owner == sim::kScenery && each.position_world_m.z() < kFloor_m;
        return each.owner == owner && each.other_owner != owner && !floor;
      });
}

}  // namespace

Member::Member(const Demo& demo, const Options& options, int number, int robots)
    : plan_(plan_of(demo, options, number, robots)),
      placed_(demo.places(robots)[static_cast<std::size_t>(number)]),
      number_(number),
      computer_(plan_.entity, plan_.params, {.number = number, .robots = robots, .placed = placed_},
                demo.brain) {
  track_.name = plan_.name;
  open_trace(options);
}

void Member::open_trace(const Options& options) {
  if (options.record.empty()) return;
  track_.trace = options.record.parent_path() / (options.record.stem().string() + "." + plan_.name +
                                                 options.record.extension().string());
  record::mcap::StringMap run = scenario::metadata_of(plan_);
  run["number"] = std::to_string(number_);
  for (const auto& [key, value] : options.metadata) run[key] = value;
  trace_ = std::make_unique<record::TraceWriter>(track_.trace, plan_.params, run);
}

session::Hooks Member::hooks(Look look) {
  session::Hooks hooks;
  hooks.open_end = true;
  hooks.trace = trace_.get();
  hooks.order = [this](std::uint32_t tick) { return computer_.order(tick); };
  hooks.scanned = [this](const sim::Scan& scan, std::uint64_t stamp_ns) {
    if (scan.laser == 0) computer_.scanned(scan.range_m, stamp_ns);
  };
  if (look) {
    hooks.exposed = [this, look](const sim::Exposure& exposure, std::uint64_t stamp_ns) {
      std::optional<camera::Picture> seen = look(exposure);
      if (!seen) return;
      computer_.pictured(static_cast<int>(seen->width), static_cast<int>(seen->height),
                         std::move(seen->data), stamp_ns);
    };
  }
  hooks.ticked = [this](const session::Tick& tick) {
    tick_ = tick.record->inputs.tick;
    const bool touches = touches_something(*tick.world, tick.owner);
    if (touches && !touched_) ++track_.touches;
    touched_ = touches;
    computer_.ticked(*tick.record, *tick.state, *tick.outputs);
  };
  return hooks;
}

void Member::watch(const sim::TwinRobot& twin, double time_s) {
  const sim::Truth truth = twin.truth();
  const sim::Vec3 at = truth.body_world.translation();
  track_.moments.push_back({.time_s = time_s,
                            .real = {{at.x(), at.y()}, truth.yaw_rad},
                            .believed = out_of(placed_, computer_.odometry())});
  if (twin.fallen() && !track_.fell_s) track_.fell_s = time_s;
  if (computer_.orders().done && !track_.done_s) track_.done_s = time_s;
}

/// A full disk ends the trace, not the run.
void Member::guarded(const std::function<void()>& act) {
  try {
    if (trace_ != nullptr && track_.trace_failure.empty()) act();
  } catch (const record::TraceError& error) {
    track_.trace_failure = error.what();
  }
}

void Member::note_radio(const char* event, std::int64_t number, int from, int to,
                        const std::string& data) {
  guarded([&] {
    trace_->append("/radio", record::ros::kRadio,
                   std::uint64_t{1000} * tick_ * plan_.params.period_us,
                   record::ros::radio({.tick = tick_,
                                       .event = event,
                                       .number = static_cast<std::int32_t>(number),
                                       .from = from,
                                       .to = to,
                                       .data = data}));
  });
}

void Member::close(const session::WalkResult& result) {
  track_.ticks = result.ticks;
  track_.digest = result.digest;
  if (track_.trace_failure.empty()) track_.trace_failure = result.trace_failure;
  guarded([&] {
    trace_->close({{"digest", fmt::format("0x{:016x}", result.digest)},
                   {"failure", result.failure},
                   {"interrupted", result.interrupted ? "yes" : "no"}});
  });
}

}  // namespace verp::demos
