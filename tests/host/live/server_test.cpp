#include "host/trace/live/server.hpp"

#include <sched.h>

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "tests/host/live/viewer.hpp"

namespace verp::live {
namespace {

using test::Data;
using test::Received;
using test::Viewer;

Channel channel(const std::string& topic) {
  return {.id = 0,
          .topic = topic,
          .encoding = "json",
          .schema_name = "S",
          .schema_encoding = "jsonschema",
          .schema = "{}"};
}

std::vector<Data> read_up_to(const Viewer& viewer, const std::string& last) {
  std::vector<Data> all;
  for (Received got = viewer.next(); got.opcode >= 0; got = viewer.next()) {
    if (const auto data = test::data_of(got)) all.push_back(*data);
    if (!all.empty() && all.back().bytes == last) return all;
  }
  ADD_FAILURE() << "the stream ended before " << last;
  return all;
}

/// One hour.
ServerOptions patient() {
  ServerOptions options;
  options.patience = options.patience_all = std::chrono::hours(1);
  return options;
}

// The robot's loop must not wait for a server thread without processor.
TEST(Live, RunsBeforeOthersWhereTheSystemLetsAThread) {
  const auto urgent_threads = [] {
    int count = 0;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
      const int policy = ::sched_getscheduler(std::stoi(task.path().filename().string()));
      count += policy == SCHED_FIFO ? 1 : 0;
    }
    return count;
  };
  bool allowed = false;
  std::thread([&] {
    const sched_param wanted{.sched_priority = 1};
    allowed = ::sched_setscheduler(0, SCHED_FIFO, &wanted) == 0;
  }).join();
  Server server(0);
  EXPECT_EQ(server.run_before_others(1), allowed);
  EXPECT_EQ(urgent_threads(), allowed ? 1 : 0);
}

TEST(Live, AViewerGetsTheLastMessageAndThenAllInOrder) {
  Server server(0);
  const std::uint32_t a = server.add_channel(channel("/a")), b = server.add_channel(channel("/b"));
  server.send(a, 5, "missed");
  server.send(a, 10, "last");
  const Viewer viewer(server.port());
  EXPECT_NE(viewer.greet().find("Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n"),
            std::string::npos)
      << "the example of RFC 6455, section 1.3";
  EXPECT_NE(viewer.next_text("serverInfo").find(R"("capabilities":["time"])"), std::string::npos);
  const std::string offered = viewer.next_text("advertise");
  EXPECT_NE(offered.find(R"("id":1,"topic":"/a","encoding":"json","schemaName":"S")"),
            std::string::npos)
      << offered;
  EXPECT_NE(offered.find(R"("topic":"/b")"), std::string::npos) << offered;
  viewer.subscribe(70, a);
  server.wait_for_viewer([] { return false; });
  server.send(b, 11, "of another channel");
  const std::uint32_t c = server.add_channel(channel("/c"));
  EXPECT_NE(viewer.next_text("advertise").find(R"("topic":"/c")"), std::string::npos)
      << "a channel that comes later is offered, too";
  viewer.subscribe(71, c);
  viewer.say(R"({"op":"unsubscribe","subscriptionIds":[72]})");
  viewer.next_text("no subscription 72");
  for (std::uint64_t i = 0; i < 100; ++i)
    server.send(i % 2 == 0 ? a : c, 100 + i, std::to_string(i));
  const std::vector<Data> got = read_up_to(viewer, "99");
  ASSERT_EQ(got.size(), 100u);
  for (std::uint64_t i = 0; i < 100; ++i) {
    EXPECT_EQ(got[i].bytes, std::to_string(i));
    EXPECT_EQ(got[i].time_ns, 100 + i);
    EXPECT_EQ(got[i].subscription, i % 2 == 0 ? 70u : 71u);
  }
}

TEST(Live, OnlyTheOldestOfASlowViewerAreLostAndItIsTold) {
  ServerOptions options = patient();
  options.most_bytes = 100'000;
  Server server(0, options);
  const std::uint32_t a = server.add_channel(channel("/a"));
  const Viewer slow(server.port(), 4096), quick(server.port());
  for (const Viewer* each : {&slow, &quick}) {
    each->greet();
    each->subscribe(1, a);
    each->say("{}");
    each->next_text("not understood");  // the subscription is active
  }
  constexpr std::uint64_t kMessages = 3000;
  const std::string rest(10'000, 'x');
  for (std::uint64_t i = 1; i <= kMessages; ++i) {
    server.send(a, i, std::to_string(i) + rest);
    ASSERT_EQ(read_up_to(quick, std::to_string(i) + rest).size(), 1u)
        << "who keeps up loses nothing";
  }
  const std::uint64_t dropped = server.counts().dropped;
  EXPECT_GT(dropped, kMessages / 2) << "the socket's buffers are not so large";
  std::uint64_t before = 0, read = 0, told = 0;
  while (before < kMessages) {
    const Received got = slow.next();
    ASSERT_GE(got.opcode, 0);
    if (got.opcode == 1 && got.bytes.find("messages left out") != std::string::npos) ++told;
    const auto data = test::data_of(got);
    if (!data) continue;
    EXPECT_GT(data->time_ns, before);
    EXPECT_TRUE(data->bytes.ends_with(rest));
    before = data->time_ns;
    ++read;
  }
  EXPECT_EQ(read + dropped, kMessages) << "what is not counted as lost has come";
  EXPECT_GT(told, 0u);
}

TEST(Live, WhoSubscribesToChannelAfterChannelMissesTheBeginningOfNone) {
  Server server(0, patient());
  const std::uint32_t a = server.add_channel(channel("/a")), b = server.add_channel(channel("/b"));
  const Viewer viewer(server.port());
  viewer.greet();
  viewer.subscribe(1, a);
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    viewer.subscribe(2, b);
  });
  server.wait_for_viewer([] { return false; });
  server.send(b, 1, "first");
  server.send(b, 2, "second");
  EXPECT_EQ(read_up_to(viewer, "second").size(), 2u);
  later.join();
}

