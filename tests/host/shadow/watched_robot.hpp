#pragma once
#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <optional>
#include <random>

#include "firmware/app/app.hpp"
#include "firmware/app/operator_node.hpp"
#include "firmware/app/tick_log.hpp"
#include "host/run/shadow/live_check.hpp"
#include "host/twin/can/virtual_can.hpp"
#include "tests/host/bus/fake_plant.hpp"

namespace verp::shadow::test {

class DeafBus final : public hal::CanBus {
 public:
  explicit DeafBus(can::VirtualCan& bus) : bus_(bus) {}
  bool send(const CanFrame& frame) override { return bus_.send(frame); }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    while (bus_.poll(frame, timeout_us)) {
      if (random_() % 1000 >= lost_per_mille) return true;
      ++lost;
    }
    return false;
  }
  std::uint64_t now_us() override { return bus_.now_us(); }
  hal::CanErrors errors() const override { return bus_.errors(); }

  void seed(unsigned seed) { random_.seed(seed); }
  unsigned lost_per_mille = 0;
  unsigned lost = 0;

 private:
  can::VirtualCan& bus_;
  std::minstd_rand random_{11};
};

class Ear : public can::Node {
 public:
  explicit Ear(const Params& params) : check(params) {}
  std::uint8_t id() const override { return 126; }
  void hear(const CanFrame& frame, std::uint64_t now_us) override {
    if (cut || random_() % 10'000 < lost_per_10000) return;
    check.take(frame, now_us);
  }
  void work(std::uint64_t) override {}
  bool say(CanFrame& frame, std::uint64_t now_us) override {
    const bool says = !cut && check.next(frame, now_us);
    sent += says ? 1 : 0;
    return says;
  }
  void power_on() override {}
  void power_off() override {}
  void seed(unsigned seed) { random_.seed(seed); }

  LiveCheck check;
  unsigned lost_per_10000 = 0;
  unsigned sent = 0;
  bool cut = false;

 private:
  std::minstd_rand random_{5};
};

/// Some positions come late and changed: in time, in the next window, after the tick or in the next
/// one.
class LateTwin : public can::Node {
 public:
  explicit LateTwin(std::uint8_t drive, unsigned seed = 3) : drive_(drive), random_(seed) {}
  std::uint8_t id() const override { return 125; }
  void hear(const CanFrame& frame, std::uint64_t now_us) override {
    if (frame.extended || frame.id != canopen::tpdo_id(1, drive_) || random_() % 4 != 0) return;
    late_.push_back({frame, now_us + random_() % 12'000});
    late_.back().frame.data[2] ^= static_cast<std::uint8_t>(1 + random_() % 3);
  }
  void work(std::uint64_t) override {}
  bool say(CanFrame& frame, std::uint64_t now_us) override {
    if (late_.empty() || late_.front().due_us > now_us) return false;
    frame = late_.front().frame;
    late_.pop_front();
    ++said;
    return true;
  }
  void power_on() override {}
  void power_off() override {}
  unsigned said = 0;

 private:
  struct Late {
    CanFrame frame;
    std::uint64_t due_us;
  };
  std::uint8_t drive_;
  std::deque<Late> late_;
  std::minstd_rand random_;
};

struct Orders {
  app::OperatorOrder order(std::uint32_t tick) const {
    app::OperatorOrder order;
    const bool stopped = tick % 400 >= 390;
    order.command.request = tick % 400 < 20 ? Request::kRelax : Request::kWalk;
    order.command.sequence = static_cast<std::uint8_t>(tick / 5);
    order.command.vx_tenth_mm_s = static_cast<std::int16_t>(tick % 100);
    order.command.head_tilt_mrad = static_cast<std::int16_t>(tick / 50);
    order.mailbox = static_cast<std::uint16_t>(tick / 70);
    if (tick % 5 == 0) order.flags = kCommandFresh;
    if (stopped) order.flags |= kEmergencyStop;
    if (tick % 60 == 30) {
      order.flags |= kParameterWrite;
      order.parameter_id = 0;
      order.parameter_bits = 0x3C23D70A;  // 0.01
    }
    return order;
  }
};

/// `Chip`: the controller's own IMU.
template <class Chip = app::NoImu>
class WatchedRobot {
 public:
  using Node = app::OperatorNode;
  struct Desk {
    app::OperatorOrder order(std::uint32_t tick) const { return Orders{}.order(tick); }
    void record(const TickRecord& record, const State& state, const Outputs& outputs) {
      node->record(record, state, outputs);
    }
    Node* node;
  };
  struct Controller {
    Controller(const Params& params, DeafBus& bus, Chip* chip)
        : registers(params, {}, log),
          node(bus, params, registers, log),
          loop(params, node, desk, desk, chip) {}
    app::TickLog log{app::no_images};
    app::OperatorRegisters registers;
    Node node;
    Desk desk{&node};
    app::App<Node, Desk, Desk, Chip> loop;
  };

  explicit WatchedRobot(const Params& robot, const Params& listens_for, Chip* chip = nullptr)
      : params(robot), listened(listens_for), chip_(chip) {
    auto ear_node = std::make_unique<Ear>(listened);
    ear = ear_node.get();
    twin.plug_in(std::move(ear_node));
    for (auto& joint : plant.measured) joint.position_count = 2048;  // far from its limits
    power_on();
  }
  explicit WatchedRobot(const Params& robot, Chip* chip = nullptr)
      : WatchedRobot(robot, robot, chip) {}

  /// Also restarts.
  void power_on() {
    controller = std::make_unique<Controller>(params, bus, chip_);
    const app::BringUpReport report = controller->loop.bring_up();
    ASSERT_EQ(report.status, app::BringUpStatus::kReady) << int{report.device_id};
  }
  void run(int ticks) {
    for (int i = 0; i < ticks && !ear->check.over(); ++i) tick();
  }
  void tick() {
    for (int j = 0; j < params.joint_count; ++j) {
      plant.measured[static_cast<std::size_t>(j)].position_count += j % 3 - 1;
    }
    plant.motion.gyro_count[0] = static_cast<std::int16_t>(ticks_++ % 50);
    controller->loop.tick();
  }
  State& state() { return const_cast<State&>(controller->loop.state()); }
  LiveCheck& check() { return ear->check; }

  const Params params;
  const Params listened;  ///< expected by the live check
  verp::test::FakePlant plant;
  can::VirtualCan twin{params, plant};
  DeafBus bus{twin};
  Ear* ear = nullptr;
  std::unique_ptr<Controller> controller;

 private:
  Chip* chip_;
  unsigned ticks_ = 0;
};

inline Params can_robot() {
  Params params = verp::test::bus_params(7);
  params.bus_protocol = BusProtocol::kCia402;
  params.baud = 1'000'000;
  return params;
}

}  // namespace verp::shadow::test
