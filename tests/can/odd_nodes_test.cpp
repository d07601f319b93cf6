#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/protocol/canopen/robot_plan.hpp"
#include "firmware/app/controller_objects.hpp"
#include "host/twin/can/client.hpp"
#include "host/twin/can/device_node.hpp"
#include "tests/can/can_world.hpp"
#include "tests/can/scripted_node.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using canopen::Address;
using nlohmann::json;
using verp::test::ScriptedNode;

constexpr std::uint8_t kNode = 5;
/// Reads of 1000h, 1008h and 1018h:1 to 3.
constexpr unsigned kIdentity = 5;
const std::string kPatience = " --timeout 400";

ScriptedNode::Tells tells(const canopen::Identity& identity) {
  return [identity](Address at) -> std::optional<std::uint32_t> {
    if (at == Address{0x1000, 0}) return identity.device_type;
    if (at == Address{0x1018, 1}) return identity.vendor;
    if (at == Address{0x1018, 2}) return identity.product;
    return 1;
  };
}

class OddNodes : public Program {
 protected:
  Outcome bus_command(const std::string& words) const {
    return verp("bus " + words + " --link can:" + bus.name + kPatience, "bus");
  }
  static void expect_silence(const Outcome& outcome, int id, const ScriptedNode& node) {
    EXPECT_EQ(outcome.status, 3);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    const std::string said = "node " + std::to_string(id) + " does not answer, asked 3 times";
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    EXPECT_EQ(node.unanswered(), unsigned{can::Client::kAttempts}) << "nothing else was asked";
  }

  verp::test::OwnVcan bus;
};

TEST_F(OddNodes, ReadingAllObjectsEndsWhenTheNodeFallsSilentHalfWayThrough) {
  constexpr unsigned kTold = 4;
  const ScriptedNode node(bus.endpoint(), kNode, tells(can::drive_identity(402, kNode)),
                          kIdentity + kTold);
  const Outcome outcome = bus_command("read --id " + std::to_string(kNode));
  expect_silence(outcome, kNode, node);
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), kTold)
      << "what it told before stands: " << outcome.out;
}

TEST_F(OddNodes, ReadingAnArrayEndsWhenTheNodeFallsSilentHalfWayThrough) {
  constexpr std::uint8_t kController = canopen::plan::kControllerNode;
  const ScriptedNode node(bus.endpoint(), kController, tells(app::controller_identity()),
                          kIdentity + 10);
  const Outcome outcome = bus_command("read --register joint_velocity --json");
  expect_silence(outcome, kController, node);
  const json said = json::parse(outcome.out);
  EXPECT_EQ(said.at("exit"), 3);
  EXPECT_FALSE(said.contains("objects")) << "half an array is none: " << said;
}

// 0 is valid: this node's vendor.
TEST_F(OddNodes, ScanSaysNotToldOfObjectsThatANodeDoesNotHave) {
  const ScriptedNode node(bus.endpoint(), kNode, [](Address at) -> std::optional<std::uint32_t> {
    if (at == Address{0x1000, 0}) return 0x00020192;
    if (at == Address{0x1018, 1}) return 0;
    return std::nullopt;
  });
  const Outcome lines = bus_command("scan");
  ASSERT_EQ(lines.status, 0) << lines.err;
  EXPECT_NE(lines.out.find("  5  CiA 402 "), std::string::npos) << lines.out;
  EXPECT_NE(lines.out.find("vendor 0x0  product not told\n"), std::string::npos) << lines.out;
  const Outcome object = bus_command("scan --json");
  ASSERT_EQ(object.status, 0) << object.err;
  const json nodes = json::parse(object.out).at("nodes");
  ASSERT_EQ(nodes.size(), 1u);
  EXPECT_EQ(nodes[0].at("vendor"), 0);
  EXPECT_TRUE(nodes[0].at("product").is_null()) << nodes;
  EXPECT_TRUE(nodes[0].at("revision").is_null()) << nodes;
}

}  // namespace
}  // namespace verp::tool::test
