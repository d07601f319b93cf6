#include <atomic>
#include <deque>
#include <nlohmann/json.hpp>
#include <thread>

#include "firmware/app/operator_device.hpp"
#include "host/os/link/link.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/twin/bus/register_names.hpp"
#include "tests/host/tool/program.hpp"
#include "tests/support/delaying_link.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::tool::test {
namespace {

using Json = nlohmann::json;

class BusCommand : public Program {
 protected:
  explicit BusCommand(const app::OperatorSetup& setup = {})
      : device_(link_, verp::test::kRobot, setup) {
    serving_ = std::thread([this] {
      while (!stop_) {
        if (!device_.poll()) std::this_thread::sleep_for(std::chrono::microseconds(50));
      }
    });
  }
  ~BusCommand() override {
    stop_ = true;
    serving_.join();
  }
  Outcome bus(const std::string& arguments) const {
    return verp("bus " + arguments + " --link unix:" + (folder_ / "port").string());
  }
  Json json(const std::string& arguments) const {
    const Outcome outcome = bus(arguments + " --json");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }
  void refused(const std::string& arguments, int status, const std::string& needle) const {
    const Outcome outcome = bus(arguments);
    EXPECT_EQ(outcome.status, status) << arguments << '\n' << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(needle), std::string::npos) << arguments << '\n' << outcome.err;
  }

 private:
  link::Link link_{link::parse_endpoint("unix-listen:" + (folder_ / "port").string())};
  app::OperatorDevice device_;
  std::atomic<bool> stop_ = false;
  std::thread serving_;
};

TEST_F(BusCommand, ScanAndPingFindTheController) {
  const Json found = json("scan");
  ASSERT_EQ(found["devices"].size(), 1u);
  EXPECT_EQ(found["devices"][0]["id"], 200);
  EXPECT_EQ(found["devices"][0]["name"], "controller");
  EXPECT_EQ(json("ping --id 200"), found["devices"][0]);
  EXPECT_NE(bus("scan").out.find("200  controller"), std::string::npos);
}

class RefusedBrownOut : public BusCommand {
 protected:
  RefusedBrownOut() : BusCommand({.brown_out = app::table::BrownOut::kRefused}) {}
};
class WrittenBrownOut : public BusCommand {
 protected:
  WrittenBrownOut() : BusCommand({.brown_out = app::table::BrownOut::kWritten}) {}
};

TEST_F(RefusedBrownOut, IsToldByPingWithItsCauseAndRemedy) {
  const Outcome outcome = bus("ping");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.out.find("200  controller"), std::string::npos);
  for (const char* words :
       {"refused the brown-out level", "readout protected", "change the chip"}) {
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(json("ping")["id"], 200) << "standard output holds JSON only";
}

TEST_F(WrittenBrownOut, AsksForASecondStart) {
  EXPECT_NE(bus("ping").err.find("reset it and ask again"), std::string::npos);
}

TEST_F(BusCommand, PingIsSilentAboutAGoodStart) {
  EXPECT_EQ(bus("ping").err, "");
}

TEST_F(BusCommand, RegistersAreReadByNameByAddressAndAll) {
  EXPECT_EQ(json("read --register robot_name")["registers"]["robot_name"], "test");
  EXPECT_EQ(json("read --address 48 --size 4")["registers"]["48"], verp::test::kRobot.period_us);
  const Json two = json("read --register joint_count --register present_position");
  EXPECT_EQ(two["registers"]["joint_count"], 21);
  EXPECT_EQ(two["registers"]["present_position"].size(), 32u);
  const Json all = json("read");
  EXPECT_EQ(all["registers"].size(), dxl::controller::kRegisters);
}

TEST_F(BusCommand, NumbersAreReadWithTheirUnits) {
  EXPECT_EQ(bus("write --register walk_vx 300").status, 0);
  const std::string text = bus("read --register walk_vx --register period_us").out;
  EXPECT_NE(text.find("300 x 0.1 mm/s = 30 mm/s\n"), std::string::npos) << text;
  EXPECT_NE(text.find(" us\n"), std::string::npos) << text;
}

