#include <gtest/gtest.h>

#include "tests/unit/canopen/sdo_bench.hpp"

namespace verp::canopen {
namespace {

using test::Bench;
using test::BenchDictionary;
using test::Dice;
using Mode = SdoClient::Mode;
using State = SdoClient::State;

constexpr Address kSmall{0x2000, 0};
constexpr Address kLarge{0x3000, 0};

struct Tally {
  int done = 0;
  int aborted = 0;
};

void fill(std::uint8_t* bytes, std::uint32_t size, Dice& dice) {
  for (std::uint32_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(dice.below(256));
}
bool equal(const std::uint8_t* a, const std::uint8_t* b, std::uint32_t size) {
  for (std::uint32_t i = 0; i < size; ++i) {
    if (a[i] != b[i]) return false;
  }
  return true;
}

void transfer(Bench& bench, Dice& dice, bool write, std::uint32_t size, Mode mode, Tally& tally) {
  static std::uint8_t mine[BenchDictionary::kLarge + 8];
  const Address at = size > BenchDictionary::kSmall ? kLarge : kSmall;
  BenchDictionary::Value& theirs = *bench.dictionary.at_index(at.index);
  fill(mine, sizeof mine, dice);
  if (!write) {
    fill(theirs.bytes, size, dice);
    theirs.size = size;
  }
  static std::uint8_t before[BenchDictionary::kLarge];
  const std::uint32_t before_size = theirs.size;
  for (std::uint32_t i = 0; i < before_size; ++i) before[i] = theirs.bytes[i];
  const int writes = bench.dictionary.writes;
  if (write) {
    ASSERT_TRUE(bench.client.download(at, mine, size, mode, bench.now_us));
  } else {
    ASSERT_TRUE(bench.client.upload(at, mine, sizeof mine, mode, bench.now_us));
  }
  ASSERT_TRUE(bench.run(dice)) << "a transfer does not end";
  const bool done = bench.client.state() == State::kDone;
  done ? ++tally.done : ++tally.aborted;
  if (write) {
    // A lost confirmation leaves the client in doubt, not wrong data.
    const bool written = bench.dictionary.writes != writes;
    ASSERT_TRUE(written || !done) << "done, but never written";
    ASSERT_EQ(theirs.size, written ? size : before_size);
    ASSERT_TRUE(equal(theirs.bytes, written ? mine : before, theirs.size));
  } else if (done) {
    ASSERT_EQ(bench.client.size(), size);
    ASSERT_TRUE(equal(mine, theirs.bytes, size));
  }
  ASSERT_EQ(bench.dictionary.misuses, 0);
}

TEST(SdoTransfer, OfAnySizeArrivesOverAGoodChannel) {
  Bench& bench = test::fresh_bench();
  Dice dice(1);
  Tally tally;
  int transfers = 0;
  // Around each limit: expedited, one segment, the server's buffer, one block, two blocks.
  for (const std::uint32_t size :
       {0u,   1u,   3u,   4u,   5u,   6u,   7u,   8u,    14u,   15u,   99u,
        100u, 127u, 128u, 129u, 888u, 889u, 890u, 1777u, 1778u, 1779u, 2000u}) {
    for (const Mode mode : {Mode::kPlain, Mode::kBlock}) {
      for (const bool write : {true, false}) {
        transfer(bench, dice, write, size, mode, tally);
        ++transfers;
      }
    }
  }
  EXPECT_EQ(tally.done, transfers);
}

TEST(SdoTransfer, TakesTheFewestFrames) {
  Bench& bench = test::fresh_bench();
  Dice dice(2);
  Tally tally;
  transfer(bench, dice, true, 4, Mode::kPlain, tally);
  EXPECT_EQ(bench.frames, 2) << "expedited: a request and a response";
  bench.frames = 0;
  transfer(bench, dice, false, 70, Mode::kPlain, tally);
  EXPECT_EQ(bench.frames, 2 + 2 * 10);
  bench.frames = 0;
  transfer(bench, dice, true, 70, Mode::kBlock, tally);
  EXPECT_EQ(bench.frames, 2 + 10 + 1 + 2) << "initiate, segments, response, end";
  bench.frames = 0;
  transfer(bench, dice, false, 889 + 7, Mode::kBlock, tally);
  EXPECT_EQ(bench.frames, 3 + 127 + 1 + 1 + 1 + 2);
}

void spoil(Bench& bench, std::uint32_t lose, std::uint32_t duplicate, std::uint32_t swap) {
  for (test::Channel* channel : {&bench.up, &bench.down}) {
    channel->lose = lose;
    channel->duplicate = duplicate;
    channel->swap = swap;
  }
}

// Plain transfers have one toggle bit: frames may be lost and doubled but keep their order.
TEST(SdoTransfer, PlainOverALossyDuplicatingChannelIsRightOrAborted) {
  Bench& bench = test::fresh_bench();
  Tally tally;
  for (std::uint32_t seed = 1; seed <= 400; ++seed) {
    Dice dice(seed * 7919);
    spoil(bench, 10 + dice.below(60), 10 + dice.below(60), 0);
    transfer(bench, dice, dice.one_in(2), dice.below(101), Mode::kPlain, tally);
  }
  EXPECT_GT(tally.done, 100);
  EXPECT_GT(tally.aborted, 50) << "the channel is not bad enough to show anything";
}

// Sequence numbers and a CRC allow any order.
TEST(SdoTransfer, BlocksOverALossyReorderingDuplicatingChannelAreRightOrAborted) {
  Bench& bench = test::fresh_bench();
  Tally tally;
  for (std::uint32_t seed = 1; seed <= 150; ++seed) {
    Dice dice(seed * 104729);
    spoil(bench, 20 + dice.below(100), 20 + dice.below(100), 10 + dice.below(100));
    const std::uint32_t size = dice.one_in(4) ? 101 + dice.below(1000) : dice.below(300);
    transfer(bench, dice, dice.one_in(2), size, Mode::kBlock, tally);
  }
  EXPECT_GT(tally.done, 40);
  EXPECT_GT(tally.aborted, 20) << "the channel is not bad enough to show anything";
}

TEST(SdoTransfer, ABlockSurvivesLostSegments) {
  Bench& bench = test::fresh_bench();
  int done = 0;
  for (std::uint32_t lost = 0; lost < 20; ++lost) {
    for (const bool write : {true, false}) {
      Dice dice(lost + 1);
      static std::uint8_t data[140];
      fill(data, sizeof data, dice);
      bench.dictionary.large.size = sizeof data;
      bench.client.download(kLarge, data, sizeof data, Mode::kBlock, bench.now_us);
      if (!write) {
        ASSERT_TRUE(bench.run(dice));
        bench.client.upload(kLarge, data, sizeof data, Mode::kBlock, bench.now_us);
      }
      std::uint32_t segment = 0;
      for (int i = 0; i < 2000 && bench.client.state() == State::kBusy; ++i) {
        Frame frame;
        bool quiet = true;
        while (bench.client.next(frame, bench.now_us)) {
          quiet = false;
          const bool drop = write && (frame.data[0] & 0x7F) == segment + 1 && segment++ == lost;
          if (!drop) bench.server.receive(frame, bench.now_us);
        }
        while (bench.server.next(frame, bench.now_us)) {
          quiet = false;
          const bool drop = !write && (frame.data[0] & 0x7F) == segment + 1 && segment++ == lost;
          if (!drop) bench.client.receive(frame, bench.now_us);
        }
        bench.now_us += quiet ? 10'000 : 100;
      }
      EXPECT_EQ(segment, 20u) << "the one to be lost did not come by";
      if (bench.client.state() == State::kDone) ++done;
      EXPECT_TRUE(equal(bench.dictionary.large_bytes, data, sizeof data));
    }
  }
  EXPECT_EQ(done, 40);
}

TEST(SdoTransfer, ACorruptedBlockIsNeitherWrittenNorRead) {
  for (unsigned bit = 0; bit < 56; ++bit) {
    const bool write = bit % 2 == 0;
    Bench& bench = test::fresh_bench();
    static std::uint8_t data[70];
    Dice dice(bit + 1);
    fill(data, sizeof data, dice);
    bench.dictionary.large.size = sizeof data;
    if (write) {
      bench.client.download(kLarge, data, sizeof data, Mode::kBlock, bench.now_us);
    } else {
      bench.client.upload(kLarge, data, sizeof data, Mode::kBlock, bench.now_us);
    }
    const auto spoil = [&](bool spoilt, Frame& frame) {
      const auto mask = static_cast<std::uint8_t>(1u << bit % 8);
      std::uint8_t& byte = frame.data[1 + bit / 8];
      if (spoilt && frame.data[0] == 4) byte = static_cast<std::uint8_t>(byte ^ mask);
    };
    for (int i = 0; i < 100; ++i) {
      Frame frame;
      while (bench.client.next(frame, bench.now_us)) {
        spoil(write, frame);
        bench.server.receive(frame, bench.now_us);
      }
      while (bench.server.next(frame, bench.now_us)) {
        spoil(!write, frame);
        bench.client.receive(frame, bench.now_us);
      }
    }
    EXPECT_TRUE(bench.client.state() == State::kAborted);
    EXPECT_TRUE(bench.client.reason() == Abort::kCrc);
    EXPECT_EQ(bench.dictionary.writes, 0);
  }
}

TEST(SdoClient, EndsWithATimeoutIfNobodyAnswers) {
  SdoClient client(5);
  std::uint8_t buffer[4];
  Frame frame;
  for (const Mode mode : {Mode::kPlain, Mode::kBlock}) {
    EXPECT_TRUE(client.upload(kSmall, buffer, 4, mode, 0));
    EXPECT_FALSE(client.upload(kSmall, buffer, 4, mode, 0)) << "one at a time";
    EXPECT_TRUE(client.next(frame, 0));
    EXPECT_FALSE(client.next(frame, sdo::kTimeoutUs - 1));
    EXPECT_TRUE(client.next(frame, sdo::kTimeoutUs)) << "the server is told";
    EXPECT_EQ(get_le(frame.data + 4, 4), 0x05040000u);
    EXPECT_TRUE(client.state() == State::kAborted);
    EXPECT_TRUE(client.reason() == Abort::kTimeout);
  }
}

TEST(SdoClient, TakesNoMoreThanItsBufferHolds) {
  Bench& bench = test::fresh_bench();
  static std::uint8_t buffer[60];
  Dice dice(3);
  for (const Mode mode : {Mode::kPlain, Mode::kBlock}) {
    for (std::uint8_t& each : buffer) each = 0xA5;
    bench.dictionary.small[0].size = 50;
    EXPECT_TRUE(bench.client.upload(kSmall, buffer, 49, mode, bench.now_us));
    EXPECT_TRUE(bench.run(dice));
    EXPECT_TRUE(bench.client.reason() == Abort::kOutOfMemory);
    EXPECT_EQ(buffer[49], 0xA5);
  }
}

TEST(SdoServer, SurvivesAnyFrames) {
  Bench& bench = test::fresh_bench();
  Dice dice(4);
  const std::uint8_t common[] = {0x21, 0x40, 0x60, 0x70, 0x00, 0x10, 0x01, 0x11, 0xC6, 0xC2, 0xA4,
                                 0xA3, 0xA2, 0xA1, 0xC1, 0x81, 0x01, 0x02, 0x80, 0x2F, 0x23};
  for (int i = 0; i < 20'000; ++i) {
    Frame frame = classic_frame(0x602, 8);
    for (unsigned k = 0; k < 8; ++k) frame.data[k] = static_cast<std::uint8_t>(dice.below(256));
    if (!dice.one_in(5)) frame.data[0] = common[dice.below(sizeof common)];
    if (!dice.one_in(5))
      put_le(frame.data + 1, dice.one_in(2) ? 0x2000 : 0x3000, 2), frame.data[3] = 0;
    if (!dice.one_in(3)) put_le(frame.data + 4, dice.below(120), 4);
    bench.server.receive(frame, bench.now_us);
    for (int k = 0; k < 200 && bench.server.next(frame, bench.now_us); ++k) {
      ASSERT_EQ(frame.id, 0x582u);
      ASSERT_EQ(frame.size, 8);
    }
    if (dice.one_in(200)) bench.now_us += sdo::kTimeoutUs;
    ASSERT_EQ(bench.dictionary.misuses, 0);
  }
  EXPECT_GT(bench.dictionary.writes, 10) << "no transfer got through: the frames are too wild";
  Frame frame;
  bench.now_us += sdo::kTimeoutUs;
  while (bench.server.next(frame, bench.now_us)) {
  }
  EXPECT_TRUE(bench.server.idle());
}

}  // namespace
}  // namespace verp::canopen
