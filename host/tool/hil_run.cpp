#include "host/tool/hil_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "host/bus/shadow_loop.hpp"
#include "host/link/link.hpp"
#include "host/link/system_clock.hpp"
#include "host/tool/can_hil_run.hpp"
#include "host/tool/console.hpp"
#include "host/tool/hil_judge.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/real_time.hpp"
#include "host/tool/robot_watch.hpp"

namespace verp::tool {
namespace {

/// One controller, served until it or the walk is over.
class HilRun {
 public:
  HilRun(const WalkPlan& plan, const HilOptions& options, record::TraceWriter* trace,
         Progress& progress, bool keep_series)
      : plan_(plan),
        options_(options),
        progress_(progress),
        robot_(world_, plan, shown(plan, trace, progress, plan.params.name, keep_series),
               interrupted),
        link_(wire::parse_endpoint(options.link)),
        watch_(robot_, [this](const std::string& line) { say(line); }),
        judge_(
            plan, robot_, robot_.bus(), options.operator_link,
            [this](const std::string& line) { say(line); }, [this] { watch_.see(); }),
        lockstep_(plan.params, robot_.bus(), hooks()),
        realtime_(robot_.bus()) {
    if (options.pace == HilPace::kRealTime) lockstep_.refuse_lockstep();
  }

  HilResult run() {
    say(fmt::format("the twin waits for a controller on {}", link_.place()));
    try {
      while (!over()) turn();
    } catch (const bus::SinkError& error) {
      judge_.fail(error.what());
    }
    progress_.clear();
    HilResult result;
    const std::uint64_t start_ns = watch_.drive_ns() == 0 ? start_ns_ : watch_.drive_ns();
    const double wall_s = start_ns == 0 ? 0 : 1e-9 * static_cast<double>(now_ns() - start_ns);
    robot_.fail(judge_.failure());
    result.walk = robot_.result(wall_s);
    result.device_trouble = judge_.device_trouble();
    result.lay_down = robot_.verdict().lay_down();
    result.real_time = realtime_.begun() || options_.pace == HilPace::kRealTime;
    result.compared = judge_.compared();
    result.losses = link_.errors().losses;
    result.overruns = link_.errors().overruns;
    result.resets = judge_.resets();
    result.lockstep = lockstep_.counters();
    result.realtime = realtime_.counters();
    return result;
  }

 private:
  static constexpr std::uint32_t kIdle_us = 20'000;  // how long Ctrl-C may have to wait
  static constexpr std::uint32_t kRealTimeTurn_us = 500;
  static constexpr std::uint64_t kListen_ns = 1'000'000'000;
  static constexpr std::uint32_t kWrite_us = 100'000;
  static constexpr std::uint64_t kLossRest_ns =
      50'000'000;  // from one loss of the link to the next

  static std::uint64_t now_ns() { return wire::monotonic_ns(); }

  void say(const std::string& line) {
    progress_.clear();
    complain("verp hil: " + line);
  }

  bool over() const {
    return !judge_.failure().empty() || lockstep_.stopped() || interrupted() ||
           (realtime_.begun() && robot_.over());
  }

  bool may_run_in_real_time() const {
    return options_.pace == HilPace::kRealTime ||
           (options_.pace == HilPace::kAuto && !judge_.shadows() && !lockstep_.greeted());
  }

  void turn() {
    std::uint8_t piece[4096];
    const std::size_t count =
        link_.read(piece, sizeof piece, realtime_.begun() ? kRealTimeTurn_us : kIdle_us);
    answer_.clear();
    lockstep_.take({piece, count}, answer_);
    if (may_run_in_real_time()) let_time_go_on();
    for (std::size_t sent = 0; sent < answer_.size();) {
      const std::size_t more = link_.write(answer_.data() + sent, answer_.size() - sent, kWrite_us);
      if (more == 0) break;  // nobody reads; in lockstep it asks again
      sent += more;
    }
    watch_link();
    rest_after_loss();
  }

