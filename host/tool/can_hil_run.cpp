#include "host/tool/can_hil_run.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/bus/order_sink.hpp"
#include "host/can/lockstep_server.hpp"
#include "host/can/other_nodes.hpp"
#include "host/can/realtime_server.hpp"
#include "host/can/shadow_loop.hpp"
#include "host/link/can_claim.hpp"
#include "host/link/can_port.hpp"
#include "host/link/link_error.hpp"
#include "host/link/system_clock.hpp"
#include "host/shadow/live_check.hpp"
#include "host/tool/bit_rate.hpp"
#include "host/tool/console.hpp"
#include "host/tool/hil_judge.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/real_time.hpp"
#include "host/tool/robot_watch.hpp"

namespace verp::tool {
namespace {

/// One controller on a CAN interface, served until it or the walk is over.
class CanHilRun {
 public:
  CanHilRun(const WalkPlan& plan, const HilOptions& options, record::TraceWriter* trace,
            Progress& progress, bool keep_series)
      : plan_(plan),
        pace_(options.pace),
        progress_(progress),
        robot_(world_, plan, shown(plan, trace, progress, plan.params.name, keep_series),
               interrupted),
        port_(wire::parse_endpoint(options.link)),
        claim_(port_.interface().name, "nodes", "`verp hil`"),
        watch_(robot_, [this](const std::string& line) { say(line); }),
        judge_(
            plan, robot_, robot_.can(), options.operator_link,
            [this](const std::string& line) { say(line); }, [this] { watch_.see(); }),
        server_(plan.params, robot_.can(), hooks()),
        realtime_(robot_.can()),
        others_(plan.params),
        params_(plan.params),
        place_(options.link) {
    check_bit_rate("verp hil", port_.interface(), plan.params);
    if (pace_ == HilPace::kRealTime) {
      server_.refuse_lockstep();
    } else if (options.operator_link.empty()) {
      watch_live();
    }
  }

  HilResult run() {
    say("the twin waits for a controller on " + place_);
    try {
      while (!over()) turn();
      if (server_.stopped()) say_goodbye();
    } catch (const bus::SinkError& error) {
      judge_.fail(error.what());
    }
    if (live_ && (live_->suspects() || live_->unsettled() > 0)) {
      judge_.fail("not the same bits; the controller's State was not read in time", false);
    }
    if (live_ && live_->heard_us() > 0 && live_->compared() == 0 && !interrupted()) {
      judge_.fail("the controller told of its ticks, and none of them could be compared", false);
    }
    if (!realtime_.kept_up()) {
      judge_.fail(
          "this PC never kept up with the clock; end what else keeps it busy, or let the "
          "controller announce lockstep",
          false);
    }
    progress_.clear();
    const std::uint32_t overruns = port_.errors().overruns;
    if (overruns > 0) judge_.fail(overrun_words(overruns));
    return result();
  }

 private:
  using LockstepServer = can::LockstepServer;
  static constexpr std::uint32_t kIdle_us = 20'000;  // how long Ctrl-C may have to wait
  static constexpr std::uint32_t kRealTimeTurn_us = 500;
  static constexpr std::uint32_t kGoodbye_us = 200'000;
  static constexpr std::uint64_t kListen_us = 1'000'000;
  static constexpr std::uint64_t kMostSkipped_us = 1'000'000;

  void say(const std::string& line) {
    progress_.clear();
    complain("verp hil: " + line);
  }

  // One that watches sees the same ticks: two would take each other's answers for their own.
  void watch_live() {
    try {
      watcher_.emplace(port_.interface().name, "watcher", wire::CanClaim::kWatcher);
      live_.emplace(params_);
    } catch (const wire::LinkError& busy) {
      say(std::string(busy.what()) + ", or the walk goes without a check of its own");
    }
  }

  bool over() const {
    return !judge_.failure().empty() || server_.stopped() || interrupted() ||
           (realtime_.begun() && robot_.over());
  }

  // The link asked again for what was lost, so the walk's bits are right; the PC is not fit for it.
  std::string overrun_words(std::uint32_t overruns) const {
    return std::to_string(overruns) + " frames found no room at this PC's end of " + place_ +
           "; end what else keeps this PC busy, or sends on that bus";
  }

