#include "host/trace/record/trace_recover.hpp"

#include <set>
#include <vector>

#include "host/trace/record/replay.hpp"
#include "host/trace/record/trace_cut.hpp"
#include "tests/host/record/sample.hpp"
#include "tests/support/mcap_file.hpp"

namespace verp::record::test {
namespace {

constexpr std::uint64_t kInContent = 200;  ///< into a chunk, behind its head

class DamagedTrace : public TraceFolder {
 protected:
  void record(bool compress, bool every_state = false) {
    write_run(file_, 40, {.every_state = every_state, .chunk_ticks = 8, .compress = compress});
    take_apart();
    ASSERT_EQ(chunks_.size(), 5u);
  }
  void take_apart() {
    bytes_ = slurp(file_);
    whole_ = mcap::parse(bytes_);
    std::set<std::uint64_t> parts;
    for (const mcap::Message& each : whole_.messages) {
      if (whole_.channels.at(each.channel).topic == kTickTopic) parts.insert(each.part);
    }
    chunks_.assign(parts.begin(), parts.end());
  }
  void flip(std::uint64_t at) { bytes_[at] = static_cast<char>(bytes_[at] ^ 0x40); }
  Recovered recover() {
    spit(file_, bytes_);
    return recover_trace(file_, mended_);
  }
  /// The recovered trace has all messages but those of these chunks.
  void expect_all_but(const std::set<std::uint64_t>& lost) const {
    const mcap::WholeFile made = mcap::parse(slurp(mended_));
    ASSERT_FALSE(made.flaw) << made.flaw->what;
    std::size_t i = 0;
    for (const mcap::Message& each : whole_.messages) {
      if (lost.contains(each.part)) continue;
      ASSERT_LT(i, made.messages.size());
      const mcap::Message& got = made.messages[i++];
      EXPECT_EQ(got.data, each.data);
      EXPECT_EQ(got.time_ns, each.time_ns);
      EXPECT_EQ(made.channels.at(got.channel).topic, whole_.channels.at(each.channel).topic);
    }
    EXPECT_EQ(i, made.messages.size());
    for (const auto& [name, attachment] : whole_.attachments)
      EXPECT_EQ(made.attachments.at(name).data, attachment.data) << name;
  }
  static bool says(const Recovered& recovered, const std::string& what) {
    return recovered.warning.find(what) != std::string::npos;
  }

