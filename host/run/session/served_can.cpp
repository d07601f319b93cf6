#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/os/link/can_claim.hpp"
#include "host/os/link/can_port.hpp"
#include "host/os/link/link_error.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/run/session/remote_controller.hpp"
#include "host/run/shadow/live_check.hpp"
#include "host/twin/can/lockstep_server.hpp"
#include "host/twin/can/other_nodes.hpp"
#include "host/twin/can/realtime_server.hpp"
#include "host/twin/can/shadow_loop.hpp"

namespace verp::session {
namespace {

class ServedOnCan final : public RemoteController {
 public:
  ServedOnCan(Robot& robot, const ServeOptions& options)
      : RemoteController(robot, options, true),
        port_(link::parse_endpoint(options.link)),
        claim_(port_.interface().name, "nodes", "`verp hil`"),
        server_(robot.plan().params, robot.can(), own_hooks()),
        realtime_(robot.can()),
        others_(robot.plan().params) {
    if (options.check) options.check(port_.interface());
    if (options.pace == Pace::kRealTime) {
      server_.refuse_lockstep();
    } else if (options.operator_link.empty()) {
      watch_live();
    }
  }

  RemoteResult result() const override {
    RemoteResult result = RemoteController::result();
    if (live_) result.compared += live_->compared();
    result.losses = losses_;
    result.overruns = port_.errors().overruns;
    result.lockstep = server_.counters();
    const can::RealtimeServer::Counters& real = realtime_.counters();
    result.realtime = {.bytes = 0, .late = real.late, .worst_late_us = real.worst_late_us};
    if (result.real_time)
      result.can = CanFrames{real.frames, real.dropped + port_.errors().overruns, real.skipped_us};
    return result;
  }

 private:
  static constexpr std::uint32_t kGoodbye_us = 200'000;
  /// An SDO client waits for 0.3 to 1 s.
  static constexpr std::uint64_t kListen_ns = 150'000'000;
  static constexpr std::uint64_t kMostSkipped_us = 1'000'000;

  bool stopped() const override { return server_.stopped(); }
  bool greeted() const override { return server_.greeted(); }
  bool real_time_begun() const override { return realtime_.begun(); }

  std::unique_ptr<bus::Shadow> make_shadow(bus::Shadow::Record record) override {
    auto shadow = std::make_unique<can::ShadowLoop>(robot_.plan().params, std::move(record),
                                                    robot_.actions());
    shadow_ = shadow.get();
    return shadow;
  }

  can::LockstepHooks own_hooks() {
    return {RemoteController::hooks(),
            [this](const CanFrame& frame) {
              if (shadow_ != nullptr) shadow_->sent(frame);
            },
            [this](const std::vector<CanFrame>& burst, std::uint64_t now_us) {
              if (shadow_ != nullptr) shadow_->polled(burst, now_us);
            }};
  }

  // Two watchers would take each other's answers.
  void watch_live() {
    try {
      watcher_.emplace(port_.interface().name, "watcher", link::CanClaim::kWatcher);
      live_.emplace(robot_.plan().params, robot_.actions());
    } catch (const link::LinkError& busy) {
      say(std::string(busy.what()) + ", or the walk goes without a check of its own");
    }
  }

  void turn() override {
    CanFrame frame;
    const bool came = port_.await(frame, realtime_.begun() ? kRealTimeTurn_us : kIdle_us);
    const bool lost = !port_.connected();
    if (lost && !std::exchange(lost_, lost)) ++losses_;
    lost_ = lost;
    watch_link(port_.connected(), losses_);
    waited(server_, came ? 1 : 0, "frames");
    answer_.clear();
    if (came) hear(frame);
    if (may_run_in_real_time()) let_time_go_on(came);
    for (const CanFrame& each : answer_) {
      if (!port_.send(each)) break;  // no receiver; lockstep asks again
      listen(each);
    }
    ask();
  }

  // All waiting frames, up to a CAN controller's queue.
  void hear(CanFrame& frame) {
    heard_.clear();
    bool more = true;
    for (std::size_t left = hal::kCanQueue; more; more = --left > 0 && port_.await(frame, 0)) {
      watch_others(frame);
      if (realtime_.begun() && !lockstep::is_clock_frame(frame)) {
        heard_.push_back({frame, port_.now_us()});
        continue;
      }
      listen(frame);
      server_.take(frame, answer_);
      if (!realtime_.begun()) break;
    }
    realtime_.hear(heard_, clock_us(), answer_);
  }

