#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "host/trace/record/replay.hpp"
#include "host/trace/record/ros_radio.hpp"
#include "tests/host/demos/told.hpp"
#include "tests/support/mcap_file.hpp"

namespace verp::demos {
namespace {

namespace fs = std::filesystem;
using record::ros::Radio;

struct Folder {
  Folder() : path(fs::path(testing::TempDir()) / ("demos" + std::to_string(::getpid()))) {
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  fs::path path;
};

const Demo& follow() {
  const auto& demos = all_demos();
  return *std::find_if(demos.begin(), demos.end(),
                       [](const Demo& each) { return each.name == "follow"; });
}

std::vector<Radio> radio_of(const fs::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  const std::string text = bytes.str();
  const record::mcap::WholeFile trace = record::mcap::parse(text);
  std::uint16_t channel = 0;
  std::vector<Radio> out;
  if (trace.find_channel("/radio", channel) == nullptr) return out;
  for (const record::mcap::Message& message : trace.messages) {
    if (message.channel != channel) continue;
    const auto radio = record::ros::read_radio(message.data);
    EXPECT_TRUE(radio.has_value());
    if (!radio) continue;
    EXPECT_EQ(message.time_ns, std::uint64_t{10'000'000} * radio->tick);  // periods of 10 ms
    out.push_back(*radio);
  }
  return out;
}

TEST(Trace, OfADemoReplaysAndHasWhatWasSaid) {
  const Folder folder;
  Options options;
  options.robots = 2;
  options.for_s = 7;
  options.seed = 3;
  options.record = folder.path / "a.mcap";
  const demos::Run recorded = run(follow(), options);
  options.record.clear();
  const demos::Run again = run(follow(), options);
  options.radio.loss = 0.9;
  const demos::Run deaf = run(follow(), options);
  ASSERT_EQ(recorded.robots.size(), 2u);
  EXPECT_NE(recorded.robots[1].digest, deaf.robots[1].digest);
  std::map<std::int32_t, Radio> said;
  for (std::size_t i = 0; i < 2; ++i) {
    const Track& track = recorded.robots[i];
    EXPECT_EQ(track.digest, again.robots[i].digest);
    EXPECT_EQ(track.trace.filename(), "a." + track.name + ".mcap");
    const record::Trace trace = record::read_trace(track.trace);
    const record::ReplayResult replayed = record::replay(trace);
    EXPECT_FALSE(replayed.divergence.has_value());
    EXPECT_EQ(replayed.replayed_digest, track.digest);
    EXPECT_GT(replayed.ticks, 600u);
    for (const Radio& radio : radio_of(track.trace)) {
      if (radio.event != "said") continue;
      EXPECT_EQ(radio.from, static_cast<int>(i));
      EXPECT_TRUE(said.emplace(radio.number, radio).second) << "said twice";
    }
  }
  EXPECT_EQ(said.size(), recorded.radio.sent);
  std::size_t heard = 0;
  for (const Track& track : recorded.robots) {
    for (const Radio& radio : radio_of(track.trace)) {
      if (radio.event != "heard") continue;
      ++heard;
      ASSERT_TRUE(said.contains(radio.number));
      EXPECT_EQ(radio.data, said[radio.number].data);
      EXPECT_EQ(radio.from, said[radio.number].from);
      EXPECT_GT(radio.tick, said[radio.number].tick);
    }
  }
  const auto count = recorded.radio.fates[static_cast<std::size_t>(radio::Fate::kHeard)];
  EXPECT_GT(heard, 20u);
  EXPECT_LE(heard, count);
  EXPECT_GE(heard + 2, count);
}

TEST(Demos, RefuseANumberOfRobotsThatTheyHaveNoUseFor) {
  Options options;
  options.robots = 1;
  EXPECT_THROW(run(follow(), options), std::invalid_argument);
  options.robots = 9;
  EXPECT_THROW(run(follow(), options), std::invalid_argument);
}

}  // namespace
}  // namespace verp::demos
