#include <map>

#include "host/trace/record/joint_speeds.hpp"
#include "tests/host/record/sample.hpp"
#include "tests/support/mcap_file.hpp"

namespace verp::record::test {
namespace {

using Channels = TraceFolder;

std::map<std::string, std::vector<std::string>> messages_of(const std::string& bytes) {
  const mcap::WholeFile file = mcap::parse(bytes);
  EXPECT_FALSE(file.flaw);
  std::map<std::string, std::vector<std::string>> all;
  for (const mcap::Message& each : file.messages) {
    all[std::string(file.channels.at(each.channel).topic)].emplace_back(each.data);
  }
  return all;
}

TEST_F(Channels, TellEachTicksGoalsAndGaitAndTheRobot) {
  write_run(folder_ / "run.mcap", 40);
  auto all = messages_of(slurp(folder_ / "run.mcap"));
  EXPECT_EQ(all["/joint_goals"].size(), 40u);
  EXPECT_EQ(all["/joint_states"].size(), 40u);
  const std::string& joints = all["/joint_states"][8];
  const double effort_n_m[] = {0.5, -2};
  EXPECT_TRUE(joints.ends_with({reinterpret_cast<const char*>(effort_n_m), sizeof effort_n_m}));
  ASSERT_EQ(all["/control"].size(), 40u);
  EXPECT_NE(all["/control"][7].find(R"("tick":7,"mode":)"), std::string::npos)
      << all["/control"][7];
  ASSERT_EQ(all["/robot_description"].size(), 1u);
  const auto text = ros::read_string(all["/robot_description"][0]);
  ASSERT_TRUE(text);
  const Params params = sample_params();
  for (int j = 0; j < params.joint_count; ++j) {
    const std::string name(params.joint[j].name, ::strnlen(params.joint[j].name, kNameLength));
    EXPECT_NE(text->find("<joint name=\"" + name + "\""), std::string::npos) << name;
  }
}

TEST(JointSpeeds, AreTheWayBetweenTwoReadingsOverTheirTicks) {
  Params params;
  params.period_us = 10000;
  params.joint_count = 1;
  params.joint[0].counts_per_rad = -100;
  JointSpeeds speeds(params);
  const auto after = [&](std::uint32_t tick, bool fresh, std::int32_t count) {
    Inputs inputs;
    inputs.tick = tick;
    inputs.fresh = fresh ? 1 : 0;
    inputs.position_count[0] = count;
    return speeds.after(inputs)[0];
  };
  EXPECT_EQ(after(1, true, 50), 0);
  EXPECT_NEAR(after(2, true, 51), -1, 1e-9);
  EXPECT_NEAR(after(3, false, 0), -1, 1e-9) << "not read: as before";
  EXPECT_NEAR(after(4, true, 47), 2, 1e-9) << "four counts in two ticks";
}

}  // namespace
}  // namespace verp::record::test