TEST_F(BusCommand, WhatIsWrittenCanBeRead) {
  for (const char* value : {"-300", "32767", "0"}) {
    EXPECT_EQ(bus(std::string("write --register walk_vx ") + value).status, 0);
    EXPECT_EQ(json("read --register walk_vx")["registers"]["walk_vx"], std::stoi(value));
  }
  EXPECT_EQ(bus("write --register look_x 0x7f").status, 0);
  EXPECT_EQ(json("read --address 92 --size 2")["registers"]["92"], 127);
}

TEST_F(BusCommand, TroubleIsToldInOneLineWithItsStatus) {
  refused("ping --id 3", 3, "device 3 does not answer");
  refused("read --id 3 --address 0", 3, "did not answer");
  refused("read --register robot_nmae", 2, "did you mean robot_name?");
  refused("write --register tick 1", 2, "read-only");
  refused("write --register request 4", 3, "Data Range");
  refused("write --register request 300", 2, "from 0 to 255");
  refused("write --register request fast", 2, "whole number");
  refused("write --register request 1 1", 2, "1 element");
  refused("write --address 136 --size 4 1", 3, "Access Error");
  refused("read --address 2000", 3, "Access Error");
}

TEST_F(BusCommand, BenchCountsRoundTrips) {
  const Json result = json("bench --for 0.3");
  EXPECT_GT(result["round_trips"], 10);
  EXPECT_GT(result["latency_median_us"], 0);
  EXPECT_LE(result["latency_median_us"], result["latency_p99_us"]);
  EXPECT_LE(result["latency_p99_us"], result["latency_max_us"]);
  EXPECT_NEAR(result["round_trips_per_s"].get<double>() * result["duration_s"].get<double>(),
              result["round_trips"].get<double>(), 1);
  EXPECT_EQ(result["crc_errors"], 0);
  EXPECT_EQ(result["link_losses"], 0);
}

TEST_F(BusCommand, BenchOfNoRegisterSaysSo) {
  refused("bench --address 9999 --for 0.3", 3, "refused the read at address 9999: Access Error");
}

TEST_F(BusCommand, AnInterruptedBenchStillReports) {
  const Outcome outcome = shell(std::string("timeout -s INT --preserve-status 1 ") + VERP_PROGRAM +
                                " bus bench --for 60 --json --link unix:port");
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  const Json result = Json::parse(outcome.out, nullptr, false);
  ASSERT_TRUE(result.is_object()) << outcome.out;
  EXPECT_GT(result["round_trips"], 0);
  EXPECT_LT(result["duration_s"], 30);
}

class BusCable : public BusCommand {
 protected:
  using Cable = verp::test::DelayingLink;
  std::unique_ptr<Cable> cable(const verp::test::Latency& latency) const {
    return std::make_unique<Cable>("unix-listen:" + (folder_ / "late").string(),
                                   "unix:" + (folder_ / "port").string(), latency);
  }
  Outcome late(const std::string& arguments) const {
    return verp("bus " + arguments + " --link unix:" + (folder_ / "late").string());
  }
};

TEST_F(BusCable, LostRepliesAreAskedForAgain) {
  const auto line = cable({});
  for (const char* command : {"ping", "read --register robot_name", "write --register look_x 3"}) {
    for (int lost = 0; lost < 3; ++lost) {
      line->lose_replies(lost);
      const Outcome outcome = late(std::string(command) + " --json");
      ASSERT_EQ(outcome.status, 0) << command << ", " << lost << " lost: " << outcome.err;
      EXPECT_EQ(Json::parse(outcome.out).value("tries", 1), lost + 1) << command;
    }
    line->lose_replies(1);
    EXPECT_NE(late(command).err.find("took 2 tries"), std::string::npos);
  }
  line->lose_replies(3);
  const Outcome silent = late("ping");
  EXPECT_EQ(silent.status, 3);
  EXPECT_NE(silent.err.find("does not answer, asked 3 times"), std::string::npos) << silent.err;
}

using BusLinks = Program;

/// Answers late. Every byte of a register holds its address.
class SlowController {
 public:
  SlowController(const std::string& place, std::uint64_t delay_us)
      : link_(link::parse_endpoint(place)), delay_us_(delay_us) {
    thread_ = std::thread([this] { serve(); });
  }
  ~SlowController() {
    stop_ = true;
    thread_.join();
  }

