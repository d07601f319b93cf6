#include <fcntl.h>
#include <pty.h>
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

class Trouble : public Program {
 protected:
  /// A full disk; dash counts 512 bytes.
  Outcome verp_with_blocks(int blocks, const std::string& arguments) const {
    return shell("ulimit -f " + std::to_string(blocks) + "; " VERP_PROGRAM " " + arguments);
  }
  fs::path only_part(const fs::path& folder) const {
    fs::path part;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() != ".part") continue;
      EXPECT_EQ(part, "") << "one is enough";
      part = entry.path();
    }
    return part;
  }
  bool wait_for_walk(const fs::path& folder) const {
    for (int i = 0; i < 6000; ++i) {
      std::error_code error;
      for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (entry.path().extension() == ".part" && fs::file_size(entry, error) > 150000)
          return true;
      }
      std::this_thread::sleep_for(20ms);
    }
    return false;
  }
};

TEST_F(Trouble, FullDiskCostsTheTraceButNotTheResult) {
  const Outcome walk = verp_with_blocks(1200, "walk --for 4 --json --record a.mcap");
  EXPECT_EQ(walk.status, 1) << walk.err;
  const json result = json::parse(walk.out);
  EXPECT_GT(result.at("ticks"), 600) << "the walk went on";
  ASSERT_EQ(result.at("lost").size(), 1u);
  EXPECT_FALSE(result.contains("trace"));
  EXPECT_FALSE(fs::exists(folder_ / "a.mcap"));
  EXPECT_EQ(std::count(walk.err.begin(), walk.err.end(), '\n'), 1) << walk.err;

  const std::string line = result.at("lost")[0];
  const std::size_t start = line.find("`verp trace recover ");
  ASSERT_NE(start, std::string::npos) << line;
  const std::string command = line.substr(start + 6, line.find('`', start + 1) - start - 6);
  EXPECT_EQ(verp(command).status, 0) << command;
  EXPECT_EQ(verp("replay a.mcap").status, 0);
  // 4.2 kB a tick, 614 kB of room, 128 kB a chunk: at most one is lost.
  EXPECT_GT(json::parse(verp("trace info a.mcap --json").out).at("ticks"), (614 - 128) / 4.2);
}

TEST_F(Trouble, ARecoveryThatTheDiskRefusesLeavesNothing) {
  ASSERT_EQ(verp("walk --for 3 --json --record a.mcap").status, 0);
  const Outcome recovery = verp_with_blocks(1200, "trace recover a.mcap -o b.mcap");
  EXPECT_NE(recovery.status, 0);
  EXPECT_NE(recovery.err.find("write failed"), std::string::npos) << recovery.err;
  EXPECT_EQ(only_part(folder_), "");
  EXPECT_FALSE(fs::exists(folder_ / "b.mcap"));
}

TEST_F(Trouble, TheSecondOfTwoWalksThatRecordToOneFileIsToldWhoIsTheFirst) {
  std::ofstream(folder_ / "a.mcap.1234-0.part") << "of one that crashed";
  Outcome first;
  std::thread running([&] { first = verp("walk --for 600 --json --record a.mcap", "first"); });
  EXPECT_TRUE(wait_for_walk(folder_));
  const Outcome second = verp("walk --for 3 --json --record a.mcap", "second");
  EXPECT_EQ(second.status, 2) << second.err;
  EXPECT_NE(second.err.find("a.mcap: process "), std::string::npos) << second.err;
  EXPECT_NE(second.err.find("--for 600 --json --record a.mcap) is recording to it"),
            std::string::npos)
      << second.err;
  EXPECT_EQ(verp("walk --for 3 --json --record b.mcap", "other").status, 0);
  const std::size_t at = second.err.find("process ") + 8;
  EXPECT_EQ(::kill(std::stoi(second.err.substr(at)), SIGINT), 0);
  running.join();
  EXPECT_EQ(first.status, 130);
  EXPECT_EQ(verp("walk --for 3 --json --record a.mcap", "third").status, 0) << "it is over";
}

TEST_F(Trouble, FullDiskCostsTheReportButNotTheResult) {
  const Outcome walk = verp_with_blocks(250, "walk --for 4 --report out");
  EXPECT_EQ(walk.status, 1) << walk.err;
  EXPECT_NE(walk.out.find("digest"), std::string::npos) << walk.out;
  EXPECT_NE(walk.err.find("out/run.mcap: "), std::string::npos) << walk.err;
  EXPECT_NE(walk.err.find("out: the report is not whole: out/samples.csv: cannot be written"),
            std::string::npos)
      << walk.err;
  EXPECT_EQ(std::count(walk.err.begin(), walk.err.end(), '\n'), 2) << walk.err;
}

