#include "tests/host/flash/flash_fixture.hpp"

/// Refused before any tool runs.
namespace verp::flash::test {
namespace {

class Refusal : public Flash {
 protected:
  void expect_refused_file(const std::string& arguments, const std::string& needle) const {
    expect_refused("flash --board " + board_ + " " + arguments, needle);
  }
};

TEST_F(Refusal, FilesThatAreNotWhatTheyShouldBe) {
  Bytes image = robot();
  put(folder_ / "good.bin", image);
  EXPECT_EQ(flash("--params good.bin --dry-run").status, 0);
  image[200] ^= 1;
  put(folder_ / "damaged.bin", image);
  expect_refused_file("--params damaged.bin", "damaged: its CRC does not fit");
  image = robot();
  image.resize(1000);
  put(folder_ / "short.bin", image);
  expect_refused_file("--params short.bin", "truncated");
  put(folder_ / "huge.bin", Bytes(map_.params.bytes + 1));
  expect_refused_file("--params huge.bin", "too many");
  put(folder_ / "empty.bin", {});
  expect_refused_file("--params empty.bin", "is empty");
  expect_refused_file("--params gone.bin", "gone.bin: cannot be read");
  expect_refused_file("--params nobody", "nobody");
  expect_refused_file("--actions good.bin", "give it to --params");
  expect_refused_file("--actions gone", "cannot be read");
  expect_refused_file("--actions .", "is a folder");
  put(folder_ / "many", Bytes(map_.actions.bytes + 1));
  expect_refused_file("--actions many", "too many");
  put(folder_ / "acts", noise(map_.actions.bytes, 4));
  expect_refused_file("--actions acts", "no action library; make it again: verp action export");
  put(folder_ / "kept_actions.bin", noise(map_.actions.bytes - 1, 4));
  expect_refused_file("--actions kept_actions.bin", "no action library");
  Bytes own = actions();
  own.back() ^= 1;
  put(folder_ / "acts", own);
  expect_refused_file("--actions acts", "damaged");
  own.resize(own.size() - 8);
  put(folder_ / "acts", own);
  expect_refused_file("--actions acts", "truncated");
  put(folder_ / "acts", actions("op3"));
  expect_refused_file("--params generic21 --actions acts", "for another robot than generic21");
  expect_refused_file("--params good.bin --actions acts", "for another robot than generic21");
}

TEST_F(Refusal, CodeThatIsNotOfThisBoard) {
  const Bytes good = made_up_code(7);
  const auto with = [&](std::uint32_t stack, std::uint32_t entry) {
    Bytes code = good;
    const std::uint32_t table[] = {stack, entry};
    std::memcpy(code.data(), table, sizeof table);
    put(image(), code);
  };
  const std::uint32_t stack = map_.ram.end(), entry = map_.code.begin + 0x201;
  with(stack, entry);
  EXPECT_EQ(flash("--dry-run").status, 0);
  with(stack + 4, entry);
  expect_refused_file("", "no firmware of this board");
  with(map_.ram.begin, entry);
  expect_refused_file("", "no firmware of this board");
  with(stack, entry - 1);  // not Thumb
  expect_refused_file("", "no firmware of this board");
  with(stack, map_.code.begin + static_cast<std::uint32_t>(good.size()) + 1);
  expect_refused_file("", "no firmware of this board");
  put(image(), Bytes(map_.code.bytes + 1));
  expect_refused_file("", "too many");
  put(image(), {1, 2, 3});
  expect_refused_file("", "cut off");
  fs::remove(image());
  expect_refused_file("", "cmake --preset fw-" + board_);
}

TEST_F(Refusal, WordsThatMakeNoSense) {
  expect_refused("flash", "--board");
  expect_refused("flash --board olimex", "olimex_h405");
  expect_refused_file("--tool st-flash", "openocd, stm32flash, dfu-util");
  expect_refused_file("--tool stm32flash", "--port /dev/ttyUSB0");
  expect_refused_file("--tool openocd --port /dev/ttyACM0", "serial number of a debug probe");
  expect_refused_file("--tool openocd --port '}; exit'", "OpenOCD takes no braces");
  expect_refused("flash --board nucleo_f446re --emulate", "no emulator has this chip");
  expect_refused("flash --board mps2_an386 --port /dev/ttyUSB0", "leave out --port");
  expect_refused("flash --board mps2_an386 --params generic21", "keeps no robot");
  expect_refused("deploy generic21 --board nope", "nucleo_f446re");
  expect_refused("flash --board mps2_an386 --bus can",
                 "drives no robot on CAN; give --board one of");
  expect_refused("deploy generic21 --board mps2_an386 --bus can", "olimex_h405");
  expect_refused_file("--bus nothing", "choose one of: dxl, can");
  expect_refused("deploy nobody --board olimex_h405", "nobody");
}

TEST_F(Refusal, OnlyTheSensorsOfADynamixelBusHaveAnImage) {
  expect_refused_file("--image sensor --params generic21 --bus feetech", "no Dynamixel servos");
  expect_refused_file("--image sensor --params generic21 --bus can", "another with --bus");
  EXPECT_EQ(shell("sed 's/sensor=\"imu\" id=\"120\"/sensor=\"imu\" id=\"0\"/' " +
                  fs::absolute(model::find_model("generic21")).string() + " >own.sdf")
                .status,
            0);
  expect_refused_file("--image sensor --params own.sdf", "has none on its bus");
  expect_refused_file("--image sensor --emulate", "leave out --emulate");
  expect_refused_file("--image sensors", "--image");
  expect_refused("flash --board mps2_an386 --image sensor", "name olimex_h405");
  expect_refused("flash --board opencr --image foot", "no pins for it");
  const Outcome told = flash("--image sensor --params generic21 --dry-run --json");
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_NE(told.out.find("\"image\": \"sensor_" + board_), std::string::npos) << told.out;
  EXPECT_EQ(told.out.find("actions"), std::string::npos) << "a sensor plays none";
}

TEST_F(Refusal, BoardsThatOnlyTheirTestsStartAreNamedAsSuch) {
  for (const std::string board : {"qemu_rv32", "zcu102_r5"}) {
    const std::string remedy = "exists only in an emulator, where ./verp test --on " + board;
    expect_refused("flash --board " + board, remedy);
    expect_refused("flash --board " + board + " --emulate", remedy);
    expect_refused("deploy generic21 --bus can --board " + board, remedy);
  }
}

TEST_F(Refusal, ToolThatIsNotInstalledNamesItsPackage) {
  for (const char* tool : {"openocd", "stm32flash", "dfu-util"}) {
    RomBootLoader chip = used(this->chip());
    const BootLoaderPort port(chip);
    const bool serial = std::string(tool) == "stm32flash";
    expect_trouble(shell("PATH=/nowhere " VERP_PROGRAM " flash --board " + board_ + " --tool " +
                         tool + (serial ? " --port " + port.path() : "")),
                   std::string("apt-get install ") + tool);
  }
}

TEST_F(Refusal, PortThatIsNoneIsTold) {
  expect_trouble(flash("--port /dev/ttyNone0"), "/dev/ttyNone0: no such device");
  expect_trouble(flash("--port /dev/null"), "is no serial port");
}

TEST_F(Refusal, DryRunRunsNothing) {
  const Outcome outcome =
      shell("PATH=/nowhere " VERP_PROGRAM " flash --board " + board_ + " --dry-run");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 2) << outcome.out;
}

/// A fake dfu-util 0.11 on a file: `-l`, `-U` and `-D` at `-s ADDRESS[:LENGTH]`. SPOIL changes
/// written bytes.
constexpr const char* kDfuUtil = R"sh(#!/bin/bash
while [ $# -gt 0 ]; do
  case $1 in
  -l) echo "Found DFU: [0483:df11] ver=2200, devnum=7, cfg=1, intf=0, path=\"1-1\", alt=0," \
      "name=\"@Internal Flash  /0x08000000/$LAYOUT\", serial=\"1\""; exit ;;
  -s) address=${2%%:*} length=${2#*:}; shift ;;
  -U) [ ! -e "$2" ] || { echo "dfu-util: Cannot open file $2 for writing: File exists"; exit 74; }
      tail -c "+$((address - 0x08000000 + 1))" chip | head -c "$length" >"$2" ;;
  -D) ${SPOIL:-cat} <"$2" | dd of=chip seek=$((address - 0x08000000)) oflag=seek_bytes \
        conv=notrunc status=none
      echo 'Download [=====] 100%' ;;
  esac
  shift
