#include <gtest/gtest.h>

#include <cstdint>

#include "hal/contract/can_bus.hpp"
#include "tests/contract/backends.hpp"

// hal/contract/can_bus.hpp.

namespace verp {
namespace {

template <class Backend>
class CanBusContract : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kLong_us = 4 * Backend::kPlenty_us;

  /// Up to eight bytes, different from its neighbours.
  static CanFrame numbered(std::uint32_t id, unsigned number) {
    CanFrame frame;
    frame.id = id;
    frame.size = static_cast<std::uint8_t>(number % 9);
    for (unsigned i = 0; i < frame.size; ++i) frame.data[i] = static_cast<std::uint8_t>(number + i);
    return frame;
  }
  /// All waiting frames pass; no other node may send.
  static void settle(Backend& backend) {
    CanFrame frame;
    EXPECT_FALSE(backend.bus.poll(frame, Backend::kPlenty_us));
  }
};

TYPED_TEST_SUITE(CanBusContract, test::CanBuses);

TYPED_TEST(CanBusContract, ImplementsTheInterface) {
  static_assert(std::derived_from<std::remove_reference_t<decltype(TypeParam::bus)>, hal::CanBus>);
}

TYPED_TEST(CanBusContract, SendsEachFrameOnceWholeAndInOrder) {
  TypeParam backend;
  for (unsigned i = 0; i < 9; ++i) ASSERT_TRUE(backend.bus.send(this->numbered(0x123, i)));
  this->settle(backend);
  CanFrame frame;
  for (unsigned i = 0; i < 9; ++i) {
    ASSERT_TRUE(backend.far_take(frame)) << i;
    EXPECT_TRUE(frame == this->numbered(0x123, i)) << i;
  }
  EXPECT_FALSE(backend.far_take(frame)) << "sent once";
}

TYPED_TEST(CanBusContract, TakesAWholeTickAtOnce) {
  TypeParam backend;
  for (int round = 0; round < 2; ++round) {
    for (unsigned i = 0; i < hal::kCanQueue; ++i) {
      ASSERT_TRUE(backend.bus.send(this->numbered(0x200, i))) << i;
    }
    this->settle(backend);
    CanFrame frame;
    for (unsigned i = 0; i < hal::kCanQueue; ++i) {
      ASSERT_TRUE(backend.far_take(frame));
      EXPECT_TRUE(frame == this->numbered(0x200, i)) << i;
    }
  }
}

TYPED_TEST(CanBusContract, CarriesExtendedAndRemoteFramesAsSuch) {
  TypeParam backend;
  CanFrame extended = this->numbered(0x1ABCDEF0, 5);
  extended.extended = true;
  CanFrame remote;
  remote.id = 0x701;
  remote.remote = true;
  for (const CanFrame& each : {extended, remote}) {
    ASSERT_TRUE(backend.bus.send(each));
    this->settle(backend);
    CanFrame frame;
    ASSERT_TRUE(backend.far_take(frame));
    EXPECT_TRUE(frame == each);
    backend.far_send(each);
    ASSERT_TRUE(backend.bus.send(this->numbered(1, 1)));  // the poll's time starts here
    ASSERT_TRUE(backend.bus.poll(frame, TypeParam::kPlenty_us));
    EXPECT_TRUE(frame == each);
    this->settle(backend);  // ours may have waited for that one
    ASSERT_TRUE(backend.far_take(frame));
  }
}

TYPED_TEST(CanBusContract, RefusesWhatCannotStandOnABus) {
  TypeParam backend;
  CanFrame large = this->numbered(0x100, 8);
  large.size = 9;
  CanFrame high = this->numbered(0x800, 1);
  CanFrame higher = this->numbered(0x20000000, 1);
  higher.extended = true;
  for (const CanFrame& each : {large, high, higher}) EXPECT_FALSE(backend.bus.send(each));
  this->settle(backend);
  CanFrame frame;
  EXPECT_FALSE(backend.far_take(frame));
}

TYPED_TEST(CanBusContract, NeverHearsItself) {
  TypeParam backend;
  for (unsigned i = 0; i < 5; ++i) ASSERT_TRUE(backend.bus.send(this->numbered(0x300 + i, i)));
  this->settle(backend);
}

TYPED_TEST(CanBusContract, BringsEachFrameOnceWholeAndInOrder) {
  TypeParam backend;
  ASSERT_TRUE(backend.bus.send(this->numbered(1, 1)));
  for (unsigned i = 0; i < 20; ++i) backend.far_send(this->numbered(0x181, i));
  CanFrame frame;
  for (unsigned i = 0; i < 20; ++i) {
    ASSERT_TRUE(backend.bus.poll(frame, TypeParam::kPlenty_us)) << i;
    EXPECT_TRUE(frame == this->numbered(0x181, i)) << i;
  }
  this->settle(backend);
}

TYPED_TEST(CanBusContract, CountsWhatFindsNoRoom) {
  TypeParam backend;
  constexpr unsigned kFlood = 100;
  ASSERT_TRUE(backend.bus.send(this->numbered(1, 1)));
  for (unsigned i = 0; i < kFlood; ++i) backend.far_send(this->numbered(0x181, i));
  unsigned brought = 0;
  for (CanFrame frame; backend.bus.poll(frame, this->kLong_us); ++brought) {
    EXPECT_EQ(frame.id, 0x181u);
  }
  EXPECT_EQ(brought + backend.bus.errors().overruns, kFlood);
}

TYPED_TEST(CanBusContract, SaysFalseOnlyWhenTheTimeIsOver) {
  TypeParam backend;
  CanFrame frame;
  EXPECT_FALSE(backend.bus.poll(frame, 1000));
  EXPECT_GE(backend.bus.now_us(), 1000u);
}

TYPED_TEST(CanBusContract, CountsTheTimeoutFromTheFrameNotFromThePoll) {
  TypeParam backend;
  ASSERT_TRUE(backend.bus.send(this->numbered(0x601, 8)));
  this->settle(backend);
  const std::uint64_t after_us = backend.bus.now_us();
  this->settle(backend);
  EXPECT_LE(backend.bus.now_us(), after_us + TypeParam::kSlack_us);
}

TYPED_TEST(CanBusContract, BringsALateFrameToALaterPoll) {
  TypeParam backend;
  ASSERT_TRUE(backend.bus.send(this->numbered(0x601, 8)));
  CanFrame frame;
  EXPECT_FALSE(backend.bus.poll(frame, 0));
  backend.far_send(this->numbered(0x581, 7));
  ASSERT_TRUE(backend.bus.poll(frame, TypeParam::kPlenty_us));
  EXPECT_TRUE(frame == this->numbered(0x581, 7));
}

TYPED_TEST(CanBusContract, NeverTurnsTimeBack) {
  TypeParam backend;
  std::uint64_t last_us = backend.bus.now_us();
  for (const std::uint32_t timeout_us : {std::uint32_t{0}, std::uint32_t{500}, std::uint32_t{100},
                                         std::uint32_t{TypeParam::kPlenty_us}}) {
    ASSERT_TRUE(backend.bus.send(this->numbered(0x601, 8)));
    backend.far_send(this->numbered(0x581, 8));
    CanFrame frame;
    while (backend.bus.poll(frame, timeout_us)) {
      EXPECT_GE(backend.bus.now_us(), last_us);
      last_us = backend.bus.now_us();
    }
    EXPECT_GE(backend.bus.now_us(), last_us);
    last_us = backend.bus.now_us();
  }
}

TYPED_TEST(CanBusContract, CountsNoErrorsWhereThereAreNone) {
  TypeParam backend;
  for (unsigned i = 0; i < 9; ++i) ASSERT_TRUE(backend.bus.send(this->numbered(0x123, i)));
  for (unsigned i = 0; i < 9; ++i) backend.far_send(this->numbered(0x181, i));
  for (CanFrame frame; backend.bus.poll(frame, TypeParam::kPlenty_us);) {
  }
  const hal::CanErrors errors = backend.bus.errors();
  EXPECT_EQ(errors.errors, 0u);
  EXPECT_EQ(errors.overruns, 0u);
  EXPECT_EQ(errors.bus_offs, 0u);
  EXPECT_EQ(errors.dropped, 0u);
}

TYPED_TEST(CanBusContract, ComesBackFromBusOffByItself) {
  TypeParam backend;
  if constexpr (TypeParam::kBusOff) {
    backend.fill_and_bus_off(this->numbered(0x123, 3), 2);
    EXPECT_EQ(backend.bus.errors().bus_offs, 1u);
    EXPECT_EQ(backend.bus.errors().dropped, 2u);
    EXPECT_FALSE(backend.bus.send(this->numbered(0x123, 4)));
    this->settle(backend);
    EXPECT_TRUE(backend.bus.send(this->numbered(0x123, 5)));
    this->settle(backend);
    CanFrame frame;
    ASSERT_TRUE(backend.far_take(frame));
    EXPECT_TRUE(frame == this->numbered(0x123, 5)) << "what was dropped stays so";
    EXPECT_FALSE(backend.far_take(frame));
  }
}

TEST(ScriptedCan, NamesWhatDidNotFollowTheScript) {
  hal::ScriptedCan bus;
  CanFrame frame;
  frame.id = 0x80;
  ASSERT_TRUE(bus.expect(frame));
  EXPECT_FALSE(bus.finished());
  CanFrame other = frame;
  other.size = 1;
  EXPECT_TRUE(bus.send(other));
  EXPECT_EQ(bus.mismatches(), 1u);
  EXPECT_TRUE(bus.send(frame));
  EXPECT_FALSE(bus.finished());
}

TEST(ScriptedCan, AnswersAfterTheFrameThatWasExpectedLast) {
  hal::ScriptedCan bus;
  CanFrame ask;
  ask.id = 0x601;
  CanFrame first;
  first.id = 0x581;
  CanFrame second = first;
  second.size = 2;
  ASSERT_TRUE(bus.expect(ask) && bus.answer(second, 300) && bus.answer(first, 100));
  ASSERT_TRUE(bus.expect(ask) && bus.answer(first, 50));
  CanFrame frame;
  ASSERT_TRUE(bus.send(ask));
  ASSERT_TRUE(bus.poll(frame, 1000));
  EXPECT_TRUE(frame == first);
  EXPECT_EQ(bus.now_us(), 100u);
  ASSERT_TRUE(bus.poll(frame, 1000));
  EXPECT_TRUE(frame == second);
  EXPECT_FALSE(bus.poll(frame, 1000));
  ASSERT_TRUE(bus.send(ask));
  ASSERT_TRUE(bus.poll(frame, 1000));
  EXPECT_EQ(bus.now_us(), 1050u);
  EXPECT_TRUE(bus.finished());
}

}  // namespace
}  // namespace verp
