#include <sys/resource.h>

#include <algorithm>

#include "host/trace/record/compression.hpp"
#include "host/trace/record/in_order.hpp"
#include "host/trace/record/mcap_writer.hpp"
#include "tests/host/record/sample.hpp"
#include "tests/support/mcap_file.hpp"

namespace verp::record::test {
namespace {

using Mcap = TraceFolder;

std::string small_file(const fs::path& path,
                       mcap::Compression compression = mcap::Compression::kNone) {
  mcap::Writer writer(path, "", "test", compression);
  writer.add_metadata("facts", {{"one", "1"}, {"two", "2"}});
  writer.add_attachment("blob", "application/octet-stream", "payload");
  const auto channel =
      writer.add_channel(writer.add_schema("Number", "text", "a number"), "/n", "raw");
  for (unsigned i = 0; i < 6; ++i) {
    writer.add_message(channel, 1000 * i, "message " + std::to_string(i) + std::string(90, '.'));
    if (i % 2 == 1) writer.flush();
  }
  writer.close();
  return slurp(path);
}

TEST(Crc32, AgreesWithItsCatalogueEntry) {
  EXPECT_EQ(mcap::crc32("123456789"), 0xCBF43926u);
  EXPECT_EQ(mcap::crc32("6789", mcap::crc32("12345")), 0xCBF43926u);
}

TEST_F(Mcap, ReadsBackWhatItWrote) {
  const std::string bytes = small_file(folder_ / "a.mcap");
  const mcap::WholeFile file = mcap::parse(bytes);
  ASSERT_FALSE(file.flaw) << file.flaw->what;
  EXPECT_EQ(file.library, "test");
  EXPECT_EQ(file.metadata.at("facts").at("two"), "2");
  EXPECT_EQ(file.attachments.at("blob").data, "payload");
  ASSERT_EQ(file.messages.size(), 6u);
  EXPECT_EQ(file.messages[5].data, "message 5" + std::string(90, '.'));
  EXPECT_EQ(file.messages[5].time_ns, 5000u);
  EXPECT_EQ(file.messages[5].sequence, 5u);
  std::uint16_t id = 9;
  ASSERT_NE(file.find_channel("/n", id), nullptr);
  EXPECT_EQ(file.schemas.at(file.channels.at(id).schema).data, "a number");
}

TEST_F(Mcap, CompressedHoldsTheSameInLess) {
  const std::string plain = small_file(folder_ / "a.mcap");
  const std::string bytes = small_file(folder_ / "b.mcap", mcap::Compression::kZstd);
  EXPECT_LT(bytes.size(), plain.size() - 3 * 90);
  const mcap::WholeFile file = mcap::parse(bytes), same = mcap::parse(plain);
  ASSERT_FALSE(file.flaw) << file.flaw->what;
  ASSERT_EQ(file.messages.size(), same.messages.size());
  for (std::size_t i = 0; i < file.messages.size(); ++i) {
    EXPECT_EQ(file.messages[i].data, same.messages[i].data);
    EXPECT_EQ(file.messages[i].time_ns, same.messages[i].time_ns);
  }
  // It would not shrink.
  std::string noise(4000, '\0');
  std::uint32_t drawn = 1;
  for (char& c : noise) c = static_cast<char>((drawn = 1664525 * drawn + 1013904223) >> 24);
  {
    mcap::Writer writer(folder_ / "c.mcap", "", "test", mcap::Compression::kZstd);
    const auto channel = writer.add_channel(writer.add_schema("N", "text", ""), "/n", "raw");
    writer.add_message(channel, 0, noise);
    writer.close();
  }
  EXPECT_EQ(slurp(folder_ / "c.mcap").find(mcap::kZstdName), std::string::npos);
  EXPECT_FALSE(mcap::parse(slurp(folder_ / "c.mcap")).flaw);
}

class McapOf : public TraceFolder, public ::testing::WithParamInterface<mcap::Compression> {};
INSTANTIATE_TEST_SUITE_P(EachCompression, McapOf,
                         ::testing::Values(mcap::Compression::kNone, mcap::Compression::kZstd));

TEST_P(McapOf, EveryTruncationIsSeenAndWholeMessagesSurvive) {
  const std::string bytes = small_file(folder_ / "a.mcap", GetParam());
  std::size_t most = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const mcap::WholeFile file = mcap::parse(std::string_view(bytes).substr(0, size));
    ASSERT_TRUE(file.flaw) << "cut to " << size;
    EXPECT_TRUE(file.flaw->truncated) << "cut to " << size << ": " << file.flaw->what;
    EXPECT_LE(file.flaw->offset, size);
    EXPECT_GE(file.messages.size(), most) << "a longer file gave fewer messages at " << size;
    most = std::max(most, file.messages.size());
  }
  EXPECT_EQ(most, 6u);
}

TEST_P(McapOf, EveryEditedByteIsSeen) {
  std::string bytes = small_file(folder_ / "a.mcap", GetParam());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int flip : {0x01, 0x80, 0xFF}) {
      const char kept = bytes[i];
      bytes[i] = static_cast<char>(bytes[i] ^ flip);
      EXPECT_TRUE(mcap::parse(bytes).flaw) << "byte " << i << " flipped by " << flip;
      bytes[i] = kept;
    }
  }
}

