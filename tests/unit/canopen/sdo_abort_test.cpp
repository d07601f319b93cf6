#include <gtest/gtest.h>

#include "tests/unit/canopen/sdo_bench.hpp"

namespace verp::canopen {
namespace {

using test::Bench;
using test::frame_of;
using test::Line;
using Mode = SdoClient::Mode;
using State = SdoClient::State;

Abort refusal(Bench& bench, const Line& line) {
  bench.server.receive(frame_of(line), 0);
  Frame reply;
  if (!bench.server.next(reply, 0) || reply.data[0] != 0x80) return Abort::kNone;
  const int specifier = line.bytes[0] >> 5;
  const bool of_a_transfer = specifier == 0 || specifier == 3 || specifier == 7;
  if (!of_a_transfer && !(specifier == 5 && (line.bytes[0] & 3) != 0)) {
    EXPECT_TRUE(sdo::address_of(reply) == sdo::address_of(frame_of(line))) << "whose abort?";
  }
  return static_cast<Abort>(get_le(reply.data + 4, 4));
}

TEST(SdoServer, RefusesWithTheDocumentedCodes) {
  Bench& bench = test::fresh_bench();
  EXPECT_TRUE(refusal(bench, {true, {0x40, 0x99, 0x20, 0}}) == Abort::kNoObject);
  EXPECT_TRUE(refusal(bench, {true, {0x40, 0x00, 0x20, 1}}) == Abort::kNoSubindex);
  EXPECT_TRUE(refusal(bench, {true, {0x40, 0x02, 0x20, 0}}) == Abort::kWriteOnly);
  EXPECT_TRUE(refusal(bench, {true, {0x23, 0x01, 0x20, 0, 1, 2, 3, 4}}) == Abort::kReadOnly);
  EXPECT_TRUE(refusal(bench, {true, {0x2F, 0x02, 0x20, 0, 1}}) == Abort::kTooShort);
  EXPECT_TRUE(refusal(bench, {true, {0x21, 0x02, 0x20, 0, 5}}) == Abort::kTooLong);
  EXPECT_TRUE(refusal(bench, {true, {0xC2, 0x00, 0x20, 0, 101}}) == Abort::kTooLong);
  EXPECT_TRUE(refusal(bench, {true, {0xA4, 0x00, 0x20, 0, 0}}) == Abort::kBlockSize);
  EXPECT_TRUE(refusal(bench, {true, {0xA4, 0x00, 0x20, 0, 128}}) == Abort::kBlockSize);
  EXPECT_TRUE(refusal(bench, {true, {0xE0}}) == Abort::kCommand);
  EXPECT_TRUE(refusal(bench, {true, {0x60}}) == Abort::kCommand) << "a segment of no transfer";
  EXPECT_EQ(bench.dictionary.writes, 0);
}

TEST(SdoServer, AbortsASegmentWhoseToggleBitDidNotAlternate) {
  Bench& bench = test::fresh_bench();
  EXPECT_TRUE(refusal(bench, {true, {0x21, 0x00, 0x20, 0, 20}}) == Abort::kNone);
  EXPECT_TRUE(refusal(bench, {true, {0x00, 1, 2, 3, 4, 5, 6, 7}}) == Abort::kNone);
  EXPECT_TRUE(refusal(bench, {true, {0x00, 1, 2, 3, 4, 5, 6, 7}}) == Abort::kToggle);
  EXPECT_TRUE(refusal(bench, {true, {0x10, 1, 2, 3, 4, 5, 6, 7}}) == Abort::kCommand)
      << "the transfer is over";
  EXPECT_EQ(bench.dictionary.writes, 0);
}

TEST(SdoServer, AbortsWhatDoesNotKeepTheAnnouncedSize) {
  Bench& bench = test::fresh_bench();
  EXPECT_TRUE(refusal(bench, {true, {0x21, 0x00, 0x20, 0, 8}}) == Abort::kNone);
  EXPECT_TRUE(refusal(bench, {true, {0x01, 1, 2, 3, 4, 5, 6, 7}}) == Abort::kLength);
  EXPECT_EQ(bench.dictionary.writes, 0);
}

TEST(SdoServer, AbortsWhatGrowsTooLongWithoutAnnouncingIt) {
  Bench& bench = test::fresh_bench();
  EXPECT_TRUE(refusal(bench, {true, {0x20, 0x00, 0x20, 0}}) == Abort::kNone);
  for (unsigned i = 0; i < 14; ++i) {  // 98 of 100 bytes
    const auto byte0 = static_cast<std::uint8_t>(i % 2 == 0 ? 0x00 : 0x10);
    EXPECT_TRUE(refusal(bench, {true, {byte0, 1, 2, 3, 4, 5, 6, 7}}) == Abort::kNone);
  }
  EXPECT_TRUE(refusal(bench, {true, {0x00, 1, 2, 3, 4, 5, 6, 7}}) == Abort::kTooLong);
  EXPECT_EQ(bench.dictionary.writes, 0);
}

void send_a_block(Bench& bench) {
  bench.dictionary.small[0].size = 50;
  bench.server.receive(frame_of({true, {0xA4, 0x00, 0x20, 0, 4}}), 0);
  Frame frame;
  EXPECT_TRUE(bench.server.next(frame, 0));
  bench.server.receive(frame_of({true, {0xA3}}), 0);
  while (bench.server.next(frame, 0)) {
  }
}

TEST(SdoServer, AbortsAConfirmationOfWhatItNeverSent) {
  Bench& bench = test::fresh_bench();
  send_a_block(bench);
  EXPECT_TRUE(refusal(bench, {true, {0xA2, 5, 4}}) == Abort::kSequence);
  send_a_block(bench);
  EXPECT_TRUE(refusal(bench, {true, {0xA2, 4, 128}}) == Abort::kBlockSize);
}

TEST(SdoServer, DoesNotRepeatABlockForEver) {
  Bench& bench = test::fresh_bench();
  send_a_block(bench);
  Frame frame;
  int blocks = 0;
  for (; !bench.server.idle() && blocks < 100; ++blocks) {
    bench.server.receive(frame_of({true, {0xA2, 0, 4}}), 0);
    while (bench.server.next(frame, 0)) {
    }
  }
  EXPECT_EQ(blocks, sdo::kMaxIdleBlocks + 1);
  EXPECT_EQ(get_le(frame.data + 4, 4), 0x05040003u);
}

TEST(SdoClient, IgnoresTheRemainsOfAnEarlierTransfer) {
  SdoClient client(2);
  std::uint8_t byte = 0;
  EXPECT_TRUE(client.upload({0x2000, 3}, &byte, 1, Mode::kPlain, 0));
  const Line remains[] = {{false, {0x4F, 0x00, 0x20, 0x04, 9}},   // another subindex
                          {false, {0x4F, 0x01, 0x20, 0x03, 9}},   // another index
                          {false, {0x60, 0x00, 0x20, 0x03}},      // of a download
                          {false, {0x00, 1, 2, 3, 4, 5, 6, 7}},   // a segment
                          {false, {0x80, 0x01, 0x20, 0x03, 1}}};  // another's abort
  for (const Line& line : remains) client.receive(frame_of(line), 0);
  EXPECT_TRUE(client.state() == State::kBusy);
  client.receive(frame_of({false, {0x4F, 0x00, 0x20, 0x03, 7}}), 0);
  EXPECT_TRUE(client.state() == State::kDone);
  EXPECT_EQ(byte, 7);
}

// The client's reason, for an upload into four bytes.
template <std::size_t kLines>
Abort upload_refusal(const Line (&lines)[kLines], int& requests) {
  SdoClient client(2);
  std::uint8_t buffer[16] = {};
  client.upload({0x2000, 0}, buffer, 8, Mode::kPlain, 0);
  requests = 0;
  Frame frame;
  for (const Line& line : lines) {
    requests += client.next(frame, 0) ? 1 : 0;
    client.receive(frame_of(line), 0);
  }
  EXPECT_EQ(buffer[8], 0) << "behind the caller's memory";
  return client.state() == State::kAborted ? client.reason() : Abort::kNone;
}

TEST(SdoClient, AbortsAServerThatSendsMoreOrLessThanItSays) {
  int requests = 0;
  const Line too_long[] = {{false, {0x41, 0x00, 0x20, 0, 9}}};
  EXPECT_TRUE(upload_refusal(too_long, requests) == Abort::kOutOfMemory) << "at once";
  const Line unannounced[] = {{false, {0x40, 0x00, 0x20, 0}},
                              {false, {0x00, 1, 1, 1, 1, 1, 1, 1}},
                              {false, {0x11, 1, 1, 1, 1, 1, 1, 1}}};
  EXPECT_TRUE(upload_refusal(unannounced, requests) == Abort::kOutOfMemory);
  EXPECT_EQ(requests, 3);
  const Line too_short[] = {{false, {0x41, 0x00, 0x20, 0, 8}},
                            {false, {0x01, 1, 1, 1, 1, 1, 1, 1}}};
  EXPECT_TRUE(upload_refusal(too_short, requests) == Abort::kLength);
}

TEST(SdoClient, TakesAnAbortOfItsObjectOrOfNone) {
  for (const Line& line : {Line{false, {0x80, 0x00, 0x20, 0x03, 0, 0, 2, 6}},
                           Line{false, {0x80, 0, 0, 0, 0, 0, 2, 6}}}) {
    SdoClient client(2);
    std::uint8_t byte = 0;
    client.upload({0x2000, 3}, &byte, 1, Mode::kPlain, 0);
    client.receive(frame_of(line), 0);
    EXPECT_TRUE(client.reason() == Abort::kNoObject);
  }
}

TEST(SdoServer, GivesUpInBusTimeAndSaysSo) {
  Bench& bench = test::fresh_bench();
  EXPECT_TRUE(refusal(bench, {true, {0x21, 0x00, 0x20, 0, 20}}) == Abort::kNone);
  Frame reply;
  EXPECT_FALSE(bench.server.next(reply, sdo::kTimeoutUs - 1));
  EXPECT_TRUE(bench.server.next(reply, sdo::kTimeoutUs));
  EXPECT_EQ(get_le(reply.data + 4, 4), 0x05040000u);
  EXPECT_EQ(get_le(reply.data + 1, 2), 0x2000u);
  EXPECT_TRUE(bench.server.idle());
}

TEST(SdoServer, IgnoresWhatIsNotForIt) {
  Bench& bench = test::fresh_bench();
  Frame reply;
  Frame other = frame_of({true, {0x40, 0x01, 0x20, 0}});
  other.id = 0x603;
  bench.server.receive(other, 0);
  EXPECT_FALSE(bench.server.next(reply, 0));
  other.id = 0x602;
  other.extended = true;
  bench.server.receive(other, 0);
  EXPECT_FALSE(bench.server.next(reply, 0));
  other.extended = false;
  other.size = 7;
  bench.server.receive(other, 0);
  EXPECT_FALSE(bench.server.next(reply, 0));
}

TEST(SdoServer, SwitchesToAPlainUploadBelowTheClientsThreshold) {
  Bench& bench = test::fresh_bench();
  bench.dictionary.small[1].size = 4;
  bench.server.receive(frame_of({true, {0xA4, 0x01, 0x20, 0, 127, 4}}), 0);
  Frame reply;
  EXPECT_TRUE(bench.server.next(reply, 0));
  EXPECT_EQ(reply.data[0], 0x43);
  bench.server.receive(frame_of({true, {0xA4, 0x01, 0x20, 0, 127, 3}}), 0);
  EXPECT_TRUE(bench.server.next(reply, 0));
  EXPECT_EQ(reply.data[0], 0xC6);
}

}  // namespace
}  // namespace verp::canopen
