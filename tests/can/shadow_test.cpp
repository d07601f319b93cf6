#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/frame.hpp"
#include "firmware/app/app.hpp"
#include "firmware/app/lockstep_can.hpp"
#include "firmware/app/operator_node.hpp"
#include "firmware/app/tick_log.hpp"
#include "host/os/link/can_claim.hpp"
#include "host/os/link/can_port.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/can/can_world.hpp"
#include "tests/host/tool/link_controller.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using nlohmann::json;
using verp::test::OwnVcan;

struct CanSocket : link::CanPort {
  explicit CanSocket(const std::string& endpoint) : CanPort(link::parse_endpoint(endpoint)) {}
  bool send(const CanFrame& frame) {
    const bool answers =
        canopen::is_canopen(frame) &&
        (canopen::connection_of(frame.id).service == canopen::Service::kSdoResponse ||
         frame.id == canopen::further_sdo(1).response ||
         frame.id == canopen::further_sdo(2).response);
    return (secretive && answers) || CanPort::send(frame);
  }
  bool secretive = false;  ///< answers no question
};
using Log = app::TickLog;
using Node = app::OperatorNode;

Params generic21() {
  return model::make_params(model::load_robot(model::find_model("generic21"), "can"));
}

/// Some ticks after a read, flips one bit of the controller's State.
class Spoiler {
 public:
  explicit Spoiler(bool flips = true) : flips_(flips) {}
  void watch(const Log& log, State& state, std::uint32_t tick) {
    const bool held = log.size(app::ImageKind::kState) > 0;
    if (held && ticks_ == 0) ticks_ = kTicks;
    if (held || ticks_ <= 1 || --ticks_ > 1) return;
    if (flips_) spoil(state);
    first_bad = tick + 1;
  }
  std::atomic<std::uint32_t> first_bad = 0;

 private:
  static constexpr int kTicks = 30;
  static void spoil(State& state);
  const bool flips_;
  int ticks_ = 0;
};
void Spoiler::spoil(State& state) {
  std::uint32_t bits;
  std::memcpy(&bits, &state.zeros.leg[1].pitch_rad, sizeof bits);
  bits ^= 1;
  std::memcpy(&state.zeros.leg[1].pitch_rad, &bits, sizeof bits);
}

/// Its drives have no power.
class LoneController {
 public:
  LoneController(const Params& params, const std::string& endpoint, Spoiler* spoiler = nullptr)
      : params_(params), endpoint_(endpoint), spoiler_(spoiler), thread_([this] { run(); }) {}
  ~LoneController() {
    over_ = true;
    thread_.join();
  }

 private:
  struct Desk {
    app::OperatorOrder order(std::uint32_t tick) const {
      app::OperatorOrder order;
      order.command.sequence = static_cast<std::uint8_t>(tick / 10);
      return order;
    }
    void record(const TickRecord& record, const State& state, const Outputs& outputs) {
      node->record(record, state, outputs);
    }
    Node* node;
  };

  void run() {
    CanSocket port(endpoint_);
    Log log(app::no_images);
    app::OperatorRegisters registers(params_, {}, log);
    Node node(port, params_, registers, log);
    Desk desk{&node};
    app::App<Node, Desk, Desk> loop(params_, node, desk, desk);
    while (!over_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(3));
      loop.tick({.periods = 1});
      if (spoiler_ == nullptr) continue;
      spoiler_->watch(log, const_cast<State&>(loop.state()), loop.inputs().tick);
    }
  }

  const Params params_;
  const std::string endpoint_;
  Spoiler* const spoiler_;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

/// In lockstep with `verp hil`; obeys its operator port, or else stands.
class WalkingController {
 public:
  WalkingController(const Params& params, const std::string& orders, Spoiler* spoiler = nullptr,
                    bool secretive = false)
      : params_(params), orders_(orders), spoiler_(spoiler), secretive_(secretive), thread_([this] {
          run();
        }) {}
  ~WalkingController() {
    over_ = true;
    thread_.join();
  }

