#include "tests/unit/images/actions_board.hpp"

#include <gtest/gtest.h>

#include "tests/unit/app/operator_bench.hpp"

namespace verp::app::test {
namespace {

using dxl::Error;

struct Session {
  Session() : bench(board.images) {
    fresh.shelf.goal(0, 1, 0.25F);
    fresh.mark = action::make_mark(fresh.shelf.header, kRobot);
    EXPECT_TRUE(open() == Error::kNone);
  }
  Error open() { return bench.write(reg("window_kind"), std::uint8_t{2}); }
  Error block(std::size_t at, std::size_t most = table::kWindowBytes) {
    std::uint8_t bytes[4 + table::kWindowBytes];
    const std::size_t left = sizeof fresh - at;
    const std::size_t count = left < most ? left : most;
    dxl::put_u32(bytes, static_cast<std::uint32_t>(at));
    __builtin_memcpy(bytes + 4, fresh.bytes() + at, count);
    return bench.write_bytes(reg("window_offset"), bytes, 4 + count).error;
  }
  void send(std::size_t missing = sizeof(SentActions), std::size_t size = table::kWindowBytes) {
    for (std::size_t at = 0; at < missing; at += size) {
      EXPECT_TRUE(block(at, size) == Error::kNone) << at;
    }
  }
  Error commit(std::uint32_t crc) {
    EXPECT_TRUE(bench.write(reg("window_crc"), crc) == Error::kNone);
    return bench.write(reg("window_commit"), std::uint8_t{1});
  }
  Error commit() { return commit(fresh.crc()); }
  int fault() { return bench.value<std::uint8_t>(reg("window_fault")); }
  table::WindowState state() { return bench.value<table::WindowState>(reg("window_state")); }
  bool took_them() const { return board.images.accepted_actions() > 0; }