  HilResult result() {
    HilResult result;
    const std::uint64_t start_ns = watch_.drive_ns() == 0 ? start_ns_ : watch_.drive_ns();
    const double wall_s =
        start_ns == 0 ? 0 : 1e-9 * static_cast<double>(wire::monotonic_ns() - start_ns);
    robot_.fail(judge_.failure());
    result.walk = robot_.result(wall_s);
    result.device_trouble = judge_.device_trouble();
    result.lay_down = robot_.verdict().lay_down();
    result.real_time = realtime_.begun() || pace_ == HilPace::kRealTime;
    result.compared = judge_.compared() + (live_ ? live_->compared() : 0);
    result.losses = losses_;
    result.overruns = port_.errors().overruns;
    result.resets = judge_.resets();
    const LockstepServer::Counters& counters = server_.counters();
    result.lockstep = {.polls = counters.polls,
                       .repeats = counters.repeats,
                       .damaged = counters.damaged,
                       .greetings = counters.greetings};
    const can::RealtimeServer::Counters& real = realtime_.counters();
    result.realtime = {.bytes = 0, .late = real.late, .worst_late_us = real.worst_late_us};
    if (result.real_time)
      result.can = CanFrames{real.frames, real.dropped + port_.errors().overruns, real.skipped_us};
    return result;
  }

  void turn() {
    CanFrame frame;
    const std::uint32_t wait_us = realtime_.begun() ? kRealTimeTurn_us : kIdle_us;
    const bool came = port_.await(frame, wait_us);
    watch_port();
    if (came) watch_others(frame);
    answer_.clear();
    if (came && realtime_.begun() && !lockstep::is_clock_frame(frame)) {
      realtime_.hear(frame, port_.now_us(), answer_);
    } else if (came) {
      listen(frame);
      server_.take(frame, answer_);
    }
    if (may_run_in_real_time()) let_time_go_on(came);
    for (const CanFrame& each : answer_) {
      if (!port_.send(each)) break;  // nobody is there; in lockstep it asks again
      listen(each);
    }
    ask();
  }

  void watch_others(const CanFrame& frame) {
    others_.take(frame);
    if (others_.found() == 0) return;
    judge_.fail("node " + std::to_string(others_.found()) + " of this robot is on " + place_ +
                " already, beside the twin's; unplug it, or serve the twin on another interface");
  }

  // Without its operator's port, what the controller tells of its ticks is all that is known of it.
  void listen(const CanFrame& frame) {
    if (live_) live_->take(frame, port_.now_us());
  }
  void ask() {
    CanFrame frame;
    while (live_ && live_->next(frame, port_.now_us())) server_.enclose(frame);
    if (!live_ || !live_->over()) return;
    if (live_->differs()) {
      judge_.fail(
          "not the same bits: " + record::text(live_->divergence(), params_, "controller", "PC"),
          false);
    } else {
      judge_.fail(live_->refusal());
    }
  }

  bool may_run_in_real_time() const {
    return pace_ == HilPace::kRealTime ||
           (pace_ == HilPace::kAuto && !judge_.shadows() && !server_.greeted());
  }

  // After a frame the bus stands where that came: others may have come since.
  void let_time_go_on(bool came) {
    if (!realtime_.begun() && !begin_real_time()) return;
    if (!came) realtime_.turn(clock_us(), answer_);
    realtime_.finished(clock_us());
    watch_skips();
    watch_.see_until(robot_.can().now_us(), plan_.params.period_us);
  }

  void watch_skips() {
    const std::uint64_t skipped_us = realtime_.counters().skipped_us;
    if (skipped_us > 0 && !std::exchange(skips_told_, true)) {
      say("this PC is too slow, or was kept from it: what the twin is behind by more than 50 ms is "
          "skipped, and its time is short of the clock's");
    }
    if (skipped_us < kMostSkipped_us || std::exchange(priority_left_, true)) return;
    leave_real_time();
    say("over a second was skipped; so that others run as well, the twin does without real-time "
        "priority from now on");
  }

