#include "host/run/session/remote_controller.hpp"

#include <fmt/format.h>

#include <utility>

#include "host/os/link/system_clock.hpp"
#include "host/twin/bus/operator_port.hpp"

namespace verp::session {
namespace {

/// Restart of a controller in the twin's time: reset, boot check, greeting.
constexpr std::uint32_t kRestart_us = 1'000'000;

}  // namespace

RemoteController::RemoteController(Robot& robot, const ServeOptions& options, bool connected)
    : robot_(robot), options_(options), place_(options.link), connected_(connected) {}

void RemoteController::say(const std::string& line) const {
  if (options_.told) options_.told(line);
}

void RemoteController::fail(const std::string& why, bool device) {
  if (!failure_.empty()) return;
  failure_ = why;
  device_trouble_ = device;
  if (options_.gave_up) options_.gave_up(why);
}

bool RemoteController::over() const {
  const bool nobody_to_tell = !greeted() || real_time_begun();
  return !failure_.empty() || ended_ || stopped() || robot_.interrupted() ||
         (nobody_to_tell && robot_.over());
}

void RemoteController::introduce() {
  if (!std::exchange(introduced_, true)) say("the twin waits for a controller on " + place_);
}

bool RemoteController::tick() {
  try {
    if (!std::exchange(began_, true)) {
      if (!options_.operator_link.empty()) {
        orders_ = std::make_unique<bus::OperatorPort>(options_.operator_link,
                                                      [this] { return robot_.interrupted(); });
        begin_shadow();
      }
      introduce();
    }
    if (!over()) turn();
    if (options_.turned) options_.turned(robot_.twin());
  } catch (const bus::SinkError& error) {
    fail(error.what());
  }
  return !over();
}

void RemoteController::finish() {
  while (tick()) {  // no stop was sent
  }
  try {
    conclude();
  } catch (const bus::SinkError& error) {
    fail(error.what());
  }
  robot_.fail(failure_);
}

double RemoteController::wall_s(double) const {
  const std::uint64_t start_ns = drive_ns_ == 0 ? start_ns_ : drive_ns_;
  return start_ns == 0 ? 0 : 1e-9 * static_cast<double>(link::monotonic_ns() - start_ns);
}

RemoteResult RemoteController::result() const {
  RemoteResult result;
  result.met = met();
  result.device_trouble = device_trouble_;
  result.lay_down = robot_.verdict().lay_down();
  result.real_time = real_time_begun() || options_.pace == Pace::kRealTime;
  result.compared = compared_;
  result.resets = resets_;
  return result;
}

bus::SessionHooks RemoteController::hooks() {
  return {.greeted = [this] { begins(); },
          .refused = [this](const std::string& why) { refused(why); },
          .tick_ends = [this] { return tick_ends(); },
          .tick_begins = [this](std::uint32_t tick) { tick_begins(tick); },
          .damaged =
              [this] {
                if (shadow_) shadow_->damaged();
              },
          .set_upright = [this] { return set_upright(); }};
}

// The controller lost its state: start the copy again.
void RemoteController::begin_shadow() {
  recorded_ = false;
  shadow_ = make_shadow([this](const TickRecord& tick, const State& state, const Outputs& outputs) {
    robot_.record(tick, state, outputs);
    const std::string news = plan_notes_.news(outputs.faults);
    if (!news.empty()) say(news);
    last_ = {tick.inputs.tick, tick.digest.chain};
    recorded_ = true;
  });
}

void RemoteController::begins() {
  if (!std::exchange(met_, true)) {
    start_ns_ = link::monotonic_ns();
    say("a controller has come, in lockstep");
    return look_for_actions();
  }
  if (!robot_.ticking()) return say("the controller greets again");
  ++resets_;
  say(fmt::format("the controller began anew at {:.2f} s; the servos hold what they were told last",
                  robot_.simulated_s()));
  // On a robot time passes meanwhile, and the servos' watchdogs act.
  robot_.let_pass(kRestart_us);
  if (!shadow_) return;
  begin_shadow();
  robot_.begin_anew();
}

// The greeting's controller serves its operator meanwhile. Without the same actions here, a fall
// would look like a difference.
void RemoteController::look_for_actions() {
  if (!orders_) return;
  const int here = robot_.actions().count(), there = orders_->action_count();
  if (here == there) return;
  if (here > 0 && there == 0) {
    return fail(
        "the controller has no actions, so it cannot get up (its register action_count is 0); put "
        "the robot's onto it (verp flash --params MODEL), or leave out --get-up: u and Enter sets "
        "it on its feet");
  }
  if (here == 0) {
    return say(fmt::format(
        "the controller has {} actions, of which this PC is told none: give --get-up, or a fall "
        "will look like a difference of bits",
        there));
  }
  fail(
      fmt::format("the controller has {} actions and this PC's robot {}; put the same ones onto it",
                  there, here));
}

// Our boards ask for lockstep first, then run in real time.
void RemoteController::refused(const std::string& why) {
  if (options_.pace != Pace::kRealTime) return fail(why);
  if (!std::exchange(declined_, true)) say("the controller offers lockstep: real time, it is told");
}

/// False: no further tick.
bool RemoteController::tick_ends() {
  if (!shadow_) {
    if (robot_.ticking()) watch();
    return !robot_.over();
  }
  shadow_->catch_up();
  if (!shadow_->difference().empty()) fail("not the same bits: " + shadow_->difference(), false);
  if (robot_.over()) compare(orders_->exchange(nullptr));
  return failure_.empty() && !robot_.over();
}

// A controller that waits for its tick serves its operator: a write now acts in this tick.
void RemoteController::tick_begins(std::uint32_t tick) {
  if (!shadow_) return;
  const app::OperatorOrder order = robot_.order(tick);
  const bool news = order.flags != 0;
  compare(orders_->exchange(news ? &order : nullptr));
  if (news) shadow_->ordered(order);
}

void RemoteController::compare(const bus::ControllerReport& told) {
  if (!recorded_ || told.tick != last_.tick) return;
  if (told.digest == last_.digest) {
    ++compared_;
    return;
  }
  fail(fmt::format("not the same bits: at tick {} the controller's digest is 0x{:016x}, this PC's "
                   "0x{:016x}",
                   last_.tick, told.digest, last_.digest),
       false);
}

void RemoteController::watch() {
  robot_.watch();
  const FallVerdict& verdict = robot_.verdict();
  if (verdict.driven() && drive_ns_ == 0) {
    drive_ns_ = link::monotonic_ns();
    say("a servo has torque: the session begins");
  }
  if (verdict.lay_down() && !std::exchange(lay_down_, true)) {
    say("the robot was let go and lies down: that is no fall, and it is served on; u and Enter, or "
        "set_upright of its clock, sets it on its feet");
  }
}

bool RemoteController::set_upright() {
  const bool done = robot_.set_upright();
  if (done) lay_down_ = false;
  say(done ? "the robot is set on its feet, and held until its legs have torque"
           : "a servo has torque: nobody can set the robot on its feet");
  return done;
}

void RemoteController::watch_until(std::uint64_t now_us) {
  while (now_us >= next_us_ && !robot_.over()) {
    watch();
    next_us_ += robot_.plan().params.period_us;
  }
}

bool RemoteController::may_run_in_real_time() const {
  return options_.pace == Pace::kRealTime ||
         (options_.pace == Pace::kAuto && !shadows() && !greeted());
}

bool RemoteController::still_listening(bool heard, std::uint64_t listen_ns) {
  if (heard_ns_ == 0 && heard) heard_ns_ = link::monotonic_ns();
  return options_.pace == Pace::kAuto && link::monotonic_ns() < heard_ns_ + listen_ns;
}

void RemoteController::begin_real_time() {
  start_ns_ = link::monotonic_ns();
  say("the master does not announce lockstep: the twin runs in real time");
  if (options_.real_time_begins) options_.real_time_begins();
}

void RemoteController::waited(const bus::LockstepSession& clock, std::size_t came,
                              const char* unit) {
  const std::uint64_t now = link::monotonic_ns();
  if (!greeted()) return waited_for_first(now, came, unit);
  const auto& asked = clock.counters();
  const std::uint64_t sum = asked.polls + asked.repeats + asked.greetings;
  strange_ += came;
  if (std::exchange(asked_, sum) != sum || options_.patience_s <= 0) {
    idle_ns_ = strange_ = 0;
  } else if (idle_ns_ == 0) {
    idle_ns_ = now;
  } else if (1e-9 * static_cast<double>(now - idle_ns_) > options_.patience_s) {
    const std::string why = !connected_    ? ": its link is lost"
                            : strange_ > 0 ? fmt::format(
                                                 ": {} {} came, and nothing that asks for "
                                                 "the time",
                                                 strange_, unit)
                                           : "";
    fail(fmt::format("the controller on {} kept the twin waiting for {:g} s{}", place_,
                     options_.patience_s, why));
  }
}

void RemoteController::waited_for_first(std::uint64_t now_ns, std::size_t came, const char* unit) {
  if (alone_ns_ == 0) alone_ns_ = now_ns;
  strange_ += came;
  if (options_.patience_s <= 0 || reminded_ ||
      1e-9 * static_cast<double>(now_ns - alone_ns_) <= options_.patience_s)
    return;
  reminded_ = true;
  const std::string strange =
      strange_ == 0 ? "" : fmt::format(" ({} {} came, no greeting among them)", strange_, unit);
  say(
      fmt::format("no controller has announced lockstep on {} in {:g} s{}; the world stands until "
                  "one does, and Ctrl-C ends it",
                  place_, options_.patience_s, strange));
}

void RemoteController::watch_link(bool connected, std::uint32_t losses) {
  if (connected == std::exchange(connected_, connected)) return;
  ended_ = !connected && options_.ends_with_controller && robot_.verdict().driven() &&
           !robot_.has_torque();
  if (ended_) return say("the controller has let go and hung up");
  const std::string& link = options_.link;
  const bool is_local = link.starts_with("pty:") || link.starts_with("unix");
  if (!connected && is_local) say("the link is lost: its client hung up; waiting for the next");
  if (!connected && !is_local) say("the link is lost; waiting for it to come back");
  if (connected && losses > 0) say("the link is back");
}

std::unique_ptr<RemoteController> make_served(Robot& robot, const ServeOptions& options) {
  auto served = robot.plan().params.bus_protocol == BusProtocol::kCia402
                    ? make_served_on_can(robot, options)
                    : make_served_on_serial(robot, options);
  // Several robots are served in turn, and report at once.
  if (options.operator_link.empty()) served->introduce();
  return served;
}

}  // namespace verp::session
