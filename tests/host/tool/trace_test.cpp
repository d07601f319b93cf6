#include <fstream>
#include <nlohmann/json.hpp>

#include "common/model/image.hpp"
#include "host/trace/record/compression.hpp"
#include "host/trace/record/trace.hpp"
#include "host/trace/record/trace_writer.hpp"
#include "tests/host/tool/program.hpp"
#include "tests/support/mcap_file.hpp"

namespace verp::tool::test {
namespace {

class TraceCommand : public Program {
 protected:
  void SetUp() override { ASSERT_EQ(verp("walk --for 3 --json --record a.mcap").status, 0); }
};

TEST_F(TraceCommand, PlotDrawsSignalsThatAreNamedAndHelpsWithThoseThatAreNot) {
  const std::string list = verp("trace plot a.mcap --list").out;
  EXPECT_EQ(list.rfind("tick\ntime_s\n", 0), 0u);
  EXPECT_NE(list.find("\ngoal_rad.l_knee\n"), std::string::npos);
  EXPECT_NE(list.find("\nstate.gait."), std::string::npos);

  const std::string knee = "trace plot a.mcap --signal '*rad.l_knee' --signal mode ";
  const Outcome png = verp(knee + "--from 1 --to 2 -o knee.png");
  EXPECT_EQ(png.out, "knee.png\n") << png.err;
  EXPECT_EQ(png.err, "");
  EXPECT_TRUE(slurp(folder_ / "knee.png").starts_with("\x89PNG"));
  ASSERT_EQ(verp(knee + "-o knee.svg").status, 0);
  const std::string svg = slurp(folder_ / "knee.svg");
  EXPECT_TRUE(svg.starts_with("<?xml"));
  for (const char* name : {">rad.l_knee<", ">goal_rad.l_knee<", ">mode<"}) {
    EXPECT_NE(svg.find(name), std::string::npos) << name;
  }

  expect_refused("trace plot a.mcap --signal rad.l_kne -o a.png", "did you mean rad.l_knee?");
  expect_refused("trace plot a.mcap --signal 'x*' -o a.png", "--list prints them");
  expect_refused("trace plot a.mcap -o a.png", "name what to draw with --signal");
  expect_refused("trace plot a.mcap --signal mode --from 1 --to 1 -o a.png", "a line needs two");
  expect_refused(knee, "name the picture with -o");
  expect_refused(knee + "-o a.jpg", "a.jpg: pictures end in .png or .svg");
  expect_refused(knee + "-o a.png --from 60", "it begins at 0 s and ends at");
  expect_refused(knee + "-o a.png --from -1", "0 to");
  expect_refused(knee + "-o none/a.png", "none/a.png: cannot be written");
  expect_refused("trace plot a.mcap --signal 'state.*' -o a.png", "name fewer");
  expect_refused("trace plot none.mcap --list", "none.mcap: no such file");
  EXPECT_EQ(shell("PATH=/nowhere " VERP_PROGRAM " " + knee + "-o b.png").status, 3);

  // An alias.
  EXPECT_EQ(verp("trace csv a.mcap --state").out, verp("trace export a.mcap --state").out);
  EXPECT_NE(verp("trace --help").out.find("export, csv "), std::string::npos);
  EXPECT_NE(verp("completion bash").out.find("'trace csv') words='"), std::string::npos);
}

// Cores differ by design, even in a recovered trace.
TEST_F(TraceCommand, DiffSaysWhenTwoCoresRecorded) {
  const record::Trace trace = record::read_trace(folder_ / "a.mcap");
  const std::string own = record::core_of(trace);
  EXPECT_EQ(own, std::to_string(kCoreVersion));
  {
    record::TraceWriter other(folder_ / "b.mcap", trace.params, {{"core_version", "7"}});
    for (TickRecord tick : trace.ticks) {
      tick.digest.chain ^= tick.inputs.tick > 300 ? 1 : 0;
      other.append(tick, State{}, Outputs{});
    }
    other.close();
  }
  const Outcome told = verp("diff a.mcap b.mcap");
  EXPECT_EQ(told.status, 1);
  EXPECT_NE(told.out.find("; A is of core " + own + " and B of core 7, which"), std::string::npos)
      << told.out;
  ASSERT_EQ(verp("trace recover b.mcap -o c.mcap").status, 0);
  const nlohmann::json recovered = nlohmann::json::parse(verp("diff a.mcap c.mcap --json").out);
  EXPECT_EQ(recovered.at("core_a"), own);
  EXPECT_EQ(recovered.at("core_b"), "7");
  EXPECT_NE(verp("replay b.mcap").err.find(" with core 7, this is "), std::string::npos);
}

TEST_F(TraceCommand, ACutReplaysAndEveryCommandTakesIt) {
  const Outcome made = verp("trace cut a.mcap --from 8 --to 9 -o part.mcap");
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.out.find("; begins 0."), std::string::npos) << made.out;
  EXPECT_NE(made.out.find(" at the last State that was kept"), std::string::npos) << made.out;
  EXPECT_EQ(verp("replay part.mcap").status, 0);
  EXPECT_NE(verp("trace info part.mcap").out.find("cut_from: a.mcap"), std::string::npos);
  const std::string csv = verp("trace csv part.mcap --state").out;
  EXPECT_NE(verp("trace csv a.mcap --state").out.find(csv.substr(csv.find('\n', 1) + 1, 200)),
            std::string::npos);
  EXPECT_EQ(verp("trace recover part.mcap -o mended.mcap").status, 0);
  EXPECT_EQ(verp("replay mended.mcap").status, 0);
  EXPECT_EQ(verp("diff part.mcap mended.mcap").status, 0);
  expect_refused("trace cut a.mcap --from 60 -o b.mcap", "it begins at 0 s and ends at");
  expect_refused("trace cut a.mcap -o b.mcap", "give --from, --to, or both");
  expect_refused("trace cut a.mcap --to 3 -o a.mcap", "that is the trace itself");
  ASSERT_EQ(verp("trace cut a.mcap --from 0 --compress -o small.mcap").status, 0);
  EXPECT_LT(3 * fs::file_size(folder_ / "small.mcap"), fs::file_size(folder_ / "a.mcap"));
  EXPECT_EQ(verp("diff a.mcap small.mcap").status, 0);
  const Outcome merged = verp("trace merge lead=a.mcap part.mcap -o both.mcap");
  EXPECT_EQ(merged.out.rfind("both.mcap: 2 robots, ", 0), 0u) << merged.err;
  expect_refused("trace info both.mcap", "several robots' traces as one");
  expect_refused("trace merge a.mcap ./a.mcap -o b.mcap", "two robots called a");
  expect_refused("trace merge a.mcap part.mcap -o part.mcap", "that is the trace itself");
  expect_refused("trace merge a.mcap -o b.mcap", "two traces or more");
  expect_refused("compare a.mcap part.mcap", "begins in the midst of a walk");
  expect_refused("debug --board mps2_an386 part.mcap", "begins in the midst of a run");
}

// Under right CRCs: what nobody's writer would write.
TEST_F(TraceCommand, AMessageOfNoChannelOrAChunkOfGigabytesIsOneLine) {
  using namespace record::mcap;
  const std::string bytes = slurp(folder_ / "a.mcap");
  const std::string bomb = record::mcap::packed(std::string(65u << 20, '\0'));
  for (const auto& [content, says] :
       {std::pair(with_chunk(bytes, message_record(700, "x")),
                  "channel 700, which nothing declares"),
        std::pair(with_chunk(bytes, bomb, kZstdName, 65u << 20), "the most is 67108864")}) {
    std::ofstream(folder_ / "bad.mcap", std::ios::binary) << content;
    for (const char* words :
         {"trace info bad.mcap", "trace cut bad.mcap --from 1 -o b.mcap",
          "trace merge a.mcap bad.mcap -o b.mcap", "trace pictures bad.mcap -o pictures",
          "trace play bad.mcap --live 0", "trace csv bad.mcap", "replay bad.mcap"}) {
      expect_refused(words, says);
    }
  }
  EXPECT_FALSE(fs::exists(folder_ / "b.mcap"));
}

TEST_F(Program, AKilledWalkLeavesAFileThatOpens) {
  const Outcome killed = shell(
      VERP_PROGRAM
      " walk --for 600 --json --record k.mcap & "
      "for i in $(seq 3000); do "
      "  test $(cat k.mcap.*.part 2>/dev/null | wc -c) -ge 700000 && break; sleep 0.02; done; "
      "kill -KILL $!; wait $!; echo $?; ls");
  ASSERT_TRUE(killed.out.starts_with("137\nk.mcap.")) << killed.out;
  expect_refused("trace info k.mcap.*.part", "ticks before it are whole");
  const Outcome info = verp("trace info k.mcap.*.part --recover --json");
  EXPECT_EQ(info.status, 0) << info.err;
  EXPECT_GT(nlohmann::json::parse(info.out).at("ticks"), 124);
  EXPECT_EQ(verp("replay k.mcap.*.part --recover").status, 0);
  EXPECT_EQ(verp("trace recover k.mcap.*.part -o k.mcap").status, 0);
  EXPECT_EQ(verp("replay k.mcap").status, 0);
}

void damage(const fs::path& trace, std::streamoff at) {
  std::fstream file(trace, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(at);
  file << "XXXX";
}

TEST_F(TraceCommand, ATraceWhoseFirstChunkIsDamagedIsSaidToBeRecoverableAndIs) {
  damage(folder_ / "a.mcap", 100'000);
  expect_refused("trace info a.mcap", "`verp trace recover` keeps what is whole");
  const Outcome kept = verp("trace recover a.mcap -o b.mcap");
  EXPECT_EQ(kept.status, 0) << kept.err;
  EXPECT_NE(kept.err.find("left out: 1 damaged record"), std::string::npos) << kept.err;
  EXPECT_EQ(verp("trace info b.mcap").status, 0);
}

TEST_F(TraceCommand, NothingIsPromisedOfATraceWhoseRobotIsDamaged) {
  const std::string bytes = slurp(folder_ / "a.mcap");
  damage(folder_ / "a.mcap", static_cast<std::streamoff>(bytes.find("params")) + 200);
  for (const char* words : {"trace info a.mcap", "trace recover a.mcap -o b.mcap"}) {
    const Outcome outcome = verp(words);
    EXPECT_EQ(outcome.status, 2) << words;
    EXPECT_NE(outcome.err.find("record the run again"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("keeps"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace verp::tool::test