 private:
  using Device = app::OperatorDevice;
  struct Idle {
    bool operator()() const {
      if (device != nullptr) device->poll();
      return !*over;
    }
    Device* device;
    std::atomic<bool>* over;
  };
  struct Desk {
    app::OperatorOrder order(std::uint32_t tick) {
      if (!alone) return device->order(tick);
      app::OperatorOrder order;
      order.command.request = tick < 20 ? Request::kRelax : Request::kStand;
      order.command.sequence = static_cast<std::uint8_t>(tick);
      order.flags = kCommandFresh;
      return order;
    }
    void record(const TickRecord& record, const State& state, const Outputs& outputs) {
      device->record(record, state, outputs);
      node->record(record, state, outputs);
    }
    Device* device;
    Node* node;
    bool alone;
  };

  void run() {
    CanSocket port("can:vcan0");
    port.secretive = secretive_;
    verp::test::ControllerPort orders(orders_);
    Device device(orders, params_, {});
    Log log(app::no_images);
    app::OperatorRegisters registers(params_, {}, log);
    Node node(port, params_, registers, log);
    using Bus = app::LockstepCan<Node, Idle>;
    Bus bus(node, Idle{orders_.empty() ? nullptr : &device, &over_});
    if (bus.greet(params_) != lockstep::Verdict::kAccepted) return;
    Desk desk{&device, &node, orders_.empty()};
    app::App<Bus, Desk, Desk> loop(params_, bus, desk, desk);
    loop.bring_up();
    while (!bus.stopped()) {
      loop.tick();
      if (spoiler_ == nullptr) continue;
      spoiler_->watch(log, const_cast<State&>(loop.state()), loop.inputs().tick);
    }
  }

  const Params params_;
  const std::string orders_;
  Spoiler* const spoiler_;
  const bool secretive_;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

class ShadowOnCan : public Program {
 protected:
  Outcome shadow(const std::string& arguments) const {
    return verp("shadow generic21 --json " + arguments, "shadow");
  }
};

TEST_F(ShadowOnCan, HasTheBitsOfAControllerThatWalks) {
  const std::string orders = (folder_ / "orders").string();
  WalkingController controller(generic21(), "unix:" + orders);
  Outcome beside;
  std::thread listener([&] { beside = shadow("--link can:vcan0 --for 1 --patience 20"); });
  while (slurp(folder_ / "shadow.err").find("looking for") == std::string::npos) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const Outcome hil = verp(
      "hil generic21 --bus can --link can:vcan0 --json --for 3 --operator unix-listen:" + orders,
      "hil");
  listener.join();
  EXPECT_EQ(hil.status, 0) << hil.err;
  EXPECT_EQ(json::parse(hil.out).at("link").at("damaged"), 0) << "the listener is not in its way";
  ASSERT_EQ(beside.status, 0) << beside.err << beside.out;
  const json result = json::parse(beside.out);
  EXPECT_GE(result.at("compared_ticks"), 100);
  EXPECT_EQ(result.at("differs"), false);
}

TEST_F(ShadowOnCan, VerpHilNamesABitThatFlipped) {
  Spoiler spoiler;
  WalkingController controller(generic21(), "", &spoiler);
  const Outcome hil = verp("hil generic21 --bus can --link can:vcan0 --json --for 8", "hil");
  EXPECT_EQ(hil.status, 1) << hil.out;
  EXPECT_GT(json::parse(hil.out).at("compared_ticks"), 20);
  const std::string tick = "tick " + std::to_string(spoiler.first_bad.load()) + " ";
  EXPECT_NE(hil.err.find(tick), std::string::npos) << hil.err;
  EXPECT_NE(hil.err.find("stage kinematics"), std::string::npos) << hil.err;
  EXPECT_NE(hil.err.find("zeros.leg[1].pitch_rad"), std::string::npos) << hil.err;
}

TEST_F(ShadowOnCan, VerpHilFailsWhereItComparedNothing) {
  WalkingController controller(generic21(), "", nullptr, true);
  const Outcome hil = verp("hil generic21 --bus can --link can:vcan0 --json --for 3", "hil");
  EXPECT_EQ(hil.status, 1) << hil.err << hil.out;
  EXPECT_NE(hil.err.find("none of them could be compared"), std::string::npos) << hil.err;
  EXPECT_EQ(json::parse(hil.out).at("compared_ticks"), 0);
}

TEST_F(ShadowOnCan, NamesTickStageAndFieldOfABitThatFlipped) {
  OwnVcan bus;
  Spoiler spoiler;
  LoneController controller(generic21(), "can:vcan7", &spoiler);
  const Outcome outcome = shadow("--link can:vcan7 --for 30");
  ASSERT_EQ(outcome.status, 1) << outcome.err << outcome.out;
  const json difference = json::parse(outcome.out).at("difference");
  EXPECT_EQ(difference.at("tick"), spoiler.first_bad.load());
  EXPECT_EQ(difference.at("stage"), "kinematics");
  EXPECT_EQ(difference.at("field"), "zeros.leg[1].pitch_rad");
}

TEST_F(ShadowOnCan, RefusesAnotherRobot) {
  OwnVcan bus;
  Params other = generic21();
  other.joint[3].zero_count += 1;
  LoneController controller(other, "can:vcan7");
  const Outcome outcome = shadow("--link can:vcan7 --for 1");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("drives another robot"), std::string::npos) << outcome.err;
}

