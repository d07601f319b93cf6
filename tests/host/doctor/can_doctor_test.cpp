#include <gtest/gtest.h>

#include <deque>

#include "common/protocol/canopen/sync.hpp"
#include "host/apps/tool/robot/doctor_bus.hpp"
#include "host/twin/can/virtual_can.hpp"
#include "tests/host/bus/fake_plant.hpp"
#include "tests/host/doctor/bus_case.hpp"

namespace verp::tool {
namespace {

/// The twin's nodes in simulated time. `first`: what others send before we ask.
class Nodes final : public can::ClientBus {
 public:
  explicit Nodes(const Params& params) : bus_(params, plant_) { bus_.set_real_time(true); }
  bool send(const CanFrame& frame) override {
    ++sent;
    const int command = frame.data[0] >> 5;  // CiA 301: 2, 3 an upload, 4 an abort
    EXPECT_TRUE(frame.id > 0x600 && command >= 2 && command <= 4) << "it only reads";
    return bus_.send(frame);
  }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    if (first.empty()) return bus_.poll(frame, timeout_us);
    frame = first.front();
    first.pop_front();
    return true;
  }
  std::uint64_t now_us() override { return bus_.now_us(); }
  hal::CanErrors errors() const override { return {}; }
  bool connected() const override { return true; }
  void unplug(int id) { bus_.set_connected(static_cast<std::uint8_t>(id), false); }

  std::deque<CanFrame> first;
  int sent = 0;

 private:
  verp::test::FakePlant plant_;
  can::VirtualCan bus_;
};

class CanDoctor : public ::testing::Test {
 protected:
  Findings examined() {
    Findings found;
    can::Client client(nodes_, robot_.link, robot_.timeout_us);
    examine_nodes(nodes_, client, robot_, found);
    return found;
  }
  void send_syncs(std::initializer_list<std::uint8_t> counters) {
    for (const std::uint8_t each : counters) nodes_.first.push_back(canopen::sync_frame(each));
  }
  BusCase robot_ = generic21("can:can0", "can");
  Nodes nodes_{*robot_.params};
};

TEST_F(CanDoctor, AHealthyBusGivesNoComplaint) {
  const Findings found = examined();
  EXPECT_EQ(found.size(), 1u) << found.text();
  expect_finding(found, "good", " answer", "");
}

TEST_F(CanDoctor, SilenceNamesPowerRateAndTermination) {
  for (const int each : devices_of(robot_)) nodes_.unplug(each);
  expect_finding(examined(), "bad", "no node answers", "120 ohm at both ends");
}

TEST_F(CanDoctor, AMissingNodeIsNamedWithItsCable) {
  for (const int each : {14, 16, 18}) nodes_.unplug(each);
  expect_finding(examined(), "bad", "l_knee (id 14) and all behind it",
                 "check the cable between l_hip_pitch (id 12) and l_knee");
}

TEST_F(CanDoctor, AnotherProductIsNamed) {
  robot_.params->servo[robot_.params->joint[0].servo_profile].model_number = 7;
  expect_finding(examined(), "bad", "is no drive of product 7", "its type in the robot's file");
}

TEST_F(CanDoctor, AnotherMasterIsNamedAndNothingIsSent) {
  send_syncs({1, 2, 3, 4, 5, 1, 2, 3});
  expect_finding(examined(), "bad", "another master commands this bus (identifier 0x080)",
                 "end it");
  EXPECT_EQ(nodes_.sent, 0);
}

TEST_F(CanDoctor, TwoMastersAreNamed) {
  send_syncs({1, 3, 2, 4, 3, 5});
  expect_finding(examined(), "bad", "two masters send SYNC", "end one");
}

TEST_F(CanDoctor, AnInterfaceThatIsMissingDownOrTooFastIsNamed) {
  Machine machine("/nowhere", {});
  Findings found;
  machine.interfaces = [] { return std::vector<link::CanInterface>{}; };
  examine_can_bus(machine, robot_, found);
  machine.interfaces = [] {
    return std::vector<link::CanInterface>{{.name = "can0", .is_can = true}};
  };
  examine_can_bus(machine, robot_, found);
  machine.interfaces = [] {
    return std::vector<link::CanInterface>{{.name = "can0",
                                            .is_can = true,
                                            .up = true,
                                            .bitrate = 250000,
                                            .restart_ms = 100,
                                            .send_errors = 128}};
  };
  examine_can_bus(machine, robot_, found);
  expect_finding(found, "bad", "no such interface", "is the adapter plugged in?");
  expect_finding(found, "bad", "the interface is down", "sudo ip link set can0 up");
  expect_finding(found, "bad", "can0 runs at 250000 bit/s", "type can bitrate 1000000");
  expect_finding(found, "bad", "128 errors of sending", "120 ohm");
}

}  // namespace
}  // namespace verp::tool
