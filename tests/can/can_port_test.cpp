#include "host/os/link/can_port.hpp"

#include <gtest/gtest.h>
#include <linux/can/error.h>

#include <chrono>
#include <optional>
#include <thread>
#include <vector>

#include "tests/can/can_world.hpp"

namespace verp::link {
namespace {

using test::frame_of;
using test::OwnVcan;
using test::poll_for;
using test::RawNode;
using test::settle;
using namespace std::chrono_literals;

constexpr std::uint32_t kSoon_us = 100'000;

LinkError failure(const std::string& link) {
  try {
    const CanPort port(parse_endpoint(link));
  } catch (const LinkError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error;
  }
  ADD_FAILURE() << link << " was opened";
  return {LinkError::Kind::kBusy, ""};
}

void expect_remedy(const std::string& link, LinkError::Kind kind, const std::string& remedy) {
  const LinkError error = failure(link);
  EXPECT_EQ(error.kind(), kind) << error.what();
  EXPECT_NE(std::string(error.what()).find(remedy), std::string::npos) << error.what();
}

TEST(CanPort, NamesWhatKeepsItFromBeingOpenedAndTheCommandThatMendsIt) {
  using Kind = LinkError::Kind;
  expect_remedy("can:vcan9", Kind::kNoDevice, "sudo ip link add vcan9 type vcan");
  expect_remedy("can:slcan0", Kind::kNoDevice, "sudo slcand -o -s8 /dev/ttyACM0 slcan0");
  expect_remedy("can:can0", Kind::kNoDevice, "here: vcan0");
  expect_remedy("can:lo", Kind::kUnsuitable, "here: vcan0");
  const OwnVcan vcan;
  vcan.down();
  expect_remedy("can:" + vcan.name, Kind::kUnsuitable, "sudo ip link set " + vcan.name + " up");
}

TEST(CanPort, CarriesFdFramesWhereTheInterfaceDoes) {
  const OwnVcan vcan;
  RawNode far(vcan.name);
  CanPort port(vcan.endpoint());
  CanFrame frame = frame_of(0x123);
  frame.fd = true;
  constexpr std::uint8_t kSizes[] = {0, 8, 12, 48, 64};
  for (const std::uint8_t size : kSizes) {
    frame.size = size;
    frame.bit_rate_switch = size % 3 == 0;
    for (std::uint8_t i = 0; i < size; ++i) frame.data[i] = static_cast<std::uint8_t>(size ^ i);
    ASSERT_TRUE(port.send(frame));
    CanFrame heard;
    ASSERT_TRUE(far.take(heard));
    EXPECT_TRUE(heard == frame) << int{size};
    far.send(frame);
    ASSERT_TRUE(poll_for(port, heard, kSoon_us));
    EXPECT_TRUE(heard == frame) << int{size};
  }
}

TEST(CanPort, SendsManyAtOnceInTheOrderGivenUpToTheFirstThatItRefuses) {
  const OwnVcan vcan;
  RawNode far(vcan.name);
  CanPort port(vcan.endpoint());
  std::vector<CanFrame> frames;
  for (std::uint32_t i = 0; i < 40; ++i) frames.push_back(frame_of(0x700 - 16 * i));
  ASSERT_EQ(port.send_all(frames.data(), frames.size()), frames.size());
  CanFrame heard;
  for (const CanFrame& each : frames) {
    ASSERT_TRUE(far.take(heard));
    EXPECT_TRUE(heard == each) << each.id;
  }
  frames[20].size = 9;
  EXPECT_EQ(port.send_all(frames.data(), frames.size()), 20u);
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(far.take(heard)) << i;
  EXPECT_EQ(port.send_all(frames.data(), 0), 0u);
  settle(port);
  EXPECT_FALSE(poll_for(port, heard, kSoon_us)) << "its own";
}

TEST(CanPort, AwaitsAFrameFromNowOnHoweverLongAgoItSent) {
  const OwnVcan vcan;
  RawNode far(vcan.name);
  CanPort port(vcan.endpoint());
  std::this_thread::sleep_for(20ms);
  CanFrame heard;
  const std::uint64_t before_us = port.now_us();
  EXPECT_FALSE(port.await(heard, 10'000));
  EXPECT_GE(port.now_us() - before_us, 10'000u);
  EXPECT_FALSE(port.await(heard, 0));
  far.send(frame_of(0x123));
  far.send(frame_of(0x124));
  ASSERT_TRUE(port.await(heard, 1'000'000));
  EXPECT_TRUE(heard == frame_of(0x123));
  ASSERT_TRUE(port.await(heard, 0));
  EXPECT_TRUE(heard == frame_of(0x124));
}

TEST(CanPort, RefusesFdFramesWhereTheInterfaceHasNone) {
  const OwnVcan vcan;
  vcan.down();
  test::ip("link set " + vcan.name + " mtu 16");
  vcan.up();
  CanPort port(vcan.endpoint());
  CanFrame frame = frame_of(0x123);
  frame.fd = true;
  EXPECT_FALSE(port.send(frame));
  EXPECT_TRUE(port.connected()) << "a refusal is no loss";
  EXPECT_EQ(port.trouble().losses, 0u);
  frame.fd = false;
  EXPECT_TRUE(port.send(frame));
}

TEST(CanPort, LetsInWhatItsFiltersSayAndNothingElse) {
  const OwnVcan vcan;
  RawNode far(vcan.name);
  CanPort port(vcan.endpoint(), {{0x180, 0x780, false}, {0x1234, 0x1FFFFFFF, true}});
  for (std::uint32_t id = 0; id < 0x800; ++id) far.send(frame_of(id, id));
  CanFrame extended = frame_of(0x1234);
  extended.extended = true;
  far.send(extended);
  extended.id = 0x185;  // only the number is in range
  far.send(extended);
  far.send(frame_of(0x234));
  CanFrame heard;
  for (std::uint32_t id = 0x180; id < 0x200; ++id) {
    ASSERT_TRUE(poll_for(port, heard, kSoon_us));
    ASSERT_TRUE(heard == frame_of(id, id)) << heard.id;
  }
  ASSERT_TRUE(poll_for(port, heard, kSoon_us));
  EXPECT_TRUE(heard.extended && heard.id == 0x1234);
  settle(port);
}

// The caller never receives an error frame.
TEST(CanPort, CountsErrorFramesByKind) {
  const OwnVcan vcan;
  RawNode far(vcan.name);
  CanPort port(vcan.endpoint());
  using Counter = std::uint32_t CanTrouble::*;
  const struct {
    std::uint32_t kinds;
    std::uint8_t controller;
    Counter counter;
  } cases[] = {
      {CAN_ERR_TX_TIMEOUT, 0, &CanTrouble::send_timeouts},
      {CAN_ERR_LOSTARB, 0, &CanTrouble::lost_arbitrations},
      {CAN_ERR_PROT, 0, &CanTrouble::protocol},
      {CAN_ERR_TRX, 0, &CanTrouble::transceiver},
      {CAN_ERR_ACK, 0, &CanTrouble::unacknowledged},
      {CAN_ERR_BUSERROR, 0, &CanTrouble::bus_errors},
      {CAN_ERR_BUSOFF, 0, &CanTrouble::bus_offs},
      {CAN_ERR_RESTARTED, 0, &CanTrouble::restarts},
      {CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW, &CanTrouble::controller_overruns},
      {CAN_ERR_CRTL, CAN_ERR_CRTL_TX_OVERFLOW, &CanTrouble::send_overflows},
      {CAN_ERR_CRTL, CAN_ERR_CRTL_RX_WARNING, &CanTrouble::warnings},
      {CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING, &CanTrouble::warnings},
      {CAN_ERR_CRTL, CAN_ERR_CRTL_RX_PASSIVE, &CanTrouble::passives},
      {CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE, &CanTrouble::passives},
  };
  constexpr Counter kAll[] = {&CanTrouble::send_timeouts,   &CanTrouble::lost_arbitrations,
                              &CanTrouble::protocol,        &CanTrouble::transceiver,
                              &CanTrouble::unacknowledged,  &CanTrouble::bus_errors,
                              &CanTrouble::bus_offs,        &CanTrouble::restarts,
                              &CanTrouble::warnings,        &CanTrouble::controller_overruns,
                              &CanTrouble::send_overflows,  &CanTrouble::passives,
                              &CanTrouble::socket_overruns, &CanTrouble::losses,
                              &CanTrouble::dropped};
  std::uint32_t sent = 0;
  for (const auto& [kinds, controller, counter] : cases) {
    const CanTrouble before = port.trouble();
    far.send_error(kinds, controller);
    settle(port);
    EXPECT_EQ(port.errors().errors, ++sent);
    for (const Counter each : kAll) {
      EXPECT_EQ(port.trouble().*each, before.*each + (each == counter ? 1 : 0)) << kinds;
    }
  }
}

TEST(CanPort, RefusesFromBusOffUntilTheControllerIsBack) {
  const OwnVcan vcan;
  RawNode far(vcan.name);
  CanPort port(vcan.endpoint());
  far.send_error(CAN_ERR_BUSOFF);
  settle(port);
  EXPECT_FALSE(port.send(frame_of(1)));
  EXPECT_FALSE(port.connected());
  EXPECT_EQ(port.errors().bus_offs, 1u);
  settle(port);
  EXPECT_FALSE(port.send(frame_of(1))) << "time alone does not end it";
  far.send_error(CAN_ERR_RESTARTED);
  settle(port);
  CanFrame heard;
  EXPECT_TRUE(port.send(frame_of(2)));
  ASSERT_TRUE(far.take(heard));
  EXPECT_TRUE(heard == frame_of(2)) << "what was refused stays so";
}

/// Until the bus accepts it; false after two seconds.
bool sends_again(CanPort& port, const CanFrame& frame) {
  for (int i = 0; i < 200; ++i) {
    if (port.send(frame)) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

void expect_silence(CanPort& port) {
  const std::uint64_t before_us = port.now_us();
  EXPECT_FALSE(port.send(frame_of(1)));
  CanFrame heard;
  EXPECT_FALSE(poll_for(port, heard, 30'000));
  EXPECT_GE(port.now_us(), before_us + 30'000) << "a poll still takes its time";
  EXPECT_FALSE(port.connected());
  EXPECT_EQ(port.trouble().losses, 1u);
}

TEST(CanPort, SurvivesItsInterfaceGoingDownAndUp) {
  const OwnVcan vcan;
  RawNode far(vcan.name);
  CanPort port(vcan.endpoint());
  vcan.down();
  expect_silence(port);
  vcan.up();
  ASSERT_TRUE(sends_again(port, frame_of(2)));
  EXPECT_TRUE(port.connected());
  RawNode talker(vcan.name);
  talker.send(frame_of(3));
  CanFrame heard;
  ASSERT_TRUE(poll_for(port, heard, kSoon_us));
  EXPECT_TRUE(heard == frame_of(3));
  EXPECT_EQ(port.trouble().losses, 1u);
}

TEST(CanPort, SurvivesItsInterfaceBeingUnpluggedAndPluggedIn) {
  OwnVcan vcan;
  CanPort port(vcan.endpoint());
  ASSERT_TRUE(port.send(frame_of(9)));
  vcan.remove();
  expect_silence(port);
  vcan.make();
  RawNode far(vcan.name);
  ASSERT_TRUE(sends_again(port, frame_of(2)));
  CanFrame heard;
  ASSERT_TRUE(far.take(heard));
  EXPECT_TRUE(heard == frame_of(2));
  far.send(frame_of(3));
  ASSERT_TRUE(poll_for(port, heard, kSoon_us));
  EXPECT_TRUE(heard == frame_of(3));
}

TEST(CanPort, SaysWhenAFrameCameNotWhenItWasFetched) {
  const OwnVcan vcan;
  RawNode far(vcan.name);
  CanPort port(vcan.endpoint());
  const std::uint64_t before_us = port.now_us();
  far.send(frame_of(1));
  const std::uint64_t after_us = port.now_us();
  std::this_thread::sleep_for(50ms);
  CanFrame heard;
  ASSERT_TRUE(port.poll(heard, 0));
  EXPECT_GE(port.now_us() + 1000, before_us);
  EXPECT_LE(port.now_us(), after_us + 1000);
  settle(port);
  EXPECT_GE(port.now_us(), after_us + 50'000) << "time goes on";
}

// More than socket and inbox hold.
TEST(CanPort, LosesNoFrameUncounted) {
  const OwnVcan vcan;
  RawNode far(vcan.name);
  CanPort port(vcan.endpoint());
  constexpr std::uint32_t kFlood = 60'000;
  for (std::uint32_t i = 0; i < kFlood; ++i) far.send(frame_of(0x181, i));
  std::uint32_t brought = 0;
  std::optional<unsigned> last;
  CanFrame heard;
  while (poll_for(port, heard, 30'000)) {
    const auto number = static_cast<unsigned>(heard.data[0] | heard.data[1] << 8);
    if (last) {
      ASSERT_GT(number, *last) << "twice, or out of order";
    }
    last = number;
    ++brought;
  }
  EXPECT_GT(brought, 0u);
  EXPECT_LT(brought, kFlood) << "the flood was no flood";
  for (int i = 0; i < 3; ++i) {
    far.send(frame_of(0x182));  // the next frame reports a loss
    ASSERT_TRUE(poll_for(port, heard, kSoon_us));
    EXPECT_EQ(brought + port.errors().overruns, kFlood);
  }
}

}  // namespace
}  // namespace verp::link
