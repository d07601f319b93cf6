#include <gtest/gtest.h>

#include "tests/unit/canopen/sdo_bench.hpp"

// Exchanges on which vendors' documents and other projects' tests of CiA 301 agree, for client and
// server.
namespace verp::canopen {
namespace {

using test::frame_of;
using test::Line;
using Mode = SdoClient::Mode;
using State = SdoClient::State;

struct OneObject {
  const std::uint8_t* bytes = nullptr;
  std::uint32_t size = 0;
  std::uint8_t written[64] = {};
  std::uint32_t written_size = 0;

  Abort find(Address, Entry& entry) {
    entry = {true, true, size, 0, sizeof written};
    return Abort::kNone;
  }
  Abort read(Address, std::uint32_t offset, std::uint8_t* buffer, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) buffer[i] = bytes[offset + i];
    return Abort::kNone;
  }
  Abort write(Address, const std::uint8_t* data, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) written[i] = data[i];
    written_size = count;
    return Abort::kNone;
  }
};
static_assert(Dictionary<OneObject> && !StreamingDictionary<OneObject>);

template <class Machine>
void play(Machine& machine, bool requests, const Line* lines, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (lines[i].request != requests) {
      machine.receive(frame_of(lines[i]), 0);
      continue;
    }
    Frame said;
    ASSERT_TRUE(machine.next(said, 0)) << "line " << i << " is not said";
    EXPECT_TRUE(said == frame_of(lines[i])) << "line " << i;
  }
  Frame more;
  EXPECT_FALSE(machine.next(more, 0)) << "more than the documented frames";
}

constexpr Address kName{0x1008, 0};
constexpr Address kText{0x2000, 0};
const std::uint8_t* bytes_of(const char* text) {
  return reinterpret_cast<const std::uint8_t*>(text);
}
bool equal(const std::uint8_t* a, const char* b, std::uint32_t size) {
  for (std::uint32_t i = 0; i < size; ++i) {
    if (a[i] != static_cast<std::uint8_t>(b[i])) return false;
  }
  return true;
}

template <std::size_t kLines>
void expect_upload(const Line (&lines)[kLines], Address at, const char* text, std::uint32_t size,
                   Mode mode) {
  static OneObject object;
  object = {};
  object.bytes = bytes_of(text);
  object.size = size;
  SdoServer<OneObject> server(object, 2);
  play(server, false, lines, kLines);
  EXPECT_TRUE(server.idle());
  SdoClient client(2);
  std::uint8_t buffer[64] = {};
  EXPECT_TRUE(client.upload(at, buffer, sizeof buffer, mode, 0));
  play(client, true, lines, kLines);
  EXPECT_TRUE(client.state() == State::kDone);
  EXPECT_EQ(client.size(), size);
  EXPECT_TRUE(equal(buffer, text, size));
}

template <std::size_t kLines>
void expect_download(const Line (&lines)[kLines], Address at, const char* text, std::uint32_t size,
                     Mode mode) {
  static OneObject object;
  object = {};
  SdoServer<OneObject> server(object, 2);
  play(server, false, lines, kLines);
  EXPECT_EQ(object.written_size, size);
  EXPECT_TRUE(equal(object.written, text, size));
  SdoClient client(2);
  EXPECT_TRUE(client.download(at, bytes_of(text), size, mode, 0));
  play(client, true, lines, kLines);
  EXPECT_TRUE(client.state() == State::kDone);
}

TEST(SdoBytes, ExpeditedUpload) {
  const Line lines[] = {{true, {0x40, 0x18, 0x10, 0x01}},
                        {false, {0x43, 0x18, 0x10, 0x01, 0x04, 0, 0, 0}}};
  expect_upload(lines, {0x1018, 1}, "\x04\0\0\0", 4, Mode::kPlain);
}

TEST(SdoBytes, ExpeditedDownload) {
  const Line lines[] = {{true, {0x2B, 0x17, 0x10, 0x00, 0xA0, 0x0F, 0, 0}},
                        {false, {0x60, 0x17, 0x10, 0x00}}};
  expect_download(lines, {0x1017, 0}, "\xA0\x0F", 2, Mode::kPlain);
}

