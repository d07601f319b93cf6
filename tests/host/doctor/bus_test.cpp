#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "common/protocol/feetech.hpp"
#include "common/protocol/feetech_table.hpp"
#include "host/apps/tool/robot/doctor_bus.hpp"
#include "host/os/link/link.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/twin/bus/realtime_server.hpp"
#include "host/twin/bus/servo_device.hpp"
#include "tests/host/bus/fake_plant.hpp"
#include "tests/host/doctor/bus_case.hpp"

namespace verp::tool {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// generic21's servos on a socket, or on a pseudo-terminal whose baud rate they must match.
class BusDoctor : public ::testing::Test {
 protected:
  explicit BusDoctor(const std::string& bus = "") : robot_(generic21("unix:/nowhere", bus)) {
    for (auto& each : plant_.measured)
      each = {.position_count = 2048, .temperature_c = 30, .voltage_v = 12};
    bus_.set_real_time(true);
    for (int j = 0; bus.empty() && j < robot_.params->servo_count(); ++j) {
      set(robot_.params->joint[j].servo_id, dxl::address::kReturnDelay, 0);
    }
  }
  ~BusDoctor() override { stop(); }
  void stop() {
    over_ = true;
    if (thread_.joinable()) thread_.join();
  }

  void set(std::uint8_t id, std::uint16_t address, std::uint8_t value) {
    std::uint8_t frame[32];
    const std::size_t size = dxl::encode_write(frame, sizeof frame, id, address, &value, 1);
    bus_.send(frame, size);
    bus_.let_pass(bus_.now_us() + 5000);
  }
  void unplug(std::initializer_list<int> ids) {
    for (const int each : ids) bus_.set_connected(static_cast<std::uint8_t>(each), false);
  }
  /// A servo with another one's id, which stands elsewhere.
  void add_twin_of(std::uint8_t id) {
    plant_.measured[30].position_count = 1111;
    bus_.add(std::make_unique<bus::ServoDevice>(
        bus::ServoIdentity{.id = id, .baud = robot_.params->baud}, plant_, 30));
    set(id, dxl::address::kReturnDelay, 0);
  }

