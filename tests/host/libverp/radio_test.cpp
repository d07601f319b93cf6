#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "host/apps/libverp/verp.hpp"
#include "host/trace/record/ros_radio.hpp"
#include "tests/host/libverp/expect_error.hpp"
#include "tests/host/libverp/opened.hpp"
#include "tests/support/mcap_file.hpp"

namespace verp::abi::test {
namespace {

verp_lib::Session pair_of(double apart_m, const verp_radio& radio, const char* trace = nullptr) {
  verp_lib::Session session;
  verp_robot robot = verp_lib::Session::defaults();
  robot.walk_s = 3;
  session.add(robot);
  robot.y_m = apart_m;
  robot.record = trace;
  session.add(robot);
  session.radio(radio);
  session.tick(2);
  return session;
}

verp_radio quiet() {
  verp_radio radio = verp_lib::Session::radio_defaults();
  radio.loss = radio.fade = radio.jitter_s = 0;
  return radio;
}

/// By event.
std::map<std::string, int> kept(const std::string& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  const std::string text = bytes.str();
  const record::mcap::WholeFile trace = record::mcap::parse(text);
  std::uint16_t channel = 0;
  std::map<std::string, int> events;
  if (trace.find_channel("/radio", channel) == nullptr) return events;
  for (const record::mcap::Message& message : trace.messages) {
    if (message.channel != channel) continue;
    const auto radio = record::ros::read_radio(message.data);
    EXPECT_TRUE(radio);
    if (radio) ++events[radio->event];
  }
  return events;
}

int heard(verp_lib::Session& session, std::uint32_t robot) {
  int count = 0;
  while (session.take(robot)) ++count;
  return count;
}

TEST(LibverpRadio, AMessageComesAfterItsDelayFromWhoSaidIt) {
  verp_radio radio = quiet();
  radio.delay_s = 0.1;
  const std::string said("\0 bytes, not text", 17);
  for (const std::uint32_t from : {0U, 1U}) {
    SCOPED_TRACE(from);
    const std::uint32_t to = 1 - from;
    verp_lib::Session session = pair_of(2, radio);
    ASSERT_TRUE(session.send(from, said, static_cast<int>(to)));
    const double said_s = session.seen(to).time_s;
    std::optional<verp_lib::Session::Message> message;
    while (!message && session.tick()) message = session.take(to);
    ASSERT_TRUE(message);
    EXPECT_EQ(message->from, from);
    EXPECT_EQ(message->data, said);
    EXPECT_GT(session.seen(to).time_s - said_s, 0.099);
    EXPECT_LT(session.seen(to).time_s - said_s, 0.125);
    EXPECT_FALSE(session.take(from)) << "nobody hears himself";
  }
}

TEST(LibverpRadio, BeyondTheRangeNothingIsHeardAndLossIsAShare) {
  verp_radio radio = quiet();
  radio.range_m = 5;
  radio.loss = 0.4;
  for (const double apart_m : {1.0, 6.0}) {
    verp_lib::Session session = pair_of(apart_m, radio);
    int said = 0, came = 0;
    while (session.tick(4)) said += session.send(0, "x"), came += heard(session, 1);
    EXPECT_GT(said, 200);
    const double share = apart_m > radio.range_m ? 0 : 0.6;
    EXPECT_NEAR(1.0 * came / said, share, 0.2 * share) << apart_m;
  }
}

TEST(LibverpRadio, EqualRunsHearEqualAndTheirTraceReplays) {
  std::vector<std::string> runs;
  for (int run = 0; run < 2; ++run) {
    const std::string trace = testing::TempDir() + "radio-" + std::to_string(getpid()) + ".mcap";
    std::uint64_t digest = 0;
    int said = 0, came = 0;  // of robot 1
    {
      verp_lib::Session session = pair_of(2, verp_lib::Session::radio_defaults(), trace.c_str());
      std::string all;
      const auto take_all = [&] {
        for (std::uint32_t robot : {0U, 1U}) {
          while (const auto message = session.take(robot)) {
            all += message->data + ";";
            came += static_cast<int>(robot);
          }
        }
      };
      for (int i = 0; session.tick(5); ++i) {
        session.send(0, std::to_string(i));
        said += session.send(1, "and " + std::to_string(i), 0);
        take_all();
      }
      take_all();  // the last ticks
      runs.push_back(all);
      digest = session.result(1).digest;
    }
    EXPECT_EQ(verp_lib::replay(trace).digest, digest);
    EXPECT_EQ(kept(trace), (std::map<std::string, int>{{"heard", came}, {"said", said}}));
    std::remove(trace.c_str());
  }
  EXPECT_GT(runs[0].size(), 500U);
  EXPECT_EQ(runs[0], runs[1]);
}

/// Each sends how many messages it has heard.
TEST(LibverpRadio, ControllersTalkInsideTheirTicks) {
  struct Talker {
    verp_session session;
    std::string heard = {};
    int count = 0, wrong = 0;
    std::string why = {};
  };
  const auto controller = [](const verp_moment* moment, void* user) {
    auto* const told = static_cast<Talker*>(user);
    char data[96];
    std::uint64_t size = 0;
    std::uint32_t from = 9;
    int status = VERP_OK;
    while ((status = verp_session_take(told->session, moment->robot, data, sizeof data, &size,
                                       &from)) == VERP_OK) {
      told->heard += std::string(data, size) + ";";
      told->wrong += from == moment->robot;
      ++told->count;
    }
    if (status != VERP_NO_MESSAGE && told->wrong++ == 0) told->why = verp_last_error();
    const std::string says = std::to_string(told->count);
    if (moment->inputs->tick % 3 == 0)
      told->wrong += verp_session_send(told->session, moment->robot, VERP_EVERYBODY, says.data(),
                                       says.size()) != VERP_OK;
    return verp_decide(moment->token);
  };
  constexpr std::uint32_t kTicks = 600;
  std::vector<std::string> runs;
  std::vector<std::uint64_t> digests;
  for (const std::uint32_t at_once : {1U, 100U}) {
    verp_lib::Session session = pair_of(2, verp_lib::Session::radio_defaults());
    Talker talkers[2] = {{.session = session.handle()}, {.session = session.handle()}};
    for (const std::uint32_t robot : {0U, 1U})
      ASSERT_EQ(verp_session_control(session.handle(), robot, controller, &talkers[robot]),
                VERP_OK);
    for (std::uint32_t done = 0; done < kTicks; done += at_once) session.tick(at_once);
    EXPECT_EQ(talkers[0].wrong + talkers[1].wrong, 0) << talkers[0].why;
    runs.push_back(talkers[0].heard + "|" + talkers[1].heard);
    digests.push_back(session.digest(0));
    for (const Talker& each : talkers) EXPECT_GT(each.count, 50);
  }
  EXPECT_EQ(runs[0], runs[1]) << "however many ticks a call makes";
  verp_lib::Session alone = pair_of(2, quiet());
  alone.tick(kTicks);
  EXPECT_EQ(digests, (std::vector<std::uint64_t>(2, alone.digest(0))));
}

TEST(LibverpRadio, TooManyAndTooLongAreTold) {
  verp_radio radio = quiet();
  radio.most_waiting = 3;
  verp_lib::Session session = pair_of(2, radio);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(session.send(0, "x"));
  EXPECT_FALSE(session.send(0, "x"));
  char room[4];
  std::uint64_t size = 0;
  const std::string longest(radio.most_bytes, 'y');
  EXPECT_TRUE(session.send(1, longest, 0));
  const std::string more = longest + "y";
  const verp_session s = session.handle();
  expect_error(verp_session_send(s, 1, 0, more.data(), more.size()), VERP_BAD_ARGUMENT,
               "verp_session_send", "at most 96");
  expect_error(verp_session_send(s, 1, 0, more.data(), ~0ULL), VERP_BAD_ARGUMENT,
               "verp_session_send", "data is of");
  expect_error(verp_session_send(s, 1, 1, "x", 1), VERP_BAD_ARGUMENT, "verp_session_send",
               "to is 1");
  expect_error(verp_session_send(s, 1, 7, "x", 1), VERP_BAD_ARGUMENT, "verp_session_send",
               "to is 7");
  expect_error(verp_session_send(s, 5, 0, "x", 1), VERP_BAD_ARGUMENT, "verp_session_send",
               "no robot 5");
  expect_error(verp_session_send(s, 1, 0, nullptr, 1), VERP_BAD_ARGUMENT, "verp_session_send",
               "data is null");
  session.tick(60);
  expect_error(verp_session_take(s, 0, room, sizeof room, &size, nullptr), VERP_BAD_ARGUMENT,
               "verp_session_take", "room for 4 bytes, not 96");
  EXPECT_EQ(size, 96U) << "and it is still there";
  EXPECT_EQ(session.take(0)->data, longest);
  EXPECT_EQ(verp_session_take(s, 0, room, sizeof room, &size, nullptr), VERP_NO_MESSAGE);
}

TEST(LibverpRadio, WithoutOneOrAtTheWrongTimeItSaysSo) {
  Opened opened;
  opened.add();
  std::uint64_t size = 0;
  char room[8];
  expect_error(verp_session_send(opened.session, 0, VERP_EVERYBODY, "x", 1), VERP_BAD_ARGUMENT,
               "verp_session_send", "call verp_session_radio() before");
  verp_radio radio = quiet();
  radio.loss = 2;
  expect_error(verp_session_radio(opened.session, &radio), VERP_BAD_ARGUMENT, "verp_session_radio",
               "loss");
  radio = quiet();
  radio.size = 8;
  expect_error(verp_session_radio(opened.session, &radio), VERP_BAD_ARGUMENT, "verp_session_radio",
               "radio->size is 8");
  radio = quiet();
  ASSERT_EQ(verp_session_radio(opened.session, &radio), VERP_OK);
  expect_error(verp_session_radio(opened.session, &radio), VERP_BAD_ARGUMENT, "verp_session_radio",
               "already");
  expect_error(verp_session_take(opened.session, 0, room, sizeof room, &size, nullptr),
               VERP_BAD_ARGUMENT, "verp_session_take", "first tick");
  opened.run();
  opened.result();
  expect_error(verp_session_send(opened.session, 0, VERP_EVERYBODY, "x", 1), VERP_BAD_ARGUMENT,
               "verp_session_send", "end of the run");
}

}  // namespace
}  // namespace verp::abi::test
