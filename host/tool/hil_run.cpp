#include "host/tool/hil_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "host/bus/operator_port.hpp"
#include "host/bus/shadow_loop.hpp"
#include "host/link/link.hpp"
#include "host/link/system_clock.hpp"
#include "host/tool/console.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/real_time.hpp"
#include "host/tool/walk_session.hpp"

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
        session_(plan, trace, progress, plan.params.name, keep_series),
        link_(wire::parse_endpoint(options.link)),
        lockstep_(plan.params, session_.bus(), hooks()),
        realtime_(session_.bus()) {
    if (!options.operator_link.empty()) {
      orders_.emplace(options.operator_link, [] { return interrupted(); });
      begin_shadow();
    }
    if (options.pace == HilPace::kRealTime) lockstep_.refuse_lockstep();
  }

  HilResult run() {
    say(fmt::format("the twin waits for a controller on {}", link_.place()));
    try {
      while (!over()) turn();
    } catch (const bus::SinkError& error) {
      fail(error.what());
    }
    progress_.clear();
    HilResult result;
    const std::uint64_t start_ns = drive_ns_ == 0 ? start_ns_ : drive_ns_;
    const double wall_s = start_ns == 0 ? 0 : 1e-9 * static_cast<double>(now_ns() - start_ns);
    result.walk = session_.result(wall_s, failure_);
    result.device_trouble = device_trouble_;
    result.lay_down = session_.verdict().lay_down();
    result.real_time = realtime_.begun();
    result.compared = compared_;
    result.losses = link_.errors().losses;
    result.resets = resets_;
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
  /// What a start takes by the twin's clock: reset, boot check, greeting.
  static constexpr std::uint32_t kRestart_us = 1'000'000;

  static std::uint64_t now_ns() { return wire::monotonic_ns(); }

  void say(const std::string& line) {
    progress_.clear();
    complain("verp hil: " + line);
  }

  void fail(const std::string& why, bool device = true) {
    if (!failure_.empty()) return;
    failure_ = why;
    device_trouble_ = device;
  }

  bool over() const {
    return !failure_.empty() || lockstep_.stopped() || interrupted() ||
           (realtime_.begun() && session_.over());
  }

  bool may_run_in_real_time() const {
    return options_.pace == HilPace::kRealTime ||
           (options_.pace == HilPace::kAuto && !shadow_ && !lockstep_.greeted());
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
    while (session_.bus().now_us() >= next_watch_us_ && !session_.over()) {
      watch_robot();
      next_watch_us_ += plan_.params.period_us;
    }
  }

  void watch_robot() {
    session_.watch();
    const FallVerdict& verdict = session_.verdict();
    if (verdict.driven() && drive_ns_ == 0) {
      drive_ns_ = now_ns();
      say("a servo has torque: the session begins");
    }
    if (verdict.lay_down() && !std::exchange(lay_down_, true)) {
      say("the robot was let go and lies down: that is no fall, and it is served on");
    }
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
      options_.pace == HilPace::kRealTime ? decline() : fail(why);
    };
    hooks.tick_ends = [this] { return tick_ends(); };
    hooks.tick_begins = [this](std::uint32_t tick) { tick_begins(tick); };
    hooks.sent = [this](std::span<const std::uint8_t> frame) {
      if (shadow_) shadow_->sent(frame);
    };
    hooks.damaged = [this] {
      if (shadow_) shadow_->damaged();
    };
    hooks.polled = [this](std::span<const std::uint8_t> bytes, std::uint64_t now_us) {
      if (shadow_) shadow_->polled(bytes, now_us);
    };
    return hooks;
  }

  // Our own boards ask for lockstep first, and keep time by themselves where there is none.
  void decline() {
    if (!std::exchange(declined_, true))
      say("the controller offers lockstep: real time, it is told");
  }

  void greeted() {
    if (lockstep_.counters().greetings == 1) {
      start_ns_ = now_ns();
      return say("a controller has come, in lockstep");
    }
    if (!session_.bus().ticking()) return say("the controller greets again");
    ++resets_;
    say(fmt::format(
        "the controller began anew at {:.2f} s; the servos hold what they were told last",
        session_.simulated_s()));
    pass_restart();
    if (!shadow_) return;
    // What it knew is gone, and with it what this PC knew of it.
    recorded_ = false;
    begin_shadow();
    session_.begin_anew();
  }

  // In lockstep no time goes by while a controller is away; on a robot it does, and the servos' Bus
  // Watchdogs see it.
  void pass_restart() {
    bus::VirtualBus& bus = session_.bus();
    const std::uint64_t back_us = bus.now_us() + kRestart_us;
    std::uint8_t unheard[hal::kMaxFrame];
    while (bus.now_us() < back_us) bus.bring_until(back_us, unheard, sizeof unheard);
  }

  void begin_shadow() {
    shadow_.emplace(plan_.params, [this](const TickRecord& tick, const State& state,
                                         const Outputs& outputs) { record(tick, state, outputs); });
  }

  bool tick_ends() {
    if (!shadow_) {
      if (session_.bus().ticking()) watch_robot();
      return !session_.over();
    }
    shadow_->catch_up();
    if (!shadow_->difference().empty()) {
      fail("not the same bits: " + shadow_->difference(), false);
    }
    if (session_.over()) compare(orders_->exchange(nullptr));
    return failure_.empty() && !session_.over();
  }

  // The controller waits for the answer that begins its tick, and serves its operator meanwhile:
  // what is written now, it takes in this very tick.
  void tick_begins(std::uint32_t tick) {
    if (!shadow_) return;
    const app::OperatorOrder order = session_.walker().order(tick);
    const bool news = order.flags != 0;
    compare(orders_->exchange(news ? &order : nullptr));
    if (news) shadow_->ordered(order);
  }

  void record(const TickRecord& tick, const State& state, const Outputs& outputs) {
    session_.record(tick, state, outputs);
    last_ = {tick.inputs.tick, tick.digest.chain};
    recorded_ = true;
  }

  void compare(const bus::ControllerReport& told) {
    if (!recorded_ || told.tick != last_.tick) return;
    if (told.digest == last_.digest) {
      ++compared_;
      return;
    }
    fail(fmt::format("not the same bits: at tick {} the controller's digest is 0x{:016x}, this "
                     "PC's 0x{:016x}",
                     last_.tick, told.digest, last_.digest),
         false);
  }

  const WalkPlan& plan_;
  const HilOptions& options_;
  Progress& progress_;
  WalkSession session_;
  wire::Link link_;
  std::optional<bus::OperatorPort> orders_;
  std::optional<bus::ShadowLoop> shadow_;
  bus::LockstepServer lockstep_;
  bus::RealtimeServer realtime_;
  std::vector<std::uint8_t> answer_;
  bus::ControllerReport last_;
  bool recorded_ = false;
  bool connected_ = false;
  bool declined_ = false;
  bool device_trouble_ = false;
  std::string failure_;
  std::uint64_t compared_ = 0;
  std::uint32_t resets_ = 0;
  std::uint32_t losses_ = 0;     ///< of the link, as last seen
  std::uint64_t rested_ns_ = 0;  ///< when rest_after_loss() was last over
  std::uint64_t start_ns_ = 0;
  std::uint64_t drive_ns_ = 0;  ///< when torque was first seen
  bool lay_down_ = false;
  std::uint64_t heard_ns_ = 0;  ///< when something that is not for the clock came first
  std::uint64_t next_watch_us_ = 0;
};

}  // namespace

HilResult serve_controller(const WalkPlan& plan, const HilOptions& options,
                           record::TraceWriter* trace, Progress& progress, bool keep_series) {
  return HilRun(plan, options, trace, progress, keep_series).run();
}

}  // namespace verp::tool