TEST(SdoBytes, SegmentedUpload) {
  const Line lines[] = {{true, {0x40, 0x08, 0x10, 0x00}},
                        {false, {0x41, 0x08, 0x10, 0x00, 0x1A, 0, 0, 0}},
                        {true, {0x60}},
                        {false, {0x00, 'T', 'i', 'n', 'y', ' ', 'N', 'o'}},
                        {true, {0x70}},
                        {false, {0x10, 'd', 'e', ' ', '-', ' ', 'M', 'e'}},
                        {true, {0x60}},
                        {false, {0x00, 'g', 'a', ' ', 'D', 'o', 'm', 'a'}},
                        {true, {0x70}},
                        {false, {0x15, 'i', 'n', 's', ' ', '!', 0, 0}}};
  expect_upload(lines, kName, "Tiny Node - Mega Domains !", 26, Mode::kPlain);
}

TEST(SdoBytes, SegmentedDownload) {
  const Line lines[] = {
      {true, {0x21, 0x00, 0x20, 0x00, 0x0D, 0, 0, 0}},   {false, {0x60, 0x00, 0x20, 0x00}},
      {true, {0x00, 'A', ' ', 'l', 'o', 'n', 'g', ' '}}, {false, {0x20}},
      {true, {0x13, 's', 't', 'r', 'i', 'n', 'g', 0}},   {false, {0x30}}};
  expect_download(lines, kText, "A long string", 13, Mode::kPlain);
}

TEST(SdoBytes, SegmentedDownloadOfNothing) {
  const Line lines[] = {{true, {0x21, 0x00, 0x20, 0x00}},
                        {false, {0x60, 0x00, 0x20, 0x00}},
                        {true, {0x0F}},
                        {false, {0x20}}};
  expect_download(lines, kText, "", 0, Mode::kPlain);
}

TEST(SdoBytes, BlockDownload) {
  const Line lines[] = {{true, {0xC6, 0x00, 0x20, 0x00, 0x1E, 0, 0, 0}},
                        {false, {0xA4, 0x00, 0x20, 0x00, 0x7F, 0, 0, 0}},
                        {true, {0x01, 'A', ' ', 'r', 'e', 'a', 'l', 'l'}},
                        {true, {0x02, 'y', ' ', 'r', 'e', 'a', 'l', 'l'}},
                        {true, {0x03, 'y', ' ', 'l', 'o', 'n', 'g', ' '}},
                        {true, {0x04, 's', 't', 'r', 'i', 'n', 'g', '.'}},
                        {true, {0x85, '.', '.', 0, 0, 0, 0, 0}},
                        {false, {0xA2, 0x05, 0x7F}},
                        {true, {0xD5, 0x45, 0x69}},
                        {false, {0xA1}}};
  expect_download(lines, kText, "A really really long string...", 30, Mode::kBlock);
}

TEST(SdoBytes, BlockUpload) {
  const Line lines[] = {{true, {0xA4, 0x08, 0x10, 0x00, 0x7F, 0, 0, 0}},
                        {false, {0xC6, 0x08, 0x10, 0x00, 0x1A, 0, 0, 0}},
                        {true, {0xA3}},
                        {false, {0x01, 'T', 'i', 'n', 'y', ' ', 'N', 'o'}},
                        {false, {0x02, 'd', 'e', ' ', '-', ' ', 'M', 'e'}},
                        {false, {0x03, 'g', 'a', ' ', 'D', 'o', 'm', 'a'}},
                        {false, {0x84, 'i', 'n', 's', ' ', '!', 0, 0}},
                        {true, {0xA2, 0x04, 0x7F}},
                        {false, {0xC9, 0x40, 0xE1}},
                        {true, {0xA1}}};
  expect_upload(lines, kName, "Tiny Node - Mega Domains !", 26, Mode::kBlock);
}

// Some devices give no size.
TEST(SdoBytes, ExpeditedUploadWithoutASizeFillsWhatWasAskedFor) {
  std::uint8_t buffer[8] = {};
  SdoClient client(2);
  EXPECT_TRUE(client.upload({0x1400, 2}, buffer, 1, Mode::kPlain, 0));
  const Line lines[] = {{true, {0x40, 0x00, 0x14, 0x02}},
                        {false, {0x42, 0x00, 0x14, 0x02, 0xFE, 0, 0, 0}}};
  play(client, true, lines, 2);
  EXPECT_TRUE(client.state() == State::kDone);
  EXPECT_EQ(client.size(), 1u);
  EXPECT_EQ(buffer[0], 0xFE);
}

TEST(SdoBytes, CrcIsXmodems) {
  EXPECT_EQ(sdo::crc16(bytes_of("123456789"), 9), 0x31C3);
  EXPECT_EQ(sdo::crc16(bytes_of("6789"), 4, sdo::crc16(bytes_of("12345"), 5)), 0x31C3);
  EXPECT_EQ(sdo::crc16(nullptr, 0), 0);
}

}  // namespace
}  // namespace verp::canopen