TEST(Live, RubbishIsAnsweredOrEndsOneConnectionAndTakesNothingFromOthers) {
  Server server(0, patient());
  const std::uint32_t a = server.add_channel(channel("/a"));
  const Viewer good(server.port());
  good.greet();
  good.subscribe(1, a);
  server.wait_for_viewer([] { return false; });
  const std::string no_key = "GET / HTTP/1.1\r\nHost: x\r\n\r\n", head(Viewer::kGreeting);
  const std::string other = std::string(head).replace(head.find("foxglove.websocket.v1"), 21, "x");
  const std::pair<std::string, std::string> greetings[] = {
      {no_key, "HTTP/1.1 426"},
      {other, "HTTP/1.1 400"},
      {"\x16\x03\x01 TLS, perhaps\r\n\r\n", "HTTP/1.1 400"},
      {std::string(9000, 'a'), "HTTP/1.1 400"},
      {std::string("\0\0\0\r\n\r\n", 7), "HTTP/1.1 400"}};
  for (const auto& [words, answer] : greetings)
    EXPECT_TRUE(Viewer(server.port()).greet(words).starts_with(answer)) << words.substr(0, 40);
  Viewer(server.port()).put("GET / HT");  // and closes
  const std::string newer =
      std::string(head).replace(head.find("foxglove.websocket.v1"), 21, "foxglove.sdk.v1");
  EXPECT_NE(Viewer(server.port()).greet(newer).find("Protocol: foxglove.sdk.v1\r\n"),
            std::string::npos)
      << "the protocol's other name";

  const auto spoken = [&](const std::string& bytes) {
    Viewer viewer(server.port());
    viewer.greet();
    viewer.put(bytes);
    return viewer.next_text("\"level\":2");
  };
  const std::pair<std::string, std::string> texts[] = {
      {"", "not understood"},
      {"hello", "not understood"},
      {std::string(60'000, '['), "not understood"},
      {R"({"op":7})", "not understood"},
      {R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})", "32 bits"},
      {R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})", "32 bits"},
      {R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":2}]})", "no channel 2"},
      {R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":0}]})", "no channel 0"},
      {R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1},{"id":2,"channelId":1}]})",
       "subscribed already"},
      {R"({"op":"setParameters"})", "'setParameters' is not offered"}};
  for (const auto& [text, answer] : texts) {
    EXPECT_NE(spoken(Viewer::frame(1, text)).find(answer), std::string::npos) << text.substr(0, 80);
  }
  EXPECT_NE(spoken(Viewer::frame(2, "\x01")).find("not understood"), std::string::npos);

  const std::string no_frames[] = {
      std::string("\x81\x02hi"),                                               // not masked
      std::string("\xf1\x80\0\0\0\0", 6),                                      // reserved bits
      std::string("\x81\xff\x7f\xff\xff\xff\xff\xff\xff\xff\0\0\0\0...", 17),  // endless
      std::string("\x83\x80\0\0\0\0", 6),                                      // an unknown opcode
      Viewer::frame(1, "\xff\xfe")};                                           // not UTF-8
  for (const std::string& bytes : no_frames) EXPECT_EQ(spoken(bytes), "") << "ends it";

  server.send(a, 1, "all the same");
  EXPECT_EQ(read_up_to(good, "all the same").size(), 1u);
  EXPECT_EQ(server.counts().dropped, 0u);
}

/// Asks again while the kernel still takes bytes for those who read nothing. Null: kept out.
std::unique_ptr<Viewer> admitted(const Server& server, std::chrono::seconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < end) {
    auto viewer = std::make_unique<Viewer>(server.port());
    if (viewer->greet().starts_with("HTTP/1.1 101")) return viewer;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return nullptr;
}

