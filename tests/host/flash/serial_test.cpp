#include <signal.h>

#include <thread>

#include "tests/host/flash/flash_fixture.hpp"

/// Debian's stm32flash and a boot loader by AN3155.
namespace verp::flash::test {
namespace {

class SerialFlash : public Flash {
 protected:
  Outcome over_serial(RomBootLoader& chip, const std::string& arguments = "",
                      const BootLoaderPort::Trouble& trouble = {}) const {
    BootLoaderPort port(chip, trouble);
    const Outcome outcome = flash("--port " + port.path() + " " + arguments);
    port.unplug();
    chip.reset();
    return outcome;
  }
  template <class Condition>
  static void wait_until(const Condition& condition) {
    for (int i = 0; i < 3000 && !condition(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_TRUE(condition());
  }
  void expect_code(const RomBootLoader& chip, const std::string& kind = "loop_") const {
    const Bytes code = get(image(kind));
    const Bytes there = part(chip, map_.code);
    ASSERT_LE(code.size(), there.size());
    EXPECT_TRUE(std::equal(code.begin(), code.end(), there.begin()));
    EXPECT_TRUE(std::all_of(there.begin() + static_cast<std::ptrdiff_t>(code.size()), there.end(),
                            [](std::uint8_t byte) { return byte == 0xFF; }));
  }
};

TEST_F(SerialFlash, CodeIsWrittenAndNothingElseIsTouched) {
  RomBootLoader chip = used(this->chip());
  const Bytes before = chip.flash;
  const Outcome outcome = over_serial(chip);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("written and verified with stm32flash"), std::string::npos);
  expect_code(chip);
  EXPECT_TRUE(std::equal(before.begin() + map_.code.bytes, before.end(),
                         chip.flash.begin() + map_.code.bytes));
  EXPECT_FALSE(chip.started) << "it is the person who starts the robot";
}

// The tool erases whole sectors.
TEST_F(SerialFlash, RobotOrActionsAloneLeaveEverythingElse) {
  RomBootLoader chip = used(this->chip());
  Bytes expected = chip.flash;
  Bytes piece = robot();
  std::copy(piece.begin(), piece.end(), expected.begin() + (map_.params.begin - kFlashBegin));
  Outcome outcome = over_serial(chip, "--params generic21 --actions none");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(chip.flash, expected);

  piece = noise(map_.actions.bytes, 9);
  put(folder_ / "kept_actions.bin", piece);
  std::copy(piece.begin(), piece.end(), expected.begin() + (map_.actions.begin - kFlashBegin));
  outcome = over_serial(chip, "--actions kept_actions.bin");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(chip.flash, expected);
}

TEST_F(SerialFlash, ARobotBringsItsActions) {
  RomBootLoader chip = used(this->chip());
  const Bytes own = actions();
  const auto there = [&] {
    return part(chip, {map_.actions.begin, static_cast<std::uint32_t>(own.size())});
  };
  const Outcome outcome = over_serial(chip, "--params generic21");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find(" actions ("), std::string::npos) << outcome.out;
  EXPECT_EQ(there(), own);
  EXPECT_EQ(part(chip, {map_.params.begin, static_cast<std::uint32_t>(robot().size())}), robot());
  ASSERT_EQ(verp("action export generic21 -o acts.bin").status, 0);
  EXPECT_EQ(get(folder_ / "acts.bin"), own);
  chip = used(this->chip());
  ASSERT_EQ(over_serial(chip, "--actions acts.bin").status, 0);
  EXPECT_EQ(there(), own);
}

TEST_F(SerialFlash, CodeAndRobotGoTogether) {
  RomBootLoader chip = used(this->chip());
  put(folder_ / "robot.bin", robot());
  const Outcome outcome = over_serial(chip, "--code --params robot.bin --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expect_code(chip);
  const Bytes there = part(chip, {map_.params.begin, static_cast<std::uint32_t>(robot().size())});
  EXPECT_EQ(there, robot());
  const auto said = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(said.at("written"), true);
  EXPECT_EQ(said.at("pieces").size(), 2u);
  EXPECT_EQ(said.at("commands").size(), 5u);
}

TEST_F(SerialFlash, CodeIsThatOfTheRobotsBus) {
  put(folder_ / "can.bin", robot("can"));
  const auto expect_can = [&](const std::string& words, const std::string& told) {
    SCOPED_TRACE(words);
    RomBootLoader chip = used(this->chip());
    const Outcome outcome = over_serial(chip, words);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(told), std::string::npos) << outcome.out;
    expect_code(chip, "loop_can_");
  };
  expect_can("--bus can", "it drives a robot on CAN");
  expect_can("--code --params generic21 --bus can", "robot generic21");
  expect_can("--code --params can.bin", "code loop_can_" + board_);
}

TEST_F(SerialFlash, RobotAloneNamesTheFirmwareThatDrivesIt) {
  RomBootLoader chip = used(this->chip());
  EXPECT_NE(over_serial(chip, "--params generic21 --bus can").out.find("loop_can_" + board_),
            std::string::npos);
  EXPECT_NE(over_serial(chip, "--params generic21").out.find("loop_" + board_), std::string::npos);
  put(folder_ / "can.bin", robot("can"));
  expect_refused("flash --board " + board_ + " --params can.bin --bus dxl", "leave out --bus");
}

TEST_F(SerialFlash, WrongChipIsLeftAsItIs) {
  RomBootLoader::Chip other = chip();
  other.device_id = 0x419;  // STM32F42x: stm32flash would write
  RomBootLoader chip = used(other);
  const Bytes before = chip.flash;
  expect_trouble(over_serial(chip), "device id 0x419, not");
  EXPECT_EQ(chip.flash, before);
}

TEST_F(SerialFlash, ReadoutProtectionIsNamedAndLeftAsItIs) {
  RomBootLoader::Chip locked = chip();
  locked.readout_protected = true;
  RomBootLoader chip = used(locked);
  const Bytes before = chip.flash;
  expect_trouble(over_serial(chip), "readout protected");
  EXPECT_EQ(chip.flash, before);
}

TEST_F(SerialFlash, RefusedWriteIsTold) {
  RomBootLoader::Chip stubborn = chip();
  stubborn.refused = {map_.code.begin + 20'000};
  RomBootLoader chip = used(stubborn);
  expect_trouble(over_serial(chip), "refused a write");
}

TEST_F(SerialFlash, FlashThatReadsBackDifferentlyIsTold) {
  RomBootLoader::Chip worn = chip();
  const Bytes code = get(image());
  const auto some = static_cast<std::uint32_t>(
      std::find_if(code.begin() + 9000, code.end(), [](std::uint8_t b) { return b != 0; }) -
      code.begin());
  worn.stuck = {map_.code.begin + some};
  RomBootLoader chip = used(worn);
  expect_trouble(over_serial(chip), "reads back differently");
}

TEST_F(SerialFlash, NobodyThereIsTold) {
  RomBootLoader chip = used(this->chip());
  expect_trouble(over_serial(chip, "", {.mute = true}), "no boot loader answers");
}

TEST_F(SerialFlash, CableCutHalfwayIsToldAndTheNextFlashSucceeds) {
  RomBootLoader chip = used(this->chip());
  const Outcome outcome = over_serial(chip, "", {.cut_after_writes = 100});
  expect_trouble(outcome, "cable pulled?");
  EXPECT_NE(outcome.err.find("not to be used before it is flashed again"), std::string::npos);
  EXPECT_GE(chip.writes, 100u);
  const Outcome again = over_serial(chip);
  ASSERT_EQ(again.status, 0) << again.err;
  expect_code(chip);
}

// The sector held the actions; one command restores both.
TEST_F(SerialFlash, CutWhileARobotIsWrittenLosesNoActions) {
  RomBootLoader chip = used(this->chip());
  Bytes expected = chip.flash;
  const Bytes piece = robot();
  std::copy(piece.begin(), piece.end(), expected.begin() + (map_.params.begin - kFlashBegin));
  const Outcome outcome =
      over_serial(chip, "--params generic21 --actions none", {.cut_after_writes = 3});
  expect_trouble(outcome, "cable pulled?");
  ASSERT_NE(chip.flash, expected);
  const std::size_t remedy = outcome.err.find("--actions ");
  ASSERT_NE(remedy, std::string::npos) << outcome.err;
  const Outcome again = over_serial(chip, "--params generic21 " + outcome.err.substr(remedy));
  ASSERT_EQ(again.status, 0) << again.err;
  const auto end = static_cast<std::ptrdiff_t>(map_.actions.end() - kFlashBegin);
  EXPECT_TRUE(std::equal(expected.begin() + (map_.actions.begin - kFlashBegin),
                         expected.begin() + end,
                         chip.flash.begin() + (map_.actions.begin - kFlashBegin)));
  EXPECT_EQ(part(chip, {map_.params.begin, static_cast<std::uint32_t>(piece.size())}), piece);
  EXPECT_FALSE(fs::exists(folder_ / "work" / board_ / "kept_actions.bin"));
}

// The boot loader waits for the lost bytes.
TEST_F(SerialFlash, WithoutAResetAfterACutTheRemedyIsTold) {
  RomBootLoader chip = used(this->chip());
  BootLoaderPort cut(chip, {.cut_after_writes = 50});
  EXPECT_EQ(flash("--port " + cut.path()).status, 3);
  cut.unplug();
  BootLoaderPort back(chip);
  expect_trouble(flash("--port " + back.path()), "press reset");
  back.unplug();
  chip.reset();
  EXPECT_EQ(over_serial(chip).status, 0);
  expect_code(chip);
}

TEST_F(SerialFlash, SecondCopyIsRefusedAndTheFirstGoesOn) {
  RomBootLoader chip = used(this->chip());
  BootLoaderPort port(chip, {.byte_us = 60});
  Outcome first;
  std::thread one(
      [&] { first = verp("flash --board " + board_ + " --port " + port.path(), "one"); });
  wait_until([&] { return port.writes() > 0; });
  const Outcome second = flash("--port " + port.path());
  const Outcome third = shell("VERP_FLASH_DIR=elsewhere " VERP_PROGRAM " flash --board " + board_ +
                              " --port " + port.path());
  one.join();
  port.unplug();
  expect_trouble(second, "another verp flash is at work");
  expect_trouble(third, "another program has it open");
  EXPECT_EQ(first.status, 0) << first.err;
  expect_code(chip);
}

TEST_F(SerialFlash, InterruptionEndsItCleanlyAndIsTold) {
  RomBootLoader chip = used(this->chip());
  BootLoaderPort port(chip, {.byte_us = 200});
  Outcome outcome;
  std::thread run([&] {
    outcome = shell(VERP_PROGRAM " flash --board " + board_ + " --port " + port.path() +
                    " & echo $! >pid; wait $!");
  });
  wait_until([&] { return port.writes() > 0; });
  ::kill(static_cast<pid_t>(std::stol(slurp(folder_ / "pid"))), SIGINT);
  run.join();
  EXPECT_EQ(outcome.status, 130);
  EXPECT_NE(outcome.err.find("interrupted while writing"), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

}  // namespace
}  // namespace verp::flash::test