TEST_F(Mcap, BytesAfterTheEndAreSeen) {
  EXPECT_TRUE(mcap::parse(small_file(folder_ / "a.mcap") + "x").flaw);
}

TEST_P(McapOf, ATruncationLosesNoWholeMessage) {
  const std::string bytes = small_file(folder_ / "a.mcap", GetParam());
  for (unsigned i = 0; i < 6; ++i) {
    const std::string last = "message " + std::to_string(i) + std::string(90, '.');
    const std::size_t end = bytes.find(last) + last.size();
    if (GetParam() == mcap::Compression::kZstd) continue;  // its chunks are whole or lost
    EXPECT_EQ(mcap::parse(bytes.substr(0, end)).messages.size(), i + 1);
    EXPECT_EQ(mcap::parse(bytes.substr(0, end - 1)).messages.size(), i);
  }
  const mcap::WholeFile almost = mcap::parse(bytes.substr(0, bytes.size() - 1));
  EXPECT_TRUE(almost.data_whole);
  EXPECT_EQ(almost.messages.size(), 6u);
}

// Under right CRCs.
TEST_F(Mcap, WhatNothingDeclaresIsAFlaw) {
  const std::string bytes = small_file(folder_ / "a.mcap");
  EXPECT_FALSE(mcap::parse(mcap::with_chunk(bytes, mcap::message_record(0, "x"))).flaw);
  const auto flaw_of = [&](const std::string& records) {
    const mcap::WholeFile file = mcap::parse(mcap::with_chunk(bytes, records));
    EXPECT_EQ(file.messages.size(), 6u);
    return file.flaw.value_or(mcap::Flaw{}).what;
  };
  EXPECT_EQ(flaw_of(mcap::message_record(7, "x")),
            "a message of channel 7, which nothing declares");
  const auto channel = [](std::uint16_t id, std::uint16_t schema, const char* topic) {
    return mcap::Bytes()
        .record(mcap::Opcode::kChannel,
                mcap::Bytes().u16(id).u16(schema).text(topic).text("raw").map({}).data)
        .data;
  };
  EXPECT_EQ(flaw_of(channel(3, 9, "/m")), "channel 3 has a schema that nothing declares");
  EXPECT_EQ(flaw_of(channel(0, 1, "/other")), "number 0 is declared twice, each time otherwise");
}

