#include <array>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "host/robot/model/find.hpp"
#include "host/trace/record/team_channel.hpp"
#include "host/trace/record/trace.hpp"
#include "tests/host/tool/program.hpp"
#include "tests/support/mcap_file.hpp"

namespace verp::tool::test {
namespace {

class SensorsRun : public Program {
 protected:
  void write_robot(const std::string& name, const std::string& joint, const std::string& foot,
                   const std::string& elements) const {
    std::string text = slurp(model::find_model("generic21"));
    text.insert(text.find("<verp:body"), elements);
    text.insert(text.find("<sensor name=\"l_foot_front_left\""), foot);
    text.insert(text.find("</joint>", text.find("<child>l_foot</child>")), joint);
    std::ofstream(folder_ / name) << text;
  }
};

struct Message {
  std::uint64_t time_ns = 0, stamp_ns = 0;
  std::string data, type;
};

std::map<std::string, std::vector<Message>> messages_in(const fs::path& trace) {
  const std::string bytes = slurp(trace);
  const record::mcap::WholeFile file = record::mcap::parse(bytes);
  EXPECT_FALSE(file.flaw);
  std::map<std::string, std::vector<Message>> all;
  for (const auto& each : file.messages) {
    const auto& channel = file.channels.at(each.channel);
    const auto& schema = file.schemas.at(channel.schema);
    if (schema.encoding != "ros2msg") continue;
    std::uint32_t stamp[2] = {};
    std::memcpy(stamp, each.data.data() + 4, std::min<std::size_t>(8, each.data.size() - 4));
    all[std::string(channel.topic)].push_back({each.time_ns,
                                               std::uint64_t{stamp[0]} * 1'000'000'000 + stamp[1],
                                               std::string(each.data), std::string(schema.name)});
    const record::TeamChannel named("a", channel.topic, schema);
    EXPECT_TRUE(named.message(each.data)) << channel.topic;
  }
  return all;
}

TEST_F(SensorsRun, AreRecordedEachOnItsChannelAndChangeNoBitOfTheRun) {
  write_robot("seeing.sdf",
              "<sensor name=\"ankle\" type=\"force_torque\"><update_rate>50</update_rate>"
              "<force_torque/></sensor>",
              "<sensor name=\"sole\" type=\"contact\"><update_rate>20</update_rate>"
              "<topic>sole</topic><contact><collision>l_foot_box</collision></contact></sensor>",
              "<verp:truth name=\"truth\" link=\"trunk\" rate_hz=\"25\"/>"
              "<verp:latency sensor=\"ankle\" s=\"0.04\"/>"
              "<verp:latency sensor=\"laser\" s=\"0.05\"/>");
  write_robot("blind.sdf", "", "", "");
  const Outcome seeing = verp("walk seeing.sdf --for 4 --record seeing.mcap --json", "seeing");
  const Outcome blind = verp("walk blind.sdf --for 4 --record blind.mcap --json", "blind");
  ASSERT_EQ(seeing.status, 0) << seeing.err;
  ASSERT_EQ(blind.status, 0) << blind.err;
  EXPECT_EQ(nlohmann::json::parse(seeing.out).at("digest"),
            nlohmann::json::parse(blind.out).at("digest"));

  auto seen = messages_in(folder_ / "seeing.mcap");
  const auto other = messages_in(folder_ / "blind.mcap");
  for (const char* topic : {"/ankle", "/sole", "/truth"}) EXPECT_FALSE(other.contains(topic));
  ASSERT_FALSE(seen["/ankle"].empty());
  EXPECT_EQ(seen["/ankle"][0].type, "geometry_msgs/msg/WrenchStamped");
  EXPECT_EQ(seen["/sole"].at(0).type, "ros_gz_interfaces/msg/Contacts");
  EXPECT_EQ(seen["/truth"].at(0).type, "nav_msgs/msg/Odometry");
  const record::Trace trace = record::read_trace(folder_ / "seeing.mcap", record::Read::kStrict);
  const double run_s = static_cast<double>(trace.ticks.size()) * trace.period_s();
  EXPECT_NEAR(static_cast<double>(seen["/ankle"].size()), 50 * (run_s - 0.04), 2);
  EXPECT_NEAR(static_cast<double>(seen["/sole"].size()), 20 * run_s, 2);
  EXPECT_NEAR(static_cast<double>(seen["/truth"].size()), 25 * run_s, 2);

  // Stamped when measured, logged when available.
  const auto expect_late = [&](const char* topic, double from_s, double to_s) {
    for (const Message& each : seen[topic]) {
      EXPECT_GE(1e-9 * static_cast<double>(each.time_ns - each.stamp_ns), from_s) << topic;
      EXPECT_LT(1e-9 * static_cast<double>(each.time_ns - each.stamp_ns), to_s) << topic;
    }
  };
  expect_late("/ankle", 0.04, 0.0501);
  expect_late("/laser", 0.05, 0.0601);
  expect_late("/truth", 0, 0.0101);

  ASSERT_FALSE(trace.bodies.empty());
  const record::ros::BodyPose last = trace.bodies.back().pose;
  const std::string& told = seen["/truth"].back().data;
  constexpr std::size_t kPosition = 36;  // after the stamp, "world" and "truth"
  std::array<double, 3> position{};
  ASSERT_GE(told.size(), kPosition + sizeof position);
  std::memcpy(position.data(), told.data() + kPosition, sizeof position);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(position[i], last.position_m[i], 0.005) << i;
}

TEST_F(SensorsRun, TheImusLatencyChangesTheRunAsItShould) {
  std::string text = slurp(model::find_model("generic21"));
  text.insert(text.find("<verp:imu ") + 10, "latency_s=\"0.02\" ");
  std::ofstream(folder_ / "late.sdf") << text;
  const Outcome late = verp("walk late.sdf --for 3 --json", "late");
  const Outcome prompt = verp("walk generic21 --for 3 --json", "prompt");
  EXPECT_NE(nlohmann::json::parse(late.out).at("digest"),
            nlohmann::json::parse(prompt.out).at("digest"));
  EXPECT_NE(verp("check late.sdf", "check").out.find("(20 ms late)"), std::string::npos);
}

TEST_F(SensorsRun, WrongOnesCostOneLine) {
  write_robot("wrong.sdf", "", "", "<verp:latency sensor=\"camera\" s=\"-1\"/>");
  expect_refused("check wrong.sdf", "wrong.sdf:");
  expect_refused("bus camera --size 3", "WIDTHxHEIGHT");
  const Outcome none = verp("bus camera --device /dev/video-none", "none");
  EXPECT_EQ(none.status, 3) << none.err;
  EXPECT_NE(none.err.find("/dev/video-none: no such device"), std::string::npos) << none.err;
  const Outcome file = verp("bus camera --device wrong.sdf", "file");
  EXPECT_EQ(file.status, 3) << file.err;
  EXPECT_NE(file.err.find("wrong.sdf: is no camera"), std::string::npos) << file.err;
}

}  // namespace
}  // namespace verp::tool::test
