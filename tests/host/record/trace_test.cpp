#include "host/trace/record/trace.hpp"

#include <cmath>
#include <limits>

#include "host/trace/record/replay.hpp"
#include "host/trace/record/trace_recover.hpp"
#include "tests/host/record/sample.hpp"
#include "tests/support/mcap_file.hpp"

namespace verp::record::test {
namespace {

using TraceFile = TraceFolder;

std::string error_of(const fs::path& file) {
  try {
    read_trace(file);
  } catch (const TraceError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
    EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << "names the file";
    EXPECT_NE(std::string(error.what()).find("; "), std::string::npos) << "gives a remedy";
    return error.what();
  }
  return "";
}

Outputs with_faults(std::uint32_t faults) {
  Outputs outputs;
  outputs.faults = faults;
  return outputs;
}

TEST_F(TraceFile, RoundTripKeepsEveryBit) {
  const fs::path file = folder_ / "run.mcap";
  write_run(file, 300);
  const Trace trace = read_trace(file);
  const Trace expected = sample_run(300);
  ASSERT_EQ(trace.ticks.size(), 300u);
  for (std::size_t i = 0; i < 300; ++i) {
    EXPECT_TRUE(diff_fields(trace.ticks[i], expected.ticks[i]).empty()) << "tick " << i;
  }
  EXPECT_TRUE(diff_fields(trace.params, sample_params()).empty());
  EXPECT_EQ(trace.digest(), expected.digest());
  EXPECT_EQ(trace.metadata.at("seed"), "1");
  for (const char* key : {"source_revision", "compiler", "flags", "eigen", "format"}) {
    EXPECT_FALSE(trace.metadata.at(key).empty()) << key;
  }
  EXPECT_NE(trace.metadata.at("flags").find("-ffp-contract=off"), std::string::npos);
}

TEST_F(TraceFile, StateIsKeptEvery125TicksOrEveryTick) {
  write_run(folder_ / "run.mcap", 251);
  const Trace trace = read_trace(folder_ / "run.mcap");
  ASSERT_EQ(trace.keyframes.size(), 3u);
  EXPECT_EQ(trace.keyframes[1].index, 125u);
  write_run(folder_ / "all.mcap", 251, {.every_state = true, .ros = false});
  EXPECT_EQ(read_trace(folder_ / "all.mcap").keyframes.size(), 251u);
}

TEST_F(TraceFile, StateIsKeptWhenAFaultAppears) {
  {
    TraceWriter writer(folder_ / "run.mcap", sample_params(), {});
    for (std::uint32_t tick = 0; tick < 50; ++tick) {
      writer.append(record_of(sample_inputs(tick)), State{}, with_faults(tick < 20 ? 0u : 4u));
    }
    writer.close();
  }
  const Trace trace = read_trace(folder_ / "run.mcap");
  ASSERT_EQ(trace.keyframes.size(), 2u);
  EXPECT_EQ(trace.keyframes[1].index, 20u);
}

TEST_F(TraceFile, CrashLosesAtMostTheOpenChunk) {
  const fs::path file = folder_ / "run.mcap";
  fs::path part;
  {
    const Params params = sample_params();
    TraceWriter writer(file, params, {}, {.chunk_ticks = 10});
    part = writer.part_path();
    for (std::uint32_t tick = 0; tick < 25; ++tick) {
      writer.append(record_of(sample_inputs(tick)), State{}, Outputs{});
    }
    fs::copy_file(part, folder_ / "crashed.mcap");  // as if the process died here
  }
  EXPECT_NE(error_of(folder_ / "crashed.mcap").find("20 ticks before it are whole"),
            std::string::npos);
  const Trace trace = read_trace(folder_ / "crashed.mcap", Read::kRecover);
  EXPECT_EQ(trace.ticks.size(), 20u);
  EXPECT_NE(trace.warning, "");
}

// A second of pictures would be too much for the end of a tick.
TEST_F(TraceFile, ChunksEndWhenTheyAreFull) {
  fs::path part;
  TraceWriter writer(folder_ / "run.mcap", sample_params(), {}, {.ros = true});
  part = writer.part_path();
  const std::string picture(40'000, 'x');
  std::uintmax_t before = fs::file_size(part);
  for (std::uint32_t tick = 0; tick < 100; ++tick) {
    writer.append("/camera/image", {"sensor_msgs/msg/CompressedImage", ""}, tick, picture);
    writer.append(record_of(sample_inputs(tick)), State{}, Outputs{});
    const std::uintmax_t now = fs::file_size(part);
    EXPECT_LT(now - before, 200'000u) << "written at once, at tick " << tick;
    before = now;
  }
  EXPECT_GT(before, 3'800'000u) << "what a crash leaves";
}

TEST_F(TraceFile, TruncationAnywhereIsAnErrorAndRecoversWholeTicks) {
  const fs::path file = folder_ / "run.mcap";
  write_run(file, 12, {.ros = false, .chunk_ticks = 4});
  const std::string bytes = slurp(file);
  const Trace whole = read_trace(file);
  const fs::path cut = folder_ / "cut.mcap";
  const std::size_t stride = 397;  // mcap_test tries every offset
  std::size_t most = 0;
  for (std::size_t size = 0; size < bytes.size(); size += stride) {
    spit(cut, std::string_view(bytes).substr(0, size));
    EXPECT_NE(error_of(cut), "") << "cut to " << size;
    try {
      const Trace trace = read_trace(cut, Read::kRecover);
      EXPECT_GE(trace.ticks.size(), most);
      most = trace.ticks.size();
      EXPECT_FALSE(replay(trace).divergence) << "cut to " << size;
    } catch (const TraceError&) {  // cut before the robot
    }
  }
  spit(cut, std::string_view(bytes).substr(0, bytes.size() - 1));
  EXPECT_EQ(read_trace(cut, Read::kRecover).ticks.size(), whole.ticks.size());
}

TEST_F(TraceFile, MessageSaysHowMuchIsLost) {
  const fs::path file = folder_ / "run.mcap";
  write_run(file, 8, {.ros = false, .chunk_ticks = 4});
  const std::string bytes = slurp(file);
  const std::size_t last = bytes.rfind(std::string("\x07\0\0\0", 4), bytes.size() - 100);
  ASSERT_NE(last, std::string::npos);
  const Trace whole = read_trace(file);
  const std::string needle(reinterpret_cast<const char*>(&whole.ticks[6]), sizeof(TickRecord));
  const std::size_t seventh = bytes.find(needle);
  ASSERT_NE(seventh, std::string::npos);
  spit(file, std::string_view(bytes).substr(0, seventh + 40));
  const std::string error = error_of(file);
  EXPECT_NE(error.find("6 ticks before it are whole, later ones are lost"), std::string::npos)
      << error;
  spit(file, std::string_view(bytes).substr(0, bytes.size() - 1));
  EXPECT_NE(error_of(file).find("8 ticks before it are whole, and all messages are"),
            std::string::npos);
}

// It cannot say how many ticks were lost.
TEST_F(TraceFile, CompressedRecoversWholeChunksToo) {
  const fs::path file = folder_ / "run.mcap";
  write_run(file, 12, {.chunk_ticks = 4});
  const Trace plain = read_trace(file);
  const std::uintmax_t plain_bytes = fs::file_size(file);
  write_run(file, 12, {.chunk_ticks = 4, .compress = true});
  EXPECT_LT(fs::file_size(file), plain_bytes);
  EXPECT_FALSE(diff(plain, read_trace(file)));
  const std::string bytes = slurp(file);
  spit(file, std::string_view(bytes).substr(0, bytes.rfind("\x28\xb5\x2f\xfd") + 40));
  const std::string error = error_of(file);
  EXPECT_NE(error.find("8 ticks before it are whole, later ones are lost"), std::string::npos)
      << error;
  EXPECT_FALSE(replay(read_trace(file, Read::kRecover)).divergence);
}

TEST_F(TraceFile, RecoverKeepsEveryWholeMessage) {
  const fs::path file = folder_ / "run.mcap", mended = folder_ / "mended.mcap";
  for (const bool compress : {false, true}) {
    write_run(file, 30, {.chunk_ticks = 8, .compress = compress});
    const std::string bytes = slurp(file);
    const mcap::WholeFile whole = mcap::parse(bytes);
    for (const std::size_t size :
         {bytes.size(), bytes.size() - 1, whole.messages[whole.messages.size() / 2].part + 200,
          whole.messages.back().part + 200}) {
      spit(file, std::string_view(bytes).substr(0, size));
      const mcap::WholeFile cut = mcap::parse(slurp(file));
      const Recovered recovered = recover_trace(file, mended);
      const mcap::WholeFile made = mcap::parse(slurp(mended));
      ASSERT_FALSE(made.flaw) << made.flaw->what;
      EXPECT_EQ(recovered.messages, cut.messages.size());
      ASSERT_EQ(made.messages.size(), cut.messages.size());
      for (std::size_t i = 0; i < made.messages.size(); ++i) {
        const mcap::Message &a = made.messages[i], &b = whole.messages[i];
        EXPECT_EQ(a.data, b.data);
        EXPECT_EQ(a.time_ns, b.time_ns);
        EXPECT_EQ(a.sequence, b.sequence);
        EXPECT_EQ(made.channels.at(a.channel).topic, whole.channels.at(b.channel).topic);
      }
      for (const auto& [name, attachment] : whole.attachments)
        EXPECT_EQ(made.attachments.at(name).data, attachment.data) << name;
      EXPECT_EQ(made.metadata.at("result").at("recovered_from"), file.string());
      EXPECT_FALSE(replay(read_trace(mended)).divergence);
      EXPECT_EQ(recovered.warning.find("later ones") != std::string::npos, size < bytes.size() - 1)
          << recovered.warning;
    }
  }
}

TEST_F(TraceFile, RunThatNeverTickedLeavesNothing) {
  { TraceWriter writer(folder_ / "run.mcap", sample_params(), {}); }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(TraceFile, EditIsAnError) {
  const fs::path file = folder_ / "run.mcap";
  write_run(file, 12, {.ros = false, .chunk_ticks = 4});
  std::string bytes = slurp(file);
  for (std::size_t i = 0; i < bytes.size(); i += 397) {
    const char kept = bytes[i];
    bytes[i] = static_cast<char>(bytes[i] ^ 0x10);
    spit(file, bytes);
    EXPECT_NE(error_of(file), "") << "byte " << i;
    bytes[i] = kept;
  }
}

// Bad indices, or values that are no numbers.
TEST_F(TraceFile, ParamsThatAreNoRobotAreRefused) {
  const auto refused = [&](auto spoil) {
    Params params = sample_params();
    spoil(params);
    {
      TraceWriter writer(folder_ / "spoilt.mcap", params, {});
      writer.append(record_of(sample_inputs(0)), State{}, Outputs{});
      writer.close();
    }
    EXPECT_NE(error_of(folder_ / "spoilt.mcap").find("is not a robot"), std::string::npos);
  };
  refused([](Params& params) {
    params.leg[0].solver = LegSolver::kClosedForm;
    params.leg[0].joint[0] = 255;
  });
  refused([](Params& params) { params.head_pan = 254; });
  refused([](Params& params) { params.joint[1].parent = 2; });
  refused([](Params& params) { params.period_us = 0; });
  refused([](Params& params) { params.tuning.gait.lift_m = std::nanf(""); });
  refused([](Params& params) { params.body_mass_kg = std::numeric_limits<float>::infinity(); });
}

TEST_F(TraceFile, MissingEmptyFolderAndForeignFilesAreNamed) {
  EXPECT_NE(error_of(folder_ / "none.mcap").find("no such file"), std::string::npos);
  EXPECT_NE(error_of(folder_).find("is a folder"), std::string::npos);
  spit(folder_ / "empty.mcap", "");
  EXPECT_NE(error_of(folder_ / "empty.mcap"), "");
  spit(folder_ / "robot.sdf", "<sdf version='1.9'></sdf>");
  EXPECT_NE(error_of(folder_ / "robot.sdf").find("wrong magic"), std::string::npos);
  mcap::Writer other(folder_ / "other.mcap", "", "somebody else");
  other.close();
  EXPECT_NE(error_of(folder_ / "other.mcap").find("not a VERP trace"), std::string::npos);
}

TEST_F(TraceFile, OtherFormatAndOtherParamsAreNamedWithTheirRevision) {
  const auto write = [&](const char* format, std::size_t params_size) {
    mcap::Writer writer(folder_ / "old.mcap", "", "verp");
    writer.add_metadata(kMetadataName, {{"format", format}, {"source_revision", "abc123"}});
    writer.add_attachment(kParamsAttachment, "", std::string(params_size, '\0'));
    writer.close();
  };
  write("0", sizeof(Params));
  EXPECT_NE(error_of(folder_ / "old.mcap").find("revision abc123"), std::string::npos);
  write(kTraceFormat, sizeof(Params) - 4);
  EXPECT_NE(error_of(folder_ / "old.mcap").find("Params image of"), std::string::npos);
}

}  // namespace
}  // namespace verp::record::test
