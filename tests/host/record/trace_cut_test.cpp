#include "host/trace/record/trace_cut.hpp"

#include "host/trace/record/replay.hpp"
#include "tests/host/record/sample.hpp"
#include "tests/support/mcap_file.hpp"

namespace verp::record::test {
namespace {

class TraceCut : public TraceFolder {
 protected:
  TraceCut() { write_run(whole_, 700); }
  Cut cut(std::optional<double> from_s, std::optional<double> to_s) const {
    return cut_trace(whole_, from_s, to_s, part_);
  }
  const fs::path whole_ = folder_ / "whole.mcap", part_ = folder_ / "part.mcap";
};

TEST_F(TraceCut, IsATraceThatReplaysToTheSameBits) {
  const Trace whole = read_trace(whole_);
  struct Row {
    std::optional<double> from_s, to_s;
    std::size_t first, last;
  };
  for (const Row& row : {Row{3.0, 4.2, 251, 420}, Row{2.51, 2.51, 251, 251}, Row{2.5, 6, 126, 600},
                         Row{{}, 4, 0, 400}, Row{6.5, {}, 626, 699}}) {
    const Cut made = cut(row.from_s, row.to_s);
    const Trace part = read_trace(part_);
    ASSERT_EQ(part.ticks.size(), row.last - row.first + 1);
    EXPECT_EQ(made.ticks, part.ticks.size());
    EXPECT_EQ(made.from_state, row.first > 0);
    EXPECT_EQ(part.before.has_value(), row.first > 0);
    for (std::size_t i = 0; i < part.ticks.size(); ++i) {
      ASSERT_TRUE(diff_fields(part.ticks[i], whole.ticks[row.first + i]).empty()) << i;
    }
    EXPECT_FALSE(replay(part).divergence) << row.first;
    EXPECT_EQ(part.digest(), whole.ticks[row.last].digest.chain);
  }
  const fs::path again = folder_ / "again.mcap";
  ASSERT_EQ(cut(3.0, 6.0).first_tick, 251u);
  EXPECT_FALSE(cut_trace(part_, 3.0, 3.5, again).from_state) << "the one before its first tick";
  EXPECT_FALSE(replay(read_trace(again)).divergence);
  EXPECT_TRUE(cut_trace(part_, 5.5, 5.9, again).from_state);
  EXPECT_FALSE(replay(read_trace(again)).divergence);
  EXPECT_EQ(read_trace(again).ticks.front().inputs.tick, 501u);
}

TEST_F(TraceCut, KeepsEveryMessageOfItsTime) {
  {
    TraceWriter writer(whole_, sample_params(), {});
    for (std::uint32_t tick = 0; tick < 300; ++tick) {
      writer.append(record_of(sample_inputs(tick)), State{}, Outputs{});
      if (tick % 10 == 0) writer.append("laser", tick, ros::LaserScan{});
      if (tick == 130) writer.note(tick, "pushed");
    }
    writer.append("laser", 150, ros::LaserScan{});  // late, like a picture
    writer.close({{"failure", "fell"}});
  }
  cut(1.3, 2.0);
  const std::string bytes = slurp(part_);
  const mcap::WholeFile file = mcap::parse(bytes);
  ASSERT_FALSE(file.flaw) << file.flaw->what;
  std::map<std::string, int> messages;
  for (const mcap::Message& each : file.messages) {
    ++messages[std::string(file.channels.at(each.channel).topic)];
    EXPECT_GE(each.time_ns, 1'260'000'000u);
    EXPECT_LE(each.time_ns, 2'000'000'000u);
  }
  EXPECT_EQ(messages["/verp/tick"], 75);
  EXPECT_EQ(messages["/joint_states"], 75);
  EXPECT_EQ(messages["/laser"], 8 + 1);
  EXPECT_EQ(messages["/verp/changed"], 1);
  EXPECT_EQ(messages["/robot_description"], 1);
  EXPECT_FALSE(file.metadata.contains("result")) << "of the whole";
  EXPECT_EQ(read_trace(part_).metadata.at("cut_from"), whole_.string());
}

TEST_F(TraceCut, RefusesWhatItCannotReplayAndLeavesNothing) {
  EXPECT_THROW(cut(60, {}), TraceError);
  EXPECT_THROW(cut_trace(whole_, 1, 2, folder_ / "none" / "a.mcap"), TraceError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

// The other revision's State is unknown here.
TEST_F(TraceCut, OfAnotherRevisionIsRefusedByName) {
  const Params params = sample_params();
  {
    mcap::Writer writer(part_, "", "verp");
    writer.add_metadata(kMetadataName, {{"format", kTraceFormat}, {"source_revision", "abc123"}});
    writer.add_attachment(kParamsAttachment, "",
                          {reinterpret_cast<const char*>(&params), sizeof params});
    writer.add_attachment(kStateAttachment, "", std::string(sizeof(State), '\0'));
    writer.add_attachment(kStateLayoutAttachment, "", "# State: other fields");
    writer.close();
  }
  try {
    read_trace(part_);
    FAIL() << "must throw";
  } catch (const TraceError& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find("begins in the midst of a run"), std::string::npos) << line;
    EXPECT_NE(line.find("revision abc123"), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace verp::record::test
