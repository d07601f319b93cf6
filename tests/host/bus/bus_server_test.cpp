#include "host/twin/bus/bus_server.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <memory>
#include <thread>
#include <vector>

#include "firmware/app/app.hpp"
#include "firmware/app/remote_bus.hpp"
#include "tests/host/bus/fake_plant.hpp"
#include "tests/host/bus/pipes.hpp"
#include "tests/host/bus/walker.hpp"

namespace verp {
namespace {

class BusServer : public ::testing::Test {
 protected:
  void start(bus::ServerHooks hooks, bus::RunOptions options = {}) {
    server = std::thread([this, hooks = std::move(hooks), options] {
      bus::BusServer service(params, virtual_bus, test::server_streams(pipes), hooks, options);
      result = service.serve();
    });
  }
  void TearDown() override {
    hang_up();
    if (server.joinable()) server.join();
  }
  void hang_up() { pipes.from_controller.close_write_end(); }
  template <class... Parts>
  void put(link::Kind kind, const Parts&... parts) {
    link::MessageHeader header{kind, 0, static_cast<std::uint16_t>((0u + ... + sizeof(Parts)))};
    append(header);
    (append(parts), ...);
  }
  template <class T>
  void append(const T& part) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&part);
    outbox.insert(outbox.end(), bytes, bytes + sizeof part);
  }
  void flush() {
    ASSERT_TRUE(out.write(outbox.data(), outbox.size()));
    outbox.clear();
  }
  template <class T>
  T get() {
    T value;
    auto* bytes = reinterpret_cast<std::uint8_t*>(&value);
    for (std::size_t have = 0; have < sizeof value;) {
      const std::size_t count = in.read_some(bytes + have, sizeof value - have);
      if (count == 0) break;
      have += count;
    }
    return value;
  }
  void greet() {
    put(link::Kind::kHello,
        link::Hello{link::kVersion, sizeof(Params), sizeof(TickRecord), sizeof(State)});
    flush();
    reply = get<link::HelloReply>();
    received = get<Params>();
  }

  Params params = test::bus_params(2);
  Params received;
  link::HelloReply reply;
  test::FakePlant plant;
  bus::VirtualBus virtual_bus{params, plant};
  test::PipePair pipes;
  test::PipeEnd in{pipes.to_controller};
  test::PipeEnd out{pipes.from_controller};
  std::vector<std::uint8_t> outbox;
  std::thread server;
  bus::ServerResult result;
};

using SyncRead = std::array<std::uint8_t, 16>;
SyncRead position_read() {
  SyncRead frame{};
  const std::uint8_t ids[] = {1, 2};
  dxl::encode_sync_read(frame.data(), frame.size(), dxl::Instruction::kSyncRead,
                        dxl::address::kPresentPosition, 4, ids, 2);
  return frame;
}

TEST_F(BusServer, GivesTheControllerItsParams) {
  start({}, {.ticks = 7, .state_every = 3});
  greet();
  EXPECT_EQ(reply.status, link::HelloStatus::kReady);
  EXPECT_EQ(reply.ticks, 7u);
  EXPECT_EQ(reply.state_every, 3u);
  EXPECT_EQ(std::memcmp(&received, &params, sizeof params), 0);
}

TEST_F(BusServer, GivesTheControllerItsActions) {
  const std::vector<std::uint32_t> actions(300, 0x12345678);
  start({}, {.actions = actions});
  app::RemoteBus<test::PipeEnd, test::PipeEnd> remote(in, out);
  const auto room = std::make_unique<app::ActionRoom>();
  ASSERT_TRUE(remote.hello(received, room.get()));
  EXPECT_EQ(std::memcmp(room->bytes, actions.data(), 4 * actions.size()), 0);
  EXPECT_EQ(remote.actions(*room).count(), 0) << "they are no library, and none is played";
}

TEST_F(BusServer, IsNotGreetedByAControllerWithoutRoomForTheActions) {
  const std::vector<std::uint32_t> actions(3);
  start({}, {.actions = actions});
  app::RemoteBus<test::PipeEnd, test::PipeEnd> remote(in, out);
  EXPECT_FALSE(remote.hello(received));
}

TEST_F(BusServer, RefusesAFirmwareOfOtherSources) {
  start({});
  put(link::Kind::kHello,
      link::Hello{link::kVersion, sizeof(Params) + 4, sizeof(TickRecord), sizeof(State)});
  flush();
  EXPECT_EQ(get<link::HelloReply>().status, link::HelloStatus::kWrongSizes);
  server.join();
  EXPECT_EQ(result.exit_code, 3u);
}