  FakeBoard board;
  SentActions fresh{kRobot};
  Bench bench;
};

Session& fresh_session() {
  return renewed<Session>();
}

TEST(OperatorActions, TakesWholeActionsOfItsOwnRobot) {
  for (const std::size_t size : {7u, 64u, 128u}) {
    Session& session = fresh_session();
    session.send(sizeof session.fresh, size);
    EXPECT_TRUE(session.state() == table::WindowState::kReceiving);
    EXPECT_FALSE(session.took_them());
    EXPECT_TRUE(session.commit() == Error::kNone);
    EXPECT_TRUE(session.state() == table::WindowState::kAccepted);
    EXPECT_EQ(session.board.images.accepted_actions(), sizeof session.fresh);
    EXPECT_EQ(
        __builtin_memcmp(session.board.place.byte, session.fresh.bytes(), sizeof session.fresh), 0);
  }
}

TEST(OperatorActions, TakesBlocksInAnyOrderAndAgain) {
  Session& session = fresh_session();
  constexpr std::size_t kBlocks = (sizeof(SentActions) - 1) / table::kWindowBytes + 1;
  for (std::size_t n = kBlocks; n-- > 0;) {
    EXPECT_TRUE(session.block(n * table::kWindowBytes) == Error::kNone);
    EXPECT_TRUE(session.block(n * table::kWindowBytes) == Error::kNone) << "its answer was lost";
  }
  EXPECT_TRUE(session.commit() == Error::kNone);
  EXPECT_EQ(session.board.place.begun, 1);
}

TEST(OperatorActions, ReadsThoseInForceAndThatCostsNoErase) {
  Session& session = fresh_session();
  ASSERT_EQ(session.bench.value<std::uint32_t>(reg("window_size")), sizeof(SentActions));
  session.bench.write(reg("window_offset"), std::uint32_t{16});
  const Reply reply = session.bench.read(reg("window_data"), 100);
  ASSERT_EQ(reply.size, 100u);
  EXPECT_EQ(__builtin_memcmp(reply.data, session.board.there.bytes() + 16, 100), 0);
  EXPECT_EQ(session.board.place.begun, 0);
}

TEST(OperatorActions, RefusesWhatIsNotWhole) {
  for (std::size_t missing = 0; missing < sizeof(SentActions); missing += table::kWindowBytes) {
    Session& session = fresh_session();
    session.send(missing);
    EXPECT_TRUE(session.commit() == Error::kResultFail) << missing;
    EXPECT_EQ(session.fault(), kWrongWindowCrc) << missing;
    const std::uint32_t crc = crc32(session.fresh.bytes(), missing);
    EXPECT_TRUE(session.commit(crc) == Error::kResultFail) << missing;
    EXPECT_EQ(session.fault(),
              missing == 0 ? kWrongWindowCrc : static_cast<int>(action::KeptFault::kTruncated))
        << missing;
    EXPECT_TRUE(session.state() == table::WindowState::kRefused);
    EXPECT_FALSE(session.took_them());
  }
}

TEST(OperatorActions, RefusesWhatIsDamagedInAnyBlock) {
  for (std::size_t at = 5; at < sizeof(SentActions); at += table::kWindowBytes) {
    Session& session = fresh_session();
    const std::uint32_t right = session.fresh.crc();
    reinterpret_cast<std::uint8_t*>(&session.fresh)[at] ^= 4;
    session.send();
    EXPECT_TRUE(session.commit(right) == Error::kResultFail) << at;
    EXPECT_EQ(session.fault(), kWrongWindowCrc);
    EXPECT_TRUE(session.commit() == Error::kResultFail) << "and those who made it damaged " << at;
    EXPECT_NE(session.fault(), 0);
    EXPECT_NE(session.fault(), kWrongWindowCrc);
    EXPECT_FALSE(session.took_them());
  }
}

TEST(OperatorActions, RefusesThoseOfAnotherRobot) {
  Session& session = fresh_session();
  Params other = kRobot;
  other.joint[0].upper_rad += 0.5F;
  session.fresh.mark = action::make_mark(session.fresh.shelf.header, other);
  session.send();
  EXPECT_TRUE(session.commit() == Error::kResultFail);
  EXPECT_EQ(session.fault(), static_cast<int>(action::KeptFault::kOtherRobot));
  EXPECT_FALSE(session.took_them());
}

TEST(OperatorActions, RefusesAllWhereNoRobotIs) {
  Session& session = fresh_session();
  session.board.robot.params.joint_count = 200;
  session.send();
  EXPECT_TRUE(session.commit() == Error::kResultFail);
  EXPECT_EQ(session.fault(), static_cast<int>(action::KeptFault::kOtherRobot));
}

TEST(OperatorActions, TakesNoBlockBeyondItsRoom) {
  Session& session = fresh_session();
  std::uint8_t block[8] = {};
  dxl::put_u32(block, FakePlace::kBytes - 3);
  EXPECT_TRUE(session.bench.write_bytes(reg("window_offset"), block, 8).error == Error::kDataLimit);
  EXPECT_EQ(session.board.place.begun, 0) << "nothing was erased for it";
  EXPECT_TRUE(session.bench.write_bytes(reg("window_offset"), block, 7).error == Error::kNone);
}

// A block may erase flash.
TEST(OperatorActions, TakesNoBlockWhileAnyServoHoldsTorque) {
  Session& session = fresh_session();
  session.bench.arm(true);
  EXPECT_TRUE(session.block(0) == Error::kAccess);
  EXPECT_EQ(session.board.place.begun, 0);
  session.bench.arm(false);
  session.send();
  session.bench.arm(true);
  EXPECT_TRUE(session.commit() == Error::kAccess);
  EXPECT_FALSE(session.took_them());
}

TEST(OperatorActions, AsksForPatienceWhileThePlaceIsMade) {
  Session& session = fresh_session();
  session.board.place.busy = true;
  EXPECT_TRUE(session.block(0) == Error::kResultFail);
  EXPECT_TRUE(session.state() == table::WindowState::kIdle) << "that is no refusal";
  session.board.place.busy = false;
  session.send();
  EXPECT_TRUE(session.commit() == Error::kNone);
}

TEST(OperatorActions, SaysThatTheFlashDidNotKeepABlock) {
  for (int taken = 0; taken * table::kWindowBytes < static_cast<int>(sizeof(SentActions));
       ++taken) {
    Session& session = fresh_session();
    session.board.place.blocks_taken = taken;
    for (int n = 0; n < taken; ++n) {
      const std::size_t at = static_cast<std::size_t>(n) * table::kWindowBytes;
      EXPECT_TRUE(session.block(at) == Error::kNone);
    }
    const std::size_t at = static_cast<std::size_t>(taken) * table::kWindowBytes;
    EXPECT_TRUE(session.block(at) == Error::kResultFail);
    EXPECT_TRUE(session.state() == table::WindowState::kRefused);
    EXPECT_EQ(session.fault(), kBlockNotKept);
    EXPECT_FALSE(session.took_them());
  }
}

TEST(OperatorActions, ASecondAttemptIsNotSpoiltByTheFirst) {
  Session& session = fresh_session();
  session.send(2 * table::kWindowBytes);
  session.fresh.shelf.goal(2, 0, -0.5F);
  session.fresh.mark = action::make_mark(session.fresh.shelf.header, kRobot);
  ASSERT_TRUE(session.open() == Error::kNone);
  session.send();
  EXPECT_TRUE(session.commit() == Error::kNone);
  ASSERT_TRUE(session.open() == Error::kNone);
  EXPECT_FALSE(session.took_them()) << "who begins anew has withdrawn it";
}

}  // namespace
}  // namespace verp::app::test