  /// Serves, and examines over a socket; `baud`: over a pseudo-terminal at that rate.
  Findings examined(std::uint32_t baud = 0) {
    serve(baud == 0 ? "unix-listen:" + path_ : "pty:" + path_);
    robot_.link = baud == 0 ? "unix:" + path_ : "serial:" + path_ + "@" + std::to_string(baud);
    robot_.endpoint = link::parse_endpoint(robot_.link);
    Findings found;
    examine_serial_bus(machine_, robot_, found);
    stop();  // `spoil` may use what its test owns
    return found;
  }
  void serve(const std::string& where) {
    link_ = std::make_unique<link::Link>(link::parse_endpoint(where));
    thread_ = std::thread([this] {
      while (!over_) turn();
    });
  }
  void turn() {
    std::uint8_t heard[512];
    const std::size_t count = link_->read(heard, sizeof heard, 200);
    if (link_->rate() != 0) bus_.set_baud(link_->rate());
    answer_.clear();
    server_.turn(clock_.now_us(), {heard, count}, answer_);
    if (spoil) spoil({heard, heard + count}, answer_);
    if (!answer_.empty()) link_->write(answer_.data(), answer_.size(), 100'000);
  }

  /// Without MODEL; the PC asks each id.
  void forget_robot() {
    robot_.robot.reset();
    robot_.params.reset();
    robot_.model.clear();
    robot_.timeout_us = 25'000;
  }

  BusCase robot_;
  verp::test::FakePlant plant_;
  bus::VirtualBus bus_{*robot_.params, plant_};
  bus::RealtimeServer server_{bus_};
  /// Changes what is answered to what was heard.
  std::function<void(const Bytes& heard, Bytes& answer)> spoil;
  Machine machine_{"/nowhere", {}};
  std::string path_ = (std::filesystem::path(::testing::TempDir()) /
                       (std::string("verp-bus-doctor-") +
                        ::testing::UnitTest::GetInstance()->current_test_info()->name()))
                          .string();

 private:
  link::SystemClock clock_;
  Bytes answer_;
  std::unique_ptr<link::Link> link_;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

TEST_F(BusDoctor, AHealthyBusGivesNoComplaint) {
  const Findings found = examined(2'000'000);
  const cli::Json json = found.json();
  for (const cli::Json& each : json.at("checks")) {
    if (each.at("check") == "latency") continue;  // a busy PC is late
    EXPECT_EQ(each.at("state"), "good") << each;
  }
  expect_finding(found, "good", "24 answer", "");
}

TEST_F(BusDoctor, ItOnlyPingsAndReads) {
  set(14, dxl::address::kReturnDelay, 250);
  dxl::Parser parser;
  std::atomic<int> requests = 0, others = 0;
  spoil = [&](const Bytes& heard, Bytes&) {
    for (const std::uint8_t byte : heard) {
      for (bool more = parser.push(byte); more; more = parser.next()) {
        const auto instruction = parser.packet().instruction;
        const bool reads =
            instruction == dxl::Instruction::kPing || instruction == dxl::Instruction::kRead;
        ++(reads ? requests : others);
      }
    }
  };
  examined();
  EXPECT_GT(requests, 24);
  EXPECT_EQ(others, 0);
}

TEST_F(BusDoctor, TheCommandAnswersInJsonWithItsStatus) {
  serve("pty:" + path_);
  const auto run = [&](const std::string& rate) {
    const std::string out = path_ + ".json";
    const int status = std::system((std::string(VERP_PROGRAM) +
                                    " bus doctor --timeout 250 --json --link serial:" + path_ +
                                    "@" + rate + " >" + out + " 2>/dev/null")
                                       .c_str());
    std::ifstream file(out);
    EXPECT_EQ(cli::Json::parse(file, nullptr, false).at("good"), WEXITSTATUS(status) == 0);
    std::filesystem::remove(out);
    return WEXITSTATUS(status);
  };
  EXPECT_EQ(run("2000000"), 0);
  EXPECT_EQ(run("57600"), 3);
}

TEST_F(BusDoctor, ADeviceThatIsMissingIsNamed) {
  robot_.endpoint = link::parse_endpoint("serial:/dev/ttyNone@1000000");
  Findings found;
  examine_serial_bus(machine_, robot_, found);
  expect_finding(found, "bad", "/dev/ttyNone: no such device", "plug it in, or name another: ");
}

TEST_F(BusDoctor, SilenceAtEveryRateNamesPowerAndWires) {
  spoil = [](const Bytes&, Bytes& answer) { answer.clear(); };
  expect_finding(examined(), "bad", "nothing answers, at any baud rate", "swap A and B");
}

TEST_F(BusDoctor, WhereTheRobotAnswersAtItsOwnRateTheLinkIsToMend) {
  const Findings found = examined(1'000'000);
  expect_finding(found, "bad", "at 2000000 baud and not at 1000000 these answer",
                 "give --link serial:" + path_ + "@2000000");
}

TEST_F(BusDoctor, AServoAtTheFactorysRateIsFound) {
  set(14, dxl::address::kBaudRate, dxl::baud_rate_code(57600));
  expect_finding(examined(2'000'000), "bad",
                 "at 57600 baud and not at 2000000 these answer: ids 14", "--joint l_knee");
}

TEST_F(BusDoctor, AnEchoIsNamed) {
  spoil = [](const Bytes& heard, Bytes& answer) {
    answer.insert(answer.begin(), heard.begin(), heard.end());
  };
  expect_finding(examined(), "bad", "returns the bytes that it sends", "switch its receiver off");
}

TEST_F(BusDoctor, AnEchoAndNoServoIsNamed) {
  spoil = [](const Bytes& heard, Bytes& answer) { answer = heard; };
  expect_finding(examined(), "bad", "only our own bytes come back", "power");
}

TEST_F(BusDoctor, GarbageIsNamed) {
  spoil = [](const Bytes&, Bytes& answer) {
    for (std::uint8_t& each : answer) each = static_cast<std::uint8_t>(each * 7 + 3);
  };
  expect_finding(examined(), "bad", "no packet at any baud rate", "grounds are joined");
}

TEST_F(BusDoctor, NoiseOnAQuietLineIsNamed) {
  spoil = [](const Bytes& heard, Bytes& answer) {
    if (heard.empty() && answer.empty()) answer = {0x80, 0x00};
  };
  expect_finding(examined(), "bad", "bytes came before anything was asked", "swap A and B");
}

TEST_F(BusDoctor, AnotherMasterIsNamedAndNothingIsSent) {
  std::atomic<std::size_t> sent = 0;
  spoil = [&sent](const Bytes& heard, Bytes& answer) {
    sent += heard.size();
    std::uint8_t frame[16];
    answer.assign(frame, frame + dxl::encode_ping(frame, sizeof frame, 3));
  };
  expect_finding(examined(), "bad", "another master talks on this bus", "end it");
  EXPECT_EQ(sent, 0u);
}

TEST_F(BusDoctor, ServosOfProtocol1AreNamed) {
  spoil = [](const Bytes& heard, Bytes& answer) {
    const Bytes ping = {0xFF, 0xFF, 5, 2, 1, 0xF7};
    answer.clear();
    if (heard == ping) answer = {0xFF, 0xFF, 5, 2, 0, 0xF8};
  };
  expect_finding(examined(), "bad", "Protocol 1, and not in Protocol 2", "Protocol Type (13) to 2");
}

TEST_F(BusDoctor, TwoServosWithOneIdAreNamed) {
  add_twin_of(14);
  const Findings found = examined();
  expect_finding(found, "bad", "two servos have id 14",
                 "connect each alone and give it its id: verp bus setup generic21");
  expect_one_bad(found);
}

TEST_F(BusDoctor, WithoutARobotTwoServosWithOneIdAreNamedToo) {
  add_twin_of(14);
  forget_robot();
  const Findings found = examined();
  expect_finding(found, "bad", "two servos have id 14", "connect each alone");
  expect_one_bad(found);
}

TEST_F(BusDoctor, WithoutARobotTwoServosAloneOnTheBusAreNamed) {
  for (const int each : devices_of(robot_)) {
    if (each != 14) unplug({each});
  }
  add_twin_of(14);
  forget_robot();
  expect_finding(examined(), "bad", "two servos have id 14", "connect each alone");
}

class FeetechDoctor : public BusDoctor {
 protected:
  FeetechDoctor() : BusDoctor("feetech") {}
  /// As a new servo has the id of another one until it is set up.
  void give_id(std::uint8_t from, std::uint8_t to) {
    std::uint8_t frame[16];
    bus_.send(frame,
              feetech::encode_write(frame, sizeof frame, from, feetech::address::kId, &to, 1));
    bus_.let_pass(bus_.now_us() + 5000);
  }
};

TEST_F(FeetechDoctor, AHealthyBusGivesNoComplaint) {
  const Findings found = examined();
  expect_finding(found, "good", "24 answer", "");
}

TEST_F(FeetechDoctor, TwoServosWithOneIdAreNamed) {
  give_id(16, 14);
  const Findings found = examined();
  expect_finding(found, "bad", "two servos have id 14",
                 "connect each alone and give it its id: verp bus setup generic21");
  expect_finding(found, "bad", "(id 16) does not answer", "verp bus setup generic21");
}

TEST_F(FeetechDoctor, WithoutARobotTwoServosWithOneIdAreNamedToo) {
  give_id(16, 14);
  forget_robot();
  const Findings found = examined();
  expect_finding(found, "bad", "two servos have id 14", "connect each alone");
  expect_one_bad(found);
}

TEST_F(FeetechDoctor, AServoThatIsSilentIsNoSharedId) {
  unplug({14});
  const Findings found = examined();
  expect_finding(found, "bad", "l_knee (id 14) does not answer", "verp bus setup generic21");
  expect_one_bad(found);
}

TEST_F(BusDoctor, ACableIsNamedWhereALimbFallsSilent) {
  unplug({14, 16, 18});
  const Findings found = examined();
  expect_finding(found, "bad", "l_knee (id 14) and all behind it do not answer",
                 "check the cable between l_hip_pitch (id 12) and l_knee (id 14)");
  expect_one_bad(found);
}

TEST_F(BusDoctor, AWholeLimbThatIsSilentNamesItsFirstCable) {
  unplug({1, 3, 5});
  expect_finding(examined(), "bad", "and all behind it do not answer (3 devices)",
                 "check the cable between the controller and ");
}

TEST_F(BusDoctor, OneServoAmidAnsweringOnesIsNotACable) {
  unplug({14});
  const Findings found = examined();
  expect_finding(found, "bad", "l_knee (id 14) does not answer, and others on its cable do",
                 "verp bus setup generic21 --link unix:");
  expect_one_bad(found);
}

TEST_F(BusDoctor, AWrongModelIsNamed) {
  robot_.params->servo[robot_.params->joint[0].servo_profile].model_number = dxl::kModelMx28;
  expect_finding(examined(), "bad", "is a XM430-W210, the robot's file says MX-28(2.0)",
                 "verp check generic21");
}

TEST_F(BusDoctor, AReturnDelayIsNamed) {
  set(14, dxl::address::kReturnDelay, 250);
  expect_finding(examined(), "advice", "not 0, which wastes time of each tick: 14",
                 "--joint l_knee --wired");
}

TEST_F(BusDoctor, AStatusLevelThatSilencesReadsIsNamed) {
  set(14, dxl::address::kStatusReturnLevel, 0);
  set(12, dxl::address::kStatusReturnLevel, 1);
  expect_finding(examined(), "bad", "not all requests are answered by ids 12 14",
                 "verp bus setup generic21");
}

TEST_F(BusDoctor, AHardwareErrorIsNamed) {
  plant_.measured[0].temperature_c = 95;
  expect_finding(examined(), "bad", "has a hardware error: ", "switch the servo off and on");
}

TEST_F(BusDoctor, LowVoltageIsNamed) {
  for (auto& each : plant_.measured) each.voltage_v = 9.5;
  expect_finding(examined(), "bad", "measures 9.5 V; 9.6 V or more are needed",
                 "charge the battery");
}

TEST_F(BusDoctor, AStrangerIsNamed) {
  add_twin_of(77);
  expect_finding(examined(), "advice", "generic21 has none of that id", "verp bus setup generic21");
}

TEST_F(BusDoctor, WithoutARobotTheFixIsARegister) {
  robot_.robot.reset();
  robot_.params.reset();
  robot_.model.clear();
  set(14, dxl::address::kReturnDelay, 250);
  expect_finding(examined(), "advice", "not 0", " --id 14 --register return_delay_time 0");
}

}  // namespace
}  // namespace verp::tool
