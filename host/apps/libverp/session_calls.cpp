#include <cstring>

#include "host/apps/libverp/failure.hpp"
#include "host/apps/libverp/handles.hpp"
#include "host/apps/libverp/run.hpp"
#include "host/apps/libverp/sessions.hpp"
#include "host/apps/libverp/text.hpp"
#include "host/run/scenario/expand.hpp"

namespace verp::abi {
namespace {

sim::WorldOptions world_of(const verp_world* what) {
  sim::WorldOptions options;
  if (what == nullptr) return options;
  need_struct(what, "world");
  constexpr std::uint32_t kLeast_us = 100, kMost_us = 4000;
  scenario::World world;
  if (what->physics_step_us != 0) world.physics_step_ms = 1e-3 * what->physics_step_us;
  if (what->physics_step_us != 0 &&
      (what->physics_step_us < kLeast_us || what->physics_step_us > kMost_us))
    throw Failure(VERP_BAD_ARGUMENT, "world->physics_step_us may be 100 to 4000, or 0");
  need_text_or_null(what->file, "world->file");
  if (what->file != nullptr) world.file = what->file;
  return scenario::world_of(world);
}

/// If the physics diverges, all robots' results say so.
const session::Robot* tick_of(Run& run) {
  const session::Robot* ticked = run.session.tick();
  if (ticked == nullptr && !run.session.diverged().empty())
    throw Failure(VERP_FAILED, run.session.diverged());
  return ticked;
}

verp_result told(const session::WalkResult& from) {
  constexpr double kRadPerDegree = 3.14159265358979323846 / 180;
  const sim::WalkMetrics& m = from.metrics;
  verp_result to = {};
  to.size = sizeof to;
  to.fallen = m.fallen;
  to.ticks = from.ticks;
  to.digest = from.digest;
  to.simulated_s = from.simulated_s;
  to.walk_s = m.walk_s;
  to.distance_m = m.distance_m;
  to.ahead_m = m.ahead_m;
  to.aside_m = m.lateral_drift_m;
  to.turned_rad = kRadPerDegree * m.yaw_drift_deg;
  to.speed_m_s = m.speed_mean_m_s.value_or(0);
  to.zmp_bias_mm = m.zmp_bias_mean_mm.value_or(0);
  to.faults = from.faults;
  put_text(from.failure, to.failure);
  put_text(from.remark, to.remark);
  return to;
}

}  // namespace

Handles<Run>& sessions() {
  static Handles<Run> all("session", 1);
  return all;
}

Ticking*& Ticking::last() {
  static thread_local Ticking* last = nullptr;
  return last;
}

Run* Ticking::find(verp_session session) {
  for (const Ticking* each = last(); each != nullptr; each = each->before_) {
    if (each->session_ == session) return &each->run_;
  }
  return nullptr;
}

}  // namespace verp::abi

using namespace verp::abi;

int verp_session_open(const verp_world* world, verp_session* session) {
  return call("verp_session_open", [&] {
    need(session, "session");
    *session = nullptr;
    *session = sessions().add<verp_session>(
        std::make_shared<Run>(verp::session::Options{.world = world_of(world), .interrupted = {}}));
  });
}

int verp_session_close(verp_session session) {
  return call("verp_session_close", [&] {
    const std::shared_ptr<Run> run = sessions().take(session);
    run->finish();
  });
}

int verp_robot_defaults(verp_robot* robot) {
  return call("verp_robot_defaults", [&] {
    need(robot, "robot");
    constexpr double kStep_m = 0.04, kCycle_s = 0.45;
    *robot = {};
    robot->size = sizeof *robot;
    robot->model = "generic21";
    robot->seed = 1;
    robot->walk_s = 20;
    robot->vx_m_s = 2 * kStep_m / kCycle_s;
  });
}

int verp_session_add(verp_session session, const verp_robot* what, uint32_t* robot) {
  return call("verp_session_add", [&] {
    need_struct(what, "what");
    const auto run = sessions().use(session);
    if (run->begun || run->ended)
      throw Failure(VERP_BAD_ARGUMENT, "robots join before the first tick");
    const auto index = static_cast<std::uint32_t>(run->seats.size());
    auto seat = std::make_unique<RobotInstance>(*what, index);
    run->session.add(seat->plan(), seat->hooks());
    run->sight.add(seat->plan());
    run->seats.push_back(std::move(seat));
    if (robot != nullptr) *robot = index;
  });
}

int verp_session_tick(verp_session session, uint32_t count, uint32_t* robot, uint32_t* done) {
  return call("verp_session_tick", [&] {
    if (done != nullptr) *done = 0;
    const auto run = sessions().use(session);
    if (run->seats.empty())
      throw Failure(VERP_BAD_ARGUMENT, "nobody is in the world; call verp_session_add() before");
    if (run->ended) return VERP_OVER;
    if (!run->begun && run->air) run->air->begin(run->seats.size());
    run->begun = true;
    const Ticking ticking(session, *run);
    for (std::uint32_t n = 0; n < count; ++n) {
      const verp::session::Robot* ticked = tick_of(*run);
      if (ticked == nullptr) return VERP_OVER;
      if (done != nullptr) *done = n + 1;
      const auto number = static_cast<std::uint32_t>(run->session.index_of(*ticked));
      run->sight.looked(run->session, number);
      if (run->air) run->air->ticked(*run, number);
      if (robot != nullptr) *robot = number;
    }
    return VERP_OK;
  });
}

int verp_session_view(verp_session session, uint32_t robot, verp_tick* tick) {
  return call("verp_session_view", [&] {
    if (tick != nullptr) need_struct(tick, "tick");
    sessions().use(session)->seat(robot).view(tick);
  });
}

int verp_session_state(verp_session session, uint32_t robot, void* state, uint64_t size) {
  return call("verp_session_state", [&] {
    need(state, "state");
    need_size(size, sizeof(verp::State), "state");
    std::memcpy(state, &sessions().use(session)->seat(robot).state(), sizeof(verp::State));
  });
}

int verp_session_digest(verp_session session, uint32_t robot, uint64_t* digest) {
  return call("verp_session_digest", [&] {
    need(digest, "digest");
    *digest = sessions().use(session)->seat(robot).digest();
  });
}

int verp_session_result(verp_session session, uint32_t robot, verp_result* result) {
  return call("verp_session_result", [&] {
    need_struct(result, "result");
    const auto run = sessions().use(session);
    run->seat(robot);
    run->finish();
    *result = told(run->seat(robot).finish(run->session));
  });
}

int verp_session_control(verp_session session, uint32_t robot, verp_controller controller,
                         void* user) {
  return call("verp_session_control",
              [&] { sessions().use(session)->seat(robot).control(controller, user); });
}
