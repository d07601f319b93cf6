#include "host/twin/can/client.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "common/protocol/canopen/sdo.hpp"

namespace verp::can {
namespace {

using Asked = NodeIdentity::Asked;
using canopen::Abort;
using canopen::Address;
constexpr std::uint32_t kTimeout_us = 20'000;

struct Object {
  std::uint8_t node;
  Address at;
  bool operator<(const Object& other) const { return key() < other.key(); }

 private:
  std::tuple<std::uint8_t, std::uint16_t, std::uint8_t> key() const {
    return {node, at.index, at.subindex};
  }
};

/// Objects of four bytes; waiting takes no wall time.
class FakeNodes final : public ClientBus {
 public:
  bool send(const CanFrame& frame) override {
    if (frame.data[0] >> 5 != canopen::sdo::request::kUpload) return true;  // the client's aborts
    const bool further = frame.id == 0x6D2;
    if (further && !has_further_channel) return true;
    const Object object{static_cast<std::uint8_t>(further ? 127 : frame.id - 0x600),
                        canopen::sdo::address_of(frame)};
    by_further += further ? 1 : 0;
    const int times = ++asked[object];
    if (silent && silent(object, times)) return true;
    if (!holds.contains({object.node, {0x1000, 0}})) return true;  // an absent node
    answers_.push_back(answer(object));
    if (further) answers_.back().id = 0x6C2;
    if (after_answer) after_answer(object);
    return true;
  }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    if (answers_.empty()) {
      now_us_ += timeout_us;
      return false;
    }
    frame = answers_.front();
    answers_.pop_front();
    return true;
  }
  std::uint64_t now_us() override { return now_us_; }
  hal::CanErrors errors() const override { return {}; }
  bool connected() const override { return true; }

  void add(std::uint8_t node) {
    holds[{node, {0x1000, 0}}] = 0x20192;
    holds[{node, {0x1018, 1}}] = 0x100u + node;
    holds[{node, {0x1018, 2}}] = 0x200u + node;
    holds[{node, {0x1018, 3}}] = 1;
  }

  void say(const CanFrame& frame) { answers_.push_back(frame); }
  void overhear(const Object& object) { answers_.push_back(answer(object)); }

  bool has_further_channel = false;  ///< at node 127, by 1202h
  int by_further = 0;
  std::map<Object, std::uint32_t> holds;
  std::map<Object, int> asked;
  std::function<bool(const Object&, int times)> silent;
  std::function<void(const Object&)> after_answer;

 private:
  CanFrame answer(const Object& object) const {
    const std::uint32_t id = 0x580u + object.node;
    const auto found = holds.find(object);
    if (found == holds.end()) return canopen::sdo::abort_frame(id, object.at, Abort::kNoObject);
    const unsigned bits = canopen::sdo::kExpedited | canopen::sdo::kSizeGiven;
    return canopen::sdo::addressed(id, canopen::sdo::command(canopen::sdo::response::kUpload, bits),
                                   object.at, found->second);
  }

  std::deque<CanFrame> answers_;
  std::uint64_t now_us_ = 0;
};

class CanClient : public ::testing::Test {
 protected:
  FakeNodes nodes;
  Client client{nodes, "can:fake0", kTimeout_us};
};

TEST_F(CanClient, WhatANodeRefusesIsNotTold) {
  nodes.add(19);
  nodes.holds.erase({19, {0x1018, 2}});
  const auto found = client.identify(19);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->asked, Asked::kToTheEnd);
  EXPECT_EQ(found->vendor, 0x113u);
  EXPECT_EQ(found->product, std::nullopt);
  EXPECT_EQ((nodes.asked[{19, {0x1018, 2}}]), 1) << "a refusal is an answer";
}

TEST_F(CanClient, WhatGotNoAnswerIsAskedOnceMore) {
  nodes.add(19);
  nodes.silent = [](const Object&, int times) { return times == 1; };
  const auto found = client.identify(19);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->asked, Asked::kToTheEnd);
  EXPECT_EQ(found->vendor, 0x113u);
  EXPECT_EQ(found->product, 0x213u);
  EXPECT_EQ(found->revision, 1u);
}

// The late answer meets the next request, whose abort is no refusal.
TEST_F(CanClient, WhatALateAnswerSpoiltIsAskedOnceMore) {
  nodes.add(19);
  nodes.silent = [&](const Object& object, int times) {
    const bool spoilt = object.at == Address{0x1018, 1} && times == 1;
    const auto in_segments = canopen::sdo::command(canopen::sdo::response::kUpload, 1);
    for (int i = 0; spoilt && i < 2; ++i) {
      nodes.say(canopen::sdo::addressed(0x593, in_segments, object.at, 4));
    }
    return spoilt;
  };
  const auto found = client.identify(19);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->vendor, 0x113u);
  EXPECT_EQ((nodes.asked[{19, {0x1018, 1}}]), 2);
}

