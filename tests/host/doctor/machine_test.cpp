#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "host/apps/tool/robot/doctor_checks.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPackages = "# stage, package\nrun g++ why\nrun cmake why\nfw gcc-arm why\n";

/// A healthy machine in a folder, as a user without rights sees it; tests plant troubles.
class Doctor : public ::testing::Test {
 protected:
  Doctor() {
    put("/etc/os-release", "ID=debian\nVERSION_CODENAME=bookworm\n");
    put("/etc/passwd", "root:x:0:0::/root:/bin/sh\nada:x:4242:4242::/home/ada:/bin/sh\n");
    put("/etc/group", "dialout:x:" + std::to_string(group()) + ":\n");
    put("/proc/self/status",
        "Name:\tverp_robot\nPid:\t77\nUid:\t4242\t4242\t4242\t4242\nGid:\t4242\t4242\n");
    put("/proc/self/limits",
        "Limit                     Soft Limit           Hard Limit           Units     \n"
        "Max locked memory         unlimited            unlimited            bytes     \n"
        "Max realtime priority     40                   40                   \n");
    put("/proc/77/comm", "verp_robot\n");
    put("/var/lib/dpkg/status", package("g++") + package("cmake") + package("gcc-arm"));
    put("/sys/module/can/refcnt", "0\n");
    put("/tmp/.X11-unix/X0", "");
    fs::create_directories(at("/home/ada"));
    ::chmod(at("/home/ada").c_str(), 0777);
    machine_.current_folder = "/home/ada";
    machine_.interfaces = [] { return std::vector<link::CanInterface>{}; };
    machine_.free_bytes = [](const std::string&) { return std::uint64_t{50'000'000'000}; };
  }
  ~Doctor() override { fs::remove_all(root_); }

  /// The planted files are the tester's, and 4242 is nobody.
  static gid_t group() { return ::getegid(); }
  static std::string package(const std::string& name) {
    return "Package: " + name + "\nStatus: install ok installed\nVersion: 1\n\n";
  }
  fs::path at(const std::string& path) const { return root_.string() + path; }
  void put(const std::string& path, const std::string& text, mode_t mode = 0644) const {
    fs::create_directories(at(path).parent_path());
    std::ofstream(at(path)) << text;
    ::chmod(at(path).c_str(), mode);
  }
  void plug(const std::string& vendor, const std::string& product) const {
    const std::string folder = "/sys/bus/usb/devices/1-2";
    put(folder + "/idVendor", vendor + "\n");
    put(folder + "/idProduct", product + "\n");
    put(folder + "/busnum", "1\n");
    put(folder + "/devnum", "7\n");
  }
  void run(int id, const std::string& name, const std::string& holds = "") const {
    const std::string folder = "/proc/" + std::to_string(id);
    put(folder + "/comm", name + "\n");
    put(folder + "/cmdline", name + std::string(1, '\0') + "--all" + std::string(1, '\0'));
    fs::create_directories(at(folder + "/fd"));
    if (!holds.empty()) fs::create_symlink(holds, at(folder + "/fd/5"));
  }
  cli::Json examined() const { return examine(machine_, kPackages).json(); }

  /// One finding of that state has both texts.
  void expect(const char* state, const std::string& text, const std::string& fix) const {
    const cli::Json json = examined();
    EXPECT_EQ(json.at("good"), state != std::string("bad")) << json.dump(1);
    for (const cli::Json& each : json.at("checks")) {
      const bool found = each.at("text").get<std::string>().find(text) != std::string::npos &&
                         each.at("fix").get<std::string>().find(fix) != std::string::npos;
      if (found && each.at("state") == state) return;
    }
    ADD_FAILURE() << "no " << state << " with '" << text << "' and '" << fix << "':\n"
                  << json.dump(1);
  }

  fs::path root_ = fs::path(::testing::TempDir()) /
                   (std::string("verp-doctor-") +
                    ::testing::UnitTest::GetInstance()->current_test_info()->name());
  Machine machine_{root_, {{"DISPLAY", ":0"}, {"HOME", "/home/ada"}}};
};

TEST_F(Doctor, AHealthyMachineGivesNoComplaint) {
  const cli::Json json = examined();
  EXPECT_EQ(json.at("good"), true);
  for (const cli::Json& each : json.at("checks")) {
    EXPECT_EQ(each.at("state"), "good") << each.dump();
    EXPECT_EQ(each.at("fix"), "") << each.dump();
  }
}

TEST_F(Doctor, AMissingPackageOfEveryCommandIsBad) {
  put("/var/lib/dpkg/status",
      package("cmake") + package("gcc-arm") + "Package: g++\nStatus: deinstall ok config-files\n");
  expect("bad", "missing for every command: g++",
         "sudo apt-get install --no-install-recommends g++");
}

TEST_F(Doctor, AMissingPackageOfSomeCommandsIsAdvice) {
  put("/var/lib/dpkg/status", package("cmake") + package("g++"));
  expect("advice", "verp flash", "sudo apt-get install --no-install-recommends gcc-arm");
}

TEST_F(Doctor, AnotherSystemIsNamed) {
  put("/etc/os-release", "ID=ubuntu\nVERSION_CODENAME=noble\n");
  expect("advice", "not Debian 12", "docker run");
}

TEST_F(Doctor, APortWithoutPermissionNamesItsGroup) {
  put("/dev/ttyUSB0", "", 0660);
  expect("bad", "no permission", "sudo usermod -aG dialout ada");
}

TEST_F(Doctor, AGroupThatWaitsForTheNextLoginIsNamed) {
  put("/dev/ttyUSB0", "", 0660);
  put("/etc/group", "dialout:x:" + std::to_string(group()) + ":bob,ada\n");
  expect("bad", "no permission", "newgrp dialout  # or log in again");
}

TEST_F(Doctor, AProgramThatHoldsAPortIsNamed) {
  put("/dev/ttyUSB0", "", 0666);
  run(123, "minicom", "/dev/ttyUSB0");
  expect("bad", "minicom (process 123) has it open", "kill -INT 123");
}

TEST_F(Doctor, TheModemManagerIsSwitchedOff) {
  put("/dev/ttyACM0", "", 0666);
  run(9, "ModemManager", "/dev/ttyACM0");
  expect("bad", "ModemManager", "sudo systemctl disable --now ModemManager");
}

TEST_F(Doctor, ALatencyTimerOf16MillisecondsIsSetTo1) {
  put("/dev/ttyUSB0", "", 0666);
  put("/sys/bus/usb-serial/devices/ttyUSB0/latency_timer", "16\n");
  expect("bad", "keeps bytes back for 16 ms", "echo 1 | sudo tee ");
  put("/sys/bus/usb-serial/devices/ttyUSB0/latency_timer", "1\n");
  expect("good", "can be opened", "");
}

TEST_F(Doctor, LimitsThatAreTooLowGetTheirLines) {
  put("/proc/self/limits",
      "Max locked memory         8388608   8388608   bytes\nMax realtime priority     0    0\n");
  expect("advice", "real-time priority and locked memory are not allowed",
         "@dialout - rtprio 40\\n@dialout - memlock unlimited");
  put("/proc/self/status", "Uid:\t0\t0\t0\t0\nCapEff:\t000001ffffffffff\n");
  expect("good", "priority and locked memory are allowed", "");
}

TEST_F(Doctor, AStaleDisplayIsNamedAndWhatWorksWithout) {
  fs::remove(at("/tmp/.X11-unix/X0"));
  expect("advice", "DISPLAY is :0, and no X server is there; only verp view needs one: walk",
         "ssh -X");
}

TEST_F(Doctor, ACanInterfaceWithTroubleGetsItsLine) {
  link::CanInterface can{.name = "can0", .is_can = true};
  machine_.interfaces = [&can] { return std::vector{can}; };
  expect("bad", "the interface is down",
         "sudo ip link set can0 up type can bitrate 1000000 restart-ms 100");
  can.up = true;
  can.bitrate = 500'000;
  expect("advice", "after a bus-off it would stay away", "up type can restart-ms 100");
  can.restart_ms = 100;
  expect("good", "up, 500000 bit/s", "");
  can.bus_off = true;
  expect("bad", "off the bus", "sudo ip link set can0 down && sudo ip link set can0 up");
}

TEST_F(Doctor, AKernelWithoutCanIsNamed) {
  fs::remove_all(at("/sys/module/can"));
  put("/proc/sys/kernel/osrelease", "6.1.0\n");
  put("/lib/modules/6.1.0/modules.dep", "kernel/drivers/net/veth.ko:\n");
  expect("advice", "this kernel has no CAN", "linux-image-");
}

TEST_F(Doctor, AProbeWithoutPermissionGetsItsRule) {
  plug("0483", "374b");
  put("/dev/bus/usb/001/007", "", 0660);
  put("/usr/bin/openocd", "");
  expect("bad", "ST-LINK debug probe: no permission for /dev/bus/usb/001/007",
         "/etc/udev/rules.d/60-verp.rules");
}

TEST_F(Doctor, ABootLoaderWithoutItsProgramGetsThePackage) {
  plug("0483", "df11");
  put("/dev/bus/usb/001/007", "", 0666);
  expect("bad", "dfu-util is missing", "sudo apt-get install dfu-util");
}

TEST_F(Doctor, AnAdapterWithoutADriverGetsItsModule) {
  plug("0403", "6014");
  expect("bad", "its driver is not loaded", "sudo modprobe ftdi_sio");
  put("/sys/bus/usb/devices/1-2/1-2:1.0/ttyUSB0/port_number", "0\n");
  expect("good", "FTDI", "");
}

TEST_F(Doctor, ABrailleDaemonThatTookAnAdapterIsNamed) {
  plug("1a86", "7523");
  run(50, "brltty");
  expect("bad", "brltty took it", "sudo apt-get remove brltty");
}

TEST_F(Doctor, I2cWithoutItsModuleOrPermissionIsNamed) {
  put("/sys/bus/i2c/devices/i2c-1/name", "bcm\n");
  expect("advice", "not in /dev", "sudo modprobe i2c-dev");
  put("/dev/i2c-1", "", 0600);
  expect("advice", "no permission for /dev/i2c-1", "sudo usermod -aG dialout ada");
}

TEST_F(Doctor, AFullDiskIsBad) {
  machine_.free_bytes = [](const std::string&) { return std::uint64_t{5'000'000}; };
  expect("bad", "5 MB are free", "du -xh");
}

TEST_F(Doctor, AFolderThatCannotBeWrittenIsBad) {
  ::chmod(at("/home/ada").c_str(), 0755);
  expect("bad", "/home/ada cannot be written", "cd ~");
}

TEST_F(Doctor, AnotherVerpThatRunsIsNamed) {
  run(321, "verp_robot");
  expect("advice", "process 321 runs: verp_robot --all", "kill -INT 321");
}

TEST_F(Doctor, VariablesThatChangeABuildAreNamed) {
  const Machine other(root_, {{"CCACHE_DISABLE", "1"}, {"VERP_ROBOT_PATH", "/nowhere"}});
  Findings found;
  check_environment(other, found);
  EXPECT_NE(found.text().find("fix: unset CCACHE_DISABLE"), std::string::npos) << found.text();
  EXPECT_NE(found.text().find("names /nowhere, which is not there"), std::string::npos)
      << found.text();
}

}  // namespace
}  // namespace verp::tool
