#include <chrono>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "host/os/link/link.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/run/session/remote_controller.hpp"
#include "host/twin/bus/lockstep_server.hpp"

namespace verp::session {
namespace {

class ServedOnSerial final : public RemoteController {
 public:
  ServedOnSerial(Robot& robot, const ServeOptions& options)
      : RemoteController(robot, options, false),
        link_(link::parse_endpoint(options.link)),
        lockstep_(robot.plan().params, robot.bus(), own_hooks()),
        realtime_(robot.bus()) {
    place_ = link_.place();
    link_.set_rate(robot.plan().params.baud);
    if (options.pace == Pace::kRealTime) lockstep_.refuse_lockstep();
    if (options.pace == Pace::kAuto) robot.bus().hold_plant();
    if (options.operator_link.empty()) lockstep_.welcome_strangers();
  }

  RemoteResult result() const override {
    RemoteResult result = RemoteController::result();
    result.losses = link_.errors().losses;
    result.overruns = link_.errors().overruns;
    result.lockstep = lockstep_.counters();
    result.realtime = realtime_.counters();
    return result;
  }

 private:
  static constexpr std::uint32_t kWrite_us = 100'000;
  static constexpr std::uint64_t kLossRest_ns = 50'000'000;  // between two losses

  bool stopped() const override { return lockstep_.stopped(); }
  bool greeted() const override { return lockstep_.greeted(); }
  bool real_time_begun() const override { return realtime_.begun() && !robot_.bus().held(); }
  bool met() const override { return greeted() || realtime_.begun(); }

  std::unique_ptr<bus::Shadow> make_shadow(bus::Shadow::Record record) override {
    auto shadow = std::make_unique<bus::ShadowLoop>(robot_.plan().params, std::move(record),
                                                    robot_.actions());
    shadow_ = shadow.get();
    return shadow;
  }

  bus::LockstepHooks own_hooks() {
    bus::LockstepHooks hooks{RemoteController::hooks(),
                             [this](std::span<const std::uint8_t> frame) {
                               if (shadow_ != nullptr) shadow_->sent({frame.begin(), frame.end()});
                             },
                             [this](std::span<const std::uint8_t> bytes, std::uint64_t now_us) {
                               if (shadow_ != nullptr)
                                 shadow_->polled({bytes.begin(), bytes.end()}, now_us);
                             }};
    hooks.greeted = [this, begins = hooks.greeted] {
      if (robot_.bus().held()) robot_.bus().begin_time();
      robot_.bus().set_real_time(false);
      begins();
    };
    return hooks;
  }

  void turn() override {
    std::uint8_t piece[bus::RealtimeServer::kPort_bytes];
    const std::size_t room = realtime_.begun() ? realtime_.room() : sizeof piece;
    if (room == 0) std::this_thread::sleep_for(std::chrono::microseconds(kRealTimeTurn_us));
    const std::size_t count =
        link_.read(piece, room, realtime_.begun() ? kRealTimeTurn_us : kIdle_us);
    answer_.clear();
    lockstep_.take({piece, count}, answer_);
    waited(lockstep_, count, "bytes");
    if (may_run_in_real_time()) let_time_go_on({piece, count});
    for (std::size_t sent = 0; sent < answer_.size();) {
      const std::size_t more = link_.write(answer_.data() + sent, answer_.size() - sent, kWrite_us);
      if (more == 0) break;  // no reader; lockstep asks again
      sent += more;
    }
    watch_link(link_.connected(), link_.errors().losses);
    rest_after_loss();
  }

  // Pauses for a client that hangs up repeatedly; the first loss costs no time.
  void rest_after_loss() {
    if (link_.errors().losses == losses_) return;
    losses_ = link_.errors().losses;
    if (realtime_.begun()) robot_.bus().hung_up();
    const std::uint64_t now = link::monotonic_ns();
    if (now < rested_ns_ + kLossRest_ns) {
      std::this_thread::sleep_for(std::chrono::nanoseconds(rested_ns_ + kLossRest_ns - now));
    }
    rested_ns_ = link::monotonic_ns();
  }

  // While lockstep is possible the robot does not move: a controller that looks around first finds
  // the twin unchanged. Clock packets take wire time.
  void let_time_go_on(std::span<const std::uint8_t> heard) {
    lockstep_.unannounced();
    bus::VirtualBus& bus = robot_.bus();
    const std::uint64_t now_us = link::monotonic_ns() / 1000;
    if (link_.rate() != 0) bus.set_baud(link_.rate());
    realtime_.turn(now_us, heard, answer_);
    realtime_.finished(link::monotonic_ns() / 1000);
    if (!realtime_.begun()) return;
    const bool looks = still_listening(true) && !bus.torque_on();
    if (bus.held() && (looks || !bus.quiet())) return;
    if (bus.held()) realtime_.let_go(now_us);
    if (!std::exchange(told_, true)) {
      lockstep_.refuse_lockstep();
      begin_real_time();
    }
    tell_trouble();
    watch_until(bus.now_us());
  }

  void tell_trouble() {
    const bus::RealtimeServer::Counters& real = realtime_.counters();
    if (real.lost > 0 && !std::exchange(lost_told_, true)) {
      say("requests come while a servo is answering, and are lost, as on a wire; wait for each "
          "answer, or write to all at once (Sync Write)");
    }
    if (real.skipped_us > 0 && !std::exchange(skips_told_, true)) {
      say("the twin falls behind the clock: what it can't make up for within 50 ms is skipped, and "
          "its time is short of the clock's");
    }
  }

  link::Link link_;
  bus::ShadowLoop* shadow_ = nullptr;  ///< the base owns it
  bus::LockstepServer lockstep_;
  bus::RealtimeServer realtime_;
  std::vector<std::uint8_t> answer_;
  bool told_ = false, lost_told_ = false, skips_told_ = false;
  std::uint32_t losses_ = 0;     ///< last seen
  std::uint64_t rested_ns_ = 0;  ///< last rest_after_loss()
};

}  // namespace

std::unique_ptr<RemoteController> make_served_on_serial(Robot& robot, const ServeOptions& options) {
  return std::make_unique<ServedOnSerial>(robot, options);
}

}  // namespace verp::session