// Connected without a word, greeted without a wish, or subscribed and read nothing.
TEST(Live, SilentViewersKeepNobodyOut) {
  ServerOptions options;
  options.patience = std::chrono::milliseconds(50);
  Server server(0, options);
  const std::uint32_t a = server.add_channel(channel("/a"));
  std::vector<std::unique_ptr<Viewer>> silent;
  for (int i = 0; i < 16; ++i) {
    silent.push_back(std::make_unique<Viewer>(server.port(), 4096));
    if (i % 3 == 0) continue;
    silent.back()->greet();
    silent.back()->next_text("advertise");
    if (i % 3 == 1) silent.back()->subscribe(7, a);
  }
  const std::string picture(1 << 20, 'x');
  for (std::uint64_t i = 0; i < 12; ++i) server.send(a, i, picture);
  std::vector<std::unique_ptr<Viewer>> watching;
  for (int i = 0; i < 16; ++i) {
    watching.push_back(admitted(server, std::chrono::seconds(20)));
    ASSERT_TRUE(watching.back()) << i;
    watching.back()->next_text("advertise");
    watching.back()->subscribe(1, a);
    EXPECT_TRUE(next_data(*watching.back())) << i;
  }
  EXPECT_TRUE(Viewer(server.port()).greet().starts_with("HTTP/1.1 503")) << "all of them watch";
}

// Any page may contact this port; browsers report its origin.
TEST(Live, APageOfAStrangerMayNotWatch) {
  ServerOptions options = patient();
  options.origins = {"https://viewer.example"};
  Server server(0, options);
  const auto answer_to = [&](const std::string& origin) {
    const std::string head(Viewer::kGreeting);
    return Viewer(server.port())
        .greet(head.substr(0, head.size() - 2) + "Origin: " + origin + "\r\n\r\n");
  };
  for (const char* own : {"http://localhost:8080", "http://127.0.0.1", "https://[::1]:3000",
                          "https://app.foxglove.dev", "file://", "https://Viewer.example"}) {
    EXPECT_TRUE(answer_to(own).starts_with("HTTP/1.1 101")) << own << ": " << answer_to(own);
  }
  for (const char* other :
       {"https://evil.example", "http://localhost.evil.example", "null", "http://",
        "https://app.foxglove.dev.evil.example", "http://app.foxglove.dev", "http://[::1].evil",
        "https://viewer.example:8443", "http://viewer.example"}) {
    const std::string answer = answer_to(other);
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 403")) << other << ": " << answer;
  }
}

TEST(Live, WhoNeverReadsMayNotSayWithoutEnd) {
  Server server(0, patient());
  const Viewer flood(server.port(), 4096);
  flood.greet();
  flood.lose_patience();
  std::string words;
  for (int i = 0; i < 10'000; ++i) words += Viewer::frame(i % 2 == 0 ? 9 : 1, "");
  bool taken = true;
  for (int i = 0; taken && i < 1000; ++i) taken = flood.put(words);  // 60 MB; TCP holds 10
  EXPECT_FALSE(taken) << "its answers would fill the memory";
}

TEST(Live, AtTheEndEachGetsWhatWaitsAndAGoodbye) {
  Server server(0, patient());
  const std::uint32_t a = server.add_channel(channel("/a"));
  const Viewer viewer(server.port()), silent(server.port());
  viewer.greet();
  viewer.subscribe(1, a);
  server.wait_for_viewer([] { return false; });
  const std::string rest(1'000'000, 'x');
  for (int i = 0; i < 10; ++i) server.send(a, 1, std::to_string(i) + rest);
  std::thread end([&] { server.finish(); });
  EXPECT_EQ(read_up_to(viewer, "9" + rest).size(), 10u);
  Received got = viewer.next();
  while (got.opcode == 2) got = viewer.next();
  EXPECT_EQ(got.opcode, 8);
  EXPECT_EQ(got.bytes, "\x03\xe9the run has ended") << "1001, going away";
  viewer.put(Viewer::frame(8, got.bytes.substr(0, 2)));
  end.join();
  EXPECT_EQ(viewer.next().opcode, -1);
  EXPECT_EQ(server.counts().sent, 10u);
}

TEST(Live, AtTheEndNobodyIsWaitedForWithoutEnd) {
  ServerOptions options;
  options.patience = options.patience_all = std::chrono::milliseconds(1);
  Server server(0, options);
  const std::uint32_t a = server.add_channel(channel("/a"));
  const Viewer deaf(server.port(), 4096), silent(server.port());
  deaf.greet();
  deaf.subscribe(1, a);
  server.wait_for_viewer([] { return false; });
  constexpr std::uint64_t kMessages = 20;
  for (std::uint64_t i = 0; i < kMessages; ++i) server.send(a, i, std::string(1'000'000, 'x'));
  server.finish();
  const Counts counts = server.counts();
  EXPECT_EQ(counts.sent + counts.dropped, kMessages);
  EXPECT_GT(counts.dropped, 0u);
}

TEST(Live, APortThatIsTakenIsNamed) {
  const Server server(0);
  try {
    const Server other(server.port());
    FAIL() << "two on one port";
  } catch (const LiveError& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(server.port())), std::string::npos);
  }
}

}  // namespace
}  // namespace verp::live