  const fs::path file_ = folder_ / "run.mcap", mended_ = folder_ / "mended.mcap";
  std::string bytes_;
  mcap::WholeFile whole_;
  std::vector<std::uint64_t> chunks_;  ///< with ticks
};

TEST_F(DamagedTrace, RecoverKeepsWhatStandsBeforeAndBehindADamagedChunk) {
  for (const bool compress : {false, true}) {
    record(compress);
    flip(chunks_[2] + kInContent);
    const Recovered recovered = recover();
    expect_all_but({chunks_[2]});
    EXPECT_EQ(recovered.ticks, 32u);
    EXPECT_EQ(recovered.left_out.records, 1u);
    EXPECT_EQ(recovered.left_out.messages, 0u);
    EXPECT_GT(recovered.left_out.bytes, 300u);
    EXPECT_LT(recovered.left_out.bytes, chunks_[3] - chunks_[2]);
    EXPECT_TRUE(says(recovered, "byte " + std::to_string(chunks_[2]))) << recovered.warning;
    EXPECT_TRUE(says(recovered, "left out: 1 damaged record of " +
                                    std::to_string(recovered.left_out.bytes) + " bytes"))
        << recovered.warning;
    EXPECT_EQ(mcap::parse(slurp(mended_)).metadata.at("result").at("recovered_damage"),
              recovered.warning);
  }
}

TEST_F(DamagedTrace, RecoverKeepsWhatStandsBetweenDamagedChunks) {
  record(false);
  for (const int each : {1, 3}) flip(chunks_[static_cast<std::size_t>(each)] + kInContent);
  const Recovered recovered = recover();
  expect_all_but({chunks_[1], chunks_[3]});
  EXPECT_TRUE(says(recovered, "2 damaged records")) << recovered.warning;
}

// The first chunk declares the channels; the summary repeats that.
TEST_F(DamagedTrace, RecoverKnowsTheChannelsThatADamagedChunkDeclared) {
  for (const bool compress : {false, true}) {
    record(compress);
    flip(chunks_[0] + kInContent);
    const Recovered recovered = recover();
    expect_all_but({chunks_[0]});
    EXPECT_EQ(recovered.left_out.messages, 0u);
  }
}

TEST_F(DamagedTrace, RecoverCountsMessagesOfChannelsThatNothingDeclares) {
  {
    TraceWriter writer(file_, sample_params(), {}, {.ros = true, .chunk_ticks = 8});
    for (std::uint32_t tick = 0; tick < 40; ++tick) {
      if (tick >= 8) writer.append("/late", {"sensor_msgs/msg/CompressedImage", ""}, tick, "x");
      writer.append(record_of(sample_inputs(tick)), State{}, Outputs{});
    }
    writer.close();
  }
  take_apart();
  flip(chunks_[1] + kInContent);
  bytes_.resize(chunks_[4]);  // a crash: no summary
  const Recovered recovered = recover();
  EXPECT_EQ(recovered.ticks, 24u);
  EXPECT_GE(recovered.left_out.messages, 15u);
  EXPECT_TRUE(says(recovered, std::to_string(recovered.left_out.messages) +
                                  " messages of channels that only they declare"))
      << recovered.warning;
}

TEST_F(DamagedTrace, RecoverOfADamagedLengthSaysWhereItEnds) {
  record(false);
  flip(chunks_[1] + kInContent);
  bytes_[chunks_[3] + 4] = 1;  // its length: 16 MB more
  const Recovered recovered = recover();
  expect_all_but({chunks_[1], chunks_[3], chunks_[4]});
  EXPECT_TRUE(says(recovered, "left out: 1 damaged record")) << recovered.warning;
  EXPECT_TRUE(says(recovered, "ends at byte " + std::to_string(chunks_[3]))) << recovered.warning;
}

TEST_F(DamagedTrace, RecoverDoesNotBelieveALengthBehindWhichNothingBegins) {
  record(false);
  flip(chunks_[2] + 1);  // 64 bytes more or less
  const Recovered recovered = recover();
  expect_all_but({chunks_[2], chunks_[3], chunks_[4]});
  EXPECT_EQ(recovered.left_out.records, 0u);
  EXPECT_TRUE(says(recovered, "byte " + std::to_string(chunks_[2]))) << recovered.warning;
}

TEST_F(DamagedTrace, RecoverGoesOnToATruncation) {
  record(false);
  flip(chunks_[1] + kInContent);
  bytes_.resize(chunks_[4] + kInContent);
  const Recovered recovered = recover();
  EXPECT_GE(recovered.ticks, 24u);
  EXPECT_TRUE(says(recovered, "left out: 1 damaged record")) << recovered.warning;
  EXPECT_TRUE(says(recovered, "the file ends inside a record")) << recovered.warning;
}

TEST_F(DamagedTrace, APartBehindTheGapReplays) {
  record(false, true);
  flip(chunks_[2] + kInContent);
  recover();
  const Trace mended = read_trace(mended_);
  const auto gap = replay(mended).divergence;
  ASSERT_TRUE(gap);
  EXPECT_EQ(gap->index, 16u) << "the bits hold up to the gap";
  const double from_s = 30 * mended.period_s();
  cut_trace(mended_, from_s, std::nullopt, folder_ / "part.mcap");
  const Trace part = read_trace(folder_ / "part.mcap");
  EXPECT_GE(part.ticks.size(), 10u);
  EXPECT_FALSE(replay(part).divergence);
}

TEST_F(DamagedTrace, OtherCommandsStopAtTheFirstDamage) {
  record(false);
  flip(chunks_[2] + kInContent);
  spit(file_, bytes_);
  EXPECT_EQ(read_trace(file_, Read::kRecover).ticks.size(), 16u) << "a replay needs each tick";
}

}  // namespace
}  // namespace verp::record::test
