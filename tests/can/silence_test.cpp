#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "common/protocol/canopen/sdo.hpp"
#include "tests/can/can_world.hpp"
#include "tests/can/serial_adapter.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using canopen::Address;
using nlohmann::json;

class Nodes {
 public:
  using Rule = std::function<bool(unsigned node, Address at)>;
  Nodes(const std::string& link, Rule answers)
      : port_(link::parse_endpoint(link)), answers_(std::move(answers)) {
    thread_ = std::thread([this] {
      for (CanFrame frame; !over_;) {
        if (port_.await(frame, 20'000)) take(frame);
      }
    });
  }
  ~Nodes() {
    over_ = true;
    thread_.join();
  }

 private:
  void take(const CanFrame& frame) {
    namespace sdo = canopen::sdo;
    const unsigned node = frame.id - 0x600;
    if (node != 5 && node != 19 && node != 30) return;
    if (sdo::specifier_of(frame) != sdo::request::kUpload) return;
    const Address at = sdo::address_of(frame);
    if (!answers_(node, at)) return;
    const auto whole = sdo::command(sdo::response::kUpload, sdo::kExpedited | sdo::kSizeGiven);
    const std::uint32_t value = at.index == 0x1000 ? 0x20192 : 0x41424344;
    port_.send(sdo::addressed(0x580 + node, whole, at, value));
  }

  link::CanPort port_;
  Rule answers_;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

class SilenceOnCan : public Program {
 protected:
  const verp::test::OwnVcan bus;
  const std::string link = " --link can:" + bus.name;
  static bool all_but_19(unsigned node, Address at) { return node != 19 || at.index == 0x1000; }
};

TEST_F(SilenceOnCan, AScanListsANodeThatFellSilentAndFails) {
  const Nodes nodes("can:" + bus.name, all_but_19);
  const Outcome text = verp("bus scan" + link);
  EXPECT_EQ(text.status, 3);
  EXPECT_TRUE(says(text.out, " 19  CiA 402                   type 0x00020192  fell silent"))
      << text.out;
  EXPECT_EQ(std::count(text.out.begin(), text.out.end(), '\n'), 3) << text.out;
  EXPECT_TRUE(says(text.err, "1 of 3 nodes answered, then fell silent")) << text.err;
  EXPECT_FALSE(says(text.out + text.err, "not told"));
  EXPECT_FALSE(says(text.err, "no node answers"));
  const Outcome outcome = verp("bus scan --json" + link);
  EXPECT_EQ(outcome.status, 3);
  const json found = json::parse(outcome.out).at("nodes");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[1].at("id"), 19);
  EXPECT_EQ(found[1].at("trouble"), "fell silent while it was asked");
  EXPECT_FALSE(found[0].contains("trouble"));
}

TEST_F(SilenceOnCan, AScanOfNodesThatAllFellSilentDoesNotSayThatNobodyAnswers) {
  const Nodes nodes("can:" + bus.name, [](unsigned, Address at) { return at.index == 0x1000; });
  const Outcome outcome = verp("bus scan" + link);
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 3) << outcome.out;
  EXPECT_TRUE(says(outcome.err, "3 of 3 nodes")) << outcome.err;
  EXPECT_FALSE(says(outcome.err, "no node answers")) << outcome.err;
}

TEST_F(SilenceOnCan, TheDoctorNamesANodeThatFellSilent) {
  const Nodes nodes("can:" + bus.name, all_but_19);
  const Outcome outcome = verp("bus doctor" + link);
  EXPECT_EQ(outcome.status, 3);
  EXPECT_TRUE(says(outcome.out, "id 19 answered, then fell silent")) << outcome.out;
  EXPECT_FALSE(says(outcome.out, "id 5 answered")) << outcome.out;
}

TEST_F(SilenceOnCan, APingOfANodeThatFellSilentSaysSo) {
  const Nodes nodes("can:" + bus.name, all_but_19);
  const Outcome outcome = verp("bus ping --id 19" + link);
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(says(outcome.err, "node 19 answered, then fell silent")) << outcome.err;
  EXPECT_TRUE(says(outcome.err, "raise --timeout")) << outcome.err;
}

// It waits nine seconds for 30, from 4.5 s on.
TEST_F(SilenceOnCan, AnInterruptedScanPrintsWhatItFoundSoFar) {
  const Nodes nodes("can:" + bus.name,
                    [](unsigned node, Address at) { return node != 30 || at.index == 0x1000; });
  const Outcome outcome = shell(std::string("timeout -s INT --preserve-status -k 20 9 ") +
                                VERP_PROGRAM + " bus scan --timeout 3000" + link);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "  5  DCBA")) << outcome.out;
  EXPECT_TRUE(says(outcome.out, " 30  CiA 402                   type 0x00020192  not asked"))
      << outcome.out;
  EXPECT_TRUE(says(outcome.err, "interrupted")) << outcome.err;
}

/// With half the robot's bit rate.
class SlowAdapter : public verp::test::SerialAdapter {
 public:
  SlowAdapter() {
    reader_ = std::thread([this] { read_on(); });
    verp::test::ip("link set " + name + " type can bitrate 500000");
    verp::test::ip("link set " + name + " up");
  }
  ~SlowAdapter() {
    over_ = true;
    reader_.join();
  }

 private:
  void read_on() const {
    char piece[64];
    while (!over_) {
      pollfd one{end, POLLIN, 0};
      if (::poll(&one, 1, 50) == 1 && ::read(end, piece, sizeof piece) <= 0) return;
    }
  }

  std::atomic<bool> over_ = false;
  std::thread reader_;
};

TEST_F(SilenceOnCan, AnInterfaceWithAnotherBitRateThanTheRobotIsRefused) {
  const SlowAdapter adapter;
  for (const std::string command : {"run generic21 --yes", "hil generic21", "shadow generic21"}) {
    const Outcome outcome =
        shell("timeout 20 " VERP_PROGRAM " " + command + " --bus can --link can:" + adapter.name);
    EXPECT_EQ(outcome.status, 2) << command << ": " << outcome.err;
    EXPECT_TRUE(says(outcome.err, adapter.name + " runs at 500000 bit/s, the bus of generic21 at "
                                                 "1000000; ip link set "))
        << command << ": " << outcome.err;
  }
}

}  // namespace
}  // namespace verp::tool::test
