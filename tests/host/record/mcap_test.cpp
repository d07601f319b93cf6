#include "host/trace/record/compression.hpp"
#include "host/trace/record/mcap_reader.hpp"
#include "host/trace/record/mcap_writer.hpp"
#include "tests/host/record/sample.hpp"

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
  const mcap::File file = mcap::parse(bytes);
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
  const mcap::File file = mcap::parse(bytes), same = mcap::parse(plain);
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

TEST_P(McapOf, EveryTruncationIsSeenAndWholeChunksSurvive) {
  const std::string bytes = small_file(folder_ / "a.mcap", GetParam());
  std::size_t most = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const mcap::File file = mcap::parse(std::string_view(bytes).substr(0, size));
    ASSERT_TRUE(file.flaw) << "cut to " << size;
    EXPECT_TRUE(file.flaw->truncated) << "cut to " << size << ": " << file.flaw->what;
    EXPECT_LE(file.flaw->offset, size);
    EXPECT_EQ(file.messages.size() % 2, 0u) << "half a chunk was taken at " << size;
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
  const mcap::File file = mcap::parse(bytes);
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
