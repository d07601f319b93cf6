#include <chrono>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "host/bus/lockstep_server.hpp"
#include "host/link/link.hpp"
#include "host/link/system_clock.hpp"
#include "host/session/served.hpp"

namespace verp::session {
namespace {

/// Dynamixel servos on a byte link.
class ServedOnSerial final : public Served {
 public:
  ServedOnSerial(Robot& robot, const ServeOptions& options)
      : Served(robot, options, false),
        link_(wire::parse_endpoint(options.link)),
        lockstep_(robot.plan().params, robot.bus(), own_hooks()),
        realtime_(robot.bus()) {
    place_ = link_.place();
    if (options.pace == Pace::kRealTime) lockstep_.refuse_lockstep();
  }

  ServedResult result() const override {
    ServedResult result = Served::result();
    result.losses = link_.errors().losses;
    result.overruns = link_.errors().overruns;
    result.lockstep = lockstep_.counters();
    result.realtime = realtime_.counters();
    return result;
  }

 private:
  static constexpr std::uint32_t kWrite_us = 100'000;
  static constexpr std::uint64_t kLossRest_ns = 50'000'000;  // from one loss to the next

  bool stopped() const override { return lockstep_.stopped(); }
  bool greeted() const override { return lockstep_.greeted(); }
  bool real_time_begun() const override { return realtime_.begun(); }

  std::unique_ptr<bus::Shadow> make_shadow(bus::Shadow::Record record) override {
    auto shadow = std::make_unique<bus::ShadowLoop>(robot_.plan().params, std::move(record));
    shadow_ = shadow.get();
    return shadow;
  }

  bus::LockstepHooks own_hooks() {
    return {Served::hooks(),
            [this](std::span<const std::uint8_t> frame) {
              if (shadow_ != nullptr) shadow_->sent({frame.begin(), frame.end()});
            },
            [this](std::span<const std::uint8_t> bytes, std::uint64_t now_us) {
              if (shadow_ != nullptr) shadow_->polled({bytes.begin(), bytes.end()}, now_us);
            }};
  }

  void turn() override {
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
    watch_link(link_.connected(), link_.errors().losses);
    rest_after_loss();
  }

  // Somebody who hangs up at once, again and again, is not met as fast as a processor can. The
  // first loss after a while costs no time.
  void rest_after_loss() {
    if (link_.errors().losses == losses_) return;
    losses_ = link_.errors().losses;
    const std::uint64_t now = wire::monotonic_ns();
    if (now < rested_ns_ + kLossRest_ns) {
      std::this_thread::sleep_for(std::chrono::nanoseconds(rested_ns_ + kLossRest_ns - now));
    }
    rested_ns_ = wire::monotonic_ns();
  }

  void let_time_go_on() {
    const bool begun = realtime_.begun();
    const std::vector<std::uint8_t> heard = lockstep_.unannounced();
    if (still_listening(!heard.empty())) return;
    realtime_.turn(wire::monotonic_ns() / 1000, heard, answer_);
    realtime_.finished(wire::monotonic_ns() / 1000);
    if (!realtime_.begun()) return;
    if (!begun) {
      lockstep_.refuse_lockstep();
      begin_real_time();
    }
    watch_until(robot_.bus().now_us());
  }

  wire::Link link_;
  bus::ShadowLoop* shadow_ = nullptr;  ///< the base class has it
  bus::LockstepServer lockstep_;
  bus::RealtimeServer realtime_;
  std::vector<std::uint8_t> answer_;
  std::uint32_t losses_ = 0;     ///< of the link, as last seen
  std::uint64_t rested_ns_ = 0;  ///< when rest_after_loss() was last over
};

}  // namespace

std::unique_ptr<Served> make_served_on_serial(Robot& robot, const ServeOptions& options) {
  return std::make_unique<ServedOnSerial>(robot, options);
}

}  // namespace verp::session
