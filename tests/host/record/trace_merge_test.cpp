#include "host/trace/record/trace_merge.hpp"

#include "host/trace/record/ros_frames.hpp"
#include "tests/host/record/sample.hpp"
#include "tests/support/mcap_file.hpp"

namespace verp::record::test {
namespace {

class TraceMerge : public TraceFolder {
 protected:
  void write(const char* name, std::uint32_t ticks) const {
    TraceWriter writer(folder_ / name, sample_params(), {{"seed", name}});
    const ros::BodyPose body{{1, 2, 3}, {0, 0, 0, 1}};
    const ros::ObjectPose ball{"ball", body};
    for (std::uint32_t tick = 0; tick < ticks; ++tick) {
      writer.append(record_of(sample_inputs(tick)), State{}, Outputs{}, &body);
      writer.append(tick, {{ball}});
      if (tick % 10 != 0) continue;
      writer.append("laser", tick, {.frame = "laser", .step_rad = 0.1, .range_m = {1, 2, 3}});
      const std::uint64_t time_ns = std::uint64_t{tick} * 10'000'000;
      writer.append("/eye/image/compressed", ros::kCompressedImage, time_ns,
                    ros::picture({"png", 0, 0, "a file"}, "eye", time_ns));
      writer.append("/eye/depth", ros::kImage, time_ns,
                    ros::picture({"mono16", 3, 2, "twelve bytes"}, "eye", time_ns));
      writer.append("/eye/camera_info", ros::kCameraInfo, time_ns,
                    ros::camera_info({3, 2, 1, 1, 1, 1}, "eye", time_ns));
    }
    writer.close();
  }
};

TEST_F(TraceMerge, KnowsEveryTypeOfMessageByItsDefinition) {
  write("a.mcap", 40);
  const std::string bytes = slurp(folder_ / "a.mcap");
  const mcap::WholeFile file = mcap::parse(bytes);
  std::map<std::string, int> types;
  for (const mcap::Message& each : file.messages) {
    const mcap::Schema& schema = file.schemas.at(file.channels.at(each.channel).schema);
    if (schema.encoding != "ros2msg") continue;
    const ros::Definition definition(schema.data);
    ASSERT_EQ(definition.with_frames(each.data, ""), each.data) << schema.name;
    ++types[std::string(schema.name)];
    for (std::size_t size = 0; size + 4 < each.data.size(); size += 7) {
      EXPECT_FALSE(definition.with_frames(each.data.substr(0, size), "a/")) << schema.name;
    }
  }
  EXPECT_EQ(types.size(), 9u);
}

TEST_F(TraceMerge, RobotsAreToldApartByTopicAndFrame) {
  write("a.mcap", 40);
  write("b.mcap", 60);
  const fs::path both = folder_ / "both.mcap";
  const std::size_t count =
      merge_traces({{"lead", folder_ / "a.mcap"}, {"b", folder_ / "b.mcap"}}, both);
  const std::string bytes = slurp(both);
  const mcap::WholeFile file = mcap::parse(bytes);
  ASSERT_FALSE(file.flaw) << file.flaw->what;
  EXPECT_EQ(file.messages.size(), count);
  std::map<std::string, int> messages;
  std::map<std::string, int> frames;
  std::uint64_t last_ns = 0;
  for (const mcap::Message& each : file.messages) {
    const std::string topic(file.channels.at(each.channel).topic);
    ++messages[topic];
    EXPECT_GE(each.time_ns, last_ns);
    last_ns = each.time_ns;
    if (topic == "/tf" || topic == "/objects") {
      for (const ros::ObjectPose& pose : ros::read_objects(each.data)) ++frames[pose.name];
    }
    if (topic == "/b/robot_description") {
      const std::string urdf = ros::read_string(each.data).value();
      EXPECT_NE(urdf.find("<link name=\"b/l_knee\""), std::string::npos) << urdf;
      EXPECT_NE(urdf.find("<parent link=\"b/body\""), std::string::npos) << urdf;
    }
    if (topic == "/lead/eye/depth") {
      const auto picture = ros::read_image(each.data);
      ASSERT_TRUE(picture);
      EXPECT_EQ(picture->data, "twelve bytes");
    }
  }
  EXPECT_EQ(messages["/lead/joint_states"], 40);
  EXPECT_EQ(messages["/b/joint_states"], 60);
  EXPECT_EQ(messages["/b/verp/tick"], 60);
  EXPECT_EQ(messages["/tf"], 10 + 15);
  EXPECT_EQ(messages["/objects"], 10) << "of the first";
  EXPECT_EQ(frames["ball"], 10);
  EXPECT_EQ(frames["lead/body"], 10);
  EXPECT_EQ(frames["b/l_knee"], 15);
  EXPECT_EQ(frames.count("body"), 0u);
  EXPECT_EQ(file.metadata.at("verp/b").at("seed"), "b.mcap");
  EXPECT_EQ(file.attachments.at("lead/params").data.size(), sizeof(Params));
  try {
    read_trace(both);
    ADD_FAILURE() << "it is no trace";
  } catch (const TraceError& error) {
    EXPECT_NE(std::string(error.what()).find("several robots' traces"), std::string::npos);
  }
}

}  // namespace
}  // namespace verp::record::test
