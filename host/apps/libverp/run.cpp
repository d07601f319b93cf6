#include "host/apps/libverp/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <utility>

#include "common/control/step.hpp"
#include "common/model/counts.hpp"
#include "common/record/digest.hpp"
#include "host/apps/libverp/failure.hpp"
#include "host/apps/libverp/moment.hpp"
#include "host/apps/libverp/robot_file.hpp"
#include "host/apps/libverp/velocity.hpp"
#include "host/author/action/get_up.hpp"
#include "host/run/scenario/expand.hpp"
#include "host/trace/record/trace_error.hpp"

namespace verp::abi {
namespace {

std::vector<std::vector<model::Transform>> links_of_all(session::Session& session) {
  std::vector<std::vector<model::Transform>> all;
  for (std::size_t i = 0; i < session.size(); ++i)
    all.push_back(session.robot(i).twin().body().links_world());
  return all;
}

/// The drawing program reads it later, when the directory may have changed.
std::string wherever_we_are(const std::string& file) {
  return file.empty() ? "" : std::filesystem::absolute(file).string();
}

constexpr double kMostSpeed_m_s = 3, kMostTurn_rad_s = 30, kFar_m = 1000, kMostWalk_s = 1e6;

double within(double value, double most, const char* name) {
  if (std::abs(finite(value, name)) <= most) return value;
  throw Failure(VERP_BAD_ARGUMENT,
                fmt::format("{} may be {:g} to {:g}, not {:g}", name, -most, most, value));
}

std::string text_or_empty(const char* text) {
  return text == nullptr ? "" : text;
}

void copy(const sim::Vec3& from, double* to) {
  std::copy_n(from.data(), 3, to);
}

}  // namespace

Sight::Sight(const sim::WorldOptions& world) {
  if (world.scenery != nullptr) stage_.world_file = wherever_we_are(world.scenery->file);
}

void Sight::add(const session::WalkPlan& plan) {
  stage_.robots.push_back({wherever_we_are(plan.entity.file), plan.twin.seed});
  last_.emplace_back(plan.entity.cameras.size());
  painter_.reset();  // it knows earlier robots only
}

void Sight::looked(session::Session& session, std::uint32_t robot) {
  for (sim::Exposure& exposure : session.robot(robot).twin().take_exposures()) {
    auto moment = std::make_shared<camera::Moment>();
    moment->time_us = exposure.time_us;
    moment->link_world = std::move(exposure.link_world);
    moment->body_world = std::move(exposure.body_world);
    moment->robot = robot;
    moment->raw = true;
    for (const std::size_t camera : exposure.cameras) last_[robot][camera] = {moment, {}};
  }
}

camera::Painter& Sight::painter() {
  if (painter_ == nullptr || !painter_->works())
    painter_ = std::make_unique<camera::Painter>(camera::find_program(), stage_);
  return *painter_;
}

const camera::Picture* Sight::picture(std::uint32_t robot, std::uint32_t camera,
                                      const char* encoding) {
  Look& look = last_.at(robot).at(camera);
  if (look.at == nullptr) return nullptr;
  if (look.drawn.empty()) {
    camera::Moment moment = *look.at;
    moment.cameras = {camera};
    look.drawn = painter().look(moment);
  }
  for (const camera::Picture& picture : look.drawn) {
    if (picture.encoding == encoding) return &picture;
  }
  throw camera::CameraError("cameras: their program has drawn something else than was asked for");
}

camera::Picture Sight::render(session::Session& session, std::uint32_t robot,
                              const camera::Outside& from) {
  camera::Moment moment{.time_us = session.now_us(),
                        .cameras = {},
                        .link_world = links_of_all(session),
                        .body_world = {},
                        .robot = robot};
  if (session.scenery() != nullptr) moment.body_world = session.scenery()->moving_poses();
  return painter().look(moment, from);
}

Command velocity_of(double vx_m_s, double vy_m_s, double wz_rad_s) {
  Command command;
  command.vx_tenth_mm_s =
      static_cast<std::int16_t>(std::lround(1e4 * within(vx_m_s, kMostSpeed_m_s, "vx_m_s")));
  command.vy_tenth_mm_s =
      static_cast<std::int16_t>(std::lround(1e4 * within(vy_m_s, kMostSpeed_m_s, "vy_m_s")));
  command.wz_mrad_s =
      static_cast<std::int16_t>(std::lround(1e3 * within(wz_rad_s, kMostTurn_rad_s, "wz_rad_s")));
  return command;
}

RobotInstance::RobotInstance(const verp_robot& what, std::uint32_t index) : index_(index) {
  need_text_or_null(what.name, "name");
  need_text_or_null(what.record, "record");
  scenario::Robot robot = robot_of(what.model, what.bus, what.tuning);
  robot.name = text_or_empty(what.name);
  robot.seed = what.seed;
  robot.at = {within(what.x_m, kFar_m, "x_m"), within(what.y_m, kFar_m, "y_m"),
              within(what.yaw_rad, kFar_m, "yaw_rad")};
  robot.orders = scenario::Velocity{within(what.vx_m_s, kMostSpeed_m_s, "vx_m_s"),
                                    within(what.vy_m_s, kMostSpeed_m_s, "vy_m_s"),
                                    within(what.wz_rad_s, kMostTurn_rad_s, "wz_rad_s")};
  if (what.walk_s < 0) throw Failure(VERP_BAD_ARGUMENT, "walk_s is negative");
  plan_ = scenario::plan_of(robot, within(what.walk_s, kMostWalk_s, "walk_s"), load(robot));
  plan_.number = static_cast<int>(index);
  plan_.twin.cameras = true;  // for pictures on request
  if ((what.flags & ~std::uint32_t{VERP_OPEN_END}) != 0)
    throw Failure(VERP_BAD_ARGUMENT, "what->flags has more than VERP_OPEN_END");
  own_orders_ = what.walk_s == 0;
  open_end_ = own_orders_ || (what.flags & VERP_OPEN_END) != 0;
  if (own_orders_) orders_.take({});
  take_actions();
  if (what.record != nullptr) open_trace(what.record);
}

/// The robot's lie_down, as `verp walk` gives it. One that obeys orders may be ordered to get up.
void RobotInstance::take_actions() {
  if (own_orders_) {
    const std::string why = action::offer_get_up_actions(plan_);
    if (!why.empty()) plan_.remark = "it has no actions, because " + why;
  } else {
    action::take_lie_down(plan_);
  }
  actions_ = {plan_.actions.data(), 4 * plan_.actions.size()};
}

void RobotInstance::open_trace(const char* file) {
  const Command& v = plan_.velocity;
  record::mcap::StringMap metadata = scenario::metadata_of(plan_);
  metadata["velocity"] = fmt::format("{:g},{:g},{:g}", 1e-4 * v.vx_tenth_mm_s,
                                     1e-4 * v.vy_tenth_mm_s, 1e-3 * v.wz_mrad_s);
  metadata["walk_s"] = fmt::format("{}", plan_.walk_s);
  metadata["controller"] = "libverp";
  trace_ = std::make_unique<record::TraceWriter>(file, plan_.params, metadata,
                                                 record::TraceOptions{.actions = plan_.actions});
}

session::Hooks RobotInstance::hooks() {
  session::Hooks hooks;
  if (own_orders_) hooks.order = [](std::uint32_t) { return app::OperatorOrder{}; };
  hooks.amend = [this](std::uint32_t tick, app::OperatorOrder& order) {
    orders_.amend(tick, order);
  };
  hooks.decide = [this](const Params& params, State& state, const Inputs& inputs,
                        Outputs& outputs) { decide(params, state, inputs, outputs); };
  hooks.ticked = [this](const session::Tick& tick) { ticked(tick); };
  hooks.trace = trace_.get();
  hooks.open_end = open_end_;
  return hooks;
}

void RobotInstance::decide(const Params& params, State& state, const Inputs& inputs,
                           Outputs& outputs) {
  if (controller_ == nullptr) return step(params, actions_, state, inputs, outputs);
  Moment moment(params, actions_, state, inputs, outputs);
  deciding_ = inputs.tick;
  const int answer = moment.run(controller_, user_, index_);
  if (answer != 0) {
    throw Failure(VERP_CALLBACK_FAILED, fmt::format("the controller of robot {} gave {} at tick {}",
                                                    index_, answer, inputs.tick));
  }
  deciding_.reset();
  moment.judge();
  if (moment.decided()) return;
  // The core's digest covers what it decided, not what was sent.
  record::Digest32 digest(0);
  digest.add_struct(outputs);
  state.digest.chain = record::chain(state.digest.chain, digest.value());
}

void RobotInstance::note_radio(record::ros::Radio radio) {
  if (!trace_ || !radio_failure_.empty()) return;
  radio.tick = tick_;
  try {
    trace_->append("/radio", record::ros::kRadio,
                   std::uint64_t{1000} * tick_ * plan_.params.period_us, record::ros::radio(radio));
  } catch (const record::TraceError& error) {  // a full disk costs the trace, not the run
    radio_failure_ = error.what();
  }
}

void RobotInstance::ticked(const session::Tick& tick) {
  state_ = *tick.state;
  tick_ = tick.record->inputs.tick;
  if (view_ != nullptr) write_view(tick);
}

void RobotInstance::write_view(const session::Tick& tick) {
  verp_tick& to = *view_;
  const sim::Truth& from = tick.seen.truth;
  to.size = sizeof to;
  to.robot = index_;
  to.time_s = from.t_s;
  to.gone_s = tick.gone_s;
  to.digest = digest();
  std::memcpy(&to.inputs, &tick.record->inputs, sizeof to.inputs);
  std::memcpy(&to.outputs, tick.outputs, sizeof to.outputs);
  for (int j = 0; j < plan_.params.joint_count; ++j) {
    const JointParams& joint = plan_.params.joint[j];
    to.joint_rad[j] = model::angle_of(joint, to.inputs.position_count[j]);
    to.goal_rad[j] = model::angle_of(joint, to.outputs.goal_count[j]);
  }
  verp_truth& truth = to.truth;
  const Eigen::Quaterniond turned(from.body_world.linear());
  copy(from.body_world.translation(), truth.body_m);
  std::copy_n(turned.coeffs().data(), 4, truth.body_quaternion);
  copy({from.roll_rad, from.pitch_rad, from.yaw_rad}, truth.body_rpy_rad);
  copy(from.body_velocity_world_m_s, truth.body_m_s);
  copy(from.body_rate_world_rad_s, truth.body_rad_s);
  copy(from.com_world_m, truth.com_m);
  copy(from.com_velocity_world_m_s, truth.com_m_s);
  std::copy_n(from.zmp_world_m.data(), 2, truth.zmp_m);
  for (std::size_t side = 0; side < 2; ++side) {
    truth.foot_n[side] = from.foot[side].normal_force_n;
    copy(from.foot[side].sole_world.translation(), truth.sole_m[side]);
  }
  std::ranges::copy(from.joint_rad, truth.joint_rad);
  std::ranges::copy(from.joint_rad_s, truth.joint_rad_s);
  std::ranges::copy(from.torque_n_m, truth.torque_n_m);
  truth.zmp_valid = from.zmp_valid;
  truth.held = from.held;
  truth.fallen = from.fallen;
  truth.joints = plan_.params.joint_count;
}

const session::WalkResult& RobotInstance::finish(session::Session& session) {
  if (result_) return *result_;
  result_ = session.result(index_);
  // Reports a controller's failure that the caller has not read.
  if (deciding_)
    result_->failure =
        fmt::format("the controller of robot {} failed at tick {}", index_, *deciding_);
  if (!trace_) return *result_;
  const std::unique_ptr<record::TraceWriter> trace = std::move(trace_);
  if (!result_->trace_failure.empty()) throw Failure(VERP_BAD_FILE, result_->trace_failure);
  if (!radio_failure_.empty()) throw Failure(VERP_BAD_FILE, radio_failure_);
  trace->close({{"digest", fmt::format("0x{:016x}", result_->digest)},
                {"failure", result_->failure},
                {"interrupted", "no"}});
  return *result_;
}

void Run::finish() {
  ended = true;
  for (const auto& seat : seats) seat->finish(session);
}

RobotInstance& Run::seat(std::uint32_t index) {
  if (index < seats.size()) return *seats[index];
  throw Failure(VERP_BAD_ARGUMENT,
                fmt::format("there is no robot {}: the session has {}", index, seats.size()));
}

}  // namespace verp::abi