  void watch_others(const CanFrame& frame) {
    others_.take(frame);
    if (others_.found() == 0) return;
    fail("node " + std::to_string(others_.found()) + " of this robot is on " + place_ +
         " already, beside the twin's; unplug it, or serve the twin on another interface");
  }

  // Without the operator port, only reported ticks show the controller.
  void listen(const CanFrame& frame) {
    if (live_) live_->take(frame, port_.now_us());
  }
  void ask() {
    CanFrame frame;
    while (live_ && live_->next(frame, port_.now_us())) server_.enclose(frame);
    if (!live_ || !live_->over()) return;
    if (live_->differs()) {
      fail("not the same bits: " +
               record::text(live_->divergence(), robot_.plan().params, "controller", "PC"),
           false);
    } else {
      fail(live_->refusal());
    }
  }

  // The port's clock stands at the last frame.
  void let_time_go_on(bool came) {
    if (!realtime_.begun() && !begin_with_what_was_heard()) return;
    if (!came) realtime_.turn(clock_us(), answer_);
    realtime_.finished(clock_us());
    watch_skips();
    watch_until(robot_.can().now_us());
  }

  void watch_skips() {
    const std::uint64_t skipped_us = realtime_.counters().skipped_us;
    if (skipped_us > 0 && !std::exchange(skips_told_, true)) {
      say("this PC is too slow, or was kept from it: what the twin is behind by more than 50 ms is "
          "skipped, and its time is short of the clock's");
    }
    if (skipped_us < kMostSkipped_us || std::exchange(priority_left_, true)) return;
    if (options_.cannot_keep_up) options_.cannot_keep_up();
    say("over a second was skipped; so that others run as well, the twin does without real-time "
        "priority from now on");
  }

  bool begin_with_what_was_heard() {
    for (const CanFrame& each : server_.unannounced()) unannounced_.push_back(each);
    if (unannounced_.empty() || still_listening(true, kListen_ns)) return false;
    server_.refuse_lockstep();
    live_.reset();
    watcher_.reset();
    begin_real_time();
    // Not the port's clock, which stands at the frame.
    const std::uint64_t now_us = clock_us();
    heard_.clear();
    for (const CanFrame& each : unannounced_) heard_.push_back({each, now_us});
    realtime_.hear(heard_, now_us, answer_);
    unannounced_.clear();
    return true;
  }

  /// The time now, on the port's clock, which itself stands at the last frame.
  std::uint64_t clock_us() const { return link::monotonic_ns() / 1000 - skew_us_; }

  void conclude() override {
    // The stop answer may get lost: repeat it on request.
    const std::uint64_t end_us = port_.now_us() + (server_.stopped() ? kGoodbye_us : 0);
    while (port_.now_us() < end_us && !robot_.interrupted()) turn();
    if (live_ && (live_->suspects() || live_->unsettled() > 0)) {
      fail("not the same bits; the controller's State was not read in time", false);
    }
    if (live_ && live_->heard_us() > 0 && live_->compared() == 0 && !robot_.interrupted()) {
      fail("the controller told of its ticks, and none of them could be compared", false);
    }
    if (!realtime_.kept_up()) {
      fail(
          "this PC never kept up with the clock; end what else keeps it busy, or let the "
          "controller announce lockstep",
          false);
    }
    // The bits are right, because lost frames were repeated; but this PC is too slow.
    const std::uint32_t overruns = port_.errors().overruns;
    if (overruns > 0) {
      fail(std::to_string(overruns) + " frames found no room at this PC's end of " + place_ +
           "; end what else keeps this PC busy, or sends on that bus");
    }
  }

  link::CanPort port_;
  link::CanClaim claim_;
  can::ShadowLoop* shadow_ = nullptr;  ///< the base owns it
  can::LockstepServer server_;
  can::RealtimeServer realtime_;
  can::OtherNodes others_;
  std::optional<link::CanClaim> watcher_;
  std::optional<shadow::LiveCheck> live_;
  std::vector<CanFrame> answer_;
  std::vector<CanFrame> unannounced_;  ///< before the pace was known
  std::vector<can::RealtimeServer::ReceivedFrame> heard_;
  std::uint64_t skew_us_ = link::monotonic_ns() / 1000 - port_.now_us();
  std::uint32_t losses_ = 0;
  bool lost_ = false;
  bool skips_told_ = false;
  bool priority_left_ = false;
};

}  // namespace

std::unique_ptr<RemoteController> make_served_on_can(Robot& robot, const ServeOptions& options) {
  return std::make_unique<ServedOnCan>(robot, options);
}

}  // namespace verp::session