// A kB of zstd can be 32 MB.
TEST_F(Mcap, WhatUnpacksToTooMuchIsRefusedByANumber) {
  const std::string bytes = small_file(folder_ / "a.mcap");
  const std::string bomb = mcap::packed(std::string(65u << 20, '\0'));
  ASSERT_LT(bomb.size(), 20'000u);
  const auto flaw_of = [&](std::uint64_t size) {
    const auto file = mcap::parse(mcap::with_chunk(bytes, bomb, mcap::kZstdName, size));
    return file.flaw.value_or(mcap::Flaw{}).what;
  };
  EXPECT_EQ(flaw_of(65u << 20), "a chunk takes 68157440 bytes, and the most is 67108864");
  EXPECT_EQ(flaw_of(1000),
            "edited or damaged: a compressed chunk is not the 1000 bytes that it says");
  std::string record = bytes.substr(0, 8);
  record += mcap::Bytes().u8(5).u64(mcap::kMostRecord + 1).data;
  spit(folder_ / "long.mcap", record);
  fs::resize_file(folder_ / "long.mcap", record.size() + mcap::kMostRecord + 1);
  mcap::Reader reader(std::make_unique<std::ifstream>(folder_ / "long.mcap", std::ios::binary));
  EXPECT_EQ(reader.read().flaw->what, "a record takes 67108865 bytes, and the most is 67108864");
}

long peak_kB() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

TEST_F(Mcap, AFileIsReadInTheRoomOfAChunk) {
  constexpr int kMessages = 24;
  {
    mcap::Writer writer(folder_ / "a.mcap", "", "test");
    const auto channel = writer.add_channel(writer.add_schema("N", "text", ""), "/n", "raw");
    for (int i = 0; i < kMessages; ++i) {
      writer.add_message(channel, static_cast<std::uint64_t>(i), std::string(1 << 20, 'x'));
      writer.flush();
    }
    writer.close();
  }
  const long before = peak_kB();
  mcap::Reader reader(std::make_unique<std::ifstream>(folder_ / "a.mcap", std::ios::binary));
  EXPECT_FALSE(reader.read().flaw);
  InOrder messages({{folder_ / "a.mcap", &reader}});
  int count = 0;
  while (messages.next()) ++count;
  EXPECT_EQ(count, kMessages);
  EXPECT_LT(peak_kB() - before, 12 << 10);
}

TEST_F(Mcap, MessagesOfSomeFilesComeInOrderThoughTheirChunksOverlap) {
  std::vector<std::pair<std::uint64_t, std::string>> wanted;
  std::vector<mcap::Reader> readers;
  std::uint32_t drawn = 1;
  for (const char* name : {"a", "b"}) {
    mcap::Writer writer(folder_ / name, "", "test");
    const auto channel = writer.add_channel(writer.add_schema("N", "text", ""), "/n", "raw");
    for (std::uint64_t i = 0; i < 200; ++i) {
      drawn = 1664525 * drawn + 1013904223;
      const std::uint64_t time_ns = i * 10 + drawn % 90 / 10 * 10;  // some are late, some equal
      const std::string data = name + std::to_string(i);
      writer.add_message(channel, time_ns, data);
      wanted.emplace_back(time_ns, data);
      if (i % 7 == 6) writer.flush();
    }
    writer.close();
    readers.emplace_back(std::make_unique<std::ifstream>(folder_ / name, std::ios::binary));
    readers.back().read();
  }
  std::stable_sort(wanted.begin(), wanted.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  InOrder messages({{folder_ / "a", &readers[0]}, {folder_ / "b", &readers[1]}});
  std::vector<std::pair<std::uint64_t, std::string>> got;
  while (const auto next = messages.next())
    got.emplace_back(next->message.time_ns, next->message.data);
  EXPECT_EQ(got, wanted);
}

TEST_F(Mcap, FileHasItsNameOnlyWhenWhole) {
  const fs::path path = folder_ / "a.mcap";
  fs::path part;
  {
    mcap::Writer writer(path, "", "test");
    part = writer.part_path();
    EXPECT_FALSE(fs::exists(path));
    EXPECT_TRUE(fs::exists(part));
    writer.close();
  }
  EXPECT_TRUE(fs::exists(path));
  EXPECT_FALSE(fs::exists(part));
}

TEST_F(Mcap, TwoWritersOfOnePathNeverMix) {
  const fs::path path = folder_ / "a.mcap";
  mcap::Writer first(path, "", "first"), second(path, "", "second");
  first.add_metadata("who", {{"is", "first"}});
  second.add_metadata("who", {{"is", "second"}});
  second.close();
  first.close();
  const std::string bytes = slurp(path);
  const mcap::WholeFile file = mcap::parse(bytes);
  ASSERT_FALSE(file.flaw);
  EXPECT_EQ(file.metadata.at("who").at("is"), "first");
}

TEST_F(Mcap, UnwritablePlaceIsOneClearError) {
  try {
    mcap::Writer writer(folder_ / "missing" / "a.mcap", "", "test");
    FAIL() << "must throw";
  } catch (const TraceError& error) {
    EXPECT_NE(std::string(error.what()).find("a.mcap"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("choose a folder"), std::string::npos);
  }
}

}  // namespace
}  // namespace verp::record::test
