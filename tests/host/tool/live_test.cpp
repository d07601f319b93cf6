#include <signal.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/os/process/child.hpp"
#include "tests/host/live/viewer.hpp"
#include "tests/host/tool/program.hpp"
#include "tests/support/mcap_file.hpp"

namespace verp::tool::test {
namespace {

using live::test::Received;
using live::test::Viewer;
using nlohmann::json;

using Messages = std::map<std::string, std::vector<std::pair<std::uint64_t, std::string>>>;

class Live : public Program {
 protected:
  /// Its streams go to NAME.out and NAME.err.
  process::Child begin(const std::vector<std::string>& words, const std::string& name) const {
    std::vector<std::string> all = {VERP_PROGRAM};
    all.insert(all.end(), words.begin(), words.end());
    return process::Child({.words = all,
                           .input = {},
                           .output = {.file = folder_ / (name + ".out")},
                           .error = process::Stream{.file = folder_ / (name + ".err")},
                           .folder = folder_});
  }
  std::uint16_t port_of(const std::string& name) const {
    const std::string before = "ws://127.0.0.1:";
    for (int i = 0; i < 3000; ++i) {
      const std::string said = slurp(folder_ / (name + ".err"));
      const std::size_t at = said.find(before);
      if (at != std::string::npos && said.find('\n', at) != std::string::npos)
        return static_cast<std::uint16_t>(std::stoi(said.substr(at + before.size())));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    ADD_FAILURE() << "no port was told: " << slurp(folder_ / (name + ".err"));
    return 0;
  }

  /// All channels until the goodbye.
  static Messages watch(std::uint16_t port) {
    const Viewer viewer(port);
    viewer.greet();
    std::map<std::uint32_t, std::string> topics;
    Messages seen;
    for (Received got = viewer.next(); got.opcode >= 0 && got.opcode != 8; got = viewer.next()) {
      if (const auto data = live::test::data_of(got))
        seen[topics.at(data->subscription)].emplace_back(data->time_ns, data->bytes);
      if (got.opcode != 1) continue;
      const json text = json::parse(got.bytes);
      EXPECT_NE(text.at("op"), "status") << got.bytes;
      if (text.at("op") != "advertise") continue;
      json all = json::array();
      for (const json& channel : text.at("channels")) {
        const auto id = channel.at("id").get<std::uint32_t>();
        topics[1000 + id] = channel.at("topic");
        all.push_back({{"id", 1000 + id}, {"channelId", id}});
      }
      viewer.say(json{{"op", "subscribe"}, {"subscriptions", all}}.dump());
    }
    viewer.put(Viewer::frame(8, "\x03\xe9"));
    return seen;
  }

  Messages in_trace(const std::string& name) const {
    const std::string bytes = slurp(folder_ / name);
    const record::mcap::WholeFile file = record::mcap::parse(bytes);
    EXPECT_FALSE(file.flaw.has_value());
    Messages all;
    for (const record::mcap::Message& message : file.messages) {
      const record::mcap::Channel& channel = file.channels.at(message.channel);
      if (channel.encoding != "verp")
        all[std::string(channel.topic)].emplace_back(message.time_ns, message.data);
    }
    return all;
  }
};

TEST_F(Live, AViewerSeesEveryMessageOfTheTraceAndChangesNoBit) {
  const std::vector<std::string> words = {"walk", "--for",  "3",        "--physics-step",
                                          "2",    "--json", "--record", "run.mcap"};
  std::vector<std::string> streamed = words;
  streamed.insert(streamed.end(), {"--live", "0", "--live-wait"});
  process::Child walk = begin(streamed, "live");
  const std::uint16_t port = port_of("live");
  const Outcome second = verp("walk --live " + std::to_string(port));
  EXPECT_EQ(second.status, 3);
  EXPECT_NE(second.err.find("--live " + std::to_string(port) + ": "), std::string::npos)
      << second.err;
  const Viewer deaf(port, 4096);  // without subscriptions
  deaf.greet();
  const Messages seen = watch(port);
  EXPECT_EQ(walk.wait(), 0) << slurp(folder_ / "live.err");
  const Messages recorded = in_trace("run.mcap");
  EXPECT_GE(recorded.size(), 6u);
  for (const auto& [topic, messages] : recorded) {
    ASSERT_TRUE(seen.contains(topic)) << topic;
    EXPECT_TRUE(seen.at(topic) == messages)
        << topic << ": " << seen.at(topic).size() << " of " << messages.size();
  }
  const json result = json::parse(slurp(folder_ / "live.out"));
  EXPECT_EQ(result.at("live").at("dropped"), 0);
  const Outcome alone = verp("walk --for 3 --physics-step 2 --json --record alone.mcap");
  EXPECT_EQ(json::parse(alone.out).at("digest"), result.at("digest"));
  EXPECT_EQ(slurp(folder_ / "alone.mcap").size(), slurp(folder_ / "run.mcap").size());

  process::Child play =
      begin({"trace", "play", "run.mcap", "--rate", "100", "--live", "0", "--live-wait"}, "play");
  const Messages again = watch(port_of("play"));
  EXPECT_EQ(play.wait(), 0) << slurp(folder_ / "play.err");
  EXPECT_TRUE(again == recorded) << "a trace that is played is the run once more";
}

TEST_F(Live, AnInterruptedRunSaysGoodbye) {
  process::Child walk =
      begin({"walk", "--real-time", "--for", "600", "--json", "--live", "0"}, "live");
  Viewer viewer(port_of("live"));
  viewer.greet();
  ASSERT_NE(viewer.next_text(R"("channels":[{"id":1,)"), "") << slurp(folder_ / "live.err");
  viewer.subscribe(1, 1);           // a port is printed before there are channels
  Viewer(port_of("live")).greet();  // leaves at once
  ASSERT_TRUE(live::test::next_data(viewer).has_value());
  walk.tell(SIGINT);
  EXPECT_EQ(viewer.next_text("there is none"), "") << "up to the end";
  viewer.leave();
  EXPECT_EQ(walk.wait(), 130) << slurp(folder_ / "live.err");
  const json result = json::parse(slurp(folder_ / "live.out"));
  EXPECT_TRUE(result.at("interrupted"));
  EXPECT_EQ(result.at("live").at("viewers"), 2);
}

}  // namespace
}  // namespace verp::tool::test