done
)sh";

class DfuFlash : public Flash {
 protected:
  Outcome dfu(const std::string& arguments, const std::string& environment = "") const {
    put(folder_ / "dfu-util", {kDfuUtil, kDfuUtil + std::strlen(kDfuUtil)});
    fs::permissions(folder_ / "dfu-util", fs::perms::owner_all);
    return shell("PATH=.:$PATH LAYOUT='" + dfu_layout(*recipe_->chip) + "' " + environment + " " +
                 VERP_PROGRAM + " flash --board " + board_ + " --tool dfu-util " + arguments);
  }
};

// dfu-util does not verify.
TEST_F(DfuFlash, WritesAndVerifiesByReadingBack) {
  Bytes expected = noise(RomBootLoader(chip()).flash.size(), 5);
  put(folder_ / "chip", expected);
  const Outcome outcome = dfu("--code --params generic21");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const auto& [bytes, begin] :
       {std::pair{get(image()), map_.code.begin}, std::pair{robot(), map_.params.begin},
        std::pair{actions(), map_.actions.begin}}) {
    std::copy(bytes.begin(), bytes.end(), expected.begin() + (begin - kFlashBegin));
  }
  EXPECT_EQ(get(folder_ / "chip"), expected);
  EXPECT_EQ(dfu("--params generic21").status, 0) << "again, in the same folder";

  const Outcome spoilt = dfu("", "SPOIL='tr a b'");
  expect_trouble(spoilt, "reads back differently");
}

TEST_F(DfuFlash, WritesTheImageForARobotOnCan) {
  Bytes expected = noise(RomBootLoader(chip()).flash.size(), 5);
  put(folder_ / "chip", expected);
  const Outcome outcome = dfu("--bus can");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Bytes code = get(image("loop_can_"));
  std::copy(code.begin(), code.end(), expected.begin() + (map_.code.begin - kFlashBegin));
  EXPECT_EQ(get(folder_ / "chip"), expected);
}

TEST_F(DfuFlash, OtherSectorsAreAnotherChip) {
  put(folder_ / "chip", noise(1000, 5));
  const Bytes before = get(folder_ / "chip");
  const Outcome outcome = dfu("", "LAYOUT='04*002Kg'");
  expect_trouble(outcome, "its sectors are 04*002Kg");
  EXPECT_EQ(get(folder_ / "chip"), before);
}

}  // namespace
}  // namespace verp::flash::test