 private:
  struct Reply {
    std::uint64_t due_us = 0;
    std::vector<std::uint8_t> bytes;
  };

  void serve() {
    while (!stop_) {
      std::uint8_t piece[256];
      const std::size_t count = link_.read(piece, sizeof piece, 1000);
      for (std::size_t i = 0; i < count; ++i) {
        for (bool found = parser_.push(piece[i]); found; found = parser_.next()) answer();
      }
      while (!replies_.empty() && link::monotonic_ns() / 1000 >= replies_.front().due_us) {
        link_.write(replies_.front().bytes.data(), replies_.front().bytes.size(), 100'000);
        replies_.pop_front();
      }
    }
  }
  void answer() {
    const dxl::Packet& packet = parser_.packet();
    std::vector<std::uint8_t> data = {0, 0, 1};
    if (packet.instruction == dxl::Instruction::kPing) {
      dxl::put_u16(data.data(), dxl::controller::kModel);
    } else {
      data.assign(dxl::get_u16(packet.parameters + 2), packet.parameters[0]);
    }
    std::vector<std::uint8_t> frame(128);
    frame.resize(dxl::encode_status(frame.data(), frame.size(), dxl::controller::kDefaultId, 0,
                                    data.data(), data.size()));
    replies_.push_back({link::monotonic_ns() / 1000 + delay_us_, frame});
  }

  link::Link link_;
  std::uint64_t delay_us_;
  dxl::Parser parser_;
  std::deque<Reply> replies_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

// Each reply comes during the next request; all have one length.
TEST_F(BusLinks, LateRepliesAreNotTakenForOthers) {
  const SlowController controller("unix-listen:" + (folder_ / "port").string(), 300'000);
  const Outcome outcome = verp(
      "bus read --register walk_vx --register walk_vy --register walk_wz --timeout 200 "
      "--json --link unix:port");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json result = Json::parse(outcome.out);
  for (const auto& [name, value] : result.at("registers").items()) {
    const auto address =
        static_cast<int>(bus::find_register(dxl::controller::kModel, name)->address);
    EXPECT_EQ(value, address * 0x101) << name;
  }
  EXPECT_GE(result.at("tries"), 2);
}

TEST_F(BusLinks, ThatCannotBeOpenedSayWhy) {
  EXPECT_EQ(verp("bus scan --link unix:/nowhere/port").status, 3);
  EXPECT_EQ(verp("bus scan --link serial:/dev/null").status, 3);
  expect_refused("bus scan --link nonsense", "serial:");
  expect_refused("bus scan", "--link");
  expect_refused("bus", "subcommand");
  const Outcome nobody = verp("bus ping --link pty:port");
  EXPECT_EQ(nobody.status, 3);
  EXPECT_NE(nobody.err.find("port: nobody has opened this port"), std::string::npos) << nobody.err;
  EXPECT_NE(nobody.err.find("give serial:PATH"), std::string::npos);
}

TEST_F(BusLinks, AnIdThatIsNoneIsRefusedWithTheRangeOfItsLink) {
  for (const std::string id : {"-1", "0", "128", "253"}) {
    expect_refused("bus ping --link can:none0 --id " + id, "--id: " + id + " is no node id");
    expect_refused("bus read --link can:none0 --id " + id, "give 1 to 127");
  }
  for (const std::string id : {"-1", "253"}) {
    expect_refused("bus ping --link unix:/nowhere/port --id " + id,
                   "--id: " + id + " is out of range; give 0 to 252");
  }
  EXPECT_EQ(verp("bus ping --link unix:/nowhere/port --id 0").status, 3) << "an id, but no port";
}

TEST_F(BusLinks, AnInterruptEndsALongScan) {
  link::Link silent(link::parse_endpoint("unix-listen:" + (folder_ / "port").string()));
  const Outcome outcome = shell(std::string("timeout -s INT -k 20 1 ") + VERP_PROGRAM +
                                " bus scan --each --timeout 1000 --link unix:port");
  EXPECT_EQ(outcome.status, 124) << "timeout's own: it ended on the interrupt, not killed later";
  EXPECT_EQ(outcome.out, "");
}

}  // namespace
}  // namespace verp::tool::test
