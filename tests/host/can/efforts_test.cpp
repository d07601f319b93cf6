#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "common/safety/machine.hpp"
#include "firmware/app/app.hpp"
#include "firmware/app/operator_node.hpp"
#include "firmware/app/tick_log.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/twin/can/virtual_can.hpp"
#include "host/twin/sim/robot.hpp"

namespace verp::can {
namespace {

using Log = app::TickLog;
using Controller = app::OperatorNode;

enum Effort : unsigned { kVelocity, kTorque, kEfforts };

/// A joint's range between a drive's request and answer.
struct Truth {
  std::int32_t least = 0, most = 0;
  std::uint64_t at_us = 0;
  unsigned number = 0;

  void take(std::int32_t value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  bool holds(std::int32_t value) const { return least <= value && value <= most; }
};

class Reader : public Node {
 public:
  Reader(const Params& params, sim::Plant& plant) : params_(params), plant_(plant) {}
  std::uint8_t id() const override { return 126; }
  void power_on() override {}
  void power_off() override {}
  void work(std::uint64_t) override {}

  void hear(const CanFrame& frame, std::uint64_t now_us) override {
    witness(frame, now_us);
    client_.receive(frame, now_us);
    if (client_.state() == canopen::SdoClient::State::kBusy) return;
    if (judges && client_.state() == canopen::SdoClient::State::kDone) judge(now_us);
    next_ = (next_ + 1) % (int{kEfforts} * params_.joint_count);
    begin(now_us);
  }
  bool say(CanFrame& frame, std::uint64_t now_us) override {
    if (client_.state() == canopen::SdoClient::State::kIdle) begin(now_us);
    return client_.next(frame, now_us);
  }

  bool judges = false;
  std::array<unsigned, kEfforts> judged{};
  std::array<std::int32_t, kEfforts> largest{};

 private:
  /// A drive with telemetry due loses a turn.
  static constexpr unsigned kTurns = 2;

  int joint() const { return next_ % params_.joint_count; }
  Effort effort() const { return next_ < params_.joint_count ? kVelocity : kTorque; }

  void begin(std::uint64_t now_us) {
    constexpr canopen::Address kAt[] = {app::object("joint_velocity"), app::object("joint_torque")};
    canopen::Address at = kAt[effort()];
    at.subindex = static_cast<std::uint8_t>(joint() + 1);
    bytes_ = {};
    client_.upload(at, bytes_.data(), sizeof bytes_, canopen::SdoClient::Mode::kPlain, now_us);
  }

  std::int32_t truth(int joint, Effort effort) const {
    const sim::ServoMeasurement is = plant_.measure(joint);
    const double counts = std::abs(double{params_.joint[joint].counts_per_rad});
    return static_cast<std::int32_t>(
        std::lround(effort == kVelocity ? is.velocity_rad_s * counts
                                        : is.current_a / plant_.rating(joint).current_a * 1000));
  }
  void witness(const CanFrame& frame, std::uint64_t now_us) {
    const canopen::Connection of = canopen::connection_of(frame.id);
    if (of.service != canopen::Service::kSdoRequest && of.service != canopen::Service::kSdoResponse)
      return;
    for (int j = 0; j < params_.joint_count; ++j) {
      if (params_.joint[j].servo_id != of.node) continue;
      namespace object = canopen::cia402::object;
      const canopen::Address at = canopen::sdo::address_of(frame);
      const bool velocity = at == object::kActualVelocity;
      if (!velocity && !(at == object::kActualTorque)) return;
      const Effort effort = velocity ? kVelocity : kTorque;
      const std::int32_t now = truth(j, effort);
      Truth& last = last_[effort][static_cast<std::size_t>(j)];
      if (of.service == canopen::Service::kSdoRequest) {
        before_[effort][static_cast<std::size_t>(j)] = last;
        last = {now, now, now_us, ++requests_};
      } else {
        last.take(now);
      }
    }
  }

  // It may be of the turn before if the answer came late.
  void judge(std::uint64_t now_us) {
    const std::int32_t told = effort() == kVelocity
                                  ? static_cast<std::int32_t>(canopen::get_le(bytes_.data(), 4))
                                  : static_cast<std::int16_t>(canopen::get_le(bytes_.data(), 2));
    const Truth& last = last_[effort()][static_cast<std::size_t>(joint())];
    const Truth& before = before_[effort()][static_cast<std::size_t>(joint())];
    const bool lately = now_us - last.at_us <= 3 * params_.period_us;
    EXPECT_TRUE(last.number > 0);
    EXPECT_LE(requests_ - last.number, kTurns * kEfforts * params_.joint_count);
    EXPECT_TRUE(last.holds(told) || (lately && before.holds(told)))
        << "joint " << joint() << " effort " << effort() << ": " << told << " not in " << last.least
        << ".." << last.most;
    ++judged[effort()];
    largest[effort()] = std::max(largest[effort()], std::abs(told));
  }

  const Params& params_;
  sim::Plant& plant_;
  canopen::SdoClient client_{Controller::kNode};
  std::array<std::uint8_t, 4> bytes_{};
  int next_ = 0;
  unsigned requests_ = 0;  ///< for efforts
  std::array<std::array<Truth, kMaxJoints>, kEfforts> last_{}, before_{};
};

struct Desk {
  static constexpr std::uint32_t kRisen = 250;
  app::OperatorOrder order(std::uint32_t tick) const {
    app::OperatorOrder order;
    order.command.request = tick < kRisen ? Request::kStand : Request::kWalk;
    order.command.sequence = static_cast<std::uint8_t>(tick);
    order.command.vx_tenth_mm_s = 500;
    order.flags = kCommandFresh;
    return order;
  }
  void record(const TickRecord& record, const State& state, const Outputs& outputs) {
    node.record(record, state, outputs);
  }
  Controller& node;
};

// Exact to the count and at most two turns old. A turn is 21 drives' velocities and torques, one
// request in four ticks.
TEST(Efforts, ReadFromAWalkingControllersNodeAreWhatEachJointDidInItsTurn) {
  const model::Entity entity = model::load_robot(model::find_model("generic21"), "can");
  const Params params = model::make_params(entity);
  sim::World world;
  sim::TwinRobot robot(world, entity);
  VirtualCan bus(params, robot);
  auto owned = std::make_unique<Reader>(params, robot);
  Reader& reader = *owned;
  bus.plug_in(std::move(owned));
  Log log(app::no_images);
  auto registers = std::make_unique<app::OperatorRegisters>(params, app::OperatorSetup{}, log);
  Controller node(bus, params, *registers, log);
  Desk desk{node};
  auto loop = std::make_unique<app::App<Controller, Desk, Desk>>(params, node, desk, desk);
  ASSERT_EQ(loop->bring_up().status, app::BringUpStatus::kReady);
  const auto run = [&](unsigned ticks) {
    for (unsigned i = 0; i < ticks; ++i) {
      loop->tick();
      node.report({.bus = loop->counters(), .efforts = loop->efforts()});
    }
  };
  run(Desk::kRisen + 50);
  reader.judges = true;
  run(400);
  EXPECT_EQ(static_cast<safety::Mode>(loop->outputs().mode), safety::Mode::kWalking);
  EXPECT_EQ(bus.errors().overruns, 0u);
  for (const Effort effort : {kVelocity, kTorque}) {
    EXPECT_GE(reader.judged[effort], 2u * params.joint_count) << effort;
    EXPECT_GT(reader.largest[effort], 100) << "it walked " << effort;
  }
}

}  // namespace
}  // namespace verp::can