TEST_F(Trouble, AnExportThatFailsLeavesTheOldImageAndSaysWhy) {
  ASSERT_EQ(verp("export generic21 -o .").status, 0);
  const std::string before = slurp(folder_ / "params.bin");
  const Outcome failed = verp_with_blocks(8, "export op3 -o .");
  EXPECT_EQ(failed.status, 2);
  EXPECT_NE(failed.err.find("params.bin: cannot be written: File too large; free space"),
            std::string::npos)
      << failed.err;
  EXPECT_EQ(slurp(folder_ / "params.bin"), before);
  EXPECT_EQ(only_part(folder_), "");
}

TEST_F(Trouble, NoRoomForAnyTraceIsToldBeforeTheWalkAndLeavesNothing) {
  const Outcome walk = verp_with_blocks(8, "walk --for 4 --record a.mcap --json");
  EXPECT_EQ(walk.status, 2);
  EXPECT_NE(walk.err.find("write failed"), std::string::npos) << walk.err;
  EXPECT_EQ(only_part(folder_), "");
}

TEST_F(Trouble, TmpdirThatIsNoFolderCostsNothing) {
  const Outcome walk = shell("TMPDIR=/nowhere " VERP_PROGRAM " walk --for 3 --report out");
  EXPECT_EQ(walk.status, 0) << walk.err;
  EXPECT_EQ(walk.err, "");
  EXPECT_TRUE(fs::exists(folder_ / "out/index.html"));
}

TEST_F(Trouble, ReaderThatLeavesAtOnceCostsNothing) {
  const Outcome walk =
      shell(VERP_PROGRAM " walk --for 3 --json --record a.mcap --report out | head -n 0");
  EXPECT_EQ(walk.err, "");
  EXPECT_EQ(verp("replay a.mcap").status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/index.html"));
}

TEST_F(Trouble, StreamsThatAreClosedOrFullCostNothingElse) {
  const struct {
    const char* streams;
    int status;
  } kRows[] = {{">&-", 1}, {"2>&-", 0}, {">&- 2>&- <&-", 1}, {">/dev/full", 1}, {"2>/dev/full", 0}};
  for (const auto& [streams, status] : kRows) {
    // Without gnuplot the program writes to stderr.
    const Outcome walk =
        shell("PATH=/nowhere " VERP_PROGRAM " walk --for 3 --json --record a.mcap --report out " +
              std::string(streams));
    EXPECT_EQ(walk.status, status) << streams;
    EXPECT_EQ(verp("replay a.mcap").status, 0) << streams;
    fs::remove(folder_ / "a.mcap");
  }
}

TEST_F(Trouble, TerminalThatIsClosedEndsTheRunInOrder) {
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::unsetenv("CI");  // it would disable the progress bar
    if (::chdir(folder_.c_str()) == 0) {
      ::execl(VERP_PROGRAM, "verp", "walk", "--for", "600", "--report", "out", nullptr);
    }
    ::_exit(99);
  }
  EXPECT_TRUE(wait_for_walk(folder_ / "out"));
  ::close(terminal);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGHUP);
  EXPECT_EQ(verp("replay out/run.mcap").status, 0);
  EXPECT_NE(slurp(folder_ / "out/index.html").find("Interrupted"), std::string::npos);
}

TEST_F(Trouble, NohupIsRespected) {
  const Outcome walk = shell("trap '' HUP; " VERP_PROGRAM
                             " walk --for 4 --json --record a.mcap & sleep 0.5; kill -HUP $!; "
                             "wait $!");
  EXPECT_EQ(walk.status, 0) << walk.err;
}

// The first comes during the run; the report then hangs in a plot.
TEST_F(Trouble, SecondSignalEndsARunThatHangs) {
  fs::create_directories(folder_ / "bin");
  std::ofstream(folder_ / "bin/gnuplot")
      << "#!/bin/sh\ntouch started\nexec sleep 20 >/dev/null 2>&1\n";
  fs::permissions(folder_ / "bin/gnuplot", fs::perms::owner_all);
  const Outcome walk =
      shell("PATH=$PWD/bin:$PATH; " VERP_PROGRAM
            " walk --for 600 --physics-step 2 --report out & "
            "for i in $(seq 300); do "
            "  test $(cat out/*.part 2>/dev/null | wc -c) -ge 1000000 || sleep 0.1; done; "
            "kill -TERM $!; for i in $(seq 100); do test -e started || sleep 0.1; done; sleep 3; "
            "kill -TERM $!; wait $!");
  EXPECT_EQ(walk.status, 128 + SIGTERM) << walk.err;
}

