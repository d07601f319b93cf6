#include "host/boards/flash/diagnosis.hpp"

#include <gtest/gtest.h>

#include "host/boards/flash/tool_run.hpp"
#include "host/os/process/child.hpp"

namespace verp::flash::test {
namespace {

using Kind = FlashError::Kind;

Job job_for(Tool tool) {
  const Recipe& recipe = find_recipe("olimex_h405");
  return {recipe, read_memory_map(recipe.board),
          tool,   tool == Tool::kStm32flash ? "/dev/null" : "",
          {},     "/tmp"};
}

struct Case {
  Tool tool;
  Step::Kind step;
  const char* output;
  Kind kind;
  const char* words;
};

const Case kCases[] = {
    {Tool::kOpenocd, Step::Kind::kCheckChip, "Info : clock speed 2000 kHz\nError: open failed\n\n",
     Kind::kNoDevice, "no debug probe"},
    {Tool::kOpenocd, Step::Kind::kCheckChip,
     "Error: libusb_open() failed with LIBUSB_ERROR_ACCESS\nError: open failed\n",
     Kind::kPermission, R"(ATTRS{idVendor}=="0483")"},
    {Tool::kOpenocd, Step::Kind::kCheckChip,
     "Error: libusb_claim_interface() failed with LIBUSB_ERROR_BUSY\nError: open failed\n",
     Kind::kBusy, "another program"},
    {Tool::kOpenocd, Step::Kind::kCheckChip,
     "Info : STLINK V2J37S7\nInfo : Target voltage: 0.0\nError: init mode failed (unable to "
     "connect to the target)\n",
     Kind::kNoDevice, "no chip answers"},
    {Tool::kOpenocd, Step::Kind::kWrite,
     "** Programming Started **\nError: stm32x device protected\nError: failed erasing sectors 0 "
     "to "
     "4\nembedded:startup.tcl:1817: Error: ** Programming Failed **\n",
     Kind::kProtected, "readout protected"},
    {Tool::kOpenocd, Step::Kind::kWrite,
     "** Verify Started **\nError: checksum mismatch - attempting binary compare\ndiff 0 address "
     "0x08000004. Was 0xff instead of 0x01\nembedded:startup.tcl:1813: Error: ** Verify Failed "
     "**\n",
     Kind::kVerify, "reads back differently"},
    {Tool::kOpenocd, Step::Kind::kWrite, "Error: something nobody has seen\n", Kind::kOther,
     "openocd says: Error: something nobody has seen"},
    {Tool::kStm32flash, Step::Kind::kCheckChip,
     "Interface serial_posix: 115200 8E1\nFailed to init device, timeout.\n", Kind::kNoDevice,
     "BOOT0 high"},
    {Tool::kStm32flash, Step::Kind::kCheckChip,
     "Device ID    : 0x0413 (STM32F40xxx/41xxx)\nMemory read\nGot NACK from device on command "
     "0x11\nFailed to read memory at address 0x08000000, target write-protected?\n",
     Kind::kProtected, "stm32flash -k /dev/null"},
    {Tool::kStm32flash, Step::Kind::kWrite,
     "Write to memory\nErasing memory\nFailed to write memory at address 0x08004e00\n",
     Kind::kRefused, "refused a write"},
    {Tool::kStm32flash, Step::Kind::kWrite,
     "Failed to verify at address 0x08000100, expected 0x12 and found 0x00\n", Kind::kVerify,
     "reads back differently"},
    {Tool::kDfuUtil, Step::Kind::kCheckChip, "dfu-util: No DFU capable USB device available\n",
     Kind::kNoDevice, "DFU mode"},
    {Tool::kDfuUtil, Step::Kind::kCheckChip,
     "dfu-util: Cannot open DFU device 0483:df11 found on devnum 7 (LIBUSB_ERROR_ACCESS)\n",
     Kind::kPermission, "60-verp.rules"},
    {Tool::kDfuUtil, Step::Kind::kWrite,
     "Download\t[=====    ] 55%\ndfu-util: Error during download (LIBUSB_ERROR_NO_DEVICE)\n",
     Kind::kLost, "went away"},
    {Tool::kDfuUtil, Step::Kind::kCompare, "a.bin b.bin differ: byte 9, line 1\n", Kind::kVerify,
     "reads back differently"},
};

TEST(Diagnosis, KnownWordsBecomeOneLineWithARemedy) {
  for (const Case& each : kCases) {
    SCOPED_TRACE(each.output);
    const FlashError error = diagnose(
        job_for(each.tool), {each.step, "writing code", {name_of(each.tool)}}, each.output);
    const std::string line = error.what();
    EXPECT_EQ(error.kind(), each.kind) << line;
    EXPECT_NE(line.find(each.words), line.npos) << line;
    EXPECT_EQ(line.find('\n'), line.npos);
    EXPECT_TRUE(line.starts_with("olimex_h405: ")) << line;
    const bool half = line.find("not to be used") != line.npos;
    EXPECT_EQ(half, each.step == Step::Kind::kWrite || each.step == Step::Kind::kCompare) << line;
  }
}

TEST(Diagnosis, PortThatIsGoneCountsMoreThanWords) {
  Job job = job_for(Tool::kStm32flash);
  job.port = "/dev/ttyUSB_gone";
  const FlashError error =
      diagnose(job, {Step::Kind::kWrite, "writing", {"stm32flash"}}, "Failed to init device\n");
  EXPECT_EQ(error.kind(), Kind::kLost);
}

Kind kind_of_check(Tool tool, const std::string& output) {
  try {
    check_chip(job_for(tool), output);
  } catch (const FlashError& error) {
    return error.kind();
  }
  return Kind::kUsage;  // a pass: no check throws it
}

TEST(Diagnosis, OnlyTheBoardsOwnChipPasses) {
  constexpr Kind kGood = Kind::kUsage;
  EXPECT_EQ(kind_of_check(Tool::kOpenocd, "FAKE\nDevice ID: 0x0413\nshutdown\n"), kGood);
  EXPECT_EQ(kind_of_check(Tool::kOpenocd, "Device ID: 0x0449\n"), Kind::kWrongChip);
  EXPECT_EQ(kind_of_check(Tool::kOpenocd, "shutdown command invoked\n"), Kind::kOther);
  EXPECT_EQ(kind_of_check(Tool::kStm32flash, "Device ID    : 0x0413 (STM32F40xxx/41xxx)\n"), kGood);
  EXPECT_EQ(kind_of_check(Tool::kStm32flash, "Device ID    : 0x0421 (STM32F446xx)\n"),
            Kind::kWrongChip);
  const std::string found = R"(Found DFU: [0483:df11] ver=2200, devnum=7, cfg=1, intf=0, alt=0, )"
                            R"(name="@Internal Flash  /0x08000000/)";
  EXPECT_EQ(kind_of_check(Tool::kDfuUtil, found + R"(04*016Kg,01*064Kg,07*128Kg", serial="1")"),
            kGood);
  EXPECT_EQ(kind_of_check(Tool::kDfuUtil, found + R"(04*032Kg,01*128Kg,03*256Kg", serial="1")"),
            Kind::kWrongChip);
  EXPECT_EQ(kind_of_check(Tool::kDfuUtil, found + R"(04*016Kg,01*064Kg,03*128Kg", serial="1")"),
            Kind::kWrongChip);
  EXPECT_EQ(kind_of_check(Tool::kDfuUtil, "dfu-util 0.11\n"), Kind::kNoDevice);
}

TEST(ToolRun, TellsHowFarTheToolIsAndWhatItSaidLast) {
  std::vector<double> shares;
  const ToolRun run = run_tool({"sh", "-c",
                                "printf 'Wrote (12.50%%)\\r'; sleep 0.2; printf 'Wrote (100.00%%) "
                                "Done.\\n\\n'; echo bad >&2; exit 4"},
                               "sh", {.share = [&](double share) { shares.push_back(share); }});
  EXPECT_EQ(run.status, 4);
  EXPECT_EQ(process::last_line(run.output), "bad");
  ASSERT_GE(shares.size(), 2u);
  EXPECT_EQ(shares.front(), 0.125);
  EXPECT_EQ(shares.back(), 1.0);
  EXPECT_EQ(process::last_line("\n \n"), "nothing");
}

TEST(ToolRun, ToolThatIsNotInstalledNamesItsPackage) {
  try {
    run_tool({"no-such-tool"}, "its-package", {});
    FAIL();
  } catch (const FlashError& error) {
    EXPECT_EQ(error.kind(), Kind::kNoTool);
    EXPECT_NE(std::string(error.what()).find("apt-get install its-package"), std::string::npos);
  }
}

// It ignores the interrupt.
TEST(ToolRun, StopEndsTheTool) {
  const ToolRun run = run_tool({"sh", "-c", "trap '' INT; echo there; while :; do sleep 0.1; done"},
                               "sh", {.stop = [] { return true; }});
  EXPECT_TRUE(run.interrupted);
  EXPECT_EQ(run.status, 128 + 9);
}

}  // namespace
}  // namespace verp::flash::test
