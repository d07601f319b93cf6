#include "host/trace/live/robot_stream.hpp"

#include "host/trace/record/trace.hpp"
#include "host/trace/record/trace_writer.hpp"
#include "tests/host/live/viewer.hpp"
#include "tests/host/record/sample.hpp"

namespace verp::live {
namespace {

using record::TraceWriter;
using test::Viewer;

void run(record::mcap::Listener* listener) {
  const Params params = record::test::sample_params();
  TraceWriter writer("", params, {}, {.listener = listener});
  const record::ros::BodyPose body{};
  const record::ros::ObjectPose ball{.name = "ball", .pose = {}};
  for (std::uint32_t tick = 1; tick <= 3; ++tick) {
    writer.append(record::test::record_of(record::test::sample_inputs(tick)), State{}, Outputs{},
                  &body);
    writer.append(tick, std::span(&ball, 1));
  }
  writer.close();
}

std::vector<std::string> topics(const Server& server, int count) {
  const Viewer viewer(server.port());
  viewer.greet();
  const std::string offered = viewer.next_text("advertise");
  std::vector<std::string> all;
  for (std::size_t at = 0; count > 0; --count) {
    at = offered.find("\"topic\":\"", at);
    if (at == std::string::npos) break;
    at += 9;
    all.push_back(offered.substr(at, offered.find('"', at) - at));
  }
  return all;
}

TEST(RobotStream, ARobotAloneHasTheTopicsOfItsTrace) {
  Server server(0);
  RobotStream robot(server);
  run(&robot);
  EXPECT_EQ(topics(server, 99),
            (std::vector<std::string>{"/joint_states", "/imu", "/tf", "/joint_goals", "/control",
                                      "/odom", "/robot_description", "/objects"}))
      << "and none in an encoding that only `verp replay` reads";
}

TEST(RobotStream, SeveralHaveNamesAndOneWorld) {
  Server server(0);
  RobotStream lead(server, "lead"), other(server, "other");
  run(&lead);
  run(&other);
  EXPECT_EQ(
      topics(server, 99),
      (std::vector<std::string>{
          "/lead/joint_states", "/lead/imu", "/tf", "/lead/joint_goals", "/lead/control",
          "/lead/odom", "/lead/robot_description", "/objects", "/other/joint_states", "/other/imu",
          "/other/joint_goals", "/other/control", "/other/odom", "/other/robot_description"}));
  const Viewer viewer(server.port());
  viewer.greet();
  viewer.subscribe(5, *server.find_channel("/other/imu"));
  const auto imu = test::next_data(viewer);
  ASSERT_TRUE(imu.has_value());
  EXPECT_EQ(imu->time_ns, 3u * record::test::sample_params().period_us * 1000);
  EXPECT_NE(imu->bytes.find("other/"), std::string::npos) << "its frame has its name";
}

}  // namespace
}  // namespace verp::live