TEST_F(Trouble, PlacesOfNoUseAreNamedBeforeTheWalk) {
  std::ofstream(folder_ / "notes.txt") << "mine";
  fs::create_directories(folder_ / "out");
  expect_refused("walk --report notes.txt", "notes.txt: not a folder");
  expect_refused("walk --report /proc --record a.mcap", "/proc: nothing can be written there");
  expect_refused("walk --record notes.txt", "notes.txt");
  expect_refused("walk --report out --record out/samples.csv",
                 "the report has a file of that name");
  expect_refused("walk --report out --record ./out/../out/index.html", "the report has a file");
  expect_refused("walk --record a.mcap --record b.mcap", "--record");
  EXPECT_EQ(slurp(folder_ / "notes.txt"), "mine");
  EXPECT_EQ(only_part(folder_), "");
  EXPECT_EQ(only_part(folder_ / "out"), "");
}

TEST_F(Trouble, ATraceIsNotReplacedByWhatIsMadeOfIt) {
  ASSERT_EQ(verp("walk --for 3 --json --record a.mcap").status, 0);
  const std::string before = slurp(folder_ / "a.mcap");
  expect_refused("trace export a.mcap -o ./a.mcap", "that is the trace itself");
  expect_refused("trace recover a.mcap -o a.mcap", "that is the trace itself");
  EXPECT_EQ(slurp(folder_ / "a.mcap"), before);
}

TEST_F(Trouble, RecoveryOfATraceInAnOddPlaceIsACommandThatWorks) {
  fs::create_directories(folder_ / "my 'runs'");
  const Outcome walk =
      verp_with_blocks(1200, "walk --for 4 --json --record \"my 'runs'/a \\$b.mcap\"");
  const std::string line = json::parse(walk.out).at("lost").at(0);
  const std::size_t start = line.find("`verp trace recover ");
  ASSERT_NE(start, std::string::npos) << line;
  const std::string command = line.substr(start + 6, line.find('`', start + 1) - start - 6);
  EXPECT_EQ(verp(command).status, 0) << command;
  EXPECT_TRUE(fs::exists(folder_ / "my 'runs'/a $b.mcap"));
}

TEST_F(Trouble, ExportedNumbersAreWholeOrAbsent) {
  ASSERT_EQ(verp("walk --for 3 --json --record a.mcap").status, 0);
  std::ofstream(folder_ / "a.csv") << "before";
  const Outcome outcome = verp_with_blocks(20, "trace export a.mcap -o a.csv");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("a.csv: cannot be written to its end"), std::string::npos);
  EXPECT_EQ(slurp(folder_ / "a.csv"), "before");
  EXPECT_EQ(only_part(folder_), "");
  EXPECT_EQ(verp("trace export a.mcap -o /dev/full").status, 1);
  EXPECT_EQ(verp("trace export a.mcap -o a.csv").status, 0);
  EXPECT_EQ(slurp(folder_ / "a.csv").rfind("tick,", 0), 0u);
}

// `timeout` gives 137 after its second signal.
TEST_F(Trouble, CommandsWithNothingToKeepEndAtTheFirstSignal) {
  ASSERT_EQ(verp("walk --for 3 --json --record a.mcap").status, 0);
  const Outcome outcome = shell("( timeout -k 1 -s INT 1 " VERP_PROGRAM
                                " trace export a.mcap; echo status $? >&2 ) | sleep 3");
  EXPECT_EQ(outcome.err, "status 124\n");
}

// All are of the run that ended last.
TEST_F(Trouble, TwoRunsIntoOneFolderDoNotMixTheirFiles) {
  std::thread other([&] { verp("walk --for 3 --seed 2 --report out", "other"); });
  verp("walk --for 3 --seed 1 --report out", "one");
  other.join();
  const json trace = json::parse(verp("trace info out/run.mcap --json").out);
  const std::string digest = trace.at("digest"), page = slurp(folder_ / "out/index.html");
  EXPECT_NE(page.find(digest), std::string::npos) << digest;
}

}  // namespace
}  // namespace verp::tool::test