// It may fall silent at any object. The client does not wait for each.
TEST_F(CanClient, ANodeThatFallsSilentIsToldApartFromOneThatRefuses) {
  for (const Address last :
       {Address{0x1000, 0}, Address{0x1008, 0}, Address{0x1018, 1}, Address{0x1018, 2}}) {
    FakeNodes all;
    all.add(19);
    bool gone = false;
    all.silent = [&](const Object&, int) { return gone; };
    all.after_answer = [&](const Object& object) { gone = gone || object.at == last; };
    const auto found = Client(all, "can:fake0", kTimeout_us).identify(19);
    ASSERT_TRUE(found) << to_text(last);
    EXPECT_EQ(found->asked, Asked::kFellSilent) << to_text(last);
    EXPECT_EQ(found->device_type, 0x20192u);
    EXPECT_EQ(found->revision, std::nullopt);
    int unanswered = 0;
    for (const auto& [object, times] : all.asked) unanswered += times > 1 ? times : 0;
    EXPECT_EQ(unanswered, Client::kAttempts) << to_text(last);
  }
}

TEST_F(CanClient, AScanListsAlsoANodeThatFellSilentAfterItsFirstAnswer) {
  for (const int node : {3, 19, 100}) nodes.add(static_cast<std::uint8_t>(node));
  nodes.silent = [](const Object& object, int) {
    return object.node == 19 && !(object.at == Address{0x1000, 0});
  };
  const auto found = client.scan();
  ASSERT_EQ(found.size(), 3u);
  for (const NodeIdentity& each : found) {
    const bool silent = each.node == 19;
    EXPECT_EQ(each.asked, silent ? Asked::kFellSilent : Asked::kToTheEnd) << int{each.node};
    EXPECT_EQ(each.device_type, 0x20192u) << "it said so, silent or not";
    EXPECT_EQ(each.product.has_value(), !silent) << int{each.node};
  }
}

TEST_F(CanClient, AScanOfNobodyFindsNobody) {
  EXPECT_TRUE(client.scan().empty());
}

// It only shows that the node is there.
TEST_F(CanClient, AnAnswerToAnothersRequestIsNotTakenForADeviceType) {
  nodes.add(19);
  nodes.add(3);
  bool first = true;
  nodes.silent = [&](const Object& object, int) {
    return object.node == 19 && std::exchange(first, false);
  };
  nodes.after_answer = [&](const Object& object) {
    if (object.node == 3 && object.at == Address{0x1000, 0}) nodes.overhear({19, {0x1018, 3}});
  };
  const auto found = client.scan();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[1].node, 19);
  EXPECT_EQ(found[1].device_type, 0x20192u);
}

// Another client reads the same object by the default channel.
TEST_F(CanClient, TheControllersNodeIsAskedByAChannelOfItsOwn) {
  nodes.add(127);
  nodes.has_further_channel = true;
  nodes.after_answer = [&](const Object& object) {
    const std::uint32_t mine = std::exchange(nodes.holds[object], 0xDEAD);
    nodes.overhear(object);
    nodes.holds[object] = mine;
  };
  const auto found = client.identify(127);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->product, 0x200u + 127);
  for (const Address at : {Address{0x1000, 0}, Address{0x1018, 2}}) {
    EXPECT_EQ(client.read(127, at)[0], nodes.holds.at({127, at}) & 0xFF);
  }
  EXPECT_GE(nodes.by_further, 7);
}

TEST_F(CanClient, ANode127WithoutThatChannelIsAskedByTheDefaultOne) {
  nodes.add(127);
  const auto found = client.identify(127);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->asked, Asked::kToTheEnd);
  EXPECT_EQ(found->product, 0x200u + 127);
}

TEST_F(CanClient, AScanThatIsStoppedHasWhatItFoundSoFar) {
  for (const int node : {3, 19, 100}) nodes.add(static_cast<std::uint8_t>(node));
  bool over = false;
  client.stop_when([&] { return over; });
  nodes.after_answer = [&](const Object& object) {
    over = over || (object.node == 19 && object.at == Address{0x1018, 1});
  };
  const auto found = client.scan();
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].asked, Asked::kToTheEnd);
  EXPECT_EQ(found[1].asked, Asked::kInterrupted);
  EXPECT_EQ(found[1].vendor, 0x113u);
  EXPECT_EQ(found[2].asked, Asked::kInterrupted);
  EXPECT_EQ((nodes.asked[{100, {0x1018, 1}}]), 0) << "nothing more is asked";
}

TEST_F(CanClient, AStopIsNotTakenForASilence) {
  nodes.add(19);
  bool over = false;
  client.stop_when([&] { return over; });
  nodes.silent = [&](const Object& object, int) { return over = object.at == Address{0x1018, 1}; };
  const auto found = client.scan();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].asked, Asked::kInterrupted);
  EXPECT_EQ((nodes.asked[{19, {0x1018, 1}}]), 1) << "nor asked again";
}

}  // namespace
}  // namespace verp::can