  // Somebody who hangs up at once, again and again, is not met as fast as a processor can. The
  // first loss after a while costs no time.
  void rest_after_loss() {
    if (link_.errors().losses == losses_) return;
    losses_ = link_.errors().losses;
    const std::uint64_t now = now_ns();
    if (now < rested_ns_ + kLossRest_ns) {
      std::this_thread::sleep_for(std::chrono::nanoseconds(rested_ns_ + kLossRest_ns - now));
    }
    rested_ns_ = now_ns();
  }

  // A controller may look for servos before it asks for a twin: it gets time to do so.
  bool still_listening(std::span<const std::uint8_t> heard) {
    if (heard_ns_ == 0 && !heard.empty()) heard_ns_ = now_ns();
    return options_.pace == HilPace::kAuto && now_ns() < heard_ns_ + kListen_ns;
  }

  void let_time_go_on() {
    const bool begun = realtime_.begun();
    const std::vector<std::uint8_t> heard = lockstep_.unannounced();
    if (still_listening(heard)) return;
    realtime_.turn(now_ns() / 1000, heard, answer_);
    realtime_.finished(now_ns() / 1000);
    if (!realtime_.begun()) return;
    if (!begun) {
      lockstep_.refuse_lockstep();
      start_ns_ = now_ns();
      say("the master does not announce lockstep: the twin runs in real time");
      const RealTime got = become_real_time();
      if (!got.advice.empty()) say(got.advice);
    }
    watch_.see_until(robot_.bus().now_us(), plan_.params.period_us);
  }

  void watch_link() {
    if (link_.connected() == connected_) return;
    connected_ = link_.connected();
    if (!connected_) say("the link is lost; waiting for it to come back");
    if (connected_ && link_.errors().losses > 0) say("the link is back");
  }

  bus::LockstepHooks hooks() {
    bus::LockstepHooks hooks;
    hooks.greeted = [this] { greeted(); };
    hooks.refused = [this](const std::string& why) {
      options_.pace == HilPace::kRealTime ? decline() : judge_.fail(why);
    };
    hooks.tick_ends = [this] { return judge_.tick_ends(); };
    hooks.tick_begins = [this](std::uint32_t tick) { judge_.tick_begins(tick); };
    hooks.sent = [this](std::span<const std::uint8_t> frame) {
      if (judge_.shadows()) judge_.shadow()->sent({frame.begin(), frame.end()});
    };
    hooks.damaged = [this] {
      if (judge_.shadows()) judge_.shadow()->damaged();
    };
    hooks.polled = [this](std::span<const std::uint8_t> bytes, std::uint64_t now_us) {
      if (judge_.shadows()) judge_.shadow()->polled({bytes.begin(), bytes.end()}, now_us);
    };
    return hooks;
  }

  // Our own boards ask for lockstep first, and keep time by themselves where there is none.
  void decline() {
    if (!std::exchange(declined_, true))
      say("the controller offers lockstep: real time, it is told");
  }

  void greeted() {
    const bool first = lockstep_.counters().greetings == 1;
    if (first) start_ns_ = now_ns();
    judge_.greeted(first);
  }

  const WalkPlan& plan_;
  const HilOptions& options_;
  Progress& progress_;
  sim::World world_;
  session::Robot robot_;
  wire::Link link_;
  RobotWatch watch_;
  HilJudge<bus::VirtualBus, bus::ShadowLoop> judge_;
  bus::LockstepServer lockstep_;
  bus::RealtimeServer realtime_;
  std::vector<std::uint8_t> answer_;
  bool connected_ = false;
  bool declined_ = false;
  std::uint32_t losses_ = 0;     ///< of the link, as last seen
  std::uint64_t rested_ns_ = 0;  ///< when rest_after_loss() was last over
  std::uint64_t start_ns_ = 0;
  std::uint64_t heard_ns_ = 0;  ///< when something that is not for the clock came first
};

}  // namespace

HilResult serve_controller(const WalkPlan& plan, const HilOptions& options,
                           record::TraceWriter* trace, Progress& progress, bool keep_series) {
  if (plan.params.bus_protocol == BusProtocol::kCia402) {
    return serve_on_can(plan, options, trace, progress, keep_series);
  }
  return HilRun(plan, options, trace, progress, keep_series).run();
}

}  // namespace verp::tool