TEST_F(BusServer, AnswersAPollInOneReadWithBytesTimeAndOrder) {
  bus::ServerHooks hooks;
  hooks.order = [](std::uint32_t tick) {
    app::OperatorOrder order;
    order.command.vx_tenth_mm_s = static_cast<std::int16_t>(100 + tick);
    return order;
  };
  start(std::move(hooks));
  greet();
  for (int tick = 0; tick < 3; ++tick) {
    put(link::Kind::kSend, position_read());
    put(link::Kind::kPoll, link::Poll{5000, 512, 0});
    flush();
    std::array<std::uint8_t, link::kMaxReply> whole{};
    ASSERT_EQ(in.read_some(whole.data(), whole.size()), sizeof(link::PollReply) + 30);
    link::PollReply head;
    std::memcpy(&head, whole.data(), sizeof head);
    EXPECT_EQ(head.size, 30);
    EXPECT_EQ(head.order.command.vx_tenth_mm_s, 100 + tick);
    EXPECT_GT(head.now_us, params.period_us * static_cast<unsigned>(tick));
    EXPECT_EQ(head.flags, 0);
  }
}

TEST_F(BusServer, PassesRecordsOnAndEndsAsTheControllerSays) {
  std::vector<std::uint32_t> ticks;
  bus::ServerHooks hooks;
  hooks.record = [&ticks](const TickRecord& record) { ticks.push_back(record.inputs.tick); };
  start(std::move(hooks));
  greet();
  for (std::uint32_t tick = 5; tick < 8; ++tick) {
    TickRecord record;
    record.inputs.tick = tick;
    put(link::Kind::kRecord, record);
  }
  put(link::Kind::kQuit, link::Quit{1}, std::array<char, 4>{'f', 'e', 'l', 'l'});
  flush();
  server.join();
  EXPECT_EQ(ticks, (std::vector<std::uint32_t>{5, 6, 7}));
  EXPECT_EQ(result.exit_code, 1u);
  EXPECT_EQ(result.reason, "fell");
}

TEST_F(BusServer, ReportsAStopAndARefusedFrame) {
  bus::ServerHooks hooks;
  hooks.stop = [] { return true; };
  start(std::move(hooks));
  greet();
  put(link::Kind::kSend);
  put(link::Kind::kPoll, link::Poll{100, 512, 0});
  flush();
  EXPECT_EQ(get<link::PollReply>().flags, link::kStop | link::kSendFailed);
}

TEST_F(BusServer, EndsWhenTheLinkBreaksOrSpeaksNonsense) {
  start({});
  greet();
  put(static_cast<link::Kind>('?'), std::uint32_t{0});
  flush();
  server.join();
  EXPECT_EQ(result.exit_code, 3u);
  EXPECT_NE(result.reason.find("kind 63"), std::string::npos);

  start({});
  hang_up();
  server.join();
  EXPECT_EQ(result.exit_code, 3u);
}

TEST(RemoteLoop, RecordsWhatTheLoopInThisProcessRecords) {
  constexpr std::uint32_t kTicks = 300;
  const Params params = test::bus_params(2);
  test::Walker local;
  {
    test::FakePlant plant;
    bus::VirtualBus direct(params, plant);
    app::App<bus::VirtualBus, test::Walker, test::Walker> loop(params, direct, local, local);
    ASSERT_EQ(loop.bring_up().status, app::BringUpStatus::kReady);
    for (std::uint32_t i = 0; i < kTicks; ++i) loop.tick();
  }
  test::Walker distant;
  test::FakePlant plant;
  bus::VirtualBus served(params, plant);
  test::PipePair pipes;
  std::thread controller([&pipes] {
    using Remote = app::RemoteBus<test::PipeEnd, test::PipeEnd>;
    test::PipeEnd in{pipes.to_controller};
    test::PipeEnd out{pipes.from_controller};
    Remote remote(in, out);
    Params received;
    if (remote.hello(received)) {
      app::App<Remote, Remote, Remote> loop(received, remote, remote, remote);
      loop.bring_up();
      while (!remote.stopped() && loop.inputs().tick + 1 < remote.ticks()) loop.tick();
      remote.quit(0, "done");
    }
    pipes.from_controller.close_write_end();
  });
  bus::ServerHooks hooks;
  hooks.order = [&distant](std::uint32_t tick) { return distant.order(tick); };
  hooks.record = [&distant](const TickRecord& record) { distant.records.push_back(record); };
  const bus::ServerResult result =
      bus::BusServer(params, served, test::server_streams(pipes), hooks, {.ticks = kTicks}).serve();
  controller.join();
  EXPECT_EQ(result.exit_code, 0u) << result.reason;
  ASSERT_EQ(distant.records.size(), local.records.size());
  for (std::size_t i = 0; i < local.records.size(); ++i) {
    ASSERT_EQ(std::memcmp(&local.records[i], &distant.records[i], sizeof(TickRecord)), 0)
        << "tick " << i;
  }
}

}  // namespace
}  // namespace verp
