#include "tests/host/flash/flash_fixture.hpp"

/// Stops at the first failed step. Success needs an emulated board (tests/target/deploy).
namespace verp::flash::test {
namespace {

using nlohmann::json;

class Deploy : public Flash {
 protected:
  Outcome deploy(const std::string& arguments, const std::string& environment = "") const {
    return shell(environment + " " VERP_PROGRAM " deploy generic21 --for 3 --json --board " +
                 board_ + " " + arguments);
  }
  void script(const std::string& name, const std::string& text) const {
    put(folder_ / name, {text.begin(), text.end()});
    fs::permissions(folder_ / name, fs::perms::owner_all);
  }
  static void expect_stop(const Outcome& outcome, int status, const std::string& step,
                          const std::string& needle) {
    EXPECT_EQ(outcome.status, status) << outcome.err;
    const json result = json::parse(outcome.out);
    const json& steps = result.at("steps");
    ASSERT_FALSE(steps.empty());
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) EXPECT_TRUE(steps[i].at("good"));
    EXPECT_EQ(steps.back().at("step"), step);
    EXPECT_FALSE(steps.back().at("good"));
    EXPECT_EQ(result.at("exit"), status);
    const std::string error = result.at("error");
    EXPECT_TRUE(error.starts_with(step + ": ")) << error;
    EXPECT_NE(error.find(needle), std::string::npos) << error;
    EXPECT_NE(outcome.err.find("verp deploy: " + error + "\n"), std::string::npos) << outcome.err;
  }
};

TEST_F(Deploy, StopsWhenTheBuildFailsWithTheCompilersWords) {
  script("cmake",
         "#!/bin/sh\n[ \"$1\" = --preset ] && exit\necho '[1/2] Building a.o'\n"
         "echo 'a.cpp:3:7: error: no such thing'\necho 'ninja: build stopped'\nexit 1\n");
  const Outcome outcome = deploy("", "PATH=.:$PATH");
  expect_stop(outcome, 1, "build", "a.cpp:3:7: error: no such thing");
  EXPECT_NE(outcome.err.find("build.log"), std::string::npos);
}

// A file size limit simulates a full disk.
TEST_F(Deploy, StopsWhenTheWalkFails) {
  const Outcome outcome =
      shell("ulimit -f 200; " VERP_PROGRAM " deploy generic21 --for 3 --json --no-build --board " +
            board_);
  expect_stop(outcome, 1, "walk", "walk.mcap");
}

TEST_F(Deploy, StopsWhenTheCoreCannotReplay) {
  put(folder_ / ("replay_" + std::string(recipe_->replay_board) + ".elf"), {1});
  script("broken", "#!/bin/sh\necho 'HardFault at 0x08000123'\nexit 70\n");
  expect_stop(deploy("--no-build", "VERP_QEMU=./broken"), 3, "replay", "HardFault at 0x08000123");
}

TEST_F(Deploy, ADryRunOnlySays) {
  for (const char* program : {"cmake", "flock", "qemu-system-arm", "openocd", "dfu-util"}) {
    script(program, "#!/bin/sh\ntouch ran\nexit 1\n");
  }
  for (const bool built : {true, false}) {
    if (!built) fs::remove(image());
    const Outcome outcome = deploy("--dry-run", "PATH=.:$PATH");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const json result = json::parse(outcome.out);
    EXPECT_TRUE(result.at("dry_run"));
    EXPECT_EQ(result.at("steps").size(), 4u);
    EXPECT_FALSE(fs::exists(folder_ / "ran"));
    EXPECT_FALSE(fs::exists(folder_ / "work" / "deploy"));
    for (const char* word : {"would build loop_", "would walk 3 s", "would replay",
                             built ? "would run:" : "not built yet"}) {
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << "\n" << outcome.err;
    }
    EXPECT_EQ(outcome.err.find("program {") != std::string::npos, built) << outcome.err;
  }
  EXPECT_EQ(deploy("--dry-run --no-build").status, 2) << "nobody would build it";
}

TEST_F(Deploy, ARobotOnCanGetsTheImageThatDrivesIt) {
  const Outcome outcome = deploy("--bus can --dry-run");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("would build loop_can_" + board_ + ","), std::string::npos)
      << outcome.err;
  const json flash = json::parse(outcome.out).at("steps").back();
  EXPECT_EQ(flash.at("image"), "loop_can_" + board_);
  EXPECT_NE(flash.at("commands").dump().find(image("loop_can_").string()), std::string::npos);
  EXPECT_EQ(flash.at("commands").dump().find(image().string()), std::string::npos);
}

}  // namespace
}  // namespace verp::flash::test
