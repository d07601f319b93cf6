#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <random>
#include <string>
#include <thread>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/twin/can/virtual_can.hpp"
#include "tests/can/can_world.hpp"
#include "tests/hil/level_plant.hpp"
#include "tests/hil/promises.hpp"
#include "tests/hil/software_board.hpp"

namespace verp::test {
namespace {

using std::chrono::milliseconds;

/// A longer period: one core may have to run all.
Params can_robot() {
  Params params = model::make_params(model::load_robot(model::find_model("generic21"), "can"));
  params.period_us = 20'000;
  return params;
}

class LiveNodes {
 public:
  LiveNodes(const Params& params, const link::Endpoint& endpoint)
      : plant_(params), nodes_(params, plant_), port_(endpoint), thread_([this] { run(); }) {}
  ~LiveNodes() {
    over_ = true;
    thread_.join();
    EXPECT_EQ(port_.errors().overruns, 0u);
  }

 private:
  void run() {
    CanFrame frame;
    while (!over_) {
      const bool came = poll_for(port_, frame, 500);
      const std::uint64_t now_ns = 1000 * port_.now_us();
      if (came) nodes_.crossed(frame, now_ns);
      nodes_.work_until(now_ns);
      while (nodes_.take_said(frame)) port_.send(frame);
    }
  }

  LevelPlant plant_;
  can::VirtualCan nodes_;
  link::CanPort port_;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

class PortLine final : public hal::CanBus {
 public:
  explicit PortLine(const link::Endpoint& endpoint) : port_(endpoint) {}
  bool send(const CanFrame& frame) override { return port_.send(frame); }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    return port_.poll(frame, timeout_us == 0 ? 0 : timeout_us + kHeld_us);
  }
  std::uint64_t now_us() override { return port_.now_us(); }
  hal::CanErrors errors() const override { return port_.errors(); }
  std::uint64_t time_us() const {
    const auto since = std::chrono::steady_clock::now() - opened_;
    return static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::microseconds>(since).count());
  }
  void wait_until(std::uint64_t until_us) const {
    std::this_thread::sleep_until(opened_ + std::chrono::microseconds(until_us));
  }

 private:
  /// How long this PC may delay an answer; the period is five times as long.
  static constexpr std::uint32_t kHeld_us = 2000;

  link::CanPort port_;
  std::chrono::steady_clock::time_point opened_ = std::chrono::steady_clock::now();
};

class InterfaceRun {
 public:
  explicit InterfaceRun(std::uint32_t seed) : random_(seed) {
    board_ = std::make_unique<Board>(params_, line_, desk_, dxl::controller::ResetCause::kPower);
  }
  bool come_up() {
    const bool ready = board_->loop.bring_up().status == app::BringUpStatus::kReady;
    board_->pacer.start(params_.period_us);
    return ready && desk_.write(app::reg("request"), {0});
  }
  ::testing::AssertionResult reaches(Mode mode, std::uint32_t then_ms) {
    // Rising takes 7 s. If this PC skips periods the robot may sit down; then the time starts
    // again.
    constexpr std::uint32_t kPatience_ms = 8000;
    const auto passed = [this](std::uint32_t ticks, std::uint32_t ms) {
      return ticks * params_.period_us >= 1000 * ms;
    };
    std::uint32_t there = 0, undisturbed = 0;
    while (!passed(undisturbed, kPatience_ms) && std::chrono::steady_clock::now() < end_) {
      if (passed(there, then_ms)) return ::testing::AssertionSuccess();
      const auto skipped = board_->pacer.deadlines().skipped;
      tick();
      const bool kept = board_->pacer.deadlines().skipped == skipped;
      there += board_->safe.mode() == mode ? 1 : 0;
      undisturbed = kept && board_->safe.mode() != kHolding ? undisturbed + 1 : 0;
    }
    const Registers now = registers();
    return ::testing::AssertionFailure()
           << "it is " << kModeNames[now.mode] << ": faults " << now.faults << ", fresh "
           << now.fresh << ", timeouts " << now.timeouts << ", strays " << now.strays
           << ", skipped periods " << now.misses;
  }
  /// In a thread, because commands take time.
  void take_down_and_up() {
    const milliseconds gone(150 + random_() % 350);
    std::atomic<int> stage = 0;
    std::thread somebody([&] {
      can.down();
      stage = 1;
      std::this_thread::sleep_for(gone);
      stage = 2;
      can.up();
      stage = 3;
    });
    while (stage < 3) {
      tick();
      if (stage == 1) during = read_registers(desk_);
    }
    somebody.join();
  }
  void watch() {
    EXPECT_EQ(board_->safe.violation(), "");
    EXPECT_EQ(line_.errors().overruns, 0u);
  }
  bool was_holding() const { return (board_->safe.seen() >> kHolding & 1) != 0; }
  Registers registers() { return read_registers(desk_); }

  OwnVcan can{"vcan8"};
  Registers during;  ///< while down

 private:
  using Board = ControllerOnBoard<PortLine>;
  void tick() {
    constexpr std::uint32_t kOrderTicks = 10;
    if (ticks_++ % kOrderTicks == 0) desk_.order_walk(ticks_);
    board_->tick();
  }

  /// Less than the limit in CMakeLists.txt.
  static constexpr std::chrono::seconds kTime{100};

  const std::chrono::steady_clock::time_point end_ = std::chrono::steady_clock::now() + kTime;
  const Params params_ = can_robot();
  std::minstd_rand random_;
  LiveNodes nodes_{params_, can.endpoint()};
  PortLine line_{can.endpoint()};
  OperatorDesk desk_;
  std::unique_ptr<Board> board_;
  std::uint32_t ticks_ = 0;
};

TEST(InterfaceDown, HoldsAndWalksAgainWhenItIsUp) {
  InterfaceRun run(1);
  ASSERT_TRUE(run.come_up());
  for (int times = 1; times <= 2; ++times) {
    SCOPED_TRACE(times);
    ASSERT_TRUE(run.reaches(kWalking, 300)) << "first, or again";
    const Registers before = run.registers();
    run.take_down_and_up();
    EXPECT_EQ(run.during.fresh, 0u);
    EXPECT_GT(run.during.timeouts, before.timeouts);
    EXPECT_GT(run.during.refused + run.during.noise, before.refused + before.noise)
        << "what was not sent is told";
    EXPECT_TRUE(run.was_holding());
  }
  EXPECT_TRUE(run.reaches(kWalking, 300)) << "it is back";
  run.watch();
}

}  // namespace
}  // namespace verp::test