TEST_F(ShadowOnCan, EndsWellWhenItIsInterruptedAndSaysWhatItKnowsAndThatTheBusIsGone) {
  OwnVcan bus;
  Spoiler reader(false);
  LoneController controller(generic21(), "can:vcan7", &reader);
  const auto wait_for = [](const std::function<bool()>& there) {
    for (int i = 0; i < 2000 && !there(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_TRUE(there());
  };
  std::thread person([&] {
    wait_for([&] { return reader.first_bad != 0; });
    bus.down();
    wait_for([&] {
      return slurp(folder_ / "shadow.err").find("the link is lost") != std::string::npos;
    });
    EXPECT_EQ(std::system(("kill -TERM $(cat " + (folder_ / "pid").string() + ")").c_str()), 0);
  });
  const Outcome outcome = shell(std::string(VERP_PROGRAM) +
                                    " shadow generic21 --json --link can:vcan7 --patience 60 & "
                                    "echo $! > pid; wait $!",
                                "shadow");
  person.join();
  EXPECT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  EXPECT_GE(json::parse(outcome.out).at("compared_ticks"), 20);
}

// The controller has one SDO server.
TEST_F(ShadowOnCan, OneAloneAsksAController) {
  const link::CanClaim first("vcan0", "watcher", link::CanClaim::kWatcher);
  const Outcome second = shadow("--link can:vcan0 --for 1");
  EXPECT_EQ(second.status, 3);
  EXPECT_NE(second.err.find("another `verp shadow`, or `verp hil`"), std::string::npos)
      << second.err;
  WalkingController controller(generic21(), "");
  const Outcome hil = verp("hil generic21 --bus can --link can:vcan0 --json --for 3", "hil");
  EXPECT_EQ(hil.status, 0) << hil.err;
  EXPECT_NE(hil.err.find("without a check of its own"), std::string::npos) << hil.err;
  EXPECT_EQ(json::parse(hil.out).at("compared_ticks"), 0);
}

TEST_F(ShadowOnCan, SaysThatNobodyIsThere) {
  OwnVcan bus;
  const Outcome outcome = shadow("--link can:vcan7 --patience 0.5");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("no controller was heard for 0.5 s"), std::string::npos)
      << outcome.err;
  const json result = json::parse(outcome.out);
  EXPECT_TRUE(result.at("tick").is_null()) << outcome.out;
  EXPECT_TRUE(result.at("digest").is_null()) << outcome.out;
}

TEST_F(ShadowOnCan, SaysWhichLinksItKnows) {
  expect_refused("shadow generic21 --link nonsense", "nonsense");
  expect_refused("shadow generic21 --bus dxl --link can:vcan0", "name another of its buses");
}

}  // namespace
}  // namespace verp::tool::test