  // A controller may look around before it asks for a twin: it gets time to do so.
  bool begin_real_time() {
    for (const CanFrame& each : server_.unannounced()) heard_.push_back(each);
    if (heard_.empty()) return false;
    if (heard_us_ == 0) heard_us_ = clock_us();
    if (pace_ == HilPace::kAuto && clock_us() < heard_us_ + kListen_us) return false;
    server_.refuse_lockstep();
    live_.reset();
    watcher_.reset();
    start_ns_ = wire::monotonic_ns();
    say("the master does not announce lockstep: the twin runs in real time");
    const RealTime got = become_real_time();
    if (!got.advice.empty()) say(got.advice);
    // By this clock: that of the port stands at the frame, and locking memory took its time.
    for (const CanFrame& each : heard_) realtime_.hear(each, clock_us(), answer_);
    heard_.clear();
    return true;
  }

  /// The port's clock, which stands where a frame came; this one does not.
  std::uint64_t clock_us() const { return wire::monotonic_ns() / 1000 - skew_us_; }

  // The answer that says stop may get lost: who asks again is told again.
  void say_goodbye() {
    const std::uint64_t end_us = port_.now_us() + kGoodbye_us;
    while (port_.now_us() < end_us && !interrupted()) turn();
  }

  void watch_port() {
    if (port_.connected() == connected_) return;
    connected_ = port_.connected();
    if (!connected_) ++losses_;
    say(connected_ ? "the bus is back" : "the bus is lost; waiting for it to come back");
  }

  // Our own boards ask for lockstep first, and keep time by themselves where there is none.
  void refused(const std::string& why) {
    if (pace_ != HilPace::kRealTime) return judge_.fail(why);
    if (!std::exchange(declined_, true)) {
      say("the controller offers lockstep: real time, it is told");
    }
  }

  can::LockstepHooks hooks() {
    can::LockstepHooks hooks;
    hooks.greeted = [this] {
      const bool first = server_.counters().greetings == 1;
      if (first) start_ns_ = wire::monotonic_ns();
      judge_.greeted(first);
    };
    hooks.refused = [this](const std::string& why) { refused(why); };
    hooks.tick_ends = [this] { return judge_.tick_ends(); };
    hooks.tick_begins = [this](std::uint32_t tick) { judge_.tick_begins(tick); };
    hooks.sent = [this](const CanFrame& frame) {
      if (judge_.shadows()) judge_.shadow()->sent(frame);
    };
    hooks.damaged = [this] {
      if (judge_.shadows()) judge_.shadow()->damaged();
    };
    hooks.polled = [this](const std::vector<CanFrame>& burst, std::uint64_t now_us) {
      if (judge_.shadows()) judge_.shadow()->polled(burst, now_us);
    };
    return hooks;
  }

  const WalkPlan& plan_;
  const HilPace pace_;
  Progress& progress_;
  sim::World world_;
  session::Robot robot_;
  wire::CanPort port_;
  wire::CanClaim claim_;
  RobotWatch watch_;
  HilJudge<can::VirtualCan, can::ShadowLoop> judge_;
  LockstepServer server_;
  can::RealtimeServer realtime_;
  can::OtherNodes others_;
  const Params& params_;
  std::optional<wire::CanClaim> watcher_;
  std::optional<shadow::LiveCheck> live_;
  std::string place_;
  std::vector<CanFrame> answer_;
  std::vector<CanFrame> heard_;  ///< before it was known that time goes on
  std::uint64_t skew_us_ = wire::monotonic_ns() / 1000 - port_.now_us();
  std::uint64_t heard_us_ = 0;  ///< when the first of these came
  std::uint64_t start_ns_ = 0;
  std::uint32_t losses_ = 0;
  bool connected_ = true;
  bool declined_ = false;
  bool skips_told_ = false;
  bool priority_left_ = false;
};

}  // namespace

HilResult serve_on_can(const WalkPlan& plan, const HilOptions& options, record::TraceWriter* trace,
                       Progress& progress, bool keep_series) {
  return CanHilRun(plan, options, trace, progress, keep_series).run();
}

}  // namespace verp::tool
